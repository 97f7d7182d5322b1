// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.h"
#include "define.h"
#include "inputs.h"
#include "results.h"
#include "values.h"

namespace mrc_python {
namespace {

using mrc::Contour;

std::size_t hash_of(const Contour& contour) {
    std::size_t hash = contour.closed ? 1 : 0;
    const auto mix = [&hash](std::size_t part) { hash = hash * 1000003 ^ part; };
    for (const mrc::SurfacePoint& p : contour.points) {
        mix(std::hash<int>()(p.a));
        mix(std::hash<int>()(p.b));
        mix(std::hash<double>()(p.t));  // equal for 0.0 and -0.0, as these are
    }
    return hash;
}

std::string text_of(const Contour& contour) {
    return std::string("<mrcontour.Contour: ") + (contour.closed ? "closed" : "open") + ", " +
           std::to_string(contour.points.size()) + " points>";
}

}  // namespace

void bind_contour(py::module_& module) {
    py::class_<Contour> contour(
        module, "Contour", py::module_local(),
        "A closed loop or an open curve: vertices, or points on edges. An immutable value: two are equal where their points\n"
        "and closed are, and len is the number of points. Accepted wherever vertices are, with its own closed.");
    define_constructor(
        contour, &to_contour,
        "vertices: (N,) ids in order along real edges; a closed contour does not repeat its first. Or a Contour or a\n"
        "Result, whose contour and closed are taken.\n"
        "closed: a loop, or an open curve; ignored for a Contour or a Result.\n"
        "edge_vertices, edge_parameters: (N, 2) and (N,), instead of vertices: point i lies at (1 - t) a + t b.\n"
        "Whether it fits a surface is checked where it is used.",
        py::arg("vertices") = py::none(), py::arg("closed") = true, py::arg("edge_vertices") = py::none(),
        py::arg("edge_parameters") = py::none());
    contour.def_property_readonly("vertices", &contour_vertices, "(N,) int32: vertex ids; -1 for points between vertices.")
        .def_property_readonly("edge_vertices", &edge_vertices,
                               "(N, 2) int32: point i lies at (1 - t) a + t b on the edge ab; a vertex is (v, v) with t = 0.")
        .def_property_readonly("edge_parameters", &edge_parameters, "(N,) float64: t of each point.")
        .def_readonly("closed", &Contour::closed, "bool: a loop, or an open curve.")
        .def("__len__", [](const Contour& c) { return c.points.size(); })
        .def("__hash__", &hash_of)
        .def("__repr__", &text_of);
    define_equality(contour);
    define_copies(contour);
    contour.def(
        py::pickle([](const Contour& c) { return py::make_tuple(edge_vertices(c), edge_parameters(c), c.closed); },
                   [](const py::tuple& state) { return to_contour(py::none(), state[2].cast<bool>(), state[0], state[1]); }));
}

}  // namespace mrc_python
