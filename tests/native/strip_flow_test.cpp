// SPDX-License-Identifier: GPL-3.0-or-later
#include "flow.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <numbers>
#include <random>
#include <set>

namespace mrc {
namespace {

using EdgeFlow = std::map<std::pair<int, int>, double>;  // increments by surface vertices

int next_of(const Curve& curve, size_t i) { return curve[(i + 1) % curve.size()]; }

enum class Faces { quads, triangles, mixed };

/// A torus of `around` x `across` cells: vertex i * across + j, the rows j run around the tube.
struct Torus {
    int around = 24;
    int across = 16;
    Faces faces = Faces::triangles;
    double jitter = 0.0;  // in cells
    unsigned seed = 1;

    int vertex(int i, int j) const { return (i + around) % around * across + (j + across) % across; }

    Surface surface(const std::vector<int32_t>& hidden = {}) const {
        std::mt19937 random(seed);
        const std::vector<double> positions = points(random);
        std::vector<int32_t> offsets{0}, corners;
        const auto add = [&](const Curve& face) {
            corners.insert(corners.end(), face.begin(), face.end());
            offsets.push_back(static_cast<int32_t>(corners.size()));
        };
        for (int j = 0; j < across; ++j) {
            for (int i = 0, width = 1; i < around; i += width) {
                width = faces == Faces::mixed ? std::min(1 + static_cast<int>(random() % 4), around - i) : 1;
                const int a = vertex(i, j), b = vertex(i + 1, j), c = vertex(i + 1, j + 1), d = vertex(i, j + 1);
                if (faces != Faces::triangles) {
                    add(merged_cells(i, j, width));
                } else if (random() % 2) {
                    add({a, b, c});
                    add({a, c, d});
                } else {
                    add({a, b, d});
                    add({b, c, d});
                }
            }
        }
        return Surface({positions, offsets, corners, {}, hidden});
    }

    std::vector<double> points(std::mt19937& random) const {
        std::uniform_real_distribution<double> wobble(-jitter, jitter);
        std::vector<double> positions;
        for (int i = 0; i < around; ++i) {
            for (int j = 0; j < across; ++j) {
                const double u = 2.0 * std::numbers::pi * (i + wobble(random)) / around;
                const double v = 2.0 * std::numbers::pi * (j + wobble(random)) / across;
                const double ring = 3.0 + std::cos(v);
                positions.insert(positions.end(), {ring * std::cos(u), ring * std::sin(u), std::sin(v)});
            }
        }
        return positions;
    }

    Curve merged_cells(int i, int j, int width) const {
        Curve face;
        for (int k = 0; k <= width; ++k) face.push_back(vertex(i + k, j));
        for (int k = width; k >= 0; --k) face.push_back(vertex(i + k, j + 1));
        return face;
    }

    Curve ring() const {
        Curve loop;
        for (int i = 0; i < around; ++i) loop.push_back(vertex(i, across / 2));
        return loop;
    }

    /// A loop once around the long circumference that climbs and falls at random by up to `steep` rows a column.
    Curve jagged_loop(int steep, unsigned loop_seed) const {
        std::mt19937 random(loop_seed);
        std::vector<int> row(around + 1, across / 2);
        for (int i = 1; i < around; ++i) {
            const int step = static_cast<int>(random() % (2 * steep + 1)) - steep;
            row[i] = std::clamp(row[i - 1] + step, across / 4, 3 * across / 4);
        }
        Curve loop;
        for (int i = 0; i < around; ++i) {
            const int step = row[i + 1] < row[i] ? -1 : 1;
            for (int j = row[i]; j != row[i + 1]; j += step) loop.push_back(vertex(i, j));
            loop.push_back(vertex(i, row[i + 1]));
        }
        return loop;
    }
};

/// The loops of edges that part the triangles whose centroids lie above a plane from the others, above to their left.
std::vector<Curve> plane_loops(const Surface& surface, const Vec3& normal, double level) {
    const auto above = [&](int face) {
        Vec3 center = Vec3::Zero();
        for (const int v : surface.face(face)) center += surface.position(v);
        return normal.dot(center) > level * static_cast<double>(surface.face(face).size());
    };
    std::map<int, int> next;
    std::set<int> touched;  // where the border touches itself
    for (int h = 0; h < surface.halfedge_count(); ++h) {
        if (surface.diagonal(h) || surface.twin(h) < 0) continue;
        if (!above(surface.halfedge_face(h)) || above(surface.halfedge_face(surface.twin(h)))) continue;
        if (!next.emplace(surface.from(h), surface.to(h)).second) touched.insert(surface.from(h));
    }
    std::vector<Curve> loops;
    while (!next.empty()) {
        Curve loop;
        for (auto at = next.begin(); at != next.end(); at = next.find(loop.back())) {
            loop.push_back(at->second);
            next.erase(at);
        }
        if (std::ranges::none_of(loop, [&](int v) { return touched.contains(v); })) loops.push_back(loop);
    }
    return loops;
}

struct Case {
    Patch patch;
    Band band;
    std::vector<Curve> strips;

