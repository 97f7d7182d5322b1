// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include "contour_optimization.h"
#include "patch.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace mrc {
namespace {

class Optimized : public testing::Test {
  protected:
    const Surface surface = mrc_test::waisted_torus();
    const Contour given = mrc_test::loop_near(1);
    const Constraints unconstrained;

    static Options settings(int regular, int refined) {
        Options options;
        options.width = 3;
        options.regular_iterations = regular;
        options.iterations = refined;
        options.refinement = refined > 0 ? 1 : 0;
        return options;
    }
};

TEST_F(Optimized, step_by_step_it_is_what_one_call_gives) {
    const Options options = settings(2, 2);
    ContourOptimization steps(surface, given, options, unconstrained, std::nullopt);
    for (const auto& [steiner, iterations] : {std::pair(0, 2), std::pair(1, 2)}) {
        steps.begin_phase(steiner);
        for (int i = 0; i < iterations && steps.moving(); ++i) {
            steps.cut_out();
            steps.grow(nullptr, 0);
            steps.search(nullptr, 0, {});
        }
    }
    const Result one = steps.finish(), other = optimize(surface, given, options);
    EXPECT_EQ(one.contour, other.contour);
    EXPECT_EQ(one.objective, other.objective);
    EXPECT_EQ(one.history, other.history);
    EXPECT_EQ(one.status, other.status);
}

TEST_F(Optimized, it_never_ends_worse_than_it_began_and_never_below_its_bound) {
    for (const Options& options : {settings(0, 1), settings(3, 0), settings(2, 3)}) {
        const Result found = optimize(surface, given, options);
        EXPECT_EQ(found.status, Status::improved);
        EXPECT_LT(found.objective, found.initial_objective);
        EXPECT_LE(found.lower_bound, found.objective);
        EXPECT_NEAR(found.gap, found.objective - found.lower_bound, 1e-12);
        // Along edges, and then with Steiner points, each from what it starts with.
        const std::size_t refined = options.regular_iterations > 0 && options.iterations > 0 ? 1 : 0;
        std::size_t rises = 0;
        for (std::size_t i = 1; i < found.history.size(); ++i) rises += found.history[i] > found.history[i - 1];
        EXPECT_LE(rises, refined);
        EXPECT_EQ(found.history.back(), found.objective);
    }
}

TEST_F(Optimized, what_it_returns_is_a_contour_with_the_ratio_that_it_says) {
    const Options options = settings(1, 2);
    const Result found = optimize(surface, given, options);
    EXPECT_EQ(checked_contour(surface, found.contour), found.contour);
    const Measure measured = measure(surface, found.contour, options, {}, found.scales);
    EXPECT_NEAR(measured.ratio, found.ratio, 1e-12);
    EXPECT_NEAR(measured.objective, found.objective, 1e-12);
    EXPECT_NEAR(measured.salience, found.salience, 1e-12);
}

TEST_F(Optimized, from_the_result_nothing_better_is_found) {
    const Options options = settings(20, 0);
    const Result first = optimize(surface, given, options);
    const Result again = optimize(surface, first.contour, options, {}, first.scales);
    EXPECT_EQ(again.status, Status::unchanged);
    EXPECT_EQ(again.reason_code, Reason::already_best);
    EXPECT_EQ(again.contour, first.contour);
    EXPECT_EQ(again.objective, first.objective);
}

TEST_F(Optimized, reversed_it_has_the_same_ratio) {
    Contour back = given;
    std::ranges::reverse(back.points);
    for (const Options& options : {settings(3, 0), settings(0, 2)})
        EXPECT_NEAR(optimize(surface, given, options).ratio, optimize(surface, back, options).ratio, 1e-9);
}

TEST_F(Optimized, where_nothing_is_salient_enough_the_given_contour_stays) {
    Options options = settings(2, 0);
    const Result free = optimize(surface, given, options);
    options.min_salience = free.salience - 1e-6;
    EXPECT_EQ(optimize(surface, given, options).contour, free.contour);
    options.min_salience = free.salience + 1e-6;
    const Result kept = optimize(surface, given, options);
    EXPECT_EQ(kept.contour, given);
    EXPECT_EQ(kept.reason_code, Reason::not_salient);
}

TEST_F(Optimized, cancelled_it_is_the_given_contour) {
    int left = 2;
    const Result found = optimize(surface, given, settings(3, 0), {}, std::nullopt, [&](double) { return --left > 0; });
    EXPECT_EQ(found.status, Status::cancelled);
    EXPECT_EQ(found.contour, given);
    EXPECT_EQ(found.objective, found.initial_objective);
}

TEST_F(Optimized, its_progress_goes_from_zero_to_one_without_falling) {
    std::vector<double> shares;
    const auto listen = [&](double share) {
        shares.push_back(share);
        return true;
    };
    const Result found = optimize(surface, given, settings(2, 1), {}, std::nullopt, listen);
    EXPECT_EQ(found.contour, optimize(surface, given, settings(2, 1)).contour);
    ASSERT_FALSE(shares.empty());
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    EXPECT_GE(shares.front(), 0.0);
    EXPECT_EQ(shares.back(), 1.0);
}

TEST_F(Optimized, a_required_vertex_is_passed_or_refused) {
    Constraints constraints;
    constraints.required_vertices = {given.points[4].a};
    const Result found = optimize(surface, given, settings(2, 0), constraints);
    EXPECT_NE(std::ranges::find(found.contour.points, given.points[4]), found.contour.points.end());
    constraints.required_vertices = {mrc_test::loop_near(3).points[0].a};
    EXPECT_THROW(optimize(surface, given, settings(2, 0), constraints), InvalidInput);
}

}  // namespace
}  // namespace mrc
