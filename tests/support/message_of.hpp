// SPDX-License-Identifier: MIT
/// @file  The sentence that a call is refused with.
#pragma once

#include <stdexcept>
#include <string>

namespace nephroid::tests {

/// What the std::invalid_argument says that a call throws; empty if it throws none.
template <class Call>
[[nodiscard]] std::string message_of(const Call& call) {
    try {
        call();
    } catch (const std::invalid_argument& error) {
        return error.what();
    }
    return "";
}

} // namespace nephroid::tests