    Case(const Surface& surface, const Curve& contour, const Options& options, bool closed = true)
        : patch(make_patch(surface, vertex_contour(contour, closed),
                           options.width ? std::optional(*options.width + 4) : std::nullopt)),
          band(grow_band(surface, patch, options)),
          strips(strip_boundaries(patch, band)) {}

    int halfedge(int a, int b) const {
        return patch.mesh.find_halfedge(PatchMesh::VertexHandle(a), PatchMesh::VertexHandle(b)).idx();
    }
    int from(int h) const { return patch.mesh.from_vertex_handle(PatchMesh::HalfedgeHandle(h)).idx(); }
    int to(int h) const { return patch.mesh.to_vertex_handle(PatchMesh::HalfedgeHandle(h)).idx(); }
    /// The face of the band to the left, or -1 where there is none or an end polygon, which is of neither side.
    int band_face(int h) const {
        const auto f = patch.mesh.face_handle(PatchMesh::HalfedgeHandle(h));
        return f.is_valid() && band.face[f.idx()] && !at_end(patch.polygon[f.idx()]) ? f.idx() : -1;
    }
    bool at_end(int polygon) const {
        return std::find(band.polygons.end() - band.end_polygons, band.polygons.end(), polygon) != band.polygons.end();
    }
    /// The vertices that no strip holds, since end polygons alone do.
    std::set<int> beyond() const {
        std::set<int> found;
        for (int v = 0; v < static_cast<int>(patch.vertex.size()); ++v) {
            if (band.side[v] != Side::outside) found.insert(v);
        }
        for (const Curve& strip : strips)
            for (const int v : strip) found.erase(v);
        return found;
    }
    size_t edges(const Curve& curve) const { return curve.size() - (patch.closed ? 0 : 1); }
    double length(const Curve& curve, size_t i) const {
        return patch.mesh.calc_edge_length(PatchMesh::HalfedgeHandle(halfedge(curve[i], next_of(curve, i))));
    }
    /// The vertices that no round's boundary holds.
    int swallowed() const {
        std::set<int> covered;
        for (const auto* side : {&band.left, &band.right})
            for (const Curve& curve : *side) covered.insert(curve.begin(), curve.end());
        return static_cast<int>(std::ranges::count_if(band.side, [](Side s) { return s != Side::outside; })) -
               static_cast<int>(covered.size());
    }
};

Options gates(std::optional<int> width) {
    Options options;
    options.width = width;
    options.flow = FlowKind::gates;
    return options;
}

EdgeFlow edge_flow(const Case& c, const Options& options) {
    const Flow flow = make_flow(c.patch, c.band, options);
    EdgeFlow result;
    for (int h = 0; h < static_cast<int>(c.patch.mesh.n_halfedges()); ++h) {
        if (c.band.edge[h / 2]) result[{c.patch.vertex[c.from(h)], c.patch.vertex[c.to(h)]}] = flow.increment(c.patch.mesh, h);
    }
    return result;
}

double largest_difference(const EdgeFlow& a, const EdgeFlow& b, double sign) {
    double largest = 0.0;
    EXPECT_EQ(a.size(), b.size());
    for (const auto& [edge, increment] : a) {
        const auto other = b.find(edge);
        largest = std::max(largest, other == b.end() ? 1.0 : std::abs(increment - sign * other->second));
    }
    return largest;
}

bool same_cycle(const Curve& a, const Curve& b) {
    if (a.size() != b.size()) return false;
    Curve turned = b;
    const auto start = std::ranges::find(turned, a.front());
    if (start == turned.end()) return false;
    std::rotate(turned.begin(), start, turned.end());
    return a == turned;
}

/// The faces of the band to the right of a strip; fails where the strip does not part the band.
std::set<int> right_of(const Case& c, const Curve& strip) {
    std::set<int> wall, faces;
    std::vector<int> queue;
    const auto add = [&](int face) {
        if (face >= 0 && faces.insert(face).second) queue.push_back(face);
    };
    for (size_t i = 0; i < c.edges(strip); ++i) {
        const int h = c.halfedge(strip[i], next_of(strip, i));
        wall.insert({h, h ^ 1});
        add(c.band_face(h ^ 1));
    }
    while (!queue.empty()) {
        const int face = queue.back();
        queue.pop_back();
        for (const auto h : c.patch.mesh.fh_range(PatchMesh::FaceHandle(face))) {
            if (!wall.contains(h.idx())) add(c.band_face(h.idx() ^ 1));
        }
    }
    for (size_t i = 0; i < c.edges(strip); ++i) {
        const int left = c.band_face(c.halfedge(strip[i], next_of(strip, i)));
        EXPECT_TRUE(left < 0 || !faces.contains(left)) << "a strip does not part the band";
    }
    return faces;
}

void expect_simple_along_edges(const Case& c) {
    for (const Curve& strip : c.strips) {
        EXPECT_EQ(std::set<int>(strip.begin(), strip.end()).size(), strip.size());
        for (size_t i = 0; i < c.edges(strip); ++i) {
            const int h = c.halfedge(strip[i], next_of(strip, i));
            ASSERT_GE(h, 0);
            EXPECT_FALSE(c.patch.diagonal_halfedge(h));
            EXPECT_TRUE(c.band.edge[h / 2]);
        }
    }
}

void expect_nested(const Case& c) {
    std::set<int> last;
    for (const Curve& strip : c.strips) {
        const std::set<int> faces = right_of(c, strip);
        EXPECT_TRUE(std::ranges::includes(faces, last)) << "strips cross";
        last = faces;
    }
    long faces = 0;
    for (const auto f : c.patch.mesh.faces()) faces += c.band.face[f.idx()] && !c.at_end(c.patch.polygon[f.idx()]);
    EXPECT_EQ(static_cast<long>(last.size()), faces);
}

void expect_covered_and_adjacent(const Case& c) {
    std::vector<std::vector<int>> levels(c.patch.vertex.size());
    for (size_t s = 0; s < c.strips.size(); ++s)
        for (const int v : c.strips[s]) levels[v].push_back(static_cast<int>(s));
    const std::set<int> beyond = c.beyond();
    EXPECT_TRUE(!c.patch.closed || beyond.empty());
    for (const int v : beyond) {
        for (const auto f : c.patch.mesh.vf_range(PatchMesh::VertexHandle(v)))
            EXPECT_TRUE(!c.band.face[f.idx()] || c.at_end(c.patch.polygon[f.idx()])) << "a strip misses a vertex";
    }
    for (size_t v = 0; v < levels.size(); ++v) EXPECT_TRUE(levels[v].empty() || c.band.side[v] != Side::outside);
    for (int h = 0; h < static_cast<int>(c.patch.mesh.n_halfedges()); h += 2) {
        if (!c.band.edge[h / 2] || (c.band_face(h) < 0 && c.band_face(h ^ 1) < 0)) continue;
        int nearest = static_cast<int>(c.strips.size());
        for (const int a : levels[c.from(h)])
            for (const int b : levels[c.to(h)]) nearest = std::min(nearest, std::abs(a - b));
        EXPECT_LE(nearest, 1) << "an edge skips a strip";
    }
}

void expect_rounds_among_strips(const Case& c) {
    for (const auto* side : {&c.band.left, &c.band.right}) {
        for (const Curve& curve : *side) {
            EXPECT_TRUE(
                std::ranges::any_of(c.strips, [&](const Curve& s) { return c.patch.closed ? same_cycle(curve, s) : curve == s; }));
        }
    }
}

void expect_strip_laws(const Case& c) {
    expect_simple_along_edges(c);
    expect_nested(c);
    expect_covered_and_adjacent(c);
    expect_rounds_among_strips(c);
}

void expect_flow_laws(const Case& c, const Flow& flow) {
    for (int h = 0; h < static_cast<int>(c.patch.mesh.n_halfedges()); ++h) EXPECT_EQ(flow.jump[h], -flow.jump[h ^ 1]);
    for (const auto f : c.patch.mesh.faces()) {
        if (!c.band.face[f.idx()]) continue;
        int sum = 0;
        for (const auto h : c.patch.mesh.fh_range(f)) sum += flow.jump[h.idx()];
        EXPECT_EQ(sum, 0);
    }
    for (const Curve& strip : c.strips) {
        int turns = 0;
        for (size_t i = 0; i < c.edges(strip); ++i) {
            const int h = c.halfedge(strip[i], next_of(strip, i));
            turns += flow.jump[h];
            EXPECT_GT(flow.increment(c.patch.mesh, h), 1e-9);
        }
        EXPECT_EQ(turns, c.patch.closed ? 1 : 0);
    }
}

/// The increments along a curve are its edges' fractions of its length.
void expect_arc_length(const Case& c, const Flow& flow, const Curve& curve) {
    double total = 0.0;
    for (size_t i = 0; i < c.edges(curve); ++i) total += c.length(curve, i);
    for (size_t i = 0; i < c.edges(curve); ++i) {
        const int h = c.halfedge(curve[i], next_of(curve, i));
        EXPECT_NEAR(flow.increment(c.patch.mesh, h), c.length(curve, i) / total, 1e-12);
    }
}

/// Values in [0, 1], and the ends alone at 0 and 1.
void expect_open_flow_laws(const Case& c, const Flow& flow) {
    EXPECT_TRUE(std::ranges::all_of(flow.jump, [](int jump) { return jump == 0; }));
    for (int v = 0; v < static_cast<int>(flow.value.size()); ++v) {
        if (c.band.side[v] == Side::outside) continue;
        EXPECT_EQ(flow.value[v] <= 0.0, v == c.patch.contour.front());
        EXPECT_EQ(flow.value[v] >= 1.0, v == c.patch.contour.back());
    }
    EXPECT_EQ(flow.value[c.patch.contour.front()], 0.0);
    EXPECT_EQ(flow.value[c.patch.contour.back()], 1.0);
}

void expect_all_laws(const Case& c, Options options) {
    expect_strip_laws(c);
    for (const FlowKind kind : {FlowKind::gates, FlowKind::arc_length}) {
        options.flow = kind;
        const Flow flow = make_flow(c.patch, c.band, options);
        expect_flow_laws(c, flow);
        if (!c.patch.closed) expect_open_flow_laws(c, flow);
        expect_arc_length(c, flow, c.patch.contour);
    }
}

TEST(Strips, LawsHoldAroundJaggedLoops) {
    int swallowed = 0, touching = 0;
    for (unsigned seed = 0; seed < 24; ++seed) {
        const Torus torus{.faces = seed % 2 ? Faces::quads : Faces::triangles, .jitter = 0.1 * (seed % 4), .seed = seed};
        const Surface surface = torus.surface();
        const Options options = gates(1 + static_cast<int>(seed % 6));
        const Case c(surface, torus.jagged_loop(1 + static_cast<int>(seed % 3), seed), options);
        SCOPED_TRACE(seed);
        expect_all_laws(c, options);
        swallowed += c.swallowed();
        std::set<int> first(c.strips[0].begin(), c.strips[0].end());
        touching += static_cast<int>(std::ranges::count_if(c.strips[1], [&](int v) { return first.contains(v); }));
    }
    EXPECT_GT(swallowed, 50) << "the loops are too smooth to need refined strips";
    EXPECT_GT(touching, 100) << "the strips never share a vertex";
}

TEST(Strips, LawsHoldOverTheWholeSurface) {
    for (const Faces faces : {Faces::quads, Faces::triangles}) {
        const Torus torus{.faces = faces, .jitter = 0.3};
        const Surface surface = torus.surface();
        const Case c(surface, torus.jagged_loop(2, 5), gates(std::nullopt));
        expect_all_laws(c, gates(std::nullopt));
    }
}

TEST(Strips, LawsHoldAmongPolygonsOfManySides) {
    for (unsigned seed = 0; seed < 12; ++seed) {
        const Torus torus{.faces = Faces::mixed, .jitter = 0.1 * (seed % 3), .seed = seed};
        const Surface surface = torus.surface();
        SCOPED_TRACE(seed);
        expect_all_laws(Case(surface, torus.ring(), gates(4)), gates(4));
    }
}

/// Hidden faces at the contour's corners pinch the band: its right and left border meet.
TEST(Strips, LawsHoldInPinchedBands) {
    int pinched = 0;
    for (unsigned seed = 0; seed < 40; ++seed) {
        const Torus torus{.around = 3 + static_cast<int>(seed % 12), .jitter = 0.1 * (seed % 4), .seed = seed};
        const Curve loop = torus.jagged_loop(2, seed);
        std::set<std::pair<int, int>> sides;
        for (size_t i = 0; i < loop.size(); ++i) sides.insert({{loop[i], next_of(loop, i)}, {next_of(loop, i), loop[i]}});
        const Surface open = torus.surface();
        std::mt19937 random(seed);
        std::vector<int32_t> hidden;
        for (int f = 0; f < open.face_count(); ++f) {
            const Curve face(open.face(f).begin(), open.face(f).end());
            bool at_contour = false;
            for (size_t i = 0; i < face.size(); ++i) at_contour |= sides.contains({face[i], next_of(face, i)});
            if (!at_contour && random() % 3 == 0) hidden.push_back(f);
        }
        const Surface surface = torus.surface(hidden);
        const Case c(surface, loop, gates(3));
        SCOPED_TRACE(seed);
        expect_all_laws(c, gates(3));
        const std::set<int> border(c.strips.front().begin(), c.strips.front().end());
        pinched += std::ranges::any_of(c.strips.back(), [&](int v) { return border.contains(v); });
    }
    EXPECT_GT(pinched, 10);
}

/// A band without the faces beside one edge of its contour: there both borders run along the contour itself.
TEST(Strips, LawsHoldWhereNoFaceEntered) {
    const Torus torus{.faces = Faces::quads};
    const Surface surface = torus.surface();
    for (const int shift : {0, 1, 2}) {
        Curve ring = torus.ring();
        std::rotate(ring.begin(), ring.begin() + shift, ring.end());
        Case c(surface, ring, gates(1));
        const Curve contour = c.patch.contour;
        const int gap = c.halfedge(contour[(24 - shift) % 24], contour[(25 - shift) % 24]);
        for (const int h : {gap, gap ^ 1}) {
            const int polygon = c.patch.polygon[c.band_face(h)];
            std::erase(c.band.polygons, polygon);
            for (int f = c.patch.first_face[polygon]; f < c.patch.first_face[polygon + 1]; ++f) {
                c.band.face[f] = 0;
                for (const auto e : c.patch.mesh.fe_range(PatchMesh::FaceHandle(f)))
                    c.band.edge[e.idx()] = std::ranges::any_of(std::array{2 * e.idx(), 2 * e.idx() + 1},
                                                               [&](int side) { return c.band_face(side) >= 0; });
            }
        }
        c.band.edge[gap / 2] = 1;
        const auto follow_contour = [&](Curve& border) {  // over the gap
            const std::set<int> at_border(border.begin(), border.end());
            const auto neighbor = [&](int v) {
                for (const auto w : c.patch.mesh.vv_range(PatchMesh::VertexHandle(v)))
                    if (at_border.contains(w.idx()) && !c.patch.diagonal_halfedge(c.halfedge(v, w.idx()))) return w.idx();
                return -1;
            };
            const auto after = std::ranges::find(border, neighbor(c.to(gap)));
            border.insert(after, {c.from(gap), c.to(gap)});
        };
        follow_contour(c.band.left[1]);
        follow_contour(c.band.right[1]);
        c.strips = strip_boundaries(c.patch, c.band);
        SCOPED_TRACE(shift);
        expect_all_laws(c, gates(1));
    }
}

TEST(Strips, LawsHoldAroundPlaneCuts) {
    int met = 0;
    for (unsigned seed = 0; seed < 12; ++seed) {
        const Torus torus{.around = 40, .across = 20, .jitter = 0.3, .seed = seed};
        const Surface surface = torus.surface();
        const Vec3 normal = Vec3(1.0, 0.1 * seed, 0.3).normalized();
        for (const Curve& loop : plane_loops(surface, normal, 0.1 * seed)) {
            if (loop.size() < 8) continue;
            SCOPED_TRACE(seed);
            expect_all_laws(Case(surface, loop, gates(4)), gates(4));
            ++met;
        }
    }
    EXPECT_GT(met, 12);
}

TEST(Strips, RefinedStripsAreNoMoreThanNeeded) {
    const Torus torus{.faces = Faces::quads};
    const Case c(torus.surface(), torus.ring(), gates(4));
    EXPECT_EQ(c.strips.size(), 9u);
    EXPECT_EQ(c.strips[4], c.band.left.front());
    for (int r = 1; r <= 4; ++r) {
        EXPECT_TRUE(same_cycle(c.strips[4 + r], c.band.left[r]));
        EXPECT_TRUE(same_cycle(c.strips[4 - r], c.band.right[r]));
    }
}

TEST(StripFlow, LeavesTheCrossEdgesOfARegularGridLevel) {
    const Torus torus{.faces = Faces::quads};
    const Surface surface = torus.surface();
    for (const FlowKind kind : {FlowKind::gates, FlowKind::arc_length}) {
        Options options = gates(4);
        options.flow = kind;
        const Case c(surface, torus.ring(), options);
        for (const auto& [edge, increment] : edge_flow(c, options)) {
            const int columns = edge.second / torus.across - edge.first / torus.across;
            EXPECT_NEAR(increment, std::remainder(columns, torus.around) / torus.around, 1e-12);
        }
    }
}

/// Rows that are stretched unevenly, each in the same way: gates tie each vertex to its neighbor across.
TEST(StripFlow, GatesTieNarrowsWhereArcLengthDrifts) {
    const int columns = 24, rows = 5;
    std::vector<double> positions;
    std::vector<int32_t> offsets{0}, corners;
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) {
            const double angle = 2.0 * std::numbers::pi * i / columns;
            const double bulge = 1.0 + 0.25 * j * std::max(0.0, std::cos(angle));  // the upper rows are longer on one side
            positions.insert(positions.end(), {bulge * std::cos(angle), bulge * std::sin(angle), 0.2 * j});
            if (j + 1 == rows) continue;
            const int next = (i + 1) % columns;
            for (const int v : {j * columns + i, j * columns + next, (j + 1) * columns + next, (j + 1) * columns + i})
                corners.push_back(v);
            offsets.push_back(static_cast<int32_t>(corners.size()));
        }
    }
    const Surface surface({positions, offsets, corners, {}, {}});
    Curve ring;
    for (int i = 0; i < columns; ++i) ring.push_back(columns + i);
    const auto drift = [&](FlowKind kind) {
        Options options = gates(std::nullopt);
        options.flow = kind;
        const EdgeFlow flow = edge_flow(Case(surface, ring, options), options);
        double sum = 0.0;
        for (int i = 0; i < columns; ++i)
            for (int j = 1; j + 1 < rows; ++j) sum += std::abs(flow.at({j * columns + i, (j + 1) * columns + i}));
        return sum;
    };
    EXPECT_LT(drift(FlowKind::gates), 0.25 * drift(FlowKind::arc_length));
}

