// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include <mrc/optimize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <optional>
#include <string>
#include <variant>
#include <vector>

namespace mrc {
namespace {

using mrc_test::all_tasks;
using mrc_test::loop_near;
using mrc_test::waisted_torus;
using mrc_test::waists;

Options each_options(int refinement, int threads) {
    Options options;
    options.refinement = refinement;
    options.regular_iterations = refinement > 0 ? 1 : 0;
    options.width = 6;
    options.iterations = 2;
    options.threads = threads;
    return options;
}

/// A contour that is refused, as it begins and ends at once; it lies where the band of the loop near waist 0 would grow.
Task refused_task() {
    const int column = 4;
    std::vector<int> arc;
    for (int j = 0; j < 12; ++j) arc.push_back(column * 20 + j);
    arc.push_back(arc.front());
    return {vertex_contour(arc, false), {}, std::nullopt};
}

bool same(const Result& a, const Result& b) {
    return a.contour == b.contour && a.status == b.status && a.reason == b.reason && a.ratio == b.ratio &&
           a.initial_ratio == b.initial_ratio && a.objective == b.objective && a.salience == b.salience &&
           a.lower_bound == b.lower_bound && a.gap == b.gap && a.history == b.history && a.held_back_by == b.held_back_by &&
           a.statistics.arcs == b.statistics.arcs && a.statistics.passes == b.statistics.passes;
}

bool same(const Outcome& a, const Outcome& b) {
    if (a.index() != b.index()) return false;
    if (const auto* result = std::get_if<Result>(&a)) return same(*result, std::get<Result>(b));
    const auto &one = std::get<InvalidInput>(a), &two = std::get<InvalidInput>(b);
    return std::string(one.what()) == two.what() && one.code() == two.code() && one.contour() == two.contour();
}

TEST(OptimizeEach, gives_the_results_of_optimize_all_where_nothing_is_wrong) {
    const Surface surface = waisted_torus();
    for (const int refinement : {0, 1}) {
        const std::vector<Task> tasks = all_tasks();
        const std::vector<Result> results = optimize_all(surface, tasks, each_options(refinement, 1));
        const std::vector<Outcome> outcomes = optimize_each(surface, tasks, each_options(refinement, 1));
        ASSERT_EQ(outcomes.size(), results.size());
        for (int i = 0; i < waists; ++i) EXPECT_TRUE(same(std::get<Result>(outcomes[i]), results[i]));
    }
}

TEST(OptimizeEach, a_refused_contour_is_a_barrier_to_the_others) {
    const Surface surface = waisted_torus();
    std::vector<Task> tasks = all_tasks();
    const std::vector<Result> without = optimize_all(surface, tasks, each_options(0, 1));
    const Task refused = refused_task();
    tasks.push_back(refused);
    const std::vector<Outcome> outcomes = optimize_each(surface, tasks, each_options(0, 1));
    EXPECT_EQ(std::get<InvalidInput>(outcomes.back()).contour(), waists);
    tasks.pop_back();
    for (Task& task : tasks) {
        for (std::size_t i = 0; i + 1 < refused.contour.points.size(); ++i) {
            const int a = refused.contour.points[i].a, b = refused.contour.points[i + 1].a;
            if (surface.real_edge(a, b)) task.constraints.barriers.push_back({a, b});
        }
    }
    const std::vector<Result> walled = optimize_all(surface, tasks, each_options(0, 1));
    for (int i = 0; i < waists; ++i) EXPECT_TRUE(same(std::get<Result>(outcomes[i]), walled[i])) << i;
    EXPECT_FALSE(same(walled[0], without[0])) << "the refused contour is not in the way";
}

TEST(OptimizeEach, a_single_contour_beside_a_refused_one_is_searched_as_alone) {
    const Surface surface = waisted_torus();
    Task refused = refused_task();
    refused.contour = vertex_contour(std::vector{640, 640});
    const std::vector<Task> tasks{{loop_near(0), {}, std::nullopt}, refused};
    const std::vector<Outcome> outcomes = optimize_each(surface, tasks, each_options(1, 1));
    EXPECT_TRUE(same(std::get<Result>(outcomes[0]), optimize(surface, loop_near(0), each_options(1, 1))));
}

TEST(OptimizeEach, a_contour_whose_search_fails_keeps_its_place) {
    const Surface surface = waisted_torus();
    std::vector<Task> tasks = all_tasks();
    // A second loop beside the first; it can not pass a vertex on the other side of the torus.
    tasks.push_back({vertex_contour(std::vector<int>()), {}, std::nullopt});
    std::vector<int> ring;
    for (int j = 0; j < 20; ++j) ring.push_back(5 * 20 + j);
    tasks.back().contour = vertex_contour(ring);
    tasks.back().constraints.required_vertices = {640};
    for (const int refinement : {0, 1}) {
        const std::vector<Outcome> outcomes = optimize_each(surface, tasks, each_options(refinement, 1));
        const auto& error = std::get<InvalidInput>(outcomes.back());
        EXPECT_EQ(error.code(), ErrorCode::outside_band);
        EXPECT_EQ(error.elements(), std::vector{Element::vertex(640)});
        for (int i = 0; i < waists; ++i) {
            for (const SurfacePoint& p : std::get<Result>(outcomes[i]).contour.points) {
                EXPECT_TRUE(std::ranges::find(ring, p.a) == ring.end() || std::ranges::find(ring, p.b) == ring.end());
            }
        }
    }
}

TEST(OptimizeEach, does_not_depend_on_threads) {
    const Surface surface = waisted_torus();
    std::vector<Task> tasks = all_tasks();
    tasks[2].constraints.required_vertices = {0};
    tasks.push_back(refused_task());
    for (const int refinement : {0, 1}) {
        const std::vector<Outcome> one = optimize_each(surface, tasks, each_options(refinement, 1));
        EXPECT_TRUE(std::holds_alternative<InvalidInput>(one[2]));
        for (const int threads : {2, 4}) {
            const std::vector<Outcome> many = optimize_each(surface, tasks, each_options(refinement, threads));
            for (std::size_t i = 0; i < tasks.size(); ++i) EXPECT_TRUE(same(one[i], many[i])) << i;
        }
    }
}

TEST(OptimizeEach, does_not_depend_on_the_order) {
    const Surface surface = waisted_torus();
    std::vector<Task> tasks = all_tasks();
    tasks[1].constraints.required_vertices = {0};
    tasks.push_back(refused_task());
    const std::vector<Outcome> forward = optimize_each(surface, tasks, each_options(0, 2));
    std::ranges::reverse(tasks);
    const std::vector<Outcome> backward = optimize_each(surface, tasks, each_options(0, 2));
    for (std::size_t i = 0; i < tasks.size(); ++i) {
        const Outcome &a = forward[i], &b = backward[tasks.size() - 1 - i];
        ASSERT_EQ(a.index(), b.index());
        if (std::holds_alternative<Result>(a)) {
            EXPECT_EQ(std::get<Result>(a).contour, std::get<Result>(b).contour);
        }
    }
}

TEST(OptimizeEach, errors_of_all_contours_are_given_to_each_and_those_of_the_options_are_thrown) {
    const Surface surface = waisted_torus();
    std::vector<Task> tasks = all_tasks();
    for (Task& task : tasks) task.constraints.attractors = {{3, -1.0, 1.0, std::nullopt}};
    for (const Outcome& outcome : optimize_each(surface, tasks))
        EXPECT_EQ(std::get<InvalidInput>(outcome).code(), ErrorCode::invalid_attractor);
    Options bad;
    bad.width = 0;
    EXPECT_THROW(optimize_each(surface, tasks, bad), InvalidInput);
}

TEST(OptimizeEach, a_cancel_leaves_errors_and_given_contours) {
    const Surface surface = waisted_torus();
    std::vector<Task> tasks = all_tasks();
    tasks.push_back(refused_task());
    const std::vector<Outcome> outcomes =
        optimize_each(surface, tasks, each_options(1, 2), [](double share) { return share < 0.3; });
    for (int i = 0; i < waists; ++i) {
        EXPECT_EQ(std::get<Result>(outcomes[i]).status, Status::cancelled);
        EXPECT_EQ(std::get<Result>(outcomes[i]).contour, tasks[i].contour);
    }
    EXPECT_EQ(std::get<InvalidInput>(outcomes.back()).code(), ErrorCode::not_simple);
}

}  // namespace
}  // namespace mrc
