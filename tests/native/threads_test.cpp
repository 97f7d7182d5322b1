// SPDX-License-Identifier: GPL-3.0-or-later
#include "search_space.h"
#include "waisted_torus.h"

#include <mrc/curvature.h>
#include <mrc/optimize.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <latch>
#include <stdexcept>
#include <string>
#include <thread>
#include <type_traits>
#include <vector>

namespace mrc {
namespace {

using mrc_test::all_tasks;
using mrc_test::loop_near;
using mrc_test::waisted_torus;
using mrc_test::waists;

/// What two runs must have in common to the last bit.
class Bytes {
  public:
    std::string text;

    Bytes& operator<<(double number) { return append(number); }
    Bytes& operator<<(int number) { return append(number); }
    Bytes& operator<<(const std::string& words) {
        text += words;
        return *this << static_cast<int>(words.size());
    }
    Bytes& operator<<(const Vec3& v) { return *this << v.x() << v.y() << v.z(); }
    template <class Item>
    Bytes& operator<<(const std::vector<Item>& items) {
        for (const Item& item : items) *this << item;
        return *this << static_cast<int>(items.size());
    }
    Bytes& operator<<(const SurfacePoint& p) { return *this << p.a << p.b << p.t; }
    Bytes& operator<<(const Result& r) {
        *this << r.contour.points << static_cast<int>(r.status) << r.reason << r.ratio << r.initial_ratio << r.objective
              << r.initial_objective << r.salience << r.lower_bound << r.gap << r.history << r.held_back_by;
        *this << r.scales.h << r.scales.K << r.scales.kappa_0 << r.scales.L0 << r.scales.clamp << r.scales.n0;
        const Statistics& s = r.statistics;
        return *this << s.faces << s.cut << s.nodes << s.arcs << s.linear_steps << s.passes << s.iterations;
    }
    Bytes& operator<<(const VertexCurvature& c) {
        return *this << c.kappa_min << c.kappa_max << c.direction_min << c.direction_max << c.normal << c.umbilic;
    }

  private:
    template <class Number>
    requires std::is_arithmetic_v<Number> Bytes& append(Number number) {
        text.append(reinterpret_cast<const char*>(&number), sizeof number);
        return *this;
    }
};

/// Listens to the progress of one call, and notes what it must not do.
class Listener {
  public:
    /// `stop_at`: the fraction from which on it cancels.
    explicit Listener(double stop_at = 2.0) : stop_at_(stop_at) {}

    Progress progress() {
        return [this](double share) {
            fell_ |= share < share_;
            strayed_ |= std::this_thread::get_id() != caller_;
            share_ = share;
            return share < stop_at_;
        };
    }
    std::string verdict() const {
        return std::string(fell_ ? "progress fell" : "") + (strayed_ ? "another thread called" : "") + std::to_string(share_);
    }