/// Where no vertex is shared, every strip runs by its own arc length.
TEST(StripFlow, ArcLengthIsEachStripsOwn) {
    const Torus torus{.faces = Faces::quads, .jitter = 0.2, .seed = 3};
    const Surface surface = torus.surface();
    Options options = gates(3);
    options.flow = FlowKind::arc_length;
    const Case c(surface, torus.ring(), options);
    ASSERT_EQ(c.strips.size(), 7u);
    const Flow flow = make_flow(c.patch, c.band, options);
    for (const Curve& strip : c.strips) expect_arc_length(c, flow, strip);
}

TEST(StripFlow, ReversalNegatesAndAShiftChangesNothing) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Torus torus{.jitter = 0.35, .seed = seed};
        const Surface surface = torus.surface();
        const Options options = gates(3);
        Curve loop = torus.jagged_loop(1 + static_cast<int>(seed % 2), seed);
        const EdgeFlow flow = edge_flow(Case(surface, loop, options), options);
        SCOPED_TRACE(seed);
        std::rotate(loop.begin(), loop.begin() + 7, loop.end());
        EXPECT_LT(largest_difference(flow, edge_flow(Case(surface, loop, options), options), 1.0), 1e-9);
        std::ranges::reverse(loop);
        EXPECT_LT(largest_difference(flow, edge_flow(Case(surface, loop, options), options), -1.0), 1e-9);
    }
}

