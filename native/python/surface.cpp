// SPDX-License-Identifier: GPL-3.0-or-later
#include "arrays.h"
#include "bindings.h"
#include "define.h"
#include "values.h"

#include <mrc/errors.h>
#include <mrc/surface.h>

#include <algorithm>
#include <memory>
#include <span>
#include <vector>

namespace mrc_python {
namespace {

/// Face ids, or a mask over all faces.
Integers face_ids(const py::object& faces, py::ssize_t count) {
    const py::array array = py::array::ensure(faces);
    if (array && array.dtype().kind() == 'b' && array.size() > 0) {
        if (array.ndim() != 1 || array.size() != count) {
            throw mrc::InvalidInput(mrc::ErrorCode::wrong_size, "hidden_faces as a mask must have one entry for each of the " +
                                                                    std::to_string(count) + " faces");
        }
        const py::object nonzero = py::module_::import("numpy").attr("flatnonzero")(array);
        return integers(nonzero, "hidden_faces");
    }
    return integers(faces, "hidden_faces");
}

std::unique_ptr<mrc::Surface> make_surface(const py::object& positions, const py::object& face_offsets,
                                           const py::object& face_vertices, const py::object& triangles,
                                           const py::object& hidden_faces) {
    const Doubles points = doubles(positions, "positions");
    require_shape(points, 3, "positions");
    const Integers corners = integers(face_vertices, "face_vertices");
    Integers offsets(0), triples(0), hidden(0);
    if (face_offsets.is_none()) {
        if (corners.size() > 0) require_shape(corners, 3, "face_vertices without face_offsets");
    } else {
        offsets = integers(face_offsets, "face_offsets");
        require_shape(offsets, 0, "face_offsets");
        require_shape(corners, 0, "face_vertices");
        if (offsets.size() == 0)
            throw mrc::InvalidInput(mrc::ErrorCode::wrong_size,
                                    "face_offsets is empty: it has one entry more than there are faces");
    }
    if (!triangles.is_none()) {
        triples = integers(triangles, "triangles");
        require_shape(triples, 3, "triangles");
    }
    if (!hidden_faces.is_none()) {
        const py::ssize_t faces = face_offsets.is_none() ? corners.size() / 3 : offsets.size() - 1;
        hidden = face_ids(hidden_faces, faces);
        require_shape(hidden, 0, "hidden_faces");
    }
    const mrc::SurfaceArrays arrays{view(points), view(offsets), view(corners), view(triples), view(hidden)};
    const py::gil_scoped_release release;
    return std::make_unique<mrc::Surface>(arrays);
}

/// The arguments that make the same surface again.
py::tuple surface_state(const mrc::Surface& surface) {
    std::vector<int> offsets{0}, corners, triangles, hidden;
    for (int f = 0; f < surface.face_count(); ++f) {
        const std::span<const int> face = surface.face(f);
        corners.insert(corners.end(), face.begin(), face.end());
        offsets.push_back(static_cast<int>(corners.size()));
        if (surface.hidden(f)) hidden.push_back(f);
    }
    for (int t = 0; t < surface.triangle_count(); ++t) {
        triangles.insert(triangles.end(), surface.triangle(t).begin(), surface.triangle(t).end());
    }
    Doubles positions({static_cast<py::ssize_t>(surface.vertex_count()), py::ssize_t{3}});
    double* out = positions.mutable_data();
    for (int v = 0; v < surface.vertex_count(); ++v) out = std::copy_n(surface.position(v).data(), 3, out);
    return py::make_tuple(positions, to_array(offsets), to_array(corners), to_array(triangles, 3), to_array(hidden));
}

std::unique_ptr<mrc::Surface> surface_from_state(const py::tuple& state) {
    return make_surface(state[0], state[1], state[2], state[3], state[4]);
}

}  // namespace

void bind_surface(py::module_& module) {
    py::class_<mrc::Surface> surface(
        module, "Surface", py::module_local(),
        "A validated, immutable mesh with its adjacency. It keeps copies: the arrays may change afterwards.\n"
        "It may be used from several threads at once.");
    define_constructor_with_advice(
        surface, &make_surface,
        "Surface(positions, None, triangles) for triangles, Surface(positions, face_offsets, face_vertices) for polygons",
        "positions: (V, 3) float64, in any unit of length.\n"
        "face_offsets: (F + 1,) int32; face i is face_vertices[face_offsets[i]:face_offsets[i + 1]]. None: all triangles.\n"
        "face_vertices: (sum of corners,) int32, or (F, 3) where face_offsets is None.\n"
        "triangles: (T, 3) int32, n - 2 for each face of n corners, in face order; None: made here.\n"
        "hidden_faces: ids, or a mask of F bools: faces that no band enters.\n"
        "Raises ValueError naming the elements: indices out of range, positions that are not finite or beyond 1e50, faces\n"
        "with fewer than three or with repeated vertices, triangles that are no triangulation of their faces.",
        py::arg("positions"), py::arg("face_offsets"), py::arg("face_vertices"), py::arg("triangles") = py::none(),
        py::arg("hidden_faces") = py::none());
    define_copies(surface);
    surface.def(py::pickle(&surface_state, &surface_from_state));
    surface.def_property_readonly("vertex_count", &mrc::Surface::vertex_count, "V, those in no face too.")
        .def_property_readonly("face_count", &mrc::Surface::face_count, "F, hidden faces too.")
        .def_property_readonly("edge_count", &mrc::Surface::edge_count, "Real edges, and the diagonals of the triangulation.")
        .def("__repr__", [](const mrc::Surface& s) {
            return "<mrcontour.Surface: " + std::to_string(s.vertex_count()) + " vertices, " + std::to_string(s.face_count()) +
                   " faces>";
        });
}

}  // namespace mrc_python
