// SPDX-License-Identifier: GPL-3.0-or-later
#include "results.h"

#include "bindings.h"
#include "values.h"

#include "number_text.h"
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
                                       "'shared_faces'", "'none_refined'", "'slipped_off'", "'cancelled'">;
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
        case mrc::Reason::slipped_off:
            return "slipped_off";
        case mrc::Reason::cancelled:
            return "cancelled";
    }
    return "";
}

py::tuple scales_state(const Scales& s) { return py::make_tuple(s.h, s.K, s.kappa_0, s.L0, s.clamp, s.n0, s.given); }

Scales scales_from_state(const py::tuple& state) {
    return {state[0].cast<double>(), state[1].cast<double>(), state[2].cast<double>(),      state[3].cast<double>(),
            state[4].cast<double>(), state[5].cast<int>(),    state[6].cast<mrc::Contour>()};
}

void bind_scales(py::module_& module) {
    py::class_<Scales> scales(
        module, "Scales", py::module_local(),
        "The scales of a contour, fixed before its first iteration. K and kappa_0 are in one over the mesh's unit of length.");
    scales.def("__hash__", [](const Scales& s) { return py::hash(scales_state(s)); });
    define_equality(scales);
    define_copies(scales);
    scales.def(py::pickle(&scales_state, &scales_from_state));
    scales
        .def_readonly("h", &Scales::h, "Mean along the contour of the surface's local scale, about 0.84 edges, in the mesh's unit.")
        .def_readonly("K", &Scales::K, "Area-weighted mean of |kappa_min| nearby (ridge: |kappa_max|), at least 0.01 / L0.")
        .def_readonly("kappa_0", &Scales::kappa_0, "The constant of eq. 3.2: kappa0_factor K.")
        .def_readonly("L0", &Scales::L0, "Length of the contour, in the mesh's unit.")
        .def_readonly("clamp", &Scales::clamp, "Where the size of feature curvatures is cut off; infinity: nowhere.")
        .def_readonly("n0", &Scales::n0, "Its number of arcs, with the Steiner points of the search.")
        .def_property_readonly(
            "given", [](const Scales& s) { return contour_vertices(s.given); },
            "(N,) int32: the contour's vertices; -1 for points between vertices.")
        .def_readonly("given_contour", &Scales::given, "The Contour itself.")
        .def_property_readonly(
            "given_edge_vertices", [](const Scales& s) { return edge_vertices(s.given); }, "(N, 2) int32, as Result.edge_vertices.")
        .def_property_readonly(
            "given_edge_parameters", [](const Scales& s) { return edge_parameters(s.given); },
            "(N,) float64, as Result.edge_parameters.");
}

py::tuple measure_state(const mrc::Measure& m) { return py::make_tuple(m.ratio, m.numerator, m.length, m.objective, m.salience); }

mrc::Measure measure_from_state(const py::tuple& state) {
    return {state[0].cast<double>(), state[1].cast<double>(), state[2].cast<double>(), state[3].cast<double>(),
            state[4].cast<double>()};
}