TEST(StripFlow, RisesAlongEdgesWithoutLength) {
    const Torus torus{.faces = Faces::quads};
    const Surface made = torus.surface();
    std::vector<double> positions;
    for (int v = 0; v < made.vertex_count(); ++v) {
        const bool collapsed = v == torus.vertex(5, 8) || v == torus.vertex(5, 9) || v == torus.vertex(5, 10);
        const Vec3& p = made.position(collapsed ? v - torus.across : v);
        positions.insert(positions.end(), p.data(), p.data() + 3);
    }
    std::vector<int32_t> offsets{0}, corners;
    for (int f = 0; f < made.face_count(); ++f) {
        corners.insert(corners.end(), made.face(f).begin(), made.face(f).end());
        offsets.push_back(static_cast<int32_t>(corners.size()));
    }
    const Surface surface({positions, offsets, corners, {}, {}});
    const Case c(surface, torus.ring(), gates(3));
    expect_strip_laws(c);
    for (const FlowKind kind : {FlowKind::gates, FlowKind::arc_length}) {
        Options options = gates(3);
        options.flow = kind;
        expect_flow_laws(c, make_flow(c.patch, c.band, options));
    }
}

/// Stretches of jagged loops on tori of all kinds of faces.
struct OpenCase {
    Torus torus;
    Options options;
    Surface surface;
    Curve contour;
    Case c;

