// SPDX-License-Identifier: GPL-3.0-or-later
#include <mrc/close_contour.h>

#include "progress_monitor.h"

#include "curvature_field.h"
#include "cut_off.h"
#include "distances.h"
#include "edge_obstacles.h"
#include "element_names.h"
#include "elementary_functions.h"
#include "patch.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <functional>
#include <iterator>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>
#include <string>
#include <tuple>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

namespace mrc {
namespace {

// Measured on quarters of part boundaries that people and segmentations drew; twice or half of each changes little.
constexpr double near_weight = 1.0;     // how much more a path costs beside the chain than far from it
constexpr double facing_weight = 2.0;   // how much more it costs on the chain's side of the limb than on the other
constexpr double along_weight = 3.0;    // how much more a step along the limb costs than one around it, squared
constexpr double feature_weight = 0.8;  // how much less a path costs along the deepest crease than on a ridge
constexpr double seam_weight = 5.0;     // cost of passing the chain's middle just beside it, in lengths of the chain
constexpr double facing_cosine = 0.2;   // nothing passes the chain's middle where the surface faces as the chain does
constexpr double flattest = 0.85;    // no loop bounds what is this nearly flat, as the middle of a cone less steep than 32 degrees
constexpr int fewest_triangles = 3;  // a loop bounds at least these

/// What a chain tells of the limb that it lies on.
struct Limb {
    double length = 0.0;           ///< of the chain
    std::vector<double> fraction;  ///< of the length, at each vertex
    Vec3 normal;                   ///< mean normal, mostly of the chain's middle
    Vec3 axis;                     ///< the direction in which the limb extends
};

Eigen::Matrix3d normalized_trace(const Eigen::Matrix3d& m) { return m.trace() > 0.0 ? Eigen::Matrix3d(m / m.trace()) : m; }

/// The direction most nearly perpendicular to both the chain's extent and its normals.
Vec3 limb_axis(const Surface& surface, const std::vector<int>& chain, const std::vector<double>& weights) {
    Vec3 center = Vec3::Zero();
    double total = 0.0;
    for (std::size_t i = 0; i < chain.size(); ++i) {
        center += weights[i] * surface.position(chain[i]);
        total += weights[i];
    }
    if (total > 0.0) center /= total;
    Eigen::Matrix3d extent = Eigen::Matrix3d::Zero(), facing = Eigen::Matrix3d::Zero();
    for (std::size_t i = 0; i < chain.size(); ++i) {
        const Vec3 offset = surface.position(chain[i]) - center, normal = vertex_normal(surface, chain[i]);
        extent += weights[i] * offset * offset.transpose();
        facing += weights[i] * normal * normal.transpose();
    }
    const Eigen::Matrix3d sum = normalized_trace(extent) + normalized_trace(facing);
    return Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(sum).eigenvectors().col(0);
}

/// The mean normal weights the chain's middle most: that of a whole ring would vanish.
Limb limb_at(const Surface& surface, const std::vector<int>& chain) {
    Limb limb{.fraction = {0.0}, .normal = Vec3::Zero(), .axis = Vec3::Zero()};
    std::vector<double> weights(chain.size(), 0.0);
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const double step = (surface.position(chain[i + 1]) - surface.position(chain[i])).norm();
        weights[i] += 0.5 * step;
        weights[i + 1] += 0.5 * step;
        limb.fraction.push_back(limb.length += step);
    }
    if (limb.length <= 0.0)
        throw InvalidInput(ErrorCode::no_length, "the chain to be closed has no length: all its vertices lie at one point");
    for (double& fraction : limb.fraction) fraction /= limb.length;
    for (std::size_t i = 0; i + 1 < chain.size(); ++i) {
        const double step = limb.fraction[i + 1] - limb.fraction[i];
        const double window = elementary::sin(std::numbers::pi * 0.5 * (limb.fraction[i] + limb.fraction[i + 1]));
        limb.normal += step * window * (vertex_normal(surface, chain[i]) + vertex_normal(surface, chain[i + 1]));
    }
    limb.normal.normalize();  // zero stays zero
    limb.axis = limb_axis(surface, chain, weights);
    return limb;
}

/// Smoothing would take most of the time without finding more limbs.
Options unsmoothed() {
    Options options;
    options.curvature_smoothing = 0.0;
    return options;
}

/// The angle at v from the edge vq, counterclockwise through the faces, to the edge vp; none where a border or an edge of more
/// than two faces lies between.
std::optional<double> angle_between(const Surface& surface, int v, int q, int p) {
    double sum = 0.0;
    const int start = surface.find_halfedge(v, q);
    for (int h = start; h >= 0;) {
        const Vec3 ahead = surface.position(surface.to(h)) - surface.position(v);
        h = Surface::previous(h);  // the triangle's other side at v
        const Vec3 behind = surface.position(surface.from(h)) - surface.position(v);
        sum += elementary::atan2(ahead.cross(behind).norm(), ahead.dot(behind));
        if (surface.from(h) == p && !surface.diagonal(h)) return sum;
        h = surface.twin(h);
        if (h == start) break;
    }
    return std::nullopt;
}

/// How nearly a loop bounds a piece of a plane: 1 where it does, 0 around a cylinder, 1/2 around the rim of a cylinder's end.
///
/// By Gauss and Bonnet, what a loop turns along the surface as seen from one side is 2 pi minus the curvature within, so that in
/// a plane it turns by 2 pi seen from within, and by -2 pi seen from without. Around a limb, both are less: a cylinder's end has
/// all the curvature of half a sphere, however short it is.
double flatness(const Surface& surface, const std::vector<int>& loop) {
    double difference = 0.0;
    for (std::size_t i = 0; i < loop.size(); ++i) {
        const int p = loop[(i + loop.size() - 1) % loop.size()], v = loop[i], q = loop[(i + 1) % loop.size()];
        const std::optional<double> left = angle_between(surface, v, q, p), right = angle_between(surface, v, p, q);
        if (!left && !right) continue;
        // Where faces are missing on one side, they are taken to lie in one plane with the others.
        const double whole = 2.0 * std::numbers::pi;
        difference += left.value_or(whole - right.value_or(0.0)) - right.value_or(whole - left.value_or(0.0));
    }
    return std::abs(difference) / (4.0 * std::numbers::pi);
}

std::tuple<double, double, double> place_of(const Surface& surface, int vertex) {
    const Vec3& p = surface.position(vertex);
    return {p.x(), p.y(), p.z()};
}

bool on_border(const Surface& surface, int vertex) {
    return std::ranges::any_of(surface.outgoing(vertex), [&](int h) {
        return surface.twin(h) == Surface::border || surface.twin(Surface::previous(h)) == Surface::border;
    });
}

/// One of these vertices and another one of the mesh at the same place, both on its border. Where some of them are, it looks at the
/// whole mesh.
std::optional<std::pair<int, int>> split_beside(const Surface& surface, std::vector<int> vertices) {
    const auto place = [&](int v) { return place_of(surface, v); };
    std::erase_if(vertices, [&](int v) { return !on_border(surface, v); });
    if (vertices.empty()) return std::nullopt;
    std::ranges::sort(vertices, {}, [&](int v) { return std::tuple_cat(place(v), std::tuple(v)); });
    for (int w = 0; w < surface.vertex_count(); ++w) {
        for (const int v : std::ranges::equal_range(vertices, place(w), {}, place)) {
            if (v != w && on_border(surface, w)) return std::pair(v, w);
        }
    }
    return std::nullopt;
}

InvalidInput split_mesh(const std::pair<int, int>& vertices) {
    const auto& [v, w] = vertices;
    return {ErrorCode::no_path_around,
            "the mesh is split beside the chain: vertices " + std::to_string(v) + " and " + std::to_string(w) +
                " lie at the same place, but the faces there are not joined; merge such vertices first (in Blender: Merge by "
                "Distance)",
            {Element::vertex(v), Element::vertex(w)}};
}

/// Refuses a loop around nothing.
void check_around_something(const Surface& surface, const std::vector<int>& loop, std::size_t chain_length) {
    if (const auto split = split_beside(surface, loop)) throw split_mesh(*split);
    const CutOff cut = cut_off_by(surface, loop, true, fewest_triangles);
    if (flatness(surface, loop) < flattest && std::min(cut.left, cut.right) >= fewest_triangles) return;
    const int start = loop.front(), end = loop[chain_length - 1];
    throw InvalidInput(ErrorCode::no_path_around,
                       "from vertex " + std::to_string(end) + ", one end of the chain, nothing leads to vertex " +
                           std::to_string(start) +
                           ", its other end, but back beside the chain, around nothing: draw the chain on a limb, draw more of "
                           "the loop, or reveal what is hidden",
                       {Element::vertex(end), Element::vertex(start)});
}

/// Dijkstra's search from the chain's last vertex to its first.
class ClosingSearch {
  public:
    ClosingSearch(const Surface& surface, const std::vector<int>& chain, ProgressMonitor& monitor)
        : surface_(surface),
          chain_(chain),
          monitor_(monitor),
          limb_(limb_at(surface, chain)),
          from_chain_(surface, vertex_contour(chain, false)),
          curvature_(surface, unsmoothed()),
          inner_(chain.begin() + 1, chain.end() - 1) {}

