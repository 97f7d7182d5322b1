// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/surface.h>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <memory>
#include <numbers>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>

namespace mrc {
namespace {

using Pair = std::pair<int, int>;

// Owns the arrays of a mesh, so that tests can build, change and drop them.
struct Mesh {
    std::vector<Vec3> points;
    std::vector<std::vector<int>> polygons;
    std::vector<int32_t> triangles, hidden;
    std::vector<double> positions;
    std::vector<int32_t> offsets, vertices;

    SurfaceArrays arrays() {
        positions.clear();
        for (const Vec3& p : points) positions.insert(positions.end(), p.begin(), p.end());
        offsets = {0};
        vertices.clear();
        for (const auto& polygon : polygons) {
            vertices.insert(vertices.end(), polygon.begin(), polygon.end());
            offsets.push_back(static_cast<int32_t>(vertices.size()));
        }
        return {positions, offsets, vertices, triangles, hidden};
    }

    Surface surface() { return Surface(arrays()); }
};

std::vector<Vec3> random_points(int count, std::mt19937& random) {
    std::uniform_real_distribution<double> coordinate(-1.0, 1.0);
    std::vector<Vec3> points(count);
    for (Vec3& p : points) p = {coordinate(random), coordinate(random), coordinate(random)};
    return points;
}

Mesh with_points(std::vector<std::vector<int>> polygons, int count) {
    std::mt19937 random(7);
    Mesh mesh;
    mesh.points = random_points(count, random);
    mesh.polygons = std::move(polygons);
    return mesh;
}

Mesh cube() {
    Mesh mesh;
    for (int i = 0; i < 8; ++i) mesh.points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
    mesh.polygons = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    return mesh;
}

Mesh tetrahedron() { return with_points({{0, 1, 2}, {0, 3, 1}, {1, 3, 2}, {2, 3, 0}}, 4); }

// Quads on a plane; wrapped in one direction it is a tube, in both a torus.
Mesh grid(int columns, int rows, bool wrap_columns = false, bool wrap_rows = false) {
    Mesh mesh;
    const int width = wrap_columns ? columns : columns + 1;
    const int height = wrap_rows ? rows : rows + 1;
    for (int j = 0; j < height; ++j) {
        for (int i = 0; i < width; ++i) mesh.points.emplace_back(i, j, 0.0);
    }
    const auto at = [&](int i, int j) { return j % height * width + i % width; };
    for (int j = 0; j < rows; ++j) {
        for (int i = 0; i < columns; ++i) mesh.polygons.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)});
    }
    return mesh;
}

// Polygons of three to seven corners between few vertices: most edges are irregular, most polygons fold.
Mesh random_soup(unsigned seed) {
    std::mt19937 random(seed);
    Mesh mesh;
    mesh.points = random_points(12 + static_cast<int>(random() % 20), random);
    std::vector<int> ids(mesh.points.size());
    std::iota(ids.begin(), ids.end(), 0);
    for (int f = 0, count = 4 + static_cast<int>(random() % 16); f < count; ++f) {
        std::ranges::shuffle(ids, random);
        mesh.polygons.emplace_back(ids.begin(), ids.begin() + 3 + random() % 5);
    }
    return mesh;
}

// A grid with quads left out, split, and turned over at random, its faces and vertices renumbered.
Mesh random_sheet(unsigned seed) {
    std::mt19937 random(seed);
    Mesh whole = grid(6, 5, random() % 2 == 0, random() % 2 == 0);
    std::vector<int> ids(whole.points.size());
    std::iota(ids.begin(), ids.end(), 0);
    std::ranges::shuffle(ids, random);
    Mesh mesh;
    mesh.points = random_points(static_cast<int>(ids.size()), random);
    for (auto& q : whole.polygons) {
        for (int& v : q) v = ids[v];
        const auto fate = random() % 12;
        if (fate == 0) continue;
        if (fate == 1) std::ranges::reverse(q);
        if (fate < 6) {
            mesh.polygons.push_back({q[0], q[1], q[2]});
            mesh.polygons.push_back({q[2], q[3], q[0]});
        } else {
            mesh.polygons.push_back(q);
        }
    }
    std::ranges::shuffle(mesh.polygons, random);
    return mesh;
}

std::vector<Mesh> sample_meshes() {
    std::vector<Mesh> meshes = {cube(), tetrahedron(), grid(4, 3), grid(5, 4, true), grid(5, 4, true, true)};
    for (unsigned seed = 0; seed < 40; ++seed) {
        meshes.push_back(random_soup(seed));
        meshes.push_back(random_sheet(seed));
    }
    return meshes;
}

Pair ordered(int a, int b) { return {std::min(a, b), std::max(a, b)}; }

// The sides of polygons by vertex pair, each as (face, true where it runs upwards): adjacency from its definition.
std::map<Pair, std::vector<std::pair<int, bool>>> sides_of(const Mesh& mesh) {
    std::map<Pair, std::vector<std::pair<int, bool>>> sides;
    for (size_t f = 0; f < mesh.polygons.size(); ++f) {
        const auto& polygon = mesh.polygons[f];
        for (size_t i = 0; i < polygon.size(); ++i) {
            const int a = polygon[i];
            const int b = polygon[(i + 1) % polygon.size()];
            sides[ordered(a, b)].emplace_back(static_cast<int>(f), a < b);
        }
    }
    return sides;
}

