// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "beat.h"

#include <mrc/types.h>

#include <atomic>
#include <chrono>
#include <exception>
#include <thread>

namespace mrc {

/// Carries the progress of a call to its caller, on the caller's own thread, and a cancel back to all threads.
class ProgressMonitor {
  public:
    /// Thrown to end the current work; it never leaves the library.
    struct Cancelled {};

    explicit ProgressMonitor(const Progress& progress) : progress_(progress), caller_(std::this_thread::get_id()) {}

    /// The fraction done so far. On the caller's thread only.
    void advance(double fraction) {
        fraction_ = fraction;
        ask();
        stop_if_cancelled();
    }

    /// For long stages, on any thread, often: the caller is asked again every few milliseconds, with the fraction unchanged.
    void beat() {
        if (due()) ask();
        stop_if_cancelled();
    }

    /// The same with the fraction done so far, on the caller's thread only.
    void beat(double fraction) {
        fraction_ = fraction;
        beat();
    }

    /// For what even a cancelled call needs: only an exception of the caller's own function ends it.
    void essential_beat() {
        if (due()) ask();
        if (failed_) throw Cancelled();
    }

    /// The same for a thread that only waits for others.
    void idle() {
        if (due()) ask();
    }

    /// What the caller's own function threw, if that is what ended the work.
    std::exception_ptr failure() const { return failure_; }

  private:
    using Clock = std::chrono::steady_clock;
    const Progress& progress_;
    const std::thread::id caller_;
    std::atomic<bool> cancelled_ = false, failed_ = false;
    double fraction_ = 0.0;
    Clock::time_point last_ = Clock::now();
    std::exception_ptr failure_;

    bool due() const {
        return progress_ && std::this_thread::get_id() == caller_ && Clock::now() - last_ > std::chrono::milliseconds(10);
    }

    void ask() {
        if (!progress_ || cancelled_) return;
        try {
            if (!progress_(fraction_)) cancelled_ = true;
        } catch (...) {
            failure_ = std::current_exception();
            failed_ = true;
            cancelled_ = true;
        }
        last_ = Clock::now();
    }

    void stop_if_cancelled() const {
        if (cancelled_) throw Cancelled();
    }
};

/// Does work(monitor); false where the caller cancelled it. What the caller's function throws comes through.
template <class Work>
bool with_monitor(const Progress& progress, Work&& work) {
    ProgressMonitor monitor(progress);
    try {
        work(monitor);
        return true;
    } catch (const ProgressMonitor::Cancelled&) {
        if (monitor.failure()) std::rethrow_exception(monitor.failure());
        return false;
    }
}

}  // namespace mrc