    /// The vertices between the chain's last and its first.
    std::vector<int> run() {
        const int start = chain_.back(), goal = chain_.front();
        reach(start, 0.0, -1);
        while (!queue_.empty()) {
            const Entry entry = queue_.top();
            const int vertex = entry.second;
            queue_.pop();
            Place& place = places_.at(vertex);
            if (std::exchange(place.settled, true)) continue;
            monitor_.beat(static_cast<double>(reached_.size()) / surface_.vertex_count());
            reached_.push_back(vertex);
            if (vertex == goal) return path_to(place.previous);
            surface_.for_each_real_edge(vertex, [&](int neighbor, int) { relax(vertex, neighbor, entry.first); });
        }
        if (const auto split = split_beside(surface_, reached_)) throw split_mesh(*split);
        throw InvalidInput(ErrorCode::no_path_around,
                           "nothing leads from vertex " + std::to_string(start) + ", one end of the chain, around to vertex " +
                               std::to_string(goal) +
                               ", its other end: the surface does not turn away behind the chain, or borders, hidden or "
                               "non-manifold faces are in the way; draw the chain on a limb, draw more of the loop, or reveal "
                               "what is hidden",
                           {Element::vertex(start), Element::vertex(goal)});
    }

  private:
    struct Place {
        double cost = std::numeric_limits<double>::infinity();
        int previous = -1;
        bool settled = false;
        double facing;    // cosine between the vertex normal and the chain's
        double weight;    // cost per unit of length
        double fraction;  // of the chain, at its point nearest to the vertex
        double alike;     // cosine between the vertex normal and that of the chain at this point
    };
    using Entry = std::pair<double, int>;
    const Surface& surface_;
    const std::vector<int>& chain_;
    ProgressMonitor& monitor_;
    Limb limb_;
    DistanceField from_chain_;
    CurvatureField curvature_;
    std::unordered_set<int> inner_;
    std::vector<int> reached_;  // in the order of their costs
    std::unordered_map<int, Place> places_;
    std::priority_queue<Entry, std::vector<Entry>, std::greater<>> queue_;

