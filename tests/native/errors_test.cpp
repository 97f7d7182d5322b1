// SPDX-License-Identifier: GPL-3.0-or-later
#include "graph_size_limit.h"
#include "waisted_torus.h"

#include <mrc/close_contour.h>
#include <mrc/optimize.h>

#include <gtest/gtest.h>

#include <functional>
#include <limits>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace mrc {
namespace {

using mrc_test::loop_near;

template <class Call>
InvalidInput error_of(Call&& call) {
    try {
        call();
    } catch (const InvalidInput& error) {
        return error;
    }
    ADD_FAILURE() << "nothing was thrown";
    return {ErrorCode::infeasible, ""};
}

struct Fault {
    ErrorCode code;
    std::function<void(const Surface&, Task&, Options&)> make;
    std::vector<Element> elements;
};

std::vector<int> ids(const Contour& contour) {
    std::vector<int> vertices;
    for (const SurfacePoint& p : contour.points) vertices.push_back(p.a);
    return vertices;
}

std::vector<Fault> faults() {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    const std::vector<int> loop = ids(loop_near(0));
    const auto density = [](std::size_t size, double value) { return std::make_shared<const std::vector<double>>(size, value); };
    return {
        {ErrorCode::invalid_option, [](auto&, Task&, Options& o) { o.width = 0; }, {}},
        {ErrorCode::out_of_range, [](auto&, Task& t, auto&) { t.contour.points[2] = vertex_point(-7); }, {Element::vertex(-7)}},
        {ErrorCode::too_short, [](auto&, Task& t, auto&) { t.contour.points.resize(1); }, {Element::vertex(loop[0])}},
        {ErrorCode::too_short, [](auto&, Task& t, auto&) { t.contour.points.clear(); }, {}},
        {ErrorCode::invalid_parameter,
         [&](auto&, Task& t, auto&) {
             t.contour.points[2] = {t.contour.points[2].a, t.contour.points[3].a, 1.5};
         },
         {Element::edge(loop[2], loop[3])}},
        {ErrorCode::no_edge,
         [](auto&, Task& t, auto&) { t.contour.points.erase(t.contour.points.begin() + 5); },
         {Element::edge(loop[4], loop[6]), Element::vertex(loop[4]), Element::vertex(loop[6])}},
        {ErrorCode::not_simple,
         [](auto&, Task& t, auto&) { t.contour.points.push_back(t.contour.points[3]); },
         {Element::vertex(loop[3])}},
        {ErrorCode::no_edge,
         [](auto&, Task& t, auto&) {
             t.constraints.barriers = {{3, 900}};
         },
         {Element::edge(3, 900)}},
        {ErrorCode::out_of_range,
         [](auto&, Task& t, auto&) { t.constraints.required_vertices = {99999}; },
         {Element::vertex(99999)}},
        {ErrorCode::invalid_attractor,
         [](auto&, Task& t, auto&) {
             t.constraints.attractors = {{5, 0.0, 1.0, std::nullopt}};
         },
         {Element::vertex(5)}},
        {ErrorCode::wrong_size, [density](auto&, Task& t, auto&) { t.constraints.region_density = density(3, 1.0); }, {}},
        {ErrorCode::not_finite,
         [density, nan](const Surface& s, Task& t, auto&) { t.constraints.region_density = density(s.face_count(), nan); },
         {Element::face(0)}},
        {ErrorCode::open_region,
         [density](const Surface& s, Task& t, auto&) {
             t.constraints.region_density = density(s.face_count(), 1.0);
             t.contour.closed = false;
         },
         {}},
        {ErrorCode::other_surface,
         [](auto&, Task& t, auto&) {
             t.scales = Scales();
             t.scales->given = vertex_contour(std::vector{5000, 5001}, false);
         },
         {Element::vertex(5000)}},
        {ErrorCode::incomputable_scales, [](auto&, Task& t, auto&) { t.scales = Scales(); }, {}},
        {ErrorCode::outside_band, [](auto&, Task& t, auto&) { t.constraints.required_vertices = {640}; }, {Element::vertex(640)}},
        {ErrorCode::too_large, [](auto&, auto&, Options& o) { o.refinement = 100000; }, {}},
        {ErrorCode::infeasible,
         [](auto&, Task& t, Options& o) {
             t.constraints.required_vertices = {t.contour.points[0].a + 20};
             o.iterations = 0;
         },
         {Element::vertex(loop[0] + 20)}},
    };
}

TEST(Errors, have_their_codes_and_name_their_elements) {
    const Surface surface = mrc_test::waisted_torus();
    for (const Fault& fault : faults()) {
        Task task{loop_near(0), {}, std::nullopt};
        Options options;
        fault.make(surface, task, options);
        const InvalidInput error = error_of([&] { optimize(surface, task.contour, options, task.constraints, task.scales); });
        EXPECT_EQ(code_name(error.code()), code_name(fault.code)) << error.what();
        EXPECT_EQ(error.elements(), fault.elements) << error.what();
        EXPECT_EQ(error.contour(), std::nullopt);
        EXPECT_EQ(error.sentence(), error.what());
        if (fault.code == ErrorCode::too_short || fault.code == ErrorCode::infeasible) continue;  // all there are
        for (const Element& element : error.elements())
            EXPECT_NE(error.sentence().find(std::to_string(element.ids[0])), std::string::npos) << error.what();
    }
}

TEST(Errors, of_several_contours_have_the_place_and_the_sentence_of_one) {
    const Surface surface = mrc_test::waisted_torus();
    for (const Fault& fault : faults()) {
        if (fault.code == ErrorCode::invalid_option || fault.code == ErrorCode::too_large) continue;
        std::vector<Task> tasks{{loop_near(1), {}, std::nullopt}, {loop_near(0), {}, std::nullopt}};
        Options options;
        fault.make(surface, tasks[1], options);
        const InvalidInput alone =
            error_of([&] { optimize(surface, tasks[1].contour, options, tasks[1].constraints, tasks[1].scales); });
        const InvalidInput error = error_of([&] { optimize_all(surface, tasks, options); });
        EXPECT_EQ(error.contour(), 1);
        EXPECT_EQ(error.code(), alone.code());
        EXPECT_EQ(error.elements(), alone.elements());
        EXPECT_EQ(error.what(), "contour 1: " + error.sentence());
        const std::vector<Outcome> outcomes = optimize_each(surface, tasks, options);
        ASSERT_TRUE(std::holds_alternative<InvalidInput>(outcomes[1]));
        const auto& returned = std::get<InvalidInput>(outcomes[1]);
        EXPECT_EQ(returned.contour(), 1);
        EXPECT_EQ(returned.what(), error.sentence());
        EXPECT_EQ(returned.code(), error.code());
        EXPECT_TRUE(std::holds_alternative<Result>(outcomes[0]));
    }
}

TEST(Errors, are_raised_as_what_they_were) {
    const InvalidInput large = error_of([] { check_graph_size(1e9, 5); });
    EXPECT_THROW(large.raise(), TooLarge);
    EXPECT_THROW(large.of_contour(3, "contour 3: ").raise(), TooLarge);
    const InvalidInput infeasible = Infeasible("no way", {Element::vertex(3)});
    EXPECT_THROW(infeasible.raise(), Infeasible);
    try {
        InvalidInput(ErrorCode::not_simple, "twice").of_contour(2, "contour 2: ").raise();
    } catch (const TooLarge&) {
        FAIL();
    } catch (const Infeasible&) {
        FAIL();
    } catch (const InvalidInput& error) {
        EXPECT_STREQ(error.what(), "contour 2: twice");
        EXPECT_EQ(error.sentence(), "twice");
        EXPECT_EQ(error.contour(), 2);
    }
}

TEST(Errors, codes_have_different_names) {
    std::set<std::string_view> names;
    for (int code = 0; code <= static_cast<int>(ErrorCode::infeasible); ++code) {
        const std::string_view name = code_name(static_cast<ErrorCode>(code));
        EXPECT_FALSE(name.empty()) << code;
        EXPECT_TRUE(names.insert(name).second) << name;
    }
}

TEST(Errors, of_surfaces_and_chains_have_codes_too) {
    const std::vector<double> positions{0, 0, 0, 1, 0, 0, 0, 1, 0};
    const auto surface = [&](std::vector<int32_t> triangles) { return Surface({positions, {}, triangles, {}, {}}); };
    EXPECT_EQ(error_of([&] { surface({0, 1, 5}); }).elements(), std::vector{Element::face(0)});
    EXPECT_EQ(error_of([&] { surface({0, 1, 5}); }).code(), ErrorCode::out_of_range);
    EXPECT_EQ(error_of([&] { surface({0, 1, 1}); }).code(), ErrorCode::invalid_face);
    EXPECT_EQ(error_of([&] { surface({0, 1}); }).code(), ErrorCode::wrong_size);
    const Surface torus = mrc_test::waisted_torus();
    EXPECT_EQ(error_of([&] { close_contour(torus, loop_near(0)); }).code(), ErrorCode::not_open);
}

}  // namespace
}  // namespace mrc
