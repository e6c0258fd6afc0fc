// SPDX-License-Identifier: MIT
#include "common/caustics/interrupt.hpp"

#include <atomic>
#include <chrono>
#include <csignal>
#include <initializer_list>

namespace nephroid::examples {

namespace {

using Clock = std::chrono::steady_clock;

std::atomic<int> caught = 0;
std::atomic<Clock::rep> caught_at = 0;
static_assert(decltype(caught)::is_always_lock_free && decltype(caught_at)::is_always_lock_free); // in a handler

// An impatient second Ctrl-C ends the program at once. Shells and `timeout` send one to the program and to its group,
// which may arrive as two: those of the same moment are one.
extern "C" void note_signal(int signal) {
    constexpr Clock::duration moment = std::chrono::milliseconds(300);
    const Clock::rep now = Clock::now().time_since_epoch().count();
    if (caught == 0) {
        caught_at = now;
        caught = signal;
    } else if (signal != caught || now - caught_at > moment.count()) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
        return;
    }
    std::signal(signal, note_signal); // where a handler is forgotten once it ran
}

} // namespace

void note_interrupts() {
    for (const int signal : {SIGINT, SIGTERM})
        if (std::signal(signal, note_signal) == SIG_IGN)
            std::signal(signal, SIG_IGN);
}

bool is_interrupted() { return caught != 0; }

int interrupted_status() { return 128 + caught; }

} // namespace nephroid::examples