    /// After Lee et al.: a distance function times a normal function, each 1 far away and on the limb's other side, times a
    /// feature function, which falls from 1 where nothing is concave to 0.2. Its unit is half the chain's length, so that scale
    /// does not matter.
    Place make_place(int vertex) const {
        Place place;
        const VertexCurvature& curvature = curvature_.at(vertex);
        const double depth = 0.5 * limb_.length * std::max(0.0, -curvature.kappa_min);
        place.facing = curvature.normal.dot(limb_.normal);
        const double near = elementary::exp(-2.0 * from_chain_.at(vertex) / limb_.length);
        place.weight = (1.0 + near_weight * near) * (1.0 + facing_weight * std::max(0.0, place.facing)) *
                       (1.0 - feature_weight * depth / (1.0 + depth));
        const int nearest = from_chain_.nearest(vertex);
        place.fraction = limb_.fraction[nearest];
        place.alike = curvature.normal.dot(vertex_normal(surface_, chain_[nearest]));
        return place;
    }

    Place& place_at(int vertex) {
        const auto known = places_.find(vertex);
        return known != places_.end() ? known->second : places_.emplace(vertex, make_place(vertex)).first->second;
    }

    /// The cost of a step ab: sqrt(|ab|^2 + along_weight (ab . axis)^2) times the mean weight, and more where it passes the seam.
    /// This is where points nearer to the chain's first half meet those nearer to its second: through the chain's middle and
    /// behind the limb. Every closing path passes it, and should do so behind: nothing does where the surface faces as the chain
    /// does, on the whole or, near the chain's middle, there, which turns around with a chain that is nearly a loop. Elsewhere
    /// it costs the more, the less of the chain lies between the nearest points of a and b.
    /// Seam and axis are not in Lee et al.: without them a short chain closes beside itself.
    double step_cost(int a, int b) {
        const Place &p = place_at(a), &q = place_at(b);
        const Vec3 step = surface_.position(b) - surface_.position(a);
        const double along = step.dot(limb_.axis);
        const double cost = std::sqrt(step.squaredNorm() + along_weight * along * along) * 0.5 * (p.weight + q.weight);
        if ((p.fraction < 0.5) == (q.fraction < 0.5)) return cost;
        const bool beside = std::abs(p.fraction - q.fraction) < 0.5;
        if (p.facing + q.facing > 2.0 * facing_cosine || (beside && p.alike + q.alike > 2.0 * facing_cosine))
            return std::numeric_limits<double>::infinity();
        return cost + seam_weight * limb_.length * (1.0 - std::abs(p.fraction - q.fraction));
    }