    explicit OpenCase(unsigned seed)
        : torus{.around = 40,
                .across = 24,
                .faces = std::array{Faces::triangles, Faces::quads, Faces::mixed}[seed % 3],
                .jitter = 0.1 * (seed % 4),
                .seed = seed},
          options(gates(1 + static_cast<int>(seed % 5))),
          surface(torus.surface()),
          contour(stretch(seed)),
          c(surface, contour, options, false) {}

    Curve stretch(unsigned seed) const {
        if (torus.faces == Faces::mixed) return row();
        const Curve loop = torus.jagged_loop(1 + static_cast<int>(seed % 2), seed);
        return Curve(loop.begin() + 3, loop.begin() + 5 + seed % 20);
    }

    /// Merged faces leave edges along the rows only.
    Curve row() const {
        const Curve ring = torus.ring();
        return Curve(ring.begin() + 4, ring.begin() + 24);
    }
};

constexpr unsigned open_cases = 60;

/// Vertices - edges + faces, the contour's own edges included.
int euler_characteristic(const Case& c) {
    return static_cast<int>(std::ranges::count_if(c.band.side, [](Side s) { return s != Side::outside; })) -
           static_cast<int>(std::ranges::count(c.band.edge, 1)) + static_cast<int>(std::ranges::count(c.band.face, 1));
}

