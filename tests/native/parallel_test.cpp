// SPDX-License-Identifier: GPL-3.0-or-later
#include "parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <set>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

namespace mrc {
namespace {

class Parallel : public testing::TestWithParam<int> {
  protected:
    static void sleep() { std::this_thread::sleep_for(std::chrono::milliseconds(1)); }
};

TEST_P(Parallel, every_task_is_done_once) {
    for (const int count : {0, 1, 2, 100}) {
        std::vector<std::atomic<int>> times(count);
        parallel_for(
            count, GetParam(), [&](int i) { ++times[i]; }, [] {});
        for (const std::atomic<int>& done : times) EXPECT_EQ(done, 1);
    }
}

TEST_P(Parallel, tasks_after_one_that_throws_are_done_too_and_the_first_is_heard) {
    std::atomic<int> done = 0;
    const auto task = [&](int i) {
        if (i == 3) sleep();  // so that a later one throws before it
        ++done;
        if (i % 4 == 3) throw std::runtime_error(std::to_string(i));
    };
    try {
        parallel_for(20, GetParam(), task, [] {});
        FAIL() << "nothing was thrown";
    } catch (const std::runtime_error& error) {
        EXPECT_STREQ(error.what(), "3");
    }
    EXPECT_EQ(done, 20);
}

TEST_P(Parallel, no_more_threads_than_asked_for_nor_than_tasks) {
    std::mutex mutex;
    std::set<std::thread::id> used;
    const auto task = [&](int) {
        sleep();
        const std::lock_guard lock(mutex);
        used.insert(std::this_thread::get_id());
    };
    const int threads = GetParam() > 0 ? GetParam() : std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
    parallel_for(20, GetParam(), task, [] {});
    EXPECT_LE(static_cast<int>(used.size()), threads);
    used.clear();
    parallel_for(1, GetParam(), task, [] {});
    EXPECT_EQ(used, std::set{std::this_thread::get_id()});
}

// 0: as many as the machine has.
INSTANTIATE_TEST_SUITE_P(Threads, Parallel, testing::Values(0, 1, 2, 7));

TEST(ParallelWaiting, the_calling_thread_idles_while_others_work) {
    const std::thread::id caller = std::this_thread::get_id();
    std::atomic<int> idled = 0, strayed = 0, others = 0;
    const auto wait_until = [](const auto& holds) {
        for (int i = 0; i < 10000 && !holds(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
    };
    // The caller's task is over once another thread has one, which lasts until the caller, with nothing left to do, idles.
    const auto task = [&](int) {
        if (std::this_thread::get_id() == caller) {
            wait_until([&] { return others > 0; });
        } else {
            ++others;
            wait_until([&] { return idled > 0; });
        }
    };
    const auto idle = [&] {
        ++idled;
        strayed += std::this_thread::get_id() != caller;
    };
    parallel_for(2, 2, task, idle);
    EXPECT_GT(idled, 0);
    EXPECT_EQ(strayed, 0);
}

}  // namespace
}  // namespace mrc