std::set<std::pair<int, Pair>> real_sides(const Surface& s) {
    std::set<std::pair<int, Pair>> sides;
    for (int h = 0; h < s.halfedge_count(); ++h) {
        if (!s.diagonal(h)) sides.insert({s.halfedge_face(h), {s.from(h), s.to(h)}});
    }
    return sides;
}

int real_edge_count(const Surface& s) {
    std::set<int> edges;
    for (int h = 0; h < s.halfedge_count(); ++h) {
        if (!s.diagonal(h)) edges.insert(s.edge(h));
    }
    return static_cast<int>(edges.size());
}

int euler_characteristic(const Surface& s) { return s.vertex_count() - real_edge_count(s) + s.face_count(); }

int count_twins(const Surface& s, int kind) {
    int count = 0;
    for (int h = 0; h < s.halfedge_count(); ++h) count += s.twin(h) == kind ? 1 : 0;
    return count;
}

int count_regular(const Surface& s) {
    int count = 0;
    for (int v = 0; v < s.vertex_count(); ++v) count += s.regular(v) ? 1 : 0;
    return count;
}

Vec3 area_vector(const Surface& s, int triangle) {
    const auto& [a, b, c] = s.triangle(triangle);
    return 0.5 * (s.position(b) - s.position(a)).cross(s.position(c) - s.position(a));
}

// --- Half-edge laws, on every sample mesh ---

TEST(Surface, KeepsPolygonsAndNumbersTheirTriangles) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        ASSERT_EQ(s.vertex_count(), static_cast<int>(mesh.points.size()));
        ASSERT_EQ(s.face_count(), static_cast<int>(mesh.polygons.size()));
        ASSERT_EQ(s.first_triangle(s.face_count()), s.triangle_count());
        for (int v = 0; v < s.vertex_count(); ++v) EXPECT_EQ(s.position(v), mesh.points[v]);
        for (int f = 0; f < s.face_count(); ++f) {
            EXPECT_TRUE(std::ranges::equal(s.face(f), mesh.polygons[f]));
            EXPECT_EQ(s.first_triangle(f + 1) - s.first_triangle(f), static_cast<int>(s.face(f).size()) - 2);
            for (int t = s.first_triangle(f); t < s.first_triangle(f + 1); ++t) EXPECT_EQ(s.triangle_face(t), f);
        }
    }
}

TEST(Surface, HalfedgesObeyTheirLaws) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        for (int h = 0; h < s.halfedge_count(); ++h) {
            EXPECT_EQ(Surface::next(Surface::next(Surface::next(h))), h);
            EXPECT_EQ(Surface::previous(Surface::next(h)), h);
            EXPECT_EQ(Surface::next(h) / 3, h / 3);
            const int twin = s.twin(h);
            if (twin < 0) {
                EXPECT_FALSE(s.diagonal(h));
                continue;
            }
            ASSERT_NE(twin, h);
            EXPECT_EQ(s.twin(twin), h);
            EXPECT_EQ(s.from(twin), s.to(h));
            EXPECT_EQ(s.to(twin), s.from(h));
            EXPECT_EQ(s.diagonal(twin), s.diagonal(h));
            EXPECT_EQ(s.halfedge_face(twin) == s.halfedge_face(h), s.diagonal(h));
        }
    }
}

TEST(Surface, TwinsFollowFromTheSidesOfPolygons) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        const auto sides = sides_of(mesh);
        size_t real = 0;
        for (int h = 0; h < s.halfedge_count(); ++h) {
            if (s.diagonal(h)) continue;
            ++real;
            const auto& meeting = sides.at(ordered(s.from(h), s.to(h)));
            if (meeting.size() == 1) {
                EXPECT_EQ(s.twin(h), Surface::border);
            } else if (meeting.size() == 2 && meeting[0].second != meeting[1].second) {
                ASSERT_GE(s.twin(h), 0);
                EXPECT_NE(s.halfedge_face(s.twin(h)), s.halfedge_face(h));
            } else {
                EXPECT_EQ(s.twin(h), Surface::irregular);
            }
        }
        EXPECT_EQ(real, mesh.vertices.size());
    }
}

TEST(Surface, EdgeIdsAreDenseAndInTheOrderOfTheFirstHalfedge) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        // A real edge is its two vertices; a diagonal is besides of one face.
        std::map<std::pair<int, Pair>, int> ids;
        for (int h = 0; h < s.halfedge_count(); ++h) {
            const std::pair key(s.diagonal(h) ? s.halfedge_face(h) : -1, ordered(s.from(h), s.to(h)));
            EXPECT_EQ(s.edge(h), ids.emplace(key, static_cast<int>(ids.size())).first->second);
        }
        EXPECT_EQ(s.edge_count(), static_cast<int>(ids.size()));
        EXPECT_EQ(real_edge_count(s), static_cast<int>(sides_of(mesh).size()));
    }
}

TEST(Surface, OutgoingHalfedgesArePartitionedByTheirStart) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        int degrees = 0;
        for (int v = 0; v < s.vertex_count(); ++v) {
            const auto outgoing = s.outgoing(v);
            degrees += static_cast<int>(outgoing.size());
            EXPECT_EQ(std::ranges::adjacent_find(outgoing, std::greater_equal<>{}), outgoing.end());
            for (const int h : outgoing) EXPECT_EQ(s.from(h), v);
        }
        EXPECT_EQ(degrees, s.halfedge_count());
    }
}

