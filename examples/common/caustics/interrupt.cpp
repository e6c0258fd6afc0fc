// SPDX-License-Identifier: MIT
#include "common/caustics/interrupt.hpp"

#include <atomic>
#include <csignal>
#include <ctime>
#include <initializer_list>

namespace nephroid::examples {

namespace {

volatile std::sig_atomic_t caught = 0;
std::atomic<std::time_t> caught_at = 0;
static_assert(decltype(caught_at)::is_always_lock_free); // a handler may write nothing else

// An impatient second Ctrl-C ends the program at once. Shells and `timeout` send one to the program and to its group,
// which may arrive as two: those of the same moment are one.
extern "C" void note_signal(int signal) {
    constexpr std::time_t moment = 1; // seconds; the clock has whole ones
    const std::time_t now = std::time(nullptr);
    if (caught == 0)
        caught_at = now;
    else if (now - caught_at > moment) {
        std::signal(signal, SIG_DFL);
        std::raise(signal);
        return;
    }
    caught = signal;
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