    bool is_on_chain(int a, int b) const { return chain_.size() == 2 && b == chain_.front() && a == chain_.back(); }

    void relax(int from, int to, double cost) {
        if (inner_.contains(to) || is_on_chain(from, to)) return;
        if (place_at(to).settled) return;
        const double through = cost + step_cost(from, to);
        if (through < place_at(to).cost && !obstacle(surface_, from, to)) reach(to, through, from);
    }

    void reach(int vertex, double cost, int previous) {
        Place& place = place_at(vertex);
        place.cost = cost;
        place.previous = previous;
        queue_.emplace(cost, vertex);
    }

    std::vector<int> path_to(int vertex) const {
        std::vector<int> path;
        for (; vertex != chain_.back(); vertex = places_.at(vertex).previous) path.push_back(vertex);
        std::ranges::reverse(path);
        return path;
    }
};

std::vector<int> chain_vertices(const Contour& chain) {
    std::vector<int> vertices;
    for (const SurfacePoint& p : chain.points) {
        if (!p.is_vertex()) {
            throw InvalidInput(
                ErrorCode::not_on_vertices,
                "the chain to be closed has a point inside edge " + edge_name(p.a, p.b) + ": give one that runs along mesh edges",
                {Element::edge(p.a, p.b)});
        }
        vertices.push_back(p.a);
    }
    return vertices;
}

}  // namespace

Contour close_contour(const Surface& surface, const Contour& chain, const Progress& progress) {
    if (chain.closed) throw InvalidInput(ErrorCode::not_open, "the contour to be closed is closed already: give an open chain");
    std::vector<int> vertices = chain_vertices(checked_contour(surface, chain));
    // Always searched from the same end, so that ties between paths of equal cost do not depend on the chain's direction.
    const bool turned = vertices.front() > vertices.back();
    if (turned) std::ranges::reverse(vertices);
    ProgressMonitor monitor(progress);
    std::vector<int> closing;
    try {
        monitor.advance(0.0);
        closing = ClosingSearch(surface, vertices, monitor).run();
        monitor.advance(1.0);
    } catch (const ProgressMonitor::Cancelled&) {
        if (monitor.failure()) std::rethrow_exception(monitor.failure());
        return {};
    }
    if (turned) {
        std::ranges::reverse(vertices);
        std::ranges::reverse(closing);
    }
    const std::size_t chain_length = vertices.size();
    vertices.insert(vertices.end(), closing.begin(), closing.end());
    Contour loop = checked_contour(surface, vertex_contour(vertices));
    check_around_something(surface, vertices, chain_length);
    return loop;
}

}  // namespace mrc
