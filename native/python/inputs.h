// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "arrays.h"

#include <mrc/optimize.h>

#include <array>
#include <map>
#include <memory>
#include <vector>

namespace mrc_python {

/// A contour from vertex ids or points on edges; or a Contour or an earlier Result, which bring their own `closed`.
mrc::Contour to_contour(const py::object& vertices, bool closed, const py::object& edge_vertices,
                        const py::object& edge_parameters);

/// A copy of a region density; null: none.
using Density = std::shared_ptr<const std::vector<double>>;
Density to_density(const py::object& density);

mrc::Constraints to_constraints(const py::object& required_vertices, const py::object& required_edges, const Iterable& attractors,
                                const py::object& barriers, const Density& region_density);

/// Vertex pairs.
std::vector<std::array<int, 2>> edge_pairs(const py::object& edges, const char* name);

struct Tasks {
    std::vector<mrc::Task> tasks;
    std::map<std::size_t, mrc::InvalidInput> errors;  // by place: of contours that are no arrays of ids, whose tasks are empty
};

/// Several contours; what is not `shared` is one for all or one for each. The first error is raised unless `keep_errors`.
Tasks to_tasks(const Iterable& contours, const py::object& closed, const py::object& required_vertices,
               const py::object& required_edges, const mrc::Constraints& shared, const py::object& scales, bool keep_errors);

/// None: what is returned only lets Ctrl-C end the call. `progress` must outlive what is returned.
mrc::Progress to_progress(const py::object& progress);

}  // namespace mrc_python
