// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace mrc {

/// Threads that are joined at the end of their scope: std::jthread, which Apple's library lacks.
struct Joined {
    std::vector<std::thread> threads;
    ~Joined() {
        for (std::thread& thread : threads) thread.join();
    }
};

/// Calls task(i) for every i from 0 up to count, on `threads` threads; 0: as many as the machine has. All tasks are done when it
/// returns; of what they throw, the exception of the lowest i is thrown here. While the calling thread waits, it calls idle()
/// often.
template <class Task, class Idle>
void parallel_for(int count, int threads, Task&& task, Idle&& idle) {
    const int wanted = threads > 0 ? threads : static_cast<int>(std::thread::hardware_concurrency());
    const int workers = std::min(std::max(wanted, 1), count);
    std::vector<std::exception_ptr> thrown(count);
    std::atomic<int> next = 0;
    std::mutex mutex;
    std::condition_variable all_done;
    int done = 0;
    const auto work = [&] {
        for (int i = next++; i < count; i = next++) {
            try {
                task(i);
            } catch (...) {
                thrown[i] = std::current_exception();
            }
            const std::lock_guard lock(mutex);
            if (++done == count) all_done.notify_one();
        }
    };
    {
        Joined others;
        for (int w = 1; w < workers; ++w) others.threads.emplace_back(work);
        work();
        std::unique_lock lock(mutex);
        while (!all_done.wait_for(lock, std::chrono::milliseconds(2), [&] { return done == count; })) {
            lock.unlock();
            idle();
            lock.lock();
        }
    }
    for (const std::exception_ptr& exception : thrown) {
        if (exception) std::rethrow_exception(exception);
    }
}

}  // namespace mrc
