// SPDX-License-Identifier: MIT
/// @file  Measures the peak memory of a piece of work.
#pragma once

#include <cstddef>
#include <optional>

namespace nephroid::examples {

/// The largest resident memory of the process since construction, minus that at construction. Use one at a time. Linux
/// only, because other systems cannot reset a peak.
class MemoryPeak {
public:
    MemoryPeak();
    /// Bytes; nothing if the system does not tell.
    [[nodiscard]] std::optional<double> bytes() const;

private:
    std::optional<double> before_;
};

} // namespace nephroid::examples
