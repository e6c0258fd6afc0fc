// SPDX-License-Identifier: MIT
#include "common/caustics/interrupt.hpp"

#include <csignal>
#include <initializer_list>

namespace nephroid::examples {

namespace {

volatile std::sig_atomic_t caught = 0; // all that a handler may write

extern "C" void note_signal(int signal) {
    caught = signal;
    std::signal(signal, SIG_DFL);
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
