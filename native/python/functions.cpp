// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.h"
#include "results.h"

#include <mrc/optimize.h>

#include <pybind11/stl.h>

#include <algorithm>

namespace mrc_python {
namespace {

using mrc::Options;
using mrc::Scales;
using mrc::Surface;

/// A contour from vertex ids, or from an earlier result.
mrc::Contour to_contour(const py::object& vertices, bool closed) {
    if (py::isinstance<PyResult>(vertices)) return vertices.cast<const PyResult&>().result.contour;
    const Integers ids = integers(vertices, "vertices");
    require_shape(ids, 0, "vertices");
    if (!closed) throw py::value_error("closed=False: only closed contours can be optimised");
    return mrc::vertex_contour(view(ids), closed);
}

PyResult optimize(const Surface& surface, const py::object& vertices, bool closed, const Options& options, const Scales* scales,
                  const py::object& progress) {
    const mrc::Contour contour = to_contour(vertices, closed);
    mrc::Progress report;
    if (!progress.is_none()) {
        report = [&progress](double share) {
            const py::gil_scoped_acquire acquire;
            const py::object answer = progress(share);
            return !answer.is(py::bool_(false));
        };
    }
    const py::gil_scoped_release release;
    return describe(surface, mrc::optimize(surface, contour, options, scales, report));
}

mrc::Measure measure(const Surface& surface, const py::object& vertices, bool closed, const Options& options, const Scales* scales) {
    const mrc::Contour contour = to_contour(vertices, closed);
    const py::gil_scoped_release release;
    return mrc::measure(surface, contour, options, scales);
}

struct PyCurvature {
    Doubles kappa_min, kappa_max, direction_min, direction_max;
};

PyCurvature curvature(const Surface& surface, const Options& options, const Scales* scales) {
    std::vector<mrc::VertexCurvature> values;
    {
        const py::gil_scoped_release release;
        values = mrc::curvature(surface, options, scales);
    }
    std::vector<double> least, most;
    for (const auto& c : values) {
        least.push_back(c.kappa_min);
        most.push_back(c.kappa_max);
    }
    return {to_array(least), to_array(most), rows_of_three(values, [](const auto& c) { return c.direction_min; }),
            rows_of_three(values, [](const auto& c) { return c.direction_max; })};
}

mrc::SearchSpace make_space(const Surface& surface, const py::object& vertices, bool closed, const Options& options) {
    const mrc::Contour contour = to_contour(vertices, closed);
    const py::gil_scoped_release release;
    return mrc::search_space(surface, contour, options);
}

Integers band_faces(const mrc::SearchSpace& space) {
    std::vector<int> faces;
    for (const int polygon : space.band.polygons) faces.push_back(space.patch.polygon_face[polygon]);
    std::ranges::sort(faces);
    return to_array(faces);
}

Integers band(const Surface& surface, const py::object& vertices, bool closed, const Options& options) {
    const mrc::Contour contour = to_contour(vertices, closed);
    mrc::SearchSpace space;
    {
        const py::gil_scoped_release release;
        space.patch = mrc::make_patch(surface, contour, options.width);
        space.band = mrc::grow_band(space.patch, options);
    }
    return band_faces(space);
}

py::list curves(const mrc::Patch& patch, const std::vector<std::vector<int>>& local) {
    py::list list;
    for (const auto& curve : local) {
        std::vector<int> vertices;
        for (const int v : curve) vertices.push_back(patch.vertex[v]);
        list.append(to_array(vertices));
    }
    return list;
}

void describe_band(py::dict& d, const mrc::SearchSpace& space) {
    const auto& [patch, band, flow, graph] = space;
    std::vector<int> vertices, sides, rounds, triangles;
    for (std::size_t v = 0; v < patch.vertex.size(); ++v) {
        if (band.side[v] == mrc::Side::outside) continue;
        vertices.push_back(patch.vertex[v]);
        sides.push_back(static_cast<int>(band.side[v]));
        rounds.push_back(band.round[v]);
    }
    for (const auto face : patch.mesh.faces()) {
        if (!band.face[face.idx()]) continue;
        for (const auto v : patch.mesh.fv_range(face)) triangles.push_back(patch.vertex[v.idx()]);
    }
    d["faces"] = band_faces(space);
    d["vertices"] = to_array(vertices);
    d["side"] = to_array(sides);
    d["round"] = to_array(rounds);
    d["left"] = curves(patch, band.left);
    d["right"] = curves(patch, band.right);
    d["strips"] = curves(patch, mrc::strip_boundaries(patch, band));
    d["triangles"] = to_array(triangles, 3);
}

void describe_flow(py::dict& d, const mrc::SearchSpace& space) {
    const auto& [patch, band, flow, graph] = space;
    std::vector<int> edges;
    std::vector<double> increments;
    std::vector<int> diagonal;
    for (const auto edge : patch.mesh.edges()) {
        if (!band.edge[edge.idx()]) continue;
        const auto h = patch.mesh.halfedge_handle(edge, 0);
        edges.push_back(patch.vertex[patch.mesh.from_vertex_handle(h).idx()]);
        edges.push_back(patch.vertex[patch.mesh.to_vertex_handle(h).idx()]);
        increments.push_back(flow.increment(patch.mesh, h.idx()));
        diagonal.push_back(patch.diagonal[edge.idx()]);
    }
    d["edges"] = to_array(edges, 2);
    d["increments"] = to_array(increments);
    d["diagonal"] = to_array(diagonal).attr("astype")("bool");
}

void describe_graph(py::dict& d, const mrc::ContourGraph& graph) {
    std::vector<int> nodes, arcs, cut;
    for (const auto& chord : graph.chords) {
        nodes.push_back(graph.points[chord.tail].place.a);
        nodes.push_back(graph.points[chord.head].place.a);
    }
    const mrc::WeightedGraph& search = graph.search;
    for (int n = 0; n < search.node_count(); ++n) {
        for (int a = search.first_arc[n]; a < search.first_arc[n + 1]; ++a) {
            arcs.push_back(graph.chord_of(search.from[a]));
            arcs.push_back(graph.chord_of(n));
        }
    }
    for (int i = 0; i < graph.crossing; ++i) cut.push_back(static_cast<int>(graph.chords.size()) - graph.crossing + i);
    d["nodes"] = to_array(nodes, 2);
    d["arcs"] = to_array(arcs, 2);
    d["f"] = to_array(search.f);
    d["g"] = to_array(search.g);
    d["cut"] = to_array(cut);
    d["level"] = graph.level;
}

py::dict search_space(const Surface& surface, const py::object& vertices, bool closed, const Options& options) {
    const mrc::SearchSpace space = make_space(surface, vertices, closed, options);
    py::dict d;
    describe_band(d, space);
    describe_flow(d, space);
    describe_graph(d, space.graph);
    return d;
}

}  // namespace

void bind_functions(py::module_& module) {
    const Options defaults;
    py::class_<PyCurvature>(module, "Curvature", "Principal curvatures over all vertices, positive where convex (3.4).")
        .def_readonly("kappa_min", &PyCurvature::kappa_min, "(V,) float64, one over the unit of length.")
        .def_readonly("kappa_max", &PyCurvature::kappa_max, "(V,) float64.")
        .def_readonly("direction_min", &PyCurvature::direction_min, "(V, 3) float64, unit tangents; they run along ridges.")
        .def_readonly("direction_max", &PyCurvature::direction_max, "(V, 3) float64, unit tangents; they run along valleys.");
    module.def("optimize", &optimize, py::arg("surface"), py::arg("vertices"), py::arg("closed") = true, py::arg("options") = defaults,
               py::arg("scales") = py::none(), py::arg("progress") = py::none(),
               "Moves a contour to the one of least ratio in a band around it.\n\n"
               "vertices: (N,) ids in order along real edges, the first not repeated; or an earlier Result.\n"
               "scales: those of an earlier result, to go on from it.\n"
               "progress: called with the share done, from 0 to 1; returning False cancels, an exception passes through.\n"
               "Returns a Result. Raises ValueError naming the elements where the contour is no simple loop inside the mesh.");
    module.def("measure", &measure, py::arg("surface"), py::arg("vertices"), py::arg("closed") = true, py::arg("options") = defaults,
               py::arg("scales") = py::none(), "The ratio of a contour, without optimising (eq. 3.3).");
    module.def("curvature", &curvature, py::arg("surface"), py::arg("options") = defaults, py::arg("scales") = py::none(),
               "The curvatures at all vertices; without scales, h is the surface's mean edge length.");
    module.def("band", &band, py::arg("surface"), py::arg("vertices"), py::arg("closed") = true, py::arg("options") = defaults,
               "(n,) int32: the faces that optimize searches first, ascending.");
    module.def("search_space", &search_space, py::arg("surface"), py::arg("vertices"), py::arg("closed") = true,
               py::arg("options") = defaults,
               "All that optimize builds before it searches, as a dict of arrays: for display and tests.\n\n"
               "faces, vertices, side, round, left, right, strips, triangles: the band. edges, increments, diagonal: the flow.\n"
               "nodes, arcs, f, g, cut, level: the graph, nodes in topological order.");
}

}  // namespace mrc_python