TEST(Surface, FindsExactlyTheRealHalfedges) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        std::map<Pair, int> first;
        for (int h = 0; h < s.halfedge_count(); ++h) {
            if (!s.diagonal(h)) first.emplace(Pair{s.from(h), s.to(h)}, h);
        }
        for (int a = 0; a < s.vertex_count(); ++a) {
            for (int b = 0; b < s.vertex_count(); ++b) {
                const auto known = first.find({a, b});
                EXPECT_EQ(s.find_halfedge(a, b), known == first.end() ? -1 : known->second);
                EXPECT_EQ(s.real_edge(a, b), first.contains({a, b}) || first.contains({b, a}));
            }
        }
    }
}

TEST(Surface, VisitsEveryRealEdgeAtAVertex) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        const auto sides = sides_of(mesh);
        std::map<int, std::set<int>> expected;
        for (const auto& [ends, meeting] : sides) {
            expected[ends.first].insert(ends.second);
            expected[ends.second].insert(ends.first);
        }
        for (int v = 0; v < s.vertex_count(); ++v) {
            std::multiset<int> visited;
            s.for_each_real_edge(v, [&](int neighbor, int edge) {
                visited.insert(neighbor);
                const int h = s.find_halfedge(v, neighbor);
                EXPECT_EQ(edge, s.edge(h >= 0 ? h : s.find_halfedge(neighbor, v)));
            });
            EXPECT_EQ(std::set<int>(visited.begin(), visited.end()), expected[v]);
            for (const int u : expected[v]) {
                const auto& meeting = sides.at(ordered(u, v));
                const bool plain = meeting.size() == 1 || (meeting.size() == 2 && meeting[0].second != meeting[1].second);
                EXPECT_TRUE(!plain || visited.count(u) == 1);
            }
        }
    }
}

// Regular from its definition: no irregular edge, and the polygons at v are connected through the sides that they share there.
bool regular_by_definition(const Mesh& mesh, int v) {
    const auto sides = sides_of(mesh);
    std::map<int, std::set<int>> neighbors;
    std::set<int> faces;
    for (const auto& [ends, meeting] : sides) {
        if (ends.first != v && ends.second != v) continue;
        if (meeting.size() > 2 || (meeting.size() == 2 && meeting[0].second == meeting[1].second)) return false;
        for (const auto& side : meeting) {
            faces.insert(side.first);
            neighbors[side.first].insert(meeting.front().first);
            neighbors[meeting.front().first].insert(side.first);
        }
    }
    if (faces.empty()) return true;
    std::set<int> reached = {*faces.begin()};
    for (size_t before = 0; before != reached.size();) {
        before = reached.size();
        for (const int f : std::set<int>(reached)) reached.insert(neighbors[f].begin(), neighbors[f].end());
    }
    return reached == faces;
}

TEST(Surface, RegularVerticesHaveOneFan) {
    int irregular = 0;
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        for (int v = 0; v < s.vertex_count(); ++v) {
            EXPECT_EQ(s.regular(v), regular_by_definition(mesh, v)) << "vertex " << v;
            irregular += s.regular(v) ? 0 : 1;
        }
    }
    EXPECT_GT(irregular, 100);
}

// --- Known shapes ---

TEST(Surface, KnownShapesHaveTheirEulerCharacteristic) {
    EXPECT_EQ(euler_characteristic(cube().surface()), 2);
    EXPECT_EQ(euler_characteristic(tetrahedron().surface()), 2);
    EXPECT_EQ(euler_characteristic(grid(4, 3).surface()), 1);
    EXPECT_EQ(euler_characteristic(grid(5, 4, true).surface()), 0);
    EXPECT_EQ(euler_characteristic(grid(5, 4, true, true).surface()), 0);
}

TEST(Surface, DiagonalsLeaveTheEulerCharacteristicAsItIs) {
    for (Mesh& mesh : sample_meshes()) {
        const Surface s = mesh.surface();
        EXPECT_EQ(euler_characteristic(s), s.vertex_count() - s.edge_count() + s.triangle_count());
    }
}

TEST(Surface, ClosedShapesHaveNoBorderAndOpenOnesTheirRim) {
    for (Mesh mesh : {cube(), tetrahedron(), grid(5, 4, true, true)}) {
        const Surface s = mesh.surface();
        EXPECT_EQ(count_twins(s, Surface::border) + count_twins(s, Surface::irregular), 0);
        EXPECT_EQ(count_regular(s), s.vertex_count());
    }
    const Surface open = grid(4, 3).surface();
    EXPECT_EQ(count_twins(open, Surface::border), 2 * (4 + 3));
    EXPECT_EQ(count_regular(open), open.vertex_count());
    EXPECT_EQ(count_twins(grid(5, 4, true).surface(), Surface::border), 2 * 5);
}

TEST(Surface, MoebiusStripHasOneEdgeOfDisagreeingWinding) {
    constexpr int n = 7;
    Mesh mesh = with_points({}, 2 * n);
    for (int i = 0; i < n; ++i) {
        const int a = 2 * i, b = 2 * i + 1;
        const bool seam = i == n - 1;
        mesh.polygons.push_back({a, seam ? 1 : a + 2, seam ? 0 : b + 2, b});
    }
    const Surface s = mesh.surface();
    EXPECT_EQ(count_twins(s, Surface::irregular), 2);
    EXPECT_EQ(s.twin(s.find_halfedge(1, 0)), Surface::irregular);
    EXPECT_EQ(euler_characteristic(s), 0);
    EXPECT_EQ(count_regular(s), s.vertex_count() - 2);
}