/// The vertices of all band polygons at a vertex.
std::set<int> polygon_neighbors(const Case& c, int vertex) {
    std::set<int> polygons, found;
    for (const auto f : c.patch.mesh.vf_range(PatchMesh::VertexHandle(vertex)))
        if (c.band.face[f.idx()]) polygons.insert(c.patch.polygon[f.idx()]);
    for (const int p : polygons) {
        for (int f = c.patch.first_face[p]; f < c.patch.first_face[p + 1]; ++f)
            for (const auto v : c.patch.mesh.fv_range(PatchMesh::FaceHandle(f))) found.insert(v.idx());
    }
    return found;
}

TEST(OpenBand, IsADiskThatGrowsRoundByRound) {
    for (unsigned seed = 0; seed < open_cases; ++seed) {
        const OpenCase open(seed);
        const Case& c = open.c;
        SCOPED_TRACE(seed);
        EXPECT_EQ(euler_characteristic(c), 1);
        EXPECT_GT(c.band.rounds, 0);
        for (int v = 0; v < static_cast<int>(c.band.round.size()); ++v) {
            EXPECT_EQ(c.band.round[v] < 0, c.band.side[v] == Side::outside);
            EXPECT_LE(c.band.round[v], c.band.rounds);
            if (c.band.round[v] <= 0) continue;
            const std::set<int> near = polygon_neighbors(c, v);
            EXPECT_TRUE(
                std::ranges::any_of(near, [&](int w) { return c.band.round[w] >= 0 && c.band.round[w] < c.band.round[v]; }));
        }
    }
}

