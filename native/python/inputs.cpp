// SPDX-License-Identifier: GPL-3.0-or-later
#include "inputs.h"

#include "results.h"

#include <array>
#include <chrono>
#include <cmath>
#include <string>

namespace mrc_python {
namespace {

std::vector<mrc::Attractor> to_attractors(const Iterable& attractors) {
    std::vector<mrc::Attractor> result;
    for (const py::handle item : attractors) {
        const Doubles fields = doubles(py::reinterpret_borrow<py::object>(item), "an attractor");
        if (fields.ndim() != 1 || (fields.size() != 3 && fields.size() != 4)) {
            throw mrc::InvalidInput(mrc::ErrorCode::invalid_attractor,
                                    "an attractor is (vertex, radius, strength) or (vertex, radius, strength, sigma)");
        }
        const double vertex = fields.at(0);
        if (!(vertex == std::floor(vertex) && std::abs(vertex) < 2147483648.0)) {
            throw mrc::InvalidInput(mrc::ErrorCode::invalid_attractor, "an attractor's vertex must be a whole number");
        }
        mrc::Attractor a{static_cast<int>(vertex), fields.at(1), fields.at(2), std::nullopt};
        if (fields.size() == 4) a.sigma = fields.at(3);
        result.push_back(a);
    }
    return result;
}

/// Values of which there is one for all contours, or one for each.
std::vector<py::object> one_each(const py::object& value, bool single, std::size_t count, const char* name) {
    if (single) return std::vector<py::object>(count, value);
    std::vector<py::object> values;
    for (const py::handle item : value) values.push_back(py::reinterpret_borrow<py::object>(item));
    if (values.size() != count) {
        throw mrc::InvalidInput(mrc::ErrorCode::wrong_size, std::string(name) + " has " + std::to_string(values.size()) +
                                                                " entries for " + std::to_string(count) +
                                                                " contours: give one for all or one for each");
    }
    return values;
}

bool is_list(const py::handle& value) {
    if (py::isinstance<py::array>(value)) return py::reinterpret_borrow<py::array>(value).ndim() > 0;
    return py::isinstance<py::sequence>(value) && !py::isinstance<py::str>(value);
}

/// Lists nested to `depth`: ids are one deep, vertex pairs two.
bool is_nested(const py::object& value, int depth) {
    for (const py::handle item : value) {
        if (!is_list(item)) return false;
        if (depth == 1 || py::len(item) == 0 || is_nested(py::reinterpret_borrow<py::object>(item), depth - 1)) return true;
    }
    return false;
}

bool to_bool(const py::object& value, const char* name) {
    py::detail::make_caster<bool> caster;
    if (!caster.load(value, true)) {
        static_cast<void>(py::bool_(value));  // its own exception where it has no truth, as arrays
        throw py::type_error(std::string(name) + " must be True or False, not " +
                             py::cast<std::string>(py::type::of(value).attr("__name__")));
    }
    return caster;
}

std::optional<mrc::Scales> to_scales(const py::object& scales) {
    if (scales.is_none()) return std::nullopt;
    if (!py::isinstance<mrc::Scales>(scales)) throw py::type_error("scales must be the Scales of an earlier result, or None");
    return scales.cast<mrc::Scales>();
}

/// A contour of a list: vertex ids, points on edges as a pair of arrays, a Contour or an earlier Result.
mrc::Contour listed_contour(const py::object& item, bool closed) {
    const bool points = py::isinstance<py::tuple>(item) && py::len(item) == 2 && is_list(py::tuple(item)[0]);
    if (!points) return to_contour(item, closed, py::none(), py::none());
    const py::tuple pair(item);
    return to_contour(py::none(), closed, pair[0], pair[1]);
}

/// Lets Ctrl-C end a call: looks for signals now and then, seldom enough not to wait for the interpreter's lock all the time. Python
/// handles signals on the main thread alone.
mrc::Progress interruption() {
    const py::module_ threading = py::module_::import("threading");
    if (!threading.attr("current_thread")().is(threading.attr("main_thread")())) return {};
    using Clock = std::chrono::steady_clock;
    return [last = Clock::now()](double) mutable {
        if (Clock::now() - last < std::chrono::milliseconds(40)) return true;
        const py::gil_scoped_acquire acquire;
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        last = Clock::now();
        return true;
    };
}

}  // namespace

mrc::Contour to_contour(const py::object& vertices, bool closed, const py::object& edge_vertices,
                        const py::object& edge_parameters) {
    const bool stray = edge_vertices.is_none() && !edge_parameters.is_none();
    if (vertices.is_none() == edge_vertices.is_none() || stray)
        throw mrc::InvalidInput(mrc::ErrorCode::wrong_size, "give either vertices, or edge_vertices with edge_parameters");
    if (py::isinstance<mrc::Contour>(vertices)) return vertices.cast<const mrc::Contour&>();
    if (py::isinstance<PyResult>(vertices)) return vertices.cast<const PyResult&>().result.contour;
    if (!vertices.is_none()) {
        const Integers ids = integers(vertices, "vertices");
        require_shape(ids, 0, "vertices");
        return mrc::vertex_contour(view(ids), closed);
    }
    const Integers ends = integers(edge_vertices, "edge_vertices");
    require_shape(ends, 2, "edge_vertices");
    if (edge_parameters.is_none())
        throw mrc::InvalidInput(mrc::ErrorCode::wrong_size,
                                "edge_vertices need edge_parameters: where on its edge each point lies");
    const Doubles parameters = doubles(edge_parameters, "edge_parameters");
    require_shape(parameters, 0, "edge_parameters");
    if (parameters.size() != ends.shape(0)) {
        throw mrc::InvalidInput(mrc::ErrorCode::wrong_size, "edge_parameters has " + std::to_string(parameters.size()) +
                                                                " entries for " + std::to_string(ends.shape(0)) + " edge_vertices");
    }
    mrc::Contour contour{{}, closed};
    for (py::ssize_t i = 0; i < ends.shape(0); ++i) contour.points.push_back({ends.at(i, 0), ends.at(i, 1), parameters.at(i)});
    return contour;
}

Density to_density(const py::object& density) {
    if (density.is_none()) return nullptr;
    const Doubles values = doubles(density, "region_density");
    require_shape(values, 0, "region_density");
    return std::make_shared<const std::vector<double>>(values.data(), values.data() + values.size());
}

std::vector<std::array<int, 2>> edge_pairs(const py::object& edges, const char* name) {
    const Integers pairs = integers(edges, name);
    if (pairs.size() == 0) return {};
    require_shape(pairs, 2, name);
    std::vector<std::array<int, 2>> result;
    for (py::ssize_t i = 0; i < pairs.shape(0); ++i) result.push_back({pairs.at(i, 0), pairs.at(i, 1)});
    return result;
}

mrc::Constraints to_constraints(const py::object& required_vertices, const py::object& required_edges, const Iterable& attractors,
                                const py::object& barriers, const Density& region_density) {
    mrc::Constraints constraints;
    const Integers vertices = integers(required_vertices, "required_vertices");
    if (vertices.size() > 0) require_shape(vertices, 0, "required_vertices");
    constraints.required_vertices.assign(vertices.data(), vertices.data() + vertices.size());
    constraints.required_edges = edge_pairs(required_edges, "required_edges");
    constraints.attractors = to_attractors(attractors);
    constraints.barriers = edge_pairs(barriers, "barriers");
    constraints.region_density = region_density;
    return constraints;
}

Tasks to_tasks(const Iterable& contours, const py::object& closed, const py::object& required_vertices,
               const py::object& required_edges, const mrc::Constraints& shared, const py::object& scales, bool keep_errors) {
    const py::list list(contours);
    const std::size_t count = list.size();
    const auto closed_each = one_each(closed, !is_list(closed), count, "closed");
    const auto vertices_each = one_each(required_vertices, !is_nested(required_vertices, 1), count, "required_vertices");
    const auto edges_each = one_each(required_edges, !is_nested(required_edges, 2), count, "required_edges");
    const auto scales_each = one_each(scales, !is_list(scales), count, "scales");
    Tasks result;
    for (std::size_t i = 0; i < count; ++i) {
        mrc::Task task{{}, shared, to_scales(scales_each[i])};
        const bool loop = to_bool(closed_each[i], "closed");
        const auto place = static_cast<int>(i);
        try {
            task.contour = listed_contour(list[i], loop);
            const mrc::Constraints own = to_constraints(vertices_each[i], edges_each[i], py::tuple(), py::tuple(), nullptr);
            task.constraints.required_vertices = own.required_vertices;
            task.constraints.required_edges = own.required_edges;
        } catch (const mrc::InvalidInput& error) {
            if (!keep_errors) throw error.of_contour(place, count == 1 ? "" : "contour " + std::to_string(i) + ": ");
            result.errors.emplace(i, error.of_contour(place));
            task.contour.points.clear();  // no search takes it
        }
        result.tasks.push_back(std::move(task));
    }
    return result;
}

mrc::Progress to_progress(const py::object& progress) {
    if (progress.is_none()) return interruption();
    if (!PyCallable_Check(progress.ptr())) {
        throw py::type_error("progress must be a function or None, not " +
                             py::cast<std::string>(py::type::of(progress).attr("__name__")));
    }
    return [progress = progress.ptr()](double share) {
        const py::gil_scoped_acquire acquire;
        const py::object answer = py::reinterpret_borrow<py::function>(progress)(share);
        if (PyErr_CheckSignals() != 0) throw py::error_already_set();
        return answer.is_none() || py::bool_(answer);  // an exception where it has no truth, as arrays
    };
}

}  // namespace mrc_python