TEST(Surface, FlippedFaceMakesItsEdgesIrregular) {
    Mesh mesh = cube();
    std::ranges::reverse(mesh.polygons[1]);
    const Surface s = mesh.surface();
    EXPECT_EQ(count_twins(s, Surface::irregular), 8);
    for (int v = 0; v < 8; ++v) EXPECT_EQ(s.regular(v), v < 4);
}

TEST(Surface, ThreeFacesOnAnEdgeShareItsIdAndAreIrregular) {
    const Surface s = with_points({{0, 1, 2}, {1, 0, 3}, {0, 1, 4}}, 5).surface();
    EXPECT_EQ(count_twins(s, Surface::irregular), 3);
    EXPECT_EQ(s.edge(0), s.edge(3));
    EXPECT_EQ(s.edge(0), s.edge(6));
    EXPECT_EQ(s.edge_count(), 7);
    EXPECT_FALSE(s.regular(0) || s.regular(1));
    EXPECT_TRUE(s.regular(2) && s.regular(3) && s.regular(4));
}

TEST(Surface, ConesThatShareTheirTipAreTwoFans) {
    Mesh mesh = with_points({}, 9);
    for (int i = 0; i < 4; ++i) {
        mesh.polygons.push_back({0, 1 + i, 1 + (i + 1) % 4});
        mesh.polygons.push_back({0, 5 + i, 5 + (i + 1) % 4});
    }
    const Surface s = mesh.surface();
    EXPECT_FALSE(s.regular(0));
    EXPECT_EQ(count_regular(s), 8);
    EXPECT_EQ(count_twins(s, Surface::irregular), 0);
}

TEST(Surface, DuplicateFaceMakesItsEdgesIrregular) {
    Mesh mesh = tetrahedron();
    mesh.polygons.push_back({1, 2, 0});
    const Surface s = mesh.surface();
    EXPECT_EQ(count_twins(s, Surface::irregular), 9);
    EXPECT_EQ(s.edge_count(), 6);
    for (int v = 0; v < 4; ++v) EXPECT_EQ(s.regular(v), v == 3);
}

TEST(Surface, ManySpokesAtOneVertex) {
    constexpr int n = 200000;
    Mesh mesh;
    mesh.points.assign(n + 1, Vec3::Zero());
    for (int i = 0; i < n; ++i) mesh.polygons.push_back({0, 1 + i, 1 + (i + 1) % n});
    const Surface s = mesh.surface();
    EXPECT_EQ(count_twins(s, Surface::border), n);
    EXPECT_EQ(s.edge_count(), 2 * n);
    EXPECT_EQ(count_regular(s), n + 1);
}

TEST(Surface, EmptyAndDegenerateInputIsLegal) {
    const Surface none(SurfaceArrays{});
    EXPECT_EQ(none.vertex_count() + none.face_count() + none.edge_count(), 0);

    const Surface points = with_points({}, 3).surface();
    EXPECT_EQ(points.face_count(), 0);
    EXPECT_EQ(count_regular(points), 3);
    EXPECT_TRUE(points.outgoing(2).empty());

    Mesh collapsed = cube();
    std::ranges::fill(collapsed.points, Vec3(1.0, 2.0, 3.0));
    const Surface s = collapsed.surface();
    EXPECT_EQ(euler_characteristic(s), 2);
    EXPECT_EQ(count_regular(s), 8);
}

TEST(Surface, HiddenFacesAreMarkedAndMayRepeat) {
    Mesh mesh = cube();
    mesh.hidden = {4, 1, 4};
    const Surface s = mesh.surface();
    for (int f = 0; f < 6; ++f) EXPECT_EQ(s.hidden(f), f == 1 || f == 4);
}

TEST(Surface, PointsOfEdgesInterpolate) {
    const Surface s = cube().surface();
    EXPECT_EQ(s.position(vertex_point(6)), s.position(6));
    EXPECT_EQ(s.position(SurfacePoint{0, 1, 0.25}), Vec3(0.25, 0.0, 0.0));
}

// --- Triangulation ---

// A random triangulation of the polygon, from the corners i to j of it on.
void random_triangles(const std::vector<int>& polygon, size_t i, size_t j, std::mt19937& random, std::vector<int32_t>& out) {
    if (j - i < 2) return;
    const size_t k = i + 1 + random() % (j - i - 1);
    random_triangles(polygon, i, k, random, out);
    out.insert(out.end(), {polygon[k], polygon[j], polygon[i]});
    random_triangles(polygon, k, j, random, out);
}

