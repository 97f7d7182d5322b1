// SPDX-License-Identifier: GPL-3.0-or-later
#include "bindings.h"
#include "define.h"
#include "errors.h"
#include "inputs.h"
#include "results.h"
#include "search_space.h"

#include <mrc/band.h>
#include <mrc/check_contour.h>
#include <mrc/close_contour.h>
#include <mrc/curvature.h>
#include <mrc/measure.h>
#include <mrc/optimize.h>

#include <pybind11/stl.h>

#include <algorithm>
#include <optional>

namespace mrc_python {
namespace {

using mrc::Options;
using mrc::Scales;
using mrc::Surface;

using Sides = py::array_t<int8_t, readable>;

PyResult optimize(const Surface& surface, const py::object& vertices, bool closed, const Options& options,
                  const py::object& required_vertices, const py::object& required_edges, const Iterable& attractors,
                  const py::object& barriers, const py::object& region_density, const std::optional<Scales>& scales,
                  const py::object& progress, const py::object& edge_vertices, const py::object& edge_parameters) {
    const mrc::Contour contour = to_contour(vertices, closed, edge_vertices, edge_parameters);
    const Density density = to_density(region_density);
    const mrc::Constraints constraints = to_constraints(required_vertices, required_edges, attractors, barriers, density);
    const mrc::Progress report = to_progress(progress);
    const py::gil_scoped_release release;
    return describe(surface, mrc::optimize(surface, contour, options, constraints, scales, report));
}

/// Whether the argument `errors` asks for errors to be returned.
bool returns_errors(const py::object& errors) {
    const std::string words = py::isinstance<py::str>(errors) ? py::cast<std::string>(errors) : "";
    if (words == "return") return true;
    if (words == "raise") return false;
    throw py::value_error("errors is " + py::cast<std::string>(py::repr(errors)) + ": it must be 'raise' or 'return'");
}

std::vector<mrc::Outcome> outcomes_of(const Surface& surface, const std::vector<mrc::Task>& tasks, const Options& options,
                                      const mrc::Progress& progress, bool return_errors) {
    if (return_errors) return mrc::optimize_each(surface, tasks, options, progress);
    std::vector<mrc::Outcome> outcomes;
    for (mrc::Result& result : mrc::optimize_all(surface, tasks, options, progress)) outcomes.emplace_back(std::move(result));
    return outcomes;
}

py::list optimize_all(const Surface& surface, const Iterable& contours, const py::object& closed, const Options& options,
                      const py::object& required_vertices, const py::object& required_edges, const Iterable& attractors,
                      const py::object& barriers, const py::object& region_density, const py::object& scales,
                      const py::object& progress, const py::object& errors) {
    const bool return_errors = returns_errors(errors);
    const Density density = to_density(region_density);
    const mrc::Constraints shared = to_constraints(py::tuple(), py::tuple(), attractors, barriers, density);
    const Tasks given = to_tasks(contours, closed, required_vertices, required_edges, shared, scales, return_errors);
    const mrc::Progress report = to_progress(progress);
    std::vector<mrc::Outcome> outcomes;
    {
        const py::gil_scoped_release release;
        outcomes = outcomes_of(surface, given.tasks, options, report, return_errors);
    }
    for (const auto& [place, error] : given.errors) outcomes[place] = error;
    py::list described;  // of results, or errors where these are asked for: no signature can say which
    for (mrc::Outcome& outcome : outcomes) {
        if (const auto* error = std::get_if<mrc::InvalidInput>(&outcome)) {
            described.append(to_python(*error));
        } else {
            described.append(describe(surface, std::get<mrc::Result>(std::move(outcome))));
        }
    }
    return described;
}

py::typing::Optional<PyInvalidInput> check_contour(const Surface& surface, const py::object& vertices, bool closed,
                                                   const py::object& barriers, const py::object& edge_vertices,
                                                   const py::object& edge_parameters) {
    const mrc::Contour contour = to_contour(vertices, closed, edge_vertices, edge_parameters);
    const std::vector<std::array<int, 2>> edges = edge_pairs(barriers, "barriers");
    const mrc::Progress interruption = to_progress(py::none());
    std::optional<mrc::InvalidInput> error;
    {
        const py::gil_scoped_release release;
        error = mrc::check_contour(surface, contour, edges, interruption);
    }
    if (!error) return py::none();
    return to_python(*error);
}

mrc::Measure measure(const Surface& surface, const py::object& vertices, bool closed, const Options& options,
                     const Iterable& attractors, const py::object& region_density, const std::optional<Scales>& scales,
                     const py::object& edge_vertices, const py::object& edge_parameters) {
    const mrc::Contour contour = to_contour(vertices, closed, edge_vertices, edge_parameters);
    const Density density = to_density(region_density);
    const mrc::Constraints constraints = to_constraints(py::tuple(), py::tuple(), attractors, py::tuple(), density);
    const mrc::Progress interruption = to_progress(py::none());
    const py::gil_scoped_release release;
    return mrc::measure(surface, contour, options, constraints, scales, interruption);
}

py::typing::Optional<Integers> close_contour(const Surface& surface, const py::object& vertices, const py::object& progress) {
    const mrc::Contour chain = to_contour(vertices, false, py::none(), py::none());
    const mrc::Progress report = to_progress(progress);
    mrc::Contour loop;
    {
        const py::gil_scoped_release release;
        loop = mrc::close_contour(surface, chain, report);
    }
    if (loop.points.empty()) return py::none();
    return contour_vertices(loop);
}

struct PyCurvature {
    Doubles kappa_min, kappa_max, direction_min, direction_max;
};

PyCurvature curvature(const Surface& surface, const Options& options, const std::optional<Scales>&) {
    const mrc::Progress interruption = to_progress(py::none());
    std::vector<mrc::VertexCurvature> values;
    {
        const py::gil_scoped_release release;
        values = mrc::curvature(surface, options, interruption);
    }
    std::vector<double> least, most;
    least.reserve(values.size()), most.reserve(values.size());
    for (const auto& c : values) {
        least.push_back(c.kappa_min);
        most.push_back(c.kappa_max);
    }
    return {to_array(least), to_array(most), rows_of_three(values, [](const auto& c) { return c.direction_min; }),
            rows_of_three(values, [](const auto& c) { return c.direction_max; })};
}

Integers band_faces(const mrc::SearchSpace& space) {
    std::vector<int> faces;
    faces.reserve(space.band.polygons.size());
    for (const int polygon : space.band.polygons) faces.push_back(space.patch.polygon_face[polygon]);
    std::ranges::sort(faces);
    return to_array(faces);
}

py::typing::Union<Integers, py::typing::Tuple<Integers, Sides>> band(const Surface& surface, const py::object& vertices,
                                                                     bool closed, const Options& options,
                                                                     const py::object& edge_vertices,
                                                                     const py::object& edge_parameters, bool sides) {
    const mrc::Contour contour = to_contour(vertices, closed, edge_vertices, edge_parameters);
    const mrc::Progress interruption = to_progress(py::none());
    mrc::BandFaces found;
    {
        const py::gil_scoped_release release;
        found = mrc::band(surface, contour, options, interruption);
    }
    Integers faces = to_array(found.faces);
    if (!sides) return faces;
    Sides array(static_cast<py::ssize_t>(found.sides.size()));
    std::ranges::copy(found.sides, array.mutable_data());
    return py::make_tuple(faces, array);
}

py::list curves(const mrc::Patch& patch, const std::vector<std::vector<int>>& local) {
    py::list list;
    for (const auto& curve : local) {
        std::vector<int> vertices;
        vertices.reserve(curve.size());
        for (const int v : curve) vertices.push_back(patch.vertex[v]);
        list.append(to_array(vertices));
    }
    return list;
}

void describe_band(Dict& d, const mrc::SearchSpace& space) {
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

void describe_flow(Dict& d, const mrc::SearchSpace& space) {
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

/// Nodes are pairs of vertices in the regular graph, of points in a refined one.
void describe_graph(Dict& d, const mrc::ContourGraph& graph) {
    const bool refined = std::ranges::any_of(graph.points, [](const auto& p) { return !p.place.is_vertex(); });
    std::vector<int> nodes, arcs, cut;
    for (const auto& chord : graph.chords) {
        nodes.push_back(refined ? chord.tail : graph.points[chord.tail].place.a);
        nodes.push_back(refined ? chord.head : graph.points[chord.head].place.a);
    }
    std::vector<int> points;
    std::vector<double> parameters;
    for (const auto& point : graph.points) {
        points.insert(points.end(), {point.place.a, point.place.b});
        parameters.push_back(point.place.t);
    }
    d["points"] = to_array(points, 2);
    d["parameters"] = to_array(parameters);
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

Dict search_space(const Surface& surface, const py::object& vertices, bool closed, const Options& options,
                  const py::object& edge_vertices, const py::object& edge_parameters) {
    const mrc::Contour contour = to_contour(vertices, closed, edge_vertices, edge_parameters);
    const mrc::Progress interruption = to_progress(py::none());
    mrc::SearchSpace space;
    {
        const py::gil_scoped_release release;
        space = mrc::search_space(surface, contour, options, {}, std::nullopt, interruption);
    }
    Dict d;
    describe_band(d, space);
    describe_flow(d, space);
    describe_graph(d, space.graph);
    return d;
}

/// For type checkers: with sides there are two arrays.
std::string overloads_by_sides(const std::string& documentation) {
    const std::string sides = ", sides: bool = False) -> ", arrow = " | ";
    const std::size_t end = documentation.find(sides), line = documentation.find('\n');
    const std::string arguments = documentation.substr(0, end), words = documentation.substr(line);
    const std::string returned = documentation.substr(end + sides.size(), line - end - sides.size());
    const std::size_t bar = returned.find(arrow);
    return "band(*args, **kwargs)\nOverloaded function.\n\n1. " + arguments + ", sides: typing.Literal[False] = False) -> " +
           returned.substr(0, bar) + words + "\n2. " + arguments + ", *, sides: typing.Literal[True]) -> " +
           returned.substr(bar + arrow.size()) + words;
}

void bind_curvature(py::module_& module) {
    py::class_<PyCurvature>(module, "Curvature", py::module_local(),
                            "Principal curvatures over all vertices, positive where convex (3.4).")
        .def(py::pickle(
            [](const PyCurvature& c) { return py::make_tuple(c.kappa_min, c.kappa_max, c.direction_min, c.direction_max); },
            [](const py::tuple& state) {
                return PyCurvature{state[0].cast<Doubles>(), state[1].cast<Doubles>(), state[2].cast<Doubles>(),
                                   state[3].cast<Doubles>()};
            }))
        .def_readonly("kappa_min", &PyCurvature::kappa_min, "(V,) float64, one over the unit of length.")
        .def_readonly("kappa_max", &PyCurvature::kappa_max, "(V,) float64, one over the unit of length.")
        .def_readonly("direction_min", &PyCurvature::direction_min, "(V, 3) float64, unit tangents; they run along ridges.")
        .def_readonly("direction_max", &PyCurvature::direction_max, "(V, 3) float64, unit tangents; they run along valleys.");
}

void bind_searches(py::module_& module, const py::arg_v& defaults) {
    const py::tuple nothing;
    define(
        module, "optimize", &optimize,
        "Moves a contour to the one of least ratio in a band around it (Clements 2006, chapter 4).\n\n"
        "surface: a Surface; closed: a loop, or an open curve; options: an Options.\n"
        "vertices: (N,) ids (whole numbers) in order along real edges; a closed contour does not repeat its first; or a Contour\n"
        "or an earlier Result, which bring their own closed: the argument is ignored.\n"
        "edge_vertices, edge_parameters: (N, 2) and (N,), a contour across faces: point i lies at (1 - t) a + t b.\n"
        "required_vertices, required_edges: ids and (n, 2) vertex pairs that the contour must contain (4.4).\n"
        "attractors: (vertex, radius, strength) or (vertex, radius, strength, sigma), soft constraints (4.5): radius and sigma in\n"
        "the mesh's unit, sigma half the radius where it is not given; strength in K; below 0 it repels.\n"
        "barriers: (n, 2) vertex pairs, edges that no contour may cross, including the given one.\n"
        "region_density: (F,) float64 per area, for closed contours only: the option region_weight weighs how much of it the side\n"
        "region_side gains or loses (6.1.2).\n"
        "scales: those of an earlier result, to continue from it.\n"
        "progress: called with the fraction done, from 0 to 1, three times per iteration, and every few milliseconds\n"
        "during long phases; returning False cancels, an exception passes through. Ctrl-C ends the call with or without\n"
        "it. Only the ordering of the harmonic flow's equations cannot be interrupted, about 0.2 s where 10^6 triangles are\n"
        "searched.\n"
        "Returns a Result. Raises InvalidInput, a ValueError that names the elements, where the contour is not simple, not inside\n"
        "the mesh or crosses a barrier; of these Infeasible, where no contour of the band has all required elements, and "
        "TooLarge,\n"
        "where the search would take more memory than there is. Ids that are no whole numbers are a TypeError.",
        py::arg("surface"), py::arg("vertices") = py::none(), py::arg("closed") = true, defaults,
        py::arg("required_vertices") = nothing, py::arg("required_edges") = nothing, py::arg("attractors") = nothing,
        py::arg("barriers") = nothing, py::arg("region_density") = py::none(), py::arg("scales") = py::none(),
        py::arg("progress") = py::none(), py::arg("edge_vertices") = py::none(), py::arg("edge_parameters") = py::none());
    define(
        module, "optimize_all", &optimize_all,
        "Optimizes several contours of one surface, in parallel; they never cross or touch where the given ones did not (1.4).\n\n"
        "contours: a sequence, each as (N,) vertex ids, as a tuple of edge_vertices (N, 2) and edge_parameters (N,), as a\n"
        "Contour or as an earlier Result.\n"
        "closed, required_vertices, required_edges, scales: one for all contours, or a sequence with one for each. A Contour or\n"
        "Result brings its own closed, and the argument is ignored.\n"
        "The other arguments are those of optimize.\n"
        "Each contour searches the faces that are nearer to it than to any other; what two bands have in common is closed to\n"
        "both. The results do not depend on the order of the contours, nor on the option threads.\n"
        "errors: 'raise', or 'return': a contour in error gets its InvalidInput instead of a Result and stays where it is,\n"
        "and the others are optimized all the same. Where it runs along real edges, they do not cross it.\n"
        "Returns a list of Results; held_back_by of each says which others kept its band from growing. Raises what optimize\n"
        "raises, for the first contour in error: the attribute contour is its place in the list.",
        py::arg("surface"), py::arg("contours"), py::arg("closed") = true, defaults, py::arg("required_vertices") = nothing,
        py::arg("required_edges") = nothing, py::arg("attractors") = nothing, py::arg("barriers") = nothing,
        py::arg("region_density") = py::none(), py::arg("scales") = py::none(), py::arg("progress") = py::none(),
        py::arg("errors") = "raise");
}

/// What answers without a search.
void bind_queries(py::module_& module, const py::arg_v& defaults) {
    const py::tuple nothing;
    define(module, "check_contour", &check_contour,
           "Why optimize would refuse a contour, without a search: an InvalidInput that is not raised, or None. Arguments are\n"
           "those of optimize. Only a search finds required elements that cannot be reached.",
           py::arg("surface"), py::arg("vertices") = py::none(), py::arg("closed") = true, py::arg("barriers") = nothing,
           py::arg("edge_vertices") = py::none(), py::arg("edge_parameters") = py::none());
    define(module, "measure", &measure,
           "The ratio of a contour, without optimizing (eq. 3.3). Arguments and errors are those of optimize; returns a Measure.",
           py::arg("surface"), py::arg("vertices") = py::none(), py::arg("closed") = true, defaults,
           py::arg("attractors") = nothing, py::arg("region_density") = py::none(), py::arg("scales") = py::none(),
           py::arg("edge_vertices") = py::none(), py::arg("edge_parameters") = py::none());
    define(module, "close_contour", &close_contour,
           "Closes an open chain around the limb that it lies on, so that part of a loop drawn by hand is enough.\n\n"
           "vertices: (N,) ids along mesh edges, from one end to the other, at least two; or an open Contour. A quarter of a\n"
           "loop nearly always finds the limb.\n"
           "progress: called every few milliseconds with the fraction of the vertices searched, 0 to 1; returning False cancels,\n"
           "and None is returned; an exception passes through.\n"
           "Returns (n,) int32: the closed contour, which begins with the chain. The path back is the cheapest; it costs least\n"
           "where the surface is far from the chain and faces away from it (Lee et al. 2004). Pass it to optimize. Raises\n"
           "InvalidInput where the chain cannot be closed around anything, as on a plane.",
           py::arg("surface"), py::arg("vertices"), py::arg("progress") = py::none());
    define(
        module, "curvature", &curvature,
        "The curvatures at all vertices (3.4), a Curvature. They depend on the surface alone, and not on how a flat or straight\n"
        "part of it is cut up. Of the options it uses curvature_radius and curvature_smoothing; scales has no effect any more.",
        py::arg("surface"), defaults, py::arg("scales") = py::none());
    define_worded(
        module, "band", &band, &overloads_by_sides,
        "(n,) int32: the faces that optimize searches first, ascending (4.2.1). Arguments and errors are those of optimize.\n"
        "sides: return two arrays, the faces and (n,) int8: 1 left of the contour, -1 right of it, 0 beyond an end of an open\n"
        "contour, where its two sides meet. A face that touches both sides is on the one from which the band reached it.",
        py::arg("surface"), py::arg("vertices") = py::none(), py::arg("closed") = true, defaults,
        py::arg("edge_vertices") = py::none(), py::arg("edge_parameters") = py::none(), py::arg("sides") = false);
    define(module, "search_space", &search_space,
           "What one search with this width and refinement builds, as a dict of arrays, for display and tests.\n"
           "Arguments and errors are those of optimize. Vertices are ids of the surface, indices int32, numbers float64.\n\n"
           "The band: faces (n,); vertices (n,) with side (n,), 1 left, -1 right, 0 on the contour, and round (n,), the dilation\n"
           "that reached each; left, right and strips: lists of (m,) vertices, the boundary after each round on either side, and\n"
           "all from right to left; triangles (n, 3).\n"
           "The flow: edges (n, 2) with increments (n,), from the first vertex to the second, and diagonal (n,) bool.\n"
           "The graph: points (n, 2) with parameters (n,), as Result.edge_vertices; nodes (n, 2) in topological order, as pairs\n"
           "of vertices (refined: of rows of points); arcs (n, 2), rows of nodes, with f and g (n,); cut (n,), the nodes that\n"
           "cross the flow's value level, a float.",
           py::arg("surface"), py::arg("vertices") = py::none(), py::arg("closed") = true, defaults,
           py::arg("edge_vertices") = py::none(), py::arg("edge_parameters") = py::none());
}

}  // namespace

void bind_functions(py::module_& module) {
    const auto defaults = py::arg_v("options", Options(), "Options()");  // all of them would fill each signature
    bind_curvature(module);
    bind_searches(module, defaults);
    bind_queries(module, defaults);
}

}  // namespace mrc_python