  private:
    const double stop_at_;
    const std::thread::id caller_ = std::this_thread::get_id();
    double share_ = 0.0;
    bool fell_ = false, strayed_ = false;
};

Options thread_options(int refinement, int threads) {
    Options options;
    options.refinement = refinement;
    options.iterations = 2;
    options.band_distance = 0.4;  // makes the surface find the radii of its components, once for all threads
    options.threads = threads;
    return options;
}

using Job = std::function<std::string(const Surface&, int threads)>;

std::string one(const Surface& surface, int refinement, double stop_at) {
    Listener listener(stop_at);
    const Result result =
        optimize(surface, loop_near(refinement), thread_options(refinement, 1), {}, std::nullopt, listener.progress());
    return (Bytes() << result << listener.verdict()).text;
}

std::string all(const Surface& surface, int threads, double stop_at) {
    Listener listener(stop_at);
    const std::vector<Result> results = optimize_all(surface, all_tasks(), thread_options(1, threads), listener.progress());
    return (Bytes() << results << listener.verdict()).text;
}

/// Cancels in the middle of a search, where progress is asked for again at the same fraction, or at the end at the latest.
std::string all_with_a_cancel_under_way(const Surface& surface, int threads) {
    double last = 0.0;
    const auto progress = [&last](double share) {
        const bool again = share > 0.3 && share == last;
        last = share;
        return !again && share < 1.0;
    };
    return (Bytes() << optimize_all(surface, all_tasks(), thread_options(2, threads), progress)).text;
}

std::string all_with_a_throw(const Surface& surface, int threads) {
    const auto progress = [](double share) -> bool { return share < 0.3 ? true : throw std::runtime_error("enough"); };
    try {
        optimize_all(surface, all_tasks(), thread_options(1, threads), progress);
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "nothing was thrown";
}

/// Contours 1 and 3 are no loops: the message is that of the first.
std::string all_with_bad_input(const Surface& surface, int threads) {
    std::vector<Task> tasks = all_tasks();
    for (const int i : {1, 3}) tasks[i].contour.points.resize(5);
    try {
        optimize_all(surface, tasks, thread_options(1, threads));
    } catch (const InvalidInput& error) {
        return error.what();
    }
    return "nothing was thrown";
}

std::string space(const Surface& surface) {
    const SearchSpace space = search_space(surface, loop_near(2), thread_options(2, 1));
    const WeightedGraph& search = space.graph.search;
    return (Bytes() << space.band.polygons << search.first_arc << search.from << search.f << search.g).text;
}

std::vector<Job> jobs() {
    return {
        [](const Surface& surface, int) { return one(surface, 0, 2.0); },
        [](const Surface& surface, int) { return one(surface, 1, 2.0); },
        [](const Surface& surface, int) { return one(surface, 2, 0.3); },
        [](const Surface& surface, int threads) { return all(surface, threads, 2.0); },
        [](const Surface& surface, int threads) { return all(surface, threads, 0.3); },
        all_with_a_cancel_under_way,
        all_with_a_throw,
        all_with_bad_input,
        [](const Surface& surface, int) { return space(surface); },
        [](const Surface& surface, int) { return (Bytes() << curvature(surface)).text; },
        [](const Surface& surface, int) { return (Bytes() << surface.average_radius(0)).text; },
    };
}

TEST(Threads, calls_at_once_on_one_surface_give_the_bytes_of_calls_in_turn) {
    const std::vector<Job> all_jobs = jobs();
    std::vector<std::string> expected(all_jobs.size());
    std::ranges::transform(all_jobs, expected.begin(), [](const Job& job) { return job(waisted_torus(), 1); });
    const Surface surface = waisted_torus();
    const int copies = 2, count = copies * static_cast<int>(all_jobs.size());
    std::vector<std::string> found(count);
    {
        std::latch start(count);
        std::vector<std::jthread> threads;
        threads.reserve(count);
        for (int i = 0; i < count; ++i) {
            threads.emplace_back([&, i] {
                start.arrive_and_wait();
                found[i] = all_jobs[i / copies](surface, 4);
            });
        }
    }
    for (int i = 0; i < count; ++i) EXPECT_TRUE(found[i] == expected[i / copies]) << "job " << i / copies;
}

TEST(Threads, the_calls_that_are_compared_do_what_they_are_meant_to) {
    const Surface surface = waisted_torus();
    const std::vector<Task> tasks = all_tasks();
    for (const Result& result : optimize_all(surface, tasks, thread_options(1, 4))) EXPECT_EQ(result.status, Status::improved);
    Listener listener(0.3);
    const std::vector<Result> cancelled = optimize_all(surface, tasks, thread_options(1, 4), listener.progress());
    for (int i = 0; i < waists; ++i) {
        EXPECT_EQ(cancelled[i].status, Status::cancelled);
        EXPECT_EQ(cancelled[i].contour, tasks[i].contour);
    }
    EXPECT_EQ(all_with_a_throw(surface, 4), "enough");
    EXPECT_EQ(all_with_bad_input(surface, 4).substr(0, 10), "contour 1:");
}

}  // namespace
}  // namespace mrc
