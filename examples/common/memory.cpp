// SPDX-License-Identifier: MIT
#include "common/memory.hpp"

#include <algorithm>
#include <fstream>
#include <string>

#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace nephroid::examples {

namespace {

/// A line of /proc/self/status, in bytes.
[[nodiscard]] std::optional<double> status_line(const std::string& name) {
    std::ifstream status("/proc/self/status");
    for (std::string line; std::getline(status, line);)
        if (line.starts_with(name + ":"))
            return 1024 * std::stod(line.substr(name.size() + 1));
    return std::nullopt;
}

} // namespace

MemoryPeak::MemoryPeak() {
#if defined(__GLIBC__)
    malloc_trim(0); // returns freed memory, whose reuse would otherwise not show as resident
#endif
    std::ofstream clear("/proc/self/clear_refs");
    if (clear << '5' && clear.flush()) // forgets the peak, see proc(5)
        before_ = status_line("VmRSS");
}

std::optional<double> MemoryPeak::bytes() const {
    const auto peak = status_line("VmHWM");
    if (!before_ || !peak)
        return std::nullopt;
    return (std::max)(0.0, *peak - *before_);
}

} // namespace nephroid::examples