/// Each boundary runs from end to end, and its vertices are the last one's or share a polygon with them.
TEST(OpenBand, BoundariesRunFromEndToEnd) {
    for (unsigned seed = 0; seed < open_cases; ++seed) {
        const OpenCase open(seed);
        const Case& c = open.c;
        SCOPED_TRACE(seed);
        for (const auto* side : {&c.band.left, &c.band.right}) {
            ASSERT_EQ(static_cast<int>(side->size()), c.band.rounds + 1);
            EXPECT_EQ(side->front(), c.patch.contour);
            for (size_t r = 1; r < side->size(); ++r) {
                const Curve& curve = (*side)[r];
                const std::set<int> last((*side)[r - 1].begin(), (*side)[r - 1].end());
                ASSERT_GE(curve.size(), 2u);
                EXPECT_EQ(curve.front(), c.patch.contour.front());
                EXPECT_EQ(curve.back(), c.patch.contour.back());
                EXPECT_EQ(std::set<int>(curve.begin(), curve.end()).size(), curve.size());
                for (const int v : curve) {
                    const std::set<int> near = polygon_neighbors(c, v);
                    EXPECT_TRUE(last.contains(v) || std::ranges::any_of(near, [&](int w) { return last.contains(w); }));
                }
            }
        }
    }
}

TEST(OpenBand, WrapsAroundTheEnds) {
    for (const Faces faces : {Faces::quads, Faces::triangles}) {
        const Torus torus{.around = 40, .across = 24, .faces = faces};
        const Surface surface = torus.surface();
        const Curve ring = torus.ring();
        const Case c(surface, Curve(ring.begin(), ring.begin() + 12), gates(4), false);
        for (const int end : {c.patch.contour.front(), c.patch.contour.back()}) {
            for (const auto f : c.patch.mesh.vf_range(PatchMesh::VertexHandle(end))) EXPECT_TRUE(c.band.face[f.idx()]);
        }
        EXPECT_GT(c.band.end_polygons, 0);
    }
}

TEST(OpenStrips, LawsHoldAroundJaggedCurves) {
    int swallowed = 0;
    size_t beyond = 0;
    for (unsigned seed = 0; seed < open_cases; ++seed) {
        const OpenCase open(seed);
        SCOPED_TRACE(seed);
        expect_all_laws(open.c, open.options);
        swallowed += open.c.swallowed() - static_cast<int>(open.c.beyond().size());
        beyond += open.c.beyond().size();
    }
    EXPECT_GT(swallowed, 50) << "the curves are too smooth to need refined strips";
    EXPECT_GT(beyond, 10u) << "no vertex lies beyond the strips";
}

TEST(OpenStrips, LawsHoldOverTheWholeSurface) {
    for (const Faces faces : {Faces::quads, Faces::triangles}) {
        const Torus torus{.faces = faces, .jitter = 0.3};
        const Surface surface = torus.surface();
        const Curve loop = torus.jagged_loop(2, 5);
        const Case c(surface, Curve(loop.begin(), loop.begin() + 12), gates(std::nullopt), false);
        EXPECT_EQ(euler_characteristic(c), 1);
        expect_all_laws(c, gates(std::nullopt));
    }
}

TEST(OpenStrips, LawsHoldAroundASingleEdge) {
    for (const Faces faces : {Faces::quads, Faces::triangles}) {
        const Torus torus{.faces = faces, .jitter = 0.2};
        const Surface surface = torus.surface();
        expect_all_laws(Case(surface, {torus.vertex(3, 8), torus.vertex(4, 8)}, gates(3), false), gates(3));
    }
}

