// SPDX-License-Identifier: GPL-3.0-or-later
#include "progress_monitor.h"

#include <gtest/gtest.h>

#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

namespace mrc {
namespace {

class Monitor : public testing::Test {
  protected:
    std::vector<double> shares;  // that the caller was told
    double cancel_at = 2.0;
    const Progress listen = [this](double share) {
        shares.push_back(share);
        return share < cancel_at;
    };

    static void wait() { std::this_thread::sleep_for(std::chrono::milliseconds(15)); }
    template <class Work>
    static bool cancelled(Work&& work) {
        try {
            work();
        } catch (const ProgressMonitor::Cancelled&) {
            return true;
        }
        return false;
    }
};

TEST_F(Monitor, tells_each_advance_at_once_and_in_order) {
    ProgressMonitor monitor(listen);
    for (const double share : {0.0, 0.25, 0.25, 1.0}) monitor.advance(share);
    EXPECT_EQ(shares, (std::vector<double>{0.0, 0.25, 0.25, 1.0}));
    EXPECT_FALSE(monitor.failure());
}

TEST_F(Monitor, asks_again_in_long_stages_with_the_share_as_it_was) {
    ProgressMonitor monitor(listen);
    monitor.advance(0.5);
    for (int i = 0; i < 1000; ++i) monitor.beat();
    EXPECT_LT(shares.size(), 500U);
    wait();
    monitor.beat();
    wait();
    monitor.beat(0.75);
    wait();
    monitor.idle();
    ASSERT_GE(shares.size(), 4U);
    EXPECT_EQ(shares[shares.size() - 3], 0.5);
    EXPECT_EQ(shares[shares.size() - 2], 0.75);
    EXPECT_EQ(shares.back(), 0.75);
}

TEST_F(Monitor, ends_all_threads_once_the_caller_cancels_and_asks_no_more) {
    cancel_at = 0.5;
    ProgressMonitor monitor(listen);
    EXPECT_FALSE(cancelled([&] { monitor.advance(0.25); }));
    EXPECT_TRUE(cancelled([&] { monitor.advance(0.5); }));
    bool other = false;
    std::thread([&] { other = cancelled([&] { monitor.beat(); }); }).join();
    EXPECT_TRUE(other);
    wait();
    EXPECT_TRUE(cancelled([&] { monitor.beat(); }));
    EXPECT_TRUE(cancelled([&] { monitor.advance(0.75); }));
    EXPECT_EQ(shares.size(), 2U);
    EXPECT_FALSE(monitor.failure());
}

TEST_F(Monitor, cancels_where_it_only_idles_but_ends_the_work_later) {
    cancel_at = 0.0;
    ProgressMonitor monitor(listen);
    wait();
    EXPECT_FALSE(cancelled([&] { monitor.idle(); }));
    EXPECT_TRUE(cancelled([&] { monitor.beat(); }));
    EXPECT_EQ(shares.size(), 1U);
}

TEST_F(Monitor, asks_on_the_callers_thread_alone) {
    ProgressMonitor monitor(listen);
    wait();
    std::thread([&] {
        monitor.beat();
        monitor.idle();
    }).join();
    EXPECT_TRUE(shares.empty());
}

TEST_F(Monitor, keeps_what_the_callers_function_throws_and_ends_the_work) {
    const Progress thrower = [](double) -> bool { throw std::runtime_error("enough"); };
    ProgressMonitor monitor(thrower);
    EXPECT_TRUE(cancelled([&] { monitor.advance(0.5); }));
    ASSERT_TRUE(monitor.failure());
    EXPECT_THROW(std::rethrow_exception(monitor.failure()), std::runtime_error);
}

TEST_F(Monitor, without_a_listener_lets_all_pass) {
    const Progress nobody;
    ProgressMonitor monitor(nobody);
    wait();
    EXPECT_FALSE(cancelled([&] {
        monitor.advance(0.5);
        monitor.beat();
        monitor.idle();
    }));
}

}  // namespace
}  // namespace mrc
