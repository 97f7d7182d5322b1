// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph_size_limit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <string>

namespace mrc {
namespace {

double endless() { return HUGE_VAL; }
double a_gigabyte() { return 1e9; }
double never_asked() { std::abort(); }

/// The message of the refusal, or nothing where the graph may be built.
std::string refusal(double triangles, int steiner, double (*free_bytes)()) {
    try {
        check_graph_size(triangles, steiner, free_bytes);
        return {};
    } catch (const TooLarge& error) {
        return error.what();
    }
}

/// The most triangles that are not refused.
double most_triangles(int steiner, double (*free_bytes)()) {
    double fine = 1.0, too_many = 1e12;
    while (too_many / fine > 1.0001) {
        const double middle = std::sqrt(fine * too_many);
        (refusal(middle, steiner, free_bytes).empty() ? fine : too_many) = middle;
    }
    return fine;
}

TEST(GraphSizeLimit, MoreArcsThanAnIndexCountsAreRefusedHoweverMuchIsFree) {
    for (const int steiner : {0, 2, 16}) {
        const double most = most_triangles(steiner, endless);
        EXPECT_EQ(refusal(0.999 * most, steiner, endless), "");
        EXPECT_NE(refusal(1.001 * most, steiner, endless).find("2.15e+09 arcs"), std::string::npos);
    }
}

TEST(GraphSizeLimit, MoreThanIsFreeIsRefusedWithTheEstimateAndWhatToLower) {
    for (const int steiner : {0, 2, 16}) {
        const double most = most_triangles(steiner, a_gigabyte);
        EXPECT_LT(most, 0.1 * most_triangles(steiner, endless));
        const std::string message = refusal(1.001 * most, steiner, a_gigabyte);
        EXPECT_NE(message.find("need 1 GB"), std::string::npos) << message;
        EXPECT_NE(message.find("lower refinement (now " + std::to_string(steiner) + ") or width"), std::string::npos) << message;
    }
}

TEST(GraphSizeLimit, ASmallSearchDoesNotAskTheSystem) { EXPECT_EQ(refusal(10000, 2, never_asked), ""); }

}  // namespace
}  // namespace mrc