void bind_measure(py::module_& module) {
    py::class_<mrc::Measure> measure(module, "Measure", py::module_local(), "The energy of a contour (eq. 3.3).");
    measure.def("__hash__", [](const mrc::Measure& m) { return py::hash(measure_state(m)); });
    define_equality(measure);
    define_copies(measure);
    measure.def(py::pickle(&measure_state, &measure_from_state));
    measure
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

/// The value of an enumeration that has a name.
template <class Enum>
Enum named(const py::handle& name, const char* (*name_of)(Enum), Enum last) {
    for (int i = 0; i <= static_cast<int>(last); ++i) {
        if (name.cast<std::string>() == name_of(static_cast<Enum>(i))) return static_cast<Enum>(i);
    }
    throw py::value_error("a pickled result has the unknown name '" + name.cast<std::string>() + "'");
}

constexpr std::pair<const char*, double mrc::Result::*> result_numbers[] = {
    {"length", &mrc::Result::length},
    {"ratio", &mrc::Result::ratio},
    {"initial_ratio", &mrc::Result::initial_ratio},
    {"objective", &mrc::Result::objective},
    {"initial_objective", &mrc::Result::initial_objective},
    {"salience", &mrc::Result::salience},
    {"lower_bound", &mrc::Result::lower_bound},
    {"gap", &mrc::Result::gap},
};

constexpr std::pair<const char*, int mrc::Statistics::*> statistics_numbers[] = {
    {"faces", &mrc::Statistics::faces},
    {"cut", &mrc::Statistics::cut},
    {"nodes", &mrc::Statistics::nodes},
    {"arcs", &mrc::Statistics::arcs},
    {"linear_steps", &mrc::Statistics::linear_steps},
    {"passes", &mrc::Statistics::passes},
    {"iterations", &mrc::Statistics::iterations},
    {"rings", &mrc::Statistics::rings},
};

Dict statistics(const PyResult& r) {
    Dict d;
    for (const auto& [name, member] : statistics_numbers) d[name] = r.result.statistics.*member;
    d["seconds"] = py::cast(r.result.statistics.seconds);
    return d;
}

py::dict result_state(const PyResult& r) {
    py::dict state;
    for (const auto& [name, member] : result_numbers) state[name] = r.result.*member;
    state["contour"] = r.result.contour;
    state["status"] = status_name(r.result.status);
    state["reason_code"] = reason_name(r.result.reason_code);
    state["reason"] = r.result.reason;
    state["history"] = r.result.history;
    state["held_back_by"] = r.result.held_back_by;
    state["non_manifold"] = r.result.non_manifold;
    state["scales"] = r.result.scales;
    state["statistics"] = statistics(r);
    state["positions"] = rows_of_three(r.positions, [](const mrc::Vec3& p) { return p; });
    state["segment_faces"] = to_array(r.segment_faces);
    return state;
}

PyResult result_from_state(const py::dict& state) {
    PyResult r;
    for (const auto& [name, member] : result_numbers) r.result.*member = state[name].cast<double>();
    r.result.contour = state["contour"].cast<mrc::Contour>();
    r.result.status = named(state["status"], &status_name, mrc::Status::cancelled);
    r.result.reason_code = named(state["reason_code"], &reason_name, mrc::Reason::cancelled);
    r.result.reason = state["reason"].cast<std::string>();
    r.result.history = state["history"].cast<std::vector<double>>();
    r.result.held_back_by = state["held_back_by"].cast<std::vector<int>>();
    r.result.non_manifold = state["non_manifold"].cast<std::vector<int>>();
    r.result.scales = state["scales"].cast<Scales>();
    const py::dict counts = state["statistics"];
    for (const auto& [name, member] : statistics_numbers) r.result.statistics.*member = counts[name].cast<int>();
    r.result.statistics.seconds = counts["seconds"].cast<std::map<std::string, double>>();
    const Doubles positions = doubles(state["positions"], "positions");
    for (py::ssize_t i = 0; i < positions.shape(0); ++i) {
        r.positions.emplace_back(positions.at(i, 0), positions.at(i, 1), positions.at(i, 2));
    }
    const Integers faces = integers(state["segment_faces"], "segment_faces");
    r.segment_faces.assign(faces.data(), faces.data() + faces.size());
    return r;
}

}  // namespace

