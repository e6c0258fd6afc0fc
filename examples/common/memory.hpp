// SPDX-License-Identifier: MIT
/// @file  How much memory a piece of work takes at its peak.
#pragma once

#include <cstddef>
#include <optional>

namespace nephroid::examples {

/// Watches the process from when it is made: the most memory that has been resident since, beyond what was then.
/// One at a time. Linux only, as no other system forgets a peak.
class MemoryPeak {
public:
    MemoryPeak();
    /// Bytes; nothing where the system does not tell.
    [[nodiscard]] std::optional<double> bytes() const;

private:
    std::optional<double> before_;
};

} // namespace nephroid::examples
