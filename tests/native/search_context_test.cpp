// SPDX-License-Identifier: GPL-3.0-or-later
#include "made_surfaces.h"

#include "contour_scales.h"
#include "search_context.h"

#include <gtest/gtest.h>

#include <limits>

namespace mrc {
namespace {

class ContextOf : public testing::Test {
  protected:
    const Surface surface = made::tube(16, 12).inside_out().surface();
    const Contour contour = made::ring(16, 6);
    const Options options;
};

TEST_F(ContextOf, a_first_search_has_the_scales_of_its_contour) {
    const SearchContext context(surface, contour, options, {}, std::nullopt);
    EXPECT_EQ(context.scales, contour_scales(surface, context.field, contour, options));
    EXPECT_EQ(context.scales.given, contour);
    EXPECT_EQ(context.energy.unit(), context.scales.K);
}

TEST_F(ContextOf, a_search_that_goes_on_has_the_scales_of_the_first) {
    const SearchContext first(surface, contour, options, {}, std::nullopt),
        on(surface, made::ring(16, 3), options, {}, first.scales);
    EXPECT_EQ(on.scales.h, first.scales.h);
    EXPECT_EQ(on.scales.given, contour);
    EXPECT_EQ(on.scales.L0, first.scales.L0);
    EXPECT_EQ(on.field.at(100).kappa_min, first.field.at(100).kappa_min);
    EXPECT_EQ(on.energy.frame(vertex_point(100)).kappa, first.energy.frame(vertex_point(100)).kappa);
}

TEST_F(ContextOf, scales_of_another_surface_or_that_are_no_numbers_are_refused) {
    const Scales good = SearchContext(surface, contour, options, {}, std::nullopt).scales;
    EXPECT_NO_THROW(check_scales(surface, good));
    EXPECT_THROW(check_scales(made::tube(16, 5).surface(), good), InvalidInput);
    for (double Scales::*field : {&Scales::h, &Scales::K, &Scales::kappa_0, &Scales::L0}) {
        for (const double bad : {0.0, -1.0, std::numeric_limits<double>::infinity(), std::numeric_limits<double>::quiet_NaN()}) {
            Scales scales = good;
            scales.*field = bad;
            EXPECT_THROW(check_scales(surface, scales), InvalidInput);
            EXPECT_THROW(SearchContext(surface, contour, options, {}, scales), InvalidInput);
        }
    }
}

}  // namespace
}  // namespace mrc