TEST(OpenStripFlow, ReversalIsOneMinusTheFlow) {
    for (unsigned seed = 0; seed < 20; ++seed) {
        const Torus torus{.jitter = 0.35, .seed = seed};
        const Surface surface = torus.surface();
        const Options options = gates(1 + static_cast<int>(seed % 4));
        const Curve loop = torus.jagged_loop(1 + static_cast<int>(seed % 2), seed);
        Curve contour(loop.begin(), loop.begin() + 14);
        const EdgeFlow flow = edge_flow(Case(surface, contour, options, false), options);
        SCOPED_TRACE(seed);
        std::ranges::reverse(contour);
        EXPECT_LT(largest_difference(flow, edge_flow(Case(surface, contour, options, false), options), -1.0), 1e-9);
    }
}

/// A tube from one circle of border to another, its columns `leaning` rows further each, so that the border sheers off the curve.
struct LeaningTube {
    int columns = 20, rows = 24;
    double leaning = 0.0, jitter = 0.0;

    int vertex(int i, int j) const { return i * rows + (j + rows) % rows; }

    Surface surface() const {
        std::mt19937 random(7);
        std::uniform_real_distribution<double> wobble(-jitter, jitter);
        std::vector<double> positions;
        std::vector<int32_t> offsets{0}, corners;
        for (int i = 0; i < columns; ++i) {
            for (int j = 0; j < rows; ++j) {
                const double angle = 2.0 * std::numbers::pi * (j + leaning * i + wobble(random)) / rows;
                positions.insert(positions.end(), {0.25 * (i + wobble(random)), std::cos(angle), std::sin(angle)});
                if (i + 1 == columns) continue;
                for (const int v : {vertex(i, j), vertex(i + 1, j), vertex(i + 1, j + 1), vertex(i, j + 1)}) corners.push_back(v);
                offsets.push_back(static_cast<int32_t>(corners.size()));
            }
        }
        return Surface({positions, offsets, corners, {}, {}});
    }
};

TEST(OpenStripFlow, EndsOnTheBorderHoldItsWholePiece) {
    for (const double jitter : {0.0, 0.3}) {
        const LeaningTube tube{.leaning = 0.5, .jitter = jitter};
        const Surface surface = tube.surface();
        Curve contour;
        for (int i = 0; i < tube.columns; ++i) contour.push_back(tube.vertex(i, 5));
        for (const FlowKind kind : {FlowKind::gates, FlowKind::arc_length}) {
            Options options = gates(4);
            options.flow = kind;
            options.ends = Ends::border;
            const Case c(surface, contour, options, false);
            expect_strip_laws(c);
            const Flow flow = make_flow(c.patch, c.band, options);
            const std::vector<int> first = border_piece(c.patch, c.band, c.patch.contour.front());
            const std::vector<int> last = border_piece(c.patch, c.band, c.patch.contour.back());
            ASSERT_GE(first.size(), 7u);
            ASSERT_GE(last.size(), 7u);
            const std::set<int> zero(first.begin(), first.end()), one(last.begin(), last.end());
            for (int v = 0; v < static_cast<int>(flow.value.size()); ++v) {
                if (c.band.side[v] == Side::outside) continue;
                EXPECT_EQ(flow.value[v] <= 0.0, zero.contains(v));
                EXPECT_EQ(flow.value[v] >= 1.0, one.contains(v));
            }
            for (const Curve& strip : c.strips) {
                for (size_t i = 0; i + 1 < strip.size(); ++i) {
                    const bool held = (zero.contains(strip[i]) && zero.contains(strip[i + 1])) ||
                                      (one.contains(strip[i]) && one.contains(strip[i + 1]));
                    const double increment = flow.value[strip[i + 1]] - flow.value[strip[i]];
                    EXPECT_TRUE(held ? increment == 0.0 : increment > 1e-9);
                }
            }
            expect_arc_length(c, flow, c.patch.contour);
        }
    }
}

/// Both ends on one circle of border: each holds only its own vertex.
TEST(OpenStripFlow, EndsOnOnePieceOfBorderHoldThemselves) {
    const LeaningTube tube{.jitter = 0.2};
    const Surface surface = tube.surface();
    Curve contour;
    for (int i = 0; i < 4; ++i) contour.push_back(tube.vertex(i, 5));
    for (int j = 6; j < 9; ++j) contour.push_back(tube.vertex(3, j));
    for (int i = 2; i >= 0; --i) contour.push_back(tube.vertex(i, 8));
    Options options = gates(4);
    options.ends = Ends::border;
    const Case c(surface, contour, options, false);
    expect_all_laws(c, options);
}

}  // namespace
}  // namespace mrc