TEST(Triangulation, GivenOnesAreKeptAndChangeNoRealEdge) {
    std::mt19937 random(3);
    for (Mesh& mesh : sample_meshes()) {
        const Surface own = mesh.surface();
        for (const auto& polygon : mesh.polygons) random_triangles(polygon, 0, polygon.size() - 1, random, mesh.triangles);
        const Surface given = mesh.surface();
        for (int t = 0; t < given.triangle_count(); ++t) {
            for (int c = 0; c < 3; ++c) EXPECT_EQ(given.triangle(t)[c], mesh.triangles[3 * t + c]);
        }
        EXPECT_EQ(real_sides(given), real_sides(own));
        EXPECT_EQ(given.edge_count(), own.edge_count());
        for (int f = 0; f < own.face_count(); ++f) EXPECT_TRUE(std::ranges::equal(given.face(f), own.face(f)));
        for (int v = 0; v < own.vertex_count(); ++v) EXPECT_EQ(given.regular(v), own.regular(v));
    }
}

TEST(Triangulation, TrianglesNeedNoOffsets) {
    Mesh mesh = tetrahedron();
    SurfaceArrays arrays = mesh.arrays();
    const Surface with(arrays);
    arrays.face_offsets = {};
    const Surface without(arrays);
    arrays.triangles = arrays.face_vertices;
    const Surface given(arrays);
    for (const Surface* s : {&without, &given}) {
        EXPECT_EQ(real_sides(*s), real_sides(with));
        EXPECT_TRUE(std::ranges::equal(s->face(2), mesh.polygons[2]));
    }
}

TEST(Triangulation, DiagonalOnARealEdgeOfAnotherFaceIsAnotherEdge) {
    Mesh mesh = with_points({{0, 1, 2, 3}, {2, 0, 4}}, 5);
    mesh.triangles = {0, 1, 2, 0, 2, 3, 2, 0, 4};
    const Surface s = mesh.surface();
    EXPECT_TRUE(s.diagonal(2) && s.diagonal(3));
    EXPECT_EQ(s.twin(2), 3);
    EXPECT_FALSE(s.diagonal(6));
    EXPECT_EQ(s.twin(6), Surface::border);
    EXPECT_NE(s.edge(6), s.edge(2));
    EXPECT_EQ(s.find_halfedge(2, 0), 6);
    EXPECT_EQ(s.find_halfedge(0, 2), -1);
}

// A polygon in a random plane, from its corners in the standard plane.
Mesh lone_polygon(const std::vector<Eigen::Vector2d>& corners, std::mt19937& random) {
    std::normal_distribution<double> normal;
    const Eigen::Quaterniond turn = Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
    const Vec3 shift(normal(random), normal(random), normal(random));
    Mesh mesh;
    mesh.polygons.resize(1);
    for (const auto& c : corners) {
        mesh.polygons[0].push_back(static_cast<int>(mesh.points.size()));
        mesh.points.push_back(turn * Vec3(c.x(), c.y(), 0.0) + shift);
    }
    return mesh;
}

