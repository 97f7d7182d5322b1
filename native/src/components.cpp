// SPDX-License-Identifier: GPL-3.0-or-later
#include "components.h"

#include "curvature_field.h"

namespace mrc {
namespace {

struct Sums {
    double area = 0.0, distance = 0.0;
    Vec3 centroid = Vec3::Zero();
};

/// Numbers the connected components of the vertices and returns how many there are.
int label(const Surface& surface, std::vector<int>& component) {
    component.assign(surface.vertex_count(), -1);
    int count = 0;
    std::vector<int> stack;
    for (int seed = 0; seed < surface.vertex_count(); ++seed) {
        if (component[seed] >= 0) continue;
        component[seed] = count;
        for (stack.assign(1, seed); !stack.empty();) {
            const int v = stack.back();
            stack.pop_back();
            surface.for_each_real_edge(v, [&](int neighbor, int) {
                if (component[neighbor] >= 0) return;
                component[neighbor] = count;
                stack.push_back(neighbor);
            });
        }
        ++count;
    }
    return count;
}

/// Calls visit(component, area, centroid) for each polygon.
template <class Visit>
void for_each_polygon(const Surface& surface, const std::vector<int>& component, Visit&& visit) {
    for (int f = 0; f < surface.face_count(); ++f) {
        const auto vertices = surface.face(f);
        Vec3 sum = Vec3::Zero();
        for (const int v : vertices) sum += surface.position(v);
        visit(component[vertices[0]], polygon_area_vector(surface, f).norm(), Vec3(sum / static_cast<double>(vertices.size())));
    }
}

}  // namespace

void Surface::Components::make(const Surface& surface) {
    std::vector<Sums> sums(label(surface, component));
    for_each_polygon(surface, component, [&](int i, double area, const Vec3& center) {
        sums[i].area += area;
        sums[i].centroid += area * center;
    });
    for (Sums& s : sums) {
        if (s.area > 0.0) s.centroid /= s.area;
    }
    for_each_polygon(surface, component, [&](int i, double area, const Vec3& center) {
        sums[i].distance += area * (center - sums[i].centroid).norm();
    });
    for (const Sums& s : sums) radius.push_back(s.area > 0.0 ? s.distance / s.area : 0.0);
}

double Surface::average_radius(int vertex) const {
    std::call_once(components_->once, [this] { components_->make(*this); });
    return components_->radius[components_->component[vertex]];
}

}  // namespace mrc
