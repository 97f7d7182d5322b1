// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include "bindings.h"

#include "trace_contour.h"

#include <mrc/measure.h>

#include <pybind11/stl.h>

#include <algorithm>

namespace mrc_python {
namespace {

using mrc::Scales;

#ifdef PYBIND11_TYPING_H_HAS_STRING_LITERAL
using StatusName = py::typing::Literal<"'improved'", "'unchanged'", "'constrained'", "'cancelled'">;
using ReasonName = py::typing::Literal<"''", "'already_best'", "'not_salient'", "'no_room'", "'against_flow'", "'no_neighbour'",
                                       "'shared_faces'", "'none_refined'", "'cancelled'">;
#else  // clang before 18 takes no text as a template's argument
using StatusName = py::str;
using ReasonName = py::str;
#endif

const char* status_name(mrc::Status status) {
    switch (status) {
        case mrc::Status::improved:
            return "improved";
        case mrc::Status::unchanged:
            return "unchanged";
        case mrc::Status::constrained:
            return "constrained";
        case mrc::Status::cancelled:
            return "cancelled";
    }
    return "";
}

const char* reason_name(mrc::Reason reason) {
    switch (reason) {
        case mrc::Reason::none:
            return "";
        case mrc::Reason::already_best:
            return "already_best";
        case mrc::Reason::not_salient:
            return "not_salient";
        case mrc::Reason::no_room:
            return "no_room";
        case mrc::Reason::against_flow:
            return "against_flow";
        case mrc::Reason::no_neighbour:
            return "no_neighbour";
        case mrc::Reason::shared_faces:
            return "shared_faces";
        case mrc::Reason::none_refined:
            return "none_refined";
        case mrc::Reason::cancelled:
            return "cancelled";
    }
    return "";
}

Integers edge_vertices(const mrc::Contour& contour) {
    std::vector<int> ends;
    for (const auto& p : contour.points) ends.insert(ends.end(), {p.a, p.b});
    return to_array(ends, 2);
}

Doubles edge_parameters(const mrc::Contour& contour) {
    std::vector<double> parameters;
    for (const auto& p : contour.points) parameters.push_back(p.t);
    return to_array(parameters);
}

Dict statistics(const PyResult& r) {
    const mrc::Statistics& s = r.result.statistics;
    Dict d;
    d["faces"] = s.faces;
    d["cut"] = s.cut;
    d["nodes"] = s.nodes;
    d["arcs"] = s.arcs;
    d["linear_steps"] = s.linear_steps;
    d["passes"] = s.passes;
    d["iterations"] = s.iterations;
    d["seconds"] = py::cast(s.seconds);
    return d;
}

void bind_scales(py::module_& module) {
    py::class_<Scales>(
        module, "Scales",
        "The scales of a contour, fixed before its first iteration. K and kappa_0 are in one over the mesh's unit of length.")
        .def_readonly("h", &Scales::h, "Mean edge length within 4 rings of the contour, in the mesh's unit.")
        .def_readonly("K", &Scales::K, "Area-weighted mean of |kappa_min| there (ridge: |kappa_max|), at least 0.01 / L0.")
        .def_readonly("kappa_0", &Scales::kappa_0, "The constant of eq. 3.2: kappa0_factor K.")
        .def_readonly("L0", &Scales::L0, "Length of the contour, in the mesh's unit.")
        .def_readonly("clamp", &Scales::clamp, "Where the size of feature curvatures is cut off; infinity: nowhere.")
        .def_readonly("n0", &Scales::n0, "Its number of arcs, with the Steiner points of the run.")
        .def_property_readonly(
            "given", [](const Scales& s) { return contour_vertices(s.given); },
            "(N,) int32: the contour's vertices; -1 for points between vertices.")
        .def_property_readonly(
            "given_edge_vertices", [](const Scales& s) { return edge_vertices(s.given); }, "(N, 2) int32, as Result.edge_vertices.")
        .def_property_readonly(
            "given_edge_parameters", [](const Scales& s) { return edge_parameters(s.given); },
            "(N,) float64, as Result.edge_parameters.");
}

void bind_measure(py::module_& module) {
    py::class_<mrc::Measure>(module, "Measure", "The energy of a contour (eq. 3.3).")
        .def_readonly("ratio", &mrc::Measure::ratio,
                      "numerator / length, in one over the mesh's unit of length (denominator 'arcs': without unit).")
        .def_readonly("numerator", &mrc::Measure::numerator, "The sum of f over the arcs (eq. 3.2), without unit.")
        .def_readonly("length", &mrc::Measure::length,
                      "The sum of g over the arcs (eq. 3.1), in the mesh's unit (denominator 'arcs': their number).")
        .def_readonly(
            "objective", &mrc::Measure::objective,
            "What is minimized: the ratio, or with a length bias ratio / K + length_bias max(length / L0, length_floor).");
}

template <class Value>
auto field(Value mrc::Result::*member) {
    return [member](const PyResult& r) { return r.result.*member; };
}

}  // namespace

Integers contour_vertices(const mrc::Contour& contour) {
    std::vector<int> vertices;
    for (const auto& p : contour.points) vertices.push_back(p.is_vertex() ? p.a : -1);
    return to_array(vertices);
}

PyResult describe(const mrc::Surface& surface, mrc::Result result) {
    PyResult described;
    for (const auto& p : result.contour.points) described.positions.push_back(surface.position(p));
    described.segment_faces = mrc::segment_faces(surface, result.contour);
    described.result = std::move(result);
    return described;
}

void bind_results(py::module_& module) {
    bind_scales(module);
    bind_measure(module);
    py::class_<PyResult>(
        module, "Result",
        "What optimize found. Ratios are in one over the mesh's unit of length (denominator 'arcs': without unit).")
        .def_property_readonly(
            "status", [](const PyResult& r) { return StatusName(py::str(status_name(r.result.status))); },
            "'improved', 'unchanged' (the given contour is returned), 'constrained' (it broke a requirement, and the best that "
            "keeps\n"
            "all is returned, whatever its ratio) or 'cancelled' (the given contour is returned).")
        .def_property_readonly(
            "reason_code", [](const PyResult& r) { return ReasonName(py::str(reason_name(r.result.reason_code))); },
            "The same as reason for programs: 'already_best', 'not_salient', 'no_room', 'against_flow', 'no_neighbour',\n"
            "'shared_faces', 'none_refined', 'cancelled', or empty.")
        .def_property_readonly(
            "reason", field(&mrc::Result::reason),
            "In words: why the given contour is returned; of a 'constrained' result that nothing concave was found\n"
            "(min_salience); else, and where no iteration was asked for, empty.")
        .def_property_readonly("ratio", field(&mrc::Result::ratio), "Of the contour returned (eq. 3.3); the lower, the better.")
        .def_property_readonly("initial_ratio", field(&mrc::Result::initial_ratio), "Of the given contour.")
        .def_property_readonly(
            "objective", field(&mrc::Result::objective),
            "What is minimized, of the contour returned: the ratio, or with a length bias a number without unit.")
        .def_property_readonly("initial_objective", field(&mrc::Result::initial_objective), "Of the given contour.")
        .def_property_readonly(
            "salience", field(&mrc::Result::salience),
            "How far to trust the best found, even where the given contour is returned: minus the ratio of eq. 3.2's energy alone\n"
            "(with feature_clamp; without anchor, crease, attractors and region), over K. Above 2 nearly always right, below 0.5\n"
            "seldom.")
        .def_property_readonly("lower_bound", field(&mrc::Result::lower_bound),
                               "No contour of the last iteration's graph has a lower objective.")
        .def_property_readonly("gap", field(&mrc::Result::gap), "Objective of the best found minus lower_bound, never negative.")
        .def_property_readonly(
            "held_back_by", [](const PyResult& r) { return py::typing::Tuple<int, py::ellipsis>(py::cast(r.result.held_back_by)); },
            "tuple of int: of optimize_all's contours those that kept this one's last band from growing, by their place in the "
            "list.")
        .def_property_readonly(
            "history", field(&mrc::Result::history),
            "list of float: the objective after each iteration that had a band, before these that of the contour they start from:\n"
            "once for the regular_iterations and once for those with refinement. It never rises but between these.\n"
            "Where the given contour breaks a requirement, the first that keeps all is the start.")
        .def_property_readonly("scales", field(&mrc::Result::scales),
                               "The Scales of the given contour; give them back to go on from here.")
        .def_property_readonly(
            "statistics", &statistics,
            "dict: faces, cut, nodes, arcs, linear_steps and passes of the last iteration, as in tables 5.1 and 5.2; iterations, "
            "done in all; seconds, a dict of the time of each stage.")
        .def_property_readonly(
            "closed", [](const PyResult& r) { return r.result.contour.closed; }, "bool: a loop, or an open curve.")
        .def_property_readonly(
            "vertices", [](const PyResult& r) { return contour_vertices(r.result.contour); },
            "(N,) int32: vertex ids in order, in the given direction; -1 for the points of a refined contour between vertices.")
        .def_property_readonly(
            "edge_vertices", [](const PyResult& r) { return edge_vertices(r.result.contour); },
            "(N, 2) int32: point i lies at (1 - t) a + t b on the edge ab; a vertex is (v, v) with t = 0.")
        .def_property_readonly(
            "edge_parameters", [](const PyResult& r) { return edge_parameters(r.result.contour); },
            "(N,) float64: t of each point.")
        .def_property_readonly(
            "positions", [](const PyResult& r) { return rows_of_three(r.positions, [](const mrc::Vec3& p) { return p; }); },
            "(N, 3) float64: the points in space, in the mesh's unit.")
        .def_property_readonly(
            "segment_faces", [](const PyResult& r) { return to_array(r.segment_faces); },
            "(N,) int32, of an open contour (N - 1,): a face that holds the segment from each point to the next; along an edge "
            "the\n"
            "left one.")
        .def("__repr__", [](const PyResult& r) {
            return std::string("<mrcontour.Result: ") + status_name(r.result.status) + ", ratio " +
                   std::to_string(r.result.initial_ratio) + " -> " + std::to_string(r.result.ratio) + ">";
        });
}

}  // namespace mrc_python