Integers contour_vertices(const mrc::Contour& contour) {
    std::vector<int> vertices;
    for (const auto& p : contour.points) vertices.push_back(p.is_vertex() ? p.a : -1);
    return to_array(vertices);
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

PyResult describe(const mrc::Surface& surface, mrc::Result result) {
    PyResult described;
    for (const auto& p : result.contour.points) described.positions.push_back(surface.position(p));
    described.segment_faces = mrc::segment_faces(surface, result.contour);
    described.result = std::move(result);
    return described;
}

namespace {

using ResultClass = py::class_<PyResult>;

void bind_outcome(ResultClass& result) {
    result
        .def_property_readonly(
            "status", [](const PyResult& r) { return StatusName(py::str(status_name(r.result.status))); },
            "'improved', 'unchanged' (the given contour is returned), 'constrained' (it broke a requirement, and the best that "
            "keeps\n"
            "all is returned, whatever its ratio) or 'cancelled' (the given contour is returned).")
        .def_property_readonly(
            "reason_code", [](const PyResult& r) { return ReasonName(py::str(reason_name(r.result.reason_code))); },
            "The same as reason for programs: 'already_best', 'not_salient', 'no_room', 'against_flow', 'no_neighbour',\n"
            "'shared_faces', 'none_refined', 'slipped_off', 'cancelled', or empty.")
        .def_property_readonly(
            "reason", field(&mrc::Result::reason),
            "In words: why the given contour is returned or, for a 'constrained' result, that nothing concave was found\n"
            "(min_salience); otherwise, and where no iteration was asked for, empty.")
        .def_property_readonly("ratio", field(&mrc::Result::ratio), "Of the contour returned (eq. 3.3); the lower, the better.")
        .def_property_readonly("initial_ratio", field(&mrc::Result::initial_ratio), "Of the given contour.")
        .def_property_readonly(
            "objective", field(&mrc::Result::objective),
            "What is minimized, of the contour returned: the ratio, or with a length bias a number without unit.")
        .def_property_readonly("initial_objective", field(&mrc::Result::initial_objective), "Of the given contour.")
        .def_property_readonly(
            "salience", field(&mrc::Result::salience),
            "How far to trust the best found, even where the given contour is returned: minus the ratio of eq. 3.2's energy alone\n"
            "(with feature_clamp; without anchor, crease, attractors and region), over K. Above 2 it is nearly always right,\n"
            "below 0.5 seldom.")
        .def_property_readonly("lower_bound", field(&mrc::Result::lower_bound),
                               "No contour of the last iteration's graph has a lower objective.")
        .def_property_readonly("gap", field(&mrc::Result::gap), "Objective of the best found minus lower_bound, never negative.");
}

void bind_search(ResultClass& result) {
    result
        .def_property_readonly(
            "held_back_by", [](const PyResult& r) { return py::typing::Tuple<int, py::ellipsis>(py::cast(r.result.held_back_by)); },
            "tuple of int: the contours of optimize_all that kept this one's last band from growing, by their place in the "
            "list.")
        .def_property_readonly(
            "non_manifold", [](const PyResult& r) { return to_array(r.result.non_manifold); },
            "(N,) int32: vertices at which the last band had to stop, since faces beside it meet there in a point, more than two "
            "in\n"
            "an edge, or two whose normals disagree.")
        .def_property_readonly(
            "history", field(&mrc::Result::history),
            "list of float: the objective of the contour that the iterations start from, then that after each iteration that\n"
            "had a band: one such series for regular_iterations and one for iterations. It never rises within a series. Where\n"
            "the given contour breaks a requirement, the first contour that keeps all is the start.")
        .def_property_readonly("scales", field(&mrc::Result::scales),
                               "The Scales of the given contour; pass them to optimize to continue from here.")
        .def_property_readonly(
            "statistics", &statistics,
            "dict: faces, cut, nodes, arcs, linear_steps and passes of the last iteration, as in tables 5.1 and 5.2; iterations, "
            "done in all; rings, how many edges lead from the given contour to the farthest point of the one returned; seconds, a "
            "dict of the time that each stage took.");
}

void bind_contour_found(ResultClass& result) {
    result.def_property_readonly("contour", field(&mrc::Result::contour), "The Contour found.")
        .def_property_readonly("length", field(&mrc::Result::length),
                               "Of the contour returned along its segments, in the mesh's unit.")
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
            "(N,) int32, of an open contour (N - 1,): a face that holds the segment from each point to the next; along an edge\n"
            "the left one.");
}

}  // namespace

void bind_results(py::module_& module) {
    bind_scales(module);
    bind_measure(module);
    ResultClass result(module, "Result", py::module_local(),
                       "What optimize found. Ratios are in one over the mesh's unit of length (denominator 'arcs': without unit).");
    define_copies(result);
    result.def(py::pickle(&result_state, &result_from_state));
    bind_outcome(result);
    bind_search(result);
    bind_contour_found(result);
    result.def("__repr__", [](const PyResult& r) {
        return std::string("<mrcontour.Result: ") + status_name(r.result.status) + ", ratio " +
               mrc::number_text(r.result.initial_ratio) + " -> " + mrc::number_text(r.result.ratio) + ">";
    });
}

}  // namespace mrc_python
