// SPDX-License-Identifier: GPL-3.0-or-later
/// Contours of all kinds on damaged meshes with any options give a valid result or an error.
#include "checks.h"
#include "generated_mesh.h"

#include <mrc/check_contour.h>
#include <mrc/close_contour.h>

#include <algorithm>
#include <cmath>

namespace {

using mrc::Contour, mrc::Options, mrc::Surface, mrc::Task;

template <class Value>
std::optional<Value> maybe(FuzzedDataProvider& data, Value value) {
    return data.ConsumeBool() ? std::optional<Value>(value) : std::nullopt;
}

double between(FuzzedDataProvider& data, double low, double high) { return data.ConsumeFloatingPointInRange(low, high); }

/// Any options; slow ones are less frequent, so that more inputs are tried.
Options generate_options(FuzzedDataProvider& data) {
    Options o;
    o.width = maybe(data, data.ConsumeIntegralInRange(1, 8));
    o.refinement = data.PickValueInArray({0, 0, 0, 1, 2});
    o.iterations = data.ConsumeIntegralInRange(0, 2);
    o.regular_iterations = data.ConsumeIntegralInRange(0, 1);
    o.flow = data.PickValueInArray({mrc::FlowKind::gates, mrc::FlowKind::arc_length, mrc::FlowKind::harmonic});
    o.ends = data.PickValueInArray({mrc::Ends::edges, mrc::Ends::vertices, mrc::Ends::border, mrc::Ends::edges_or_border});
    o.feature = data.PickValueInArray({mrc::Feature::valley, mrc::Feature::ridge});
    if (data.ConsumeBool()) {
        o.denominator = mrc::Denominator::arcs;
        o.length_measure = mrc::LengthMeasure::edges;
    }
    o.length_bias = std::max(0.0, between(data, -4.0, 4.0));
    o.length_floor = between(data, 0.0, 1.5);
    o.anchor = between(data, 0.0, 3.0);
    o.crease = between(data, 0.0, 2.0);
    o.max_turn = between(data, 0.05, 3.1415926);
    const double disks = data.PickValueInArray({0.4, 0.4, 0.4, 1.0});
    o.curvature_radius = between(data, 0.1, 4.0 * disks);
    o.curvature_smoothing = between(data, 0.0, 3.0 * disks);
    o.kappa0_factor = between(data, 0.01, 10.0);
    o.feature_exponent = between(data, 0.1, 3.0);
    o.direction_exponent = between(data, 0.1, 3.0);
    o.band_distance = maybe(data, between(data, 0.01, 4.0));
    o.feature_clamp = maybe(data, between(data, 0.01, 0.99));
    o.min_salience = maybe(data, between(data, -1.0, 2.0));
    o.region_weight = between(data, -3.0, 3.0);
    o.threads = data.PickValueInArray({1, 1, 1, 2});
    return o;
}

std::array<int, 2> edge(FuzzedDataProvider& data, const mrc::GeneratedMesh& mesh) {
    const std::vector<int>& face = mesh.faces[data.ConsumeIntegralInRange(0, static_cast<int>(mesh.faces.size()) - 1)];
    const std::size_t corner = data.ConsumeIntegralInRange<std::size_t>(0, face.size() - 1);
    return {face[corner], face[(corner + 1) % face.size()]};
}

mrc::Constraints generate_constraints(FuzzedDataProvider& data, const mrc::GeneratedMesh& mesh,
                                      const std::vector<double>& density) {
    mrc::Constraints constraints;
    const int last = static_cast<int>(mesh.positions.size()) - 1;
    const auto some = [&](auto add) {
        for (int n = data.ConsumeBool() ? data.ConsumeIntegralInRange(0, 3) : 0; n > 0; --n) add();
    };
    some([&] { constraints.required_vertices.push_back(data.ConsumeIntegralInRange(0, last)); });
    some([&] { constraints.required_edges.push_back(edge(data, mesh)); });
    some([&] { constraints.barriers.push_back(edge(data, mesh)); });
    some([&] {
        constraints.attractors.push_back({data.ConsumeIntegralInRange(0, last), between(data, 1e-3, 20.0), between(data, -3.0, 3.0),
                                          maybe(data, between(data, 1e-3, 10.0))});
    });
    if (data.ConsumeBool()) constraints.region_density = std::make_shared<const std::vector<double>>(density);
    return constraints;
}

/// Loops and chains; sometimes a list of vertices that is neither.
std::vector<Contour> generate_contours(FuzzedDataProvider& data, const mrc::GeneratedMesh& mesh) {
    std::vector<Contour> contours;
    for (std::vector<int>& loop : generate_loops(mesh, data)) {
        const bool closed = data.ConsumeIntegralInRange(0, 3) != 3;
        if (!closed) {
            loop.resize(data.ConsumeIntegralInRange<std::size_t>(std::min<std::size_t>(2, loop.size()), loop.size()));
        } else if (data.ConsumeIntegralInRange(0, 15) == 0) {
            loop.push_back(data.ConsumeIntegralInRange(0, static_cast<int>(mesh.positions.size()) - 1));
        }
        contours.push_back(mrc::vertex_contour(loop, closed));
        if (contours.size() == 4) break;
    }
    return contours;
}

/// Cancels a search after this many calls; 0: never.
mrc::Progress generate_progress(int calls) {
    if (calls == 0) return {};
    return [calls, last = 0.0](double now) mutable {
        mrc::require(now >= last && now <= 1.0, "progress rises, up to 1");
        last = now;
        return --calls > 0;
    };
}

/// check_contour refuses what optimize refuses before its first iteration.
void check_refusals(const Surface& surface, const std::vector<Task>& tasks) {
    Options still;
    still.iterations = 0;
    std::vector<Task> bare;
    for (const Task& task : tasks) {
        bare.push_back({task.contour, {}, std::nullopt});
        bare.back().constraints.barriers = task.constraints.barriers;
    }
    const std::vector<mrc::Outcome> outcomes = mrc::optimize_each(surface, bare, still);
    for (std::size_t i = 0; i < bare.size(); ++i) {
        const bool refused = mrc::check_contour(surface, bare[i].contour, bare[i].constraints.barriers).has_value();
        mrc::require(refused == std::holds_alternative<mrc::InvalidInput>(outcomes[i]), "both refuse the same contours");
    }
}

/// Errors of some contours keep the others neither from being optimized nor apart.
void check_each(const Surface& surface, const std::vector<Task>& tasks, const Options& options) {
    const std::vector<mrc::Outcome> outcomes = mrc::optimize_each(surface, tasks, options);
    for (std::size_t i = 0; i < outcomes.size(); ++i) {
        if (const auto* error = std::get_if<mrc::InvalidInput>(&outcomes[i])) {
            mrc::require(error->contour() == static_cast<int>(i), "an error has its contour's place");
        } else {
            mrc::check_result(surface, tasks[i].contour, options, tasks[i].constraints, std::get<mrc::Result>(outcomes[i]));
        }
    }
}

void run(FuzzedDataProvider& data, bool as_in_files) {
    const mrc::GeneratedMesh mesh = mrc::generate_mesh(data, as_in_files);
    const Surface surface = mesh.surface();
    mrc::check_surface(surface);
    std::vector<double> density(mesh.faces.size());
    for (std::size_t f = 0; f < density.size(); ++f) density[f] = static_cast<double>(f % 5) - 2.0;
    const Options options = generate_options(data);
    const mrc::Constraints constraints = generate_constraints(data, mesh, density);
    std::vector<Contour> contours = generate_contours(data, mesh);
    if (contours.empty()) return;
    if (!contours[0].closed && data.ConsumeBool()) {
        contours[0] = mrc::close_contour(surface, contours[0]);
        mrc::check_simple(surface, contours[0]);
    }
    if (data.ConsumeBool()) contours.resize(1);
    std::vector<Task> tasks;
    for (const Contour& contour : contours)
        tasks.push_back({contour, tasks.empty() ? constraints : mrc::Constraints{}, std::nullopt});
    check_refusals(surface, tasks);
    std::vector<mrc::Result> results;
    try {
        results = mrc::optimize_all(surface, tasks, options, generate_progress(data.ConsumeIntegralInRange(0, 40)));
    } catch (const mrc::InvalidInput&) {
        return check_each(surface, tasks, options);
    }
    mrc::require(results.size() == tasks.size(), "each contour has its result");
    for (std::size_t i = 0; i < results.size(); ++i) {
        mrc::check_result(surface, tasks[i].contour, options, tasks[i].constraints, results[i]);
        for (std::size_t j = 0; j < i; ++j) {
            mrc::require(mrc::apart(results[i].contour, results[j].contour) || !mrc::apart(contours[i], contours[j]),
                         "contours that are apart stay apart");
        }
    }
    if (data.ConsumeIntegralInRange(0, 3) != 0) return;
    // The result can be given again, even if it runs across faces.
    const mrc::Result again = mrc::optimize(surface, results[0].contour, options, tasks[0].constraints);
    mrc::check_result(surface, results[0].contour, options, tasks[0].constraints, again);
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, std::size_t size) {
    FuzzedDataProvider data(bytes, size);
    try {
        run(data, mrc::as_in_files(bytes, size));
    } catch (const mrc::InvalidInput&) {  // the right response to bad input
    }
    return 0;
}
