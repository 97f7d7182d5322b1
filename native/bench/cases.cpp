// SPDX-License-Identifier: GPL-3.0-or-later
#include "cases.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace mrc_bench {
namespace {

using std::numbers::pi;

void add_quad(std::vector<int>& triangles, int a, int b, int c, int d) { triangles.insert(triangles.end(), {a, b, c, a, c, d}); }

void add_point(std::vector<double>& positions, double x, double y, double z) { positions.insert(positions.end(), {x, y, z}); }

/// A tube with `columns` vertices around each of `rows` rings, edges of about unit length, waves, and noise that differs by variant.
void add_tube(Arrays& arrays, int rows, int columns, int variant = 0) {
    std::mt19937 random(2006 + variant);
    std::uniform_real_distribution<double> noise(-0.15, 0.15);
    const double radius = columns / (2.0 * pi);
    for (int row = 0; row < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const double angle = 2.0 * pi * (column + noise(random)) / columns, height = row + noise(random);
            const double wave = 1.0 + 0.1 * std::sin(0.35 * row + variant + 0.6 * std::sin(2.0 * angle)) + 0.02 * noise(random);
            add_point(arrays.positions, wave * radius * std::cos(angle), wave * radius * std::sin(angle), height);
        }
    }
    for (int row = 0; row + 1 < rows; ++row) {
        for (int column = 0; column < columns; ++column) {
            const int right = (column + 1) % columns;
            add_quad(arrays.triangles, row * columns + column, row * columns + right, (row + 1) * columns + right,
                     (row + 1) * columns + column);
        }
    }
}

void add_torus(Arrays& arrays, int faces, double offset) {
    const int first = static_cast<int>(arrays.positions.size() / 3), side = static_cast<int>(std::sqrt(faces / 2.0));
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) {
            const double u = 2.0 * pi * i / side, v = 2.0 * pi * j / side, ring = side * (1.0 + 0.3 * std::cos(v));
            add_point(arrays.positions, offset + ring * std::cos(u), ring * std::sin(u), 0.3 * side * std::sin(v));
        }
    }
    const auto at = [&](int i, int j) { return first + (i % side) * side + j % side; };
    for (int i = 0; i < side; ++i) {
        for (int j = 0; j < side; ++j) add_quad(arrays.triangles, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
}

/// The rows and columns of a tube whose middle ring has a band of this many faces, about as wide as long.
struct Shape {
    int width, columns, rows;
};

Shape shape_of(int band_faces) {
    const int width = std::max(2, static_cast<int>(std::lround(std::sqrt(band_faces / 16.0))));
    return {width, band_faces / (4 * width), 2 * width + 9};
}

mrc::Options options_for(const Shape& shape, int refinement) {
    mrc::Options options;
    options.width = shape.width;
    options.refinement = refinement;
    return options;
}

/// A ring around the tube, with a step up and down every four columns.
mrc::Contour jagged_ring(int lower, int columns) {
    std::vector<int> ring;
    int row = lower;
    for (int column = 0; column < columns; ++column) {
        ring.push_back(row * columns + column);
        const int next = column + 1 < columns && column % 4 < 2 ? lower + 1 : lower;
        if (next != row) ring.push_back(next * columns + column);
        row = next;
    }
    return mrc::vertex_contour(ring);
}

}  // namespace

Case tube_case(int band_faces, int refinement, int more_faces, int variant) {
    const Shape shape = shape_of(band_faces);
    Arrays arrays;
    add_tube(arrays, shape.rows, shape.columns, variant);
    if (more_faces > 0) add_torus(arrays, more_faces, 10.0 * more_faces);
    return {mrc::Surface(arrays.view()), jagged_ring(shape.rows / 2, shape.columns), options_for(shape, refinement)};
}

Row contours_in_a_row(int count, int band_faces, int refinement) {
    const Shape shape = shape_of(band_faces);
    Arrays arrays;
    add_tube(arrays, count * shape.rows, shape.columns);
    std::vector<mrc::Contour> contours;
    contours.reserve(count);
    for (int i = 0; i < count; ++i) contours.push_back(jagged_ring(i * shape.rows + shape.rows / 2, shape.columns));
    return {mrc::Surface(arrays.view()), contours, options_for(shape, refinement)};
}

Arrays torus_arrays(int faces) {
    Arrays arrays;
    add_torus(arrays, faces, 0.0);
    return arrays;
}

double bare_pass(const mrc::WeightedGraph& graph, double lambda, std::vector<double>& value) {
    value.assign(graph.node_count(), std::numeric_limits<double>::infinity());
    for (const mrc::Terminal& source : graph.sources) value[source.node] = source.f - lambda * source.g;
    for (int n = 0; n < graph.node_count(); ++n) {
        double best = value[n];
        for (int a = graph.first_arc[n]; a < graph.first_arc[n + 1]; ++a)
            best = std::min(best, value[graph.from[a]] + (graph.f[a] - lambda * graph.g[a]));
        value[n] = best;
    }
    return value.back();
}

}  // namespace mrc_bench
