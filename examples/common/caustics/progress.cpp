// SPDX-License-Identifier: MIT
#include "common/caustics/progress.hpp"

#include <cstdio>
#include <string>

#if defined(_WIN32)
#include <io.h>
#else
#include <unistd.h>
#endif

namespace nephroid::examples {

namespace {

[[nodiscard]] bool stderr_is_a_terminal() {
#if defined(_WIN32)
    return _isatty(_fileno(stderr)) != 0;
#else
    return isatty(STDERR_FILENO) != 0;
#endif
}

} // namespace

Progress::Progress(std::uint64_t photons) : photons_(photons), on_terminal_(stderr_is_a_terminal()) {}

Progress::~Progress() {
    if (shown_)
        std::fprintf(stderr, "\r%79s\r", "");
}

void Progress::show(std::uint64_t done) {
    const auto now = Clock::now();
    if (!on_terminal_ || now - last_ < std::chrono::milliseconds(100))
        return;
    last_ = now;
    shown_ = true;
    const double share = double(done) / double(photons_);
    const double seconds = std::chrono::duration<double>(now - start_).count();
    const auto filled = static_cast<std::size_t>(40 * share);
    const std::string bar = std::string(filled, '=') + std::string(40 - filled, ' ');
    std::fprintf(stderr, "\r[%s] %3.0f%%  %.2f M photons/s  ", bar.c_str(), 100 * share, double(done) / seconds * 1e-6);
    std::fflush(stderr);
}

} // namespace nephroid::examples
