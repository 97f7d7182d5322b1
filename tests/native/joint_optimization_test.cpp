// SPDX-License-Identifier: GPL-3.0-or-later
#include "waisted_torus.h"

#include <mrc/optimize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <stdexcept>
#include <string>

namespace mrc {
namespace {

class Joint : public testing::Test {
  protected:
    const Surface surface = mrc_test::waisted_torus();

    static Options settings(int threads = 1) {
        Options options;
        options.width = 6;
        options.regular_iterations = 4;
        options.iterations = 1;
        options.refinement = 1;
        options.threads = threads;
        return options;
    }
    static std::vector<Task> tasks() {
        std::vector<Task> tasks(mrc_test::waists);
        for (int i = 0; i < mrc_test::waists; ++i) tasks[i].contour = mrc_test::loop_near(i);
        tasks.push_back({moved(mrc_test::loop_near(0), 3), {}, {}});
        return tasks;
    }
    /// On the torus by so many columns, so that it begins beside another.
    static Contour moved(Contour contour, int columns) {
        for (SurfacePoint& p : contour.points) p = vertex_point(p.a + 20 * columns);
        return contour;
    }
    static std::set<int> touched(const Contour& contour) {
        std::set<int> vertices;
        for (const SurfacePoint& p : contour.points) {
            if (p.is_vertex()) vertices.insert(p.a);
        }
        return vertices;
    }
    static std::set<std::pair<int, int>> crossed(const Contour& contour) {
        std::set<std::pair<int, int>> edges;
        for (const SurfacePoint& p : contour.points) {
            if (!p.is_vertex()) edges.insert(std::minmax(p.a, p.b));
        }
        return edges;
    }
};

TEST_F(Joint, one_contour_is_optimized_as_if_it_were_alone) {
    const Task task{mrc_test::loop_near(2), {}, {}};
    const std::vector<Result> found = optimize_all(surface, std::span(&task, 1), settings());
    const Result alone = optimize(surface, task.contour, settings());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found[0].contour, alone.contour);
    EXPECT_EQ(found[0].objective, alone.objective);
    EXPECT_EQ(found[0].history, alone.history);
}

TEST_F(Joint, contours_never_touch_and_each_ends_no_worse_than_it_began) {
    const std::vector<Result> found = optimize_all(surface, tasks(), settings());
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_LE(found[i].objective, found[i].initial_objective);
        for (std::size_t j = 0; j < i; ++j) {
            std::vector<int> common;
            std::ranges::set_intersection(touched(found[i].contour), touched(found[j].contour), std::back_inserter(common));
            EXPECT_TRUE(common.empty()) << i << " and " << j;
            std::vector<std::pair<int, int>> edges;
            std::ranges::set_intersection(crossed(found[i].contour), crossed(found[j].contour), std::back_inserter(edges));
            EXPECT_TRUE(edges.empty()) << i << " and " << j;
        }
    }
    EXPECT_EQ(found[0].held_back_by, std::vector<int>{4});
    EXPECT_EQ(found[4].held_back_by.front(), 0);
    EXPECT_TRUE(found[2].held_back_by.empty());
}

TEST_F(Joint, results_depend_neither_on_the_order_of_the_tasks_nor_on_the_threads) {
    const std::vector<Task> given = tasks();
    std::vector<Task> turned = given;
    std::ranges::reverse(turned);
    const std::vector<Result> one = optimize_all(surface, given, settings());
    const std::vector<Result> other = optimize_all(surface, turned, settings(3));
    for (std::size_t i = 0; i < one.size(); ++i) {
        const Result& same = other[one.size() - 1 - i];
        EXPECT_EQ(one[i].contour, same.contour);
        EXPECT_EQ(one[i].objective, same.objective);
        EXPECT_EQ(one[i].history, same.history);
    }
}

TEST_F(Joint, errors_begin_with_the_place_of_the_contour) {
    std::vector<Task> bad = tasks();
    bad[3].contour.points[2] = bad[3].contour.points[0];
    try {
        optimize_all(surface, bad, settings());
        FAIL() << "nothing was thrown";
    } catch (const InvalidInput& error) {
        EXPECT_EQ(std::string(error.what()).find("contour 3: "), 0U) << error.what();
    }
}

TEST_F(Joint, its_progress_goes_from_zero_to_one_and_a_cancel_leaves_all_as_given) {
    std::vector<double> shares;
    const auto listen = [&](double share) {
        shares.push_back(share);
        return true;
    };
    const std::vector<Task> given = tasks();
    optimize_all(surface, given, settings(), listen);
    EXPECT_TRUE(std::ranges::is_sorted(shares));
    ASSERT_FALSE(shares.empty());
    EXPECT_EQ(shares.back(), 1.0);
    const std::vector<Result> found = optimize_all(surface, given, settings(), [](double share) { return share < 0.4; });
    for (std::size_t i = 0; i < found.size(); ++i) {
        EXPECT_EQ(found[i].status, Status::cancelled);
        EXPECT_EQ(found[i].contour, given[i].contour);
    }
}

/// So many contours that the caller is asked long before all are checked, and the first of them is refused at once.
TEST_F(Joint, what_the_caller_throws_comes_before_an_error_of_a_contour) {
    std::vector<Task> bad(2000, Task{mrc_test::loop_near(0), {}, {}});
    bad[0].contour.points.clear();
    const auto thrower = [](double) -> bool { throw std::runtime_error("interrupt"); };
    EXPECT_THROW(optimize_all(surface, bad, settings(), thrower), std::runtime_error);
    EXPECT_THROW(optimize_all(surface, bad, settings(2), thrower), std::runtime_error);
}

TEST_F(Joint, no_tasks_have_no_results) { EXPECT_TRUE(optimize_all(surface, {}, settings()).empty()); }

}  // namespace
}  // namespace mrc