std::vector<Eigen::Vector2d> star(int n, std::mt19937& random) {
    std::uniform_real_distribution<double> radius(0.15, 1.0);
    std::vector<Eigen::Vector2d> corners;
    for (int i = 0; i < n; ++i) {
        const double angle = 2.0 * std::numbers::pi * i / n;
        corners.push_back(radius(random) * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
    }
    return corners;
}

std::vector<Eigen::Vector2d> comb(int teeth) {
    std::vector<Eigen::Vector2d> corners = {{2.0 * teeth, 0.0}};
    for (int i = teeth - 1; i >= 0; --i) {
        corners.insert(corners.end(), {{2.0 * i + 1.6, 5.0}, {2.0 * i + 1.2, 0.3}, {2.0 * i + 0.4, 0.2}});
    }
    corners.emplace_back(0.0, 0.0);
    return corners;
}

double area(const std::vector<Eigen::Vector2d>& p) {
    double twice = 0.0;
    for (size_t i = 0; i < p.size(); ++i) {
        const auto& a = p[i];
        const auto& b = p[(i + 1) % p.size()];
        twice += a.x() * b.y() - a.y() * b.x();
    }
    return 0.5 * twice;
}

void expect_tiled(const std::vector<Eigen::Vector2d>& corners, std::mt19937& random) {
    const Surface s = lone_polygon(corners, random).surface();
    Vec3 whole = Vec3::Zero();
    for (int t = 0; t < s.triangle_count(); ++t) whole += area_vector(s, t);
    EXPECT_NEAR(whole.norm(), area(corners), 1e-9 * area(corners));
    for (int t = 0; t < s.triangle_count(); ++t) {
        EXPECT_GT(area_vector(s, t).dot(whole.normalized()), 1e-9 * whole.norm()) << corners.size() << " corners, triangle " << t;
    }
}

TEST(Triangulation, ConcavePolygonsAreTiledByPositiveAreas) {
    std::mt19937 random(11);
    for (int n = 4; n < 60; ++n) {
        for (int k = 0; k < 5; ++k) {
            auto corners = star(n, random);
            if (n < 6 && area(corners) < 0.2) continue;
            expect_tiled(corners, random);
        }
    }
    // Its corners lie on few lines, so rounding, which differs by plane, decides whether a diagonal runs through others.
    for (int teeth = 1; teeth < 12; ++teeth) {
        auto corners = comb(teeth);
        for (size_t start = 0; start < corners.size(); ++start) {
            std::rotate(corners.begin(), corners.begin() + 1, corners.end());
            for (int k = 0; k < 10; ++k) expect_tiled(corners, random);
        }
    }
}

TEST(Triangulation, StraightCornersAreTiledByPositiveAreas) {
    std::mt19937 random(12);
    for (int sides = 3; sides < 7; ++sides) {
        for (int between = 1; between < 4; ++between) {
            std::vector<Eigen::Vector2d> corners;
            const auto at = [&](int i) {
                return Eigen::Vector2d(std::cos(2.0 * std::numbers::pi * i / sides), std::sin(2.0 * std::numbers::pi * i / sides));
            };
            for (int i = 0; i < sides; ++i) {
                for (int k = 0; k <= between; ++k) corners.push_back(at(i) + k * (at(i + 1) - at(i)) / (between + 1));
            }
            expect_tiled(corners, random);
        }
    }
}

TEST(Triangulation, ConcaveQuadsAreCutInsideAndConvexOnesAlongTheShorterDiagonal) {
    std::mt19937 random(13);
    std::vector<Eigen::Vector2d> dart = {{0.0, 0.0}, {1.0, -1.0}, {0.0, 2.0}, {-1.0, -1.0}};
    std::vector<Eigen::Vector2d> kite = {{2.0, 0.0}, {0.0, 1.0}, {-3.0, 0.0}, {0.0, -1.0}};
    for (int start = 0; start < 4; ++start) {
        expect_tiled(dart, random);
        const Surface s = lone_polygon(kite, random).surface();
        for (int h = 0; h < s.halfedge_count(); ++h) {
            const double length = (s.position(s.from(h)) - s.position(s.to(h))).norm();
            EXPECT_TRUE(!s.diagonal(h) || std::abs(length - 2.0) < 1e-9) << length;
        }
        std::rotate(dart.begin(), dart.begin() + 1, dart.end());
        std::rotate(kite.begin(), kite.begin() + 1, kite.end());
    }
}

TEST(Triangulation, SquaresAreCutAtTheirFirstCornerWhicheverWayTheyLie) {
    std::mt19937 random(14);
    for (int k = 0; k < 50; ++k) {
        const Surface s = lone_polygon({{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, random).surface();
        EXPECT_EQ(s.triangle(0), (std::array{0, 1, 2}));
        EXPECT_EQ(s.triangle(1), (std::array{0, 2, 3}));
    }
}

TEST(Triangulation, DependsOnThePolygonAlone) {
    std::mt19937 random(15);
    for (int n = 4; n < 30; ++n) {
        Mesh alone = lone_polygon(star(n, random), random);
        Mesh among = random_soup(static_cast<unsigned>(n));
        std::vector<int> ids(n);
        std::iota(ids.begin(), ids.end(), static_cast<int>(among.points.size()));
        std::ranges::shuffle(ids, random);
        among.points.resize(among.points.size() + n);
        for (int i = 0; i < n; ++i) among.points[ids[i]] = alone.points[i];
        among.polygons.push_back(ids);
        const Surface a = alone.surface();
        const Surface b = among.surface();
        const int first = b.first_triangle(b.face_count() - 1);
        for (int t = 0; t < a.triangle_count(); ++t) {
            for (int c = 0; c < 3; ++c) EXPECT_EQ(ids[a.triangle(t)[c]], b.triangle(first + t)[c]);
        }
    }
}

TEST(Triangulation, DegeneratePolygonsAreStillCutIntoTheirTriangles) {
    std::mt19937 random(16);
    for (int n = 4; n < 12; ++n) {
        std::vector<Eigen::Vector2d> line, spot(n, Eigen::Vector2d(1.0, 1.0)), there_and_back;
        for (int i = 0; i < n; ++i) {
            line.emplace_back(i, 0.0);
            there_and_back.emplace_back(std::min(i, n - i), 0.0);
        }
        for (const auto& corners : {line, spot, there_and_back}) {
            Mesh mesh = lone_polygon(corners, random);
            const Surface s = mesh.surface();
            // Valid as a given triangulation means: every side once, every diagonal twice.
            for (int t = 0; t < s.triangle_count(); ++t) {
                mesh.triangles.insert(mesh.triangles.end(), s.triangle(t).begin(), s.triangle(t).end());
            }
            EXPECT_NO_THROW(mesh.surface());
            EXPECT_EQ(s.edge_count(), 2 * n - 3);
        }
    }
}

// --- Ownership ---

TEST(Surface, ArraysMayChangeAfterwards) {
    Mesh mesh = cube();
    mesh.triangles = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4, 2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    mesh.hidden = {2};
    const Surface s = mesh.surface();
    const Surface untouched = mesh.surface();
    std::ranges::fill(mesh.positions, std::numeric_limits<double>::quiet_NaN());
    for (auto* array : {&mesh.offsets, &mesh.vertices, &mesh.triangles, &mesh.hidden}) std::ranges::fill(*array, -5);
    for (int v = 0; v < 8; ++v) EXPECT_EQ(s.position(v), untouched.position(v));
    EXPECT_EQ(real_sides(s), real_sides(untouched));
    EXPECT_TRUE(std::ranges::equal(s.face(3), std::array{2, 6, 7, 3}));
    EXPECT_TRUE(s.hidden(2));
}

TEST(Surface, CopiesOutliveTheOriginal) {
    Mesh mesh = random_sheet(5);
    auto original = std::make_unique<Surface>(mesh.surface());
    const Surface copy = *original;
    const auto sides = real_sides(*original);
    original.reset();
    EXPECT_EQ(real_sides(copy), sides);
    EXPECT_EQ(real_sides(mesh.surface()), sides);
}

// --- Bad input ---

// The message of the InvalidInput that the mesh causes; empty: it caused none.
std::string fault(const SurfaceArrays& arrays) {
    try {
        const Surface s(arrays);
    } catch (const InvalidInput& e) {
        return e.what();
    }
    return {};
}

void expect_fault(Mesh mesh, std::initializer_list<const char*> words) {
    const std::string message = fault(mesh.arrays());
    EXPECT_FALSE(message.empty()) << "no exception, though expected: " << *words.begin();
    for (const char* word : words) EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' not in: " << message;
}

Mesh with_polygon(Mesh mesh, int face, std::vector<int> polygon) {
    mesh.polygons[face] = std::move(polygon);
    return mesh;
}

TEST(BadInput, PositionsThatAreNotFinite) {
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(), -HUGE_VAL}) {
        for (int axis = 0; axis < 3; ++axis) {
            Mesh mesh = cube();
            mesh.points[3][axis] = bad;
            expect_fault(mesh, {"vertex 3 has a position that is not finite"});
        }
    }
}

TEST(BadInput, PositionsTooFarOutToComputeWith) {
    for (const double bad : {1.1e50, -1e155, std::numeric_limits<double>::max()}) {
        Mesh mesh = cube();
        mesh.points[3].z() = bad;
        expect_fault(mesh, {"vertex 3 has a coordinate beyond 1e50"});
    }
    Mesh mesh = cube();
    for (Vec3& p : mesh.points) p *= 1e50;
    const double radius = mesh.surface().average_radius(0);
    EXPECT_NEAR(radius, 0.5e50, 1e36);
}

TEST(BadInput, NamesTheFirstFewAndCountsTheRest) {
    Mesh mesh = cube();
    for (int v = 1; v < 8; ++v) mesh.points[v].y() = NAN;
    expect_fault(mesh, {"vertex 1 ", "vertex 2 ", "vertex 3 ", "and 4 more"});
    EXPECT_EQ(fault(mesh.arrays()).find("vertex 4"), std::string::npos);
}

TEST(BadInput, VerticesOutOfRange) {
    for (const int bad : {-1, 8, std::numeric_limits<int>::max(), std::numeric_limits<int>::min()}) {
        const std::string vertex = "uses vertex " + std::to_string(bad);
        expect_fault(with_polygon(cube(), 4, {0, 4, bad, 2}), {"face 4 ", vertex.c_str(), "0 to 7"});
        expect_fault(with_polygon(tetrahedron(), 2, {1, bad, 2}), {"face 2 ", vertex.c_str()});
    }
    Mesh pointless = tetrahedron();
    pointless.points.clear();
    expect_fault(pointless, {"face 0 uses vertex 0"});
}

TEST(BadInput, RepeatedVertices) {
    expect_fault(with_polygon(cube(), 4, {0, 4, 6, 4}), {"face 4 repeats vertex 4"});
    expect_fault(with_polygon(tetrahedron(), 1, {0, 3, 0}), {"face 1 repeats vertex 0"});
    expect_fault(with_polygon(tetrahedron(), 1, {3, 3, 0}), {"face 1 repeats vertex 3"});
    Mesh large = grid(6, 6);
    large.polygons.push_back({0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 5});
    expect_fault(large, {"face 36 repeats vertex 5"});
}

TEST(BadInput, FacesWithFewerThanThreeVertices) {
    expect_fault(with_polygon(cube(), 5, {1, 3}), {"face 5 has 2 vertices"});
    expect_fault(with_polygon(tetrahedron(), 3, {}), {"face 3 has 0 vertices"});
}

TEST(BadInput, OffsetsThatAreNone) {
    Mesh mesh = cube();
    const auto expect_offsets = [&](std::vector<int32_t> offsets, const char* word) {
        SurfaceArrays arrays = mesh.arrays();
        arrays.face_offsets = offsets;
        const std::string message = fault(arrays);
        EXPECT_NE(message.find("face_offsets must start with 0, rise, and end with"), std::string::npos) << message;
        EXPECT_NE(message.find(word), std::string::npos) << message;
    };
    expect_offsets({4, 8, 12, 16, 20, 24}, "starts with 4");
    expect_offsets({0, 4, 8, 12, 16, 20}, "ends with 20");
    expect_offsets({0, 4, 8, 12, 16, 20, 28}, "ends with 28");
    expect_offsets({0, 4, 16, 12, 20, 24}, "from 16 to 12 at face 2");
    expect_offsets({0, 400, 24}, "from 400 to 24 at face 1");
    expect_offsets({0, -7, 24}, "from 0 to -7 at face 0");
    expect_offsets({0}, "ends with 0");
}

TEST(BadInput, ArraysOfTheWrongSize) {
    Mesh mesh = tetrahedron();
    SurfaceArrays arrays = mesh.arrays();
    arrays.positions = arrays.positions.first(10);
    EXPECT_NE(fault(arrays).find("positions has 10 numbers"), std::string::npos);

    arrays = mesh.arrays();
    arrays.face_offsets = {};
    arrays.face_vertices = arrays.face_vertices.first(11);
    EXPECT_NE(fault(arrays).find("face_vertices has 11 entries"), std::string::npos);

    mesh.triangles = {0, 1, 2};
    EXPECT_NE(fault(mesh.arrays()).find("triangles has 3 entries"), std::string::npos);
}

TEST(BadInput, HiddenFacesOutOfRange) {
    for (const int bad : {-1, 6, 600}) {
        Mesh mesh = cube();
        mesh.hidden = {0, bad};
        expect_fault(mesh, {("hidden face " + std::to_string(bad)).c_str(), "0 to 5"});
    }
}

TEST(BadInput, TrianglesThatDoNotMakeUpTheirFace) {
    // The second face is a hexagon of the vertices 3 to 8, so that every kind of fault fits in.
    const auto expect_triangles = [](std::vector<int32_t> hexagon, std::initializer_list<const char*> words) {
        Mesh mesh = with_points({{0, 1, 2}, {3, 4, 5, 6, 7, 8}}, 9);
        mesh.triangles = {1, 2, 0};
        mesh.triangles.insert(mesh.triangles.end(), hexagon.begin(), hexagon.end());
        if (words.size() == 0) {
            EXPECT_NO_THROW(mesh.surface());
        } else {
            expect_fault(mesh, words);
            EXPECT_NE(fault(mesh.arrays()).find("the triangles of face 1 "), std::string::npos);
        }
    };
    expect_triangles({3, 4, 5, 3, 5, 6, 3, 6, 7, 3, 7, 8}, {});
    expect_triangles({3, 4, 5, 5, 6, 7, 7, 8, 3, 3, 5, 7}, {});
    expect_triangles({3, 4, 5, 3, 5, 6, 3, 6, 7, 3, 7, 1}, {"vertex 1 of triangle 4 is not in the face"});
    expect_triangles({3, 4, 5, 3, 5, 6, 3, 6, 7, 3, 7, -9}, {"vertex -9 of triangle 4 is not in the face"});
    expect_triangles({3, 4, 5, 3, 5, 6, 3, 6, 7, 3, 7, 99}, {"vertex 99 of triangle 4 is not in the face"});
    expect_triangles({3, 4, 5, 3, 5, 3, 3, 6, 7, 3, 7, 8}, {"triangle 2 repeats vertex 3"});
    expect_triangles({3, 5, 4, 3, 5, 6, 3, 6, 7, 3, 7, 8}, {"triangle 1 runs against side 4-5"});
    expect_triangles({3, 4, 5, 3, 4, 6, 3, 6, 7, 3, 7, 8}, {"side 3-4 occurs more than once"});
    expect_triangles({3, 4, 5, 5, 6, 7, 3, 5, 7, 3, 5, 7}, {"side 7-8 is missing"});
    expect_triangles({3, 4, 5, 4, 5, 6, 3, 6, 7, 3, 7, 8}, {"side 4-5 occurs more than once"});
    expect_triangles({3, 4, 7, 4, 5, 8, 5, 6, 3, 6, 7, 8}, {"side 8-3 is missing"});
    expect_triangles({8, 3, 4, 4, 5, 7, 5, 6, 3, 7, 8, 6}, {"diagonal 3-5 must occur twice"});
    expect_triangles({8, 3, 4, 4, 5, 6, 6, 7, 8, 4, 8, 6}, {"diagonal 4-6 must occur twice"});
}

// Counts the multisets of n - 2 of the given triangles that a polygon of n accepts.
int count_accepted(int n, const std::vector<std::array<int, 3>>& choices, size_t from, Mesh& mesh) {
    if (mesh.triangles.size() == 3 * static_cast<size_t>(n - 2)) return fault(mesh.arrays()).empty() ? 1 : 0;
    int accepted = 0;
    for (size_t i = from; i < choices.size(); ++i) {
        mesh.triangles.insert(mesh.triangles.end(), choices[i].begin(), choices[i].end());
        accepted += count_accepted(n, choices, i, mesh);
        mesh.triangles.resize(mesh.triangles.size() - 3);
    }
    return accepted;
}

// A polygon of n has as many triangulations as Catalan's number says, and everything else is refused.
TEST(BadInput, AcceptsExactlyTheTriangulations) {
    const int catalan[] = {1, 2, 5, 14};
    for (int n = 3; n <= 6; ++n) {
        Mesh mesh = with_points({std::vector<int>(n)}, n);
        std::iota(mesh.polygons[0].begin(), mesh.polygons[0].end(), 0);
        std::vector<std::array<int, 3>> choices;
        for (int a = 0; a < n; ++a) {
            for (int b = a + 1; b < n; ++b) {
                for (int c = b + 1; c < n; ++c) {
                    choices.push_back({a, b, c});
                    if (n < 6) choices.push_back({a, c, b});  // left out of the largest to save time
                }
            }
        }
        EXPECT_EQ(count_accepted(n, choices, 0, mesh), catalan[n - 3]) << n << " corners";
    }
}

TEST(BadInput, TriangleThatIsNotItsFace) {
    Mesh mesh = tetrahedron();
    mesh.triangles = {2, 0, 1, 3, 1, 0, 1, 3, 2, 2, 3, 0};
    EXPECT_NO_THROW(mesh.surface());
    std::swap(mesh.triangles[3], mesh.triangles[4]);
    expect_fault(mesh, {"the triangles of face 1 ", "triangle 1 runs against side"});
    mesh.triangles[4] = 2;
    expect_fault(mesh, {"the triangles of face 1 ", "vertex 2 of triangle 1 is not in the face"});
}

}  // namespace
}  // namespace mrc
