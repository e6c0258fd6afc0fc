// SPDX-License-Identifier: MIT
/// @file  Numbers as text, for tables and for JSON.
#pragma once

#include <cstdint>
#include <cstdio>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples {

/// As printf writes it, up to 255 characters.
template <class... Values>
[[nodiscard]] std::string text(const char* format, Values... values) {
    char line[256];
    std::snprintf(line, sizeof line, format, values...);
    return line;
}

/// 1234567 as "1 234 567".
[[nodiscard]] std::string grouped(std::uint64_t count);

/// The members of a JSON object: names, and values that are JSON already.
using JsonMembers = std::vector<std::pair<std::string, std::string>>;

/// Nine digits; "null" for what is not finite.
[[nodiscard]] std::string json_number(double value);

/// A string in quotation marks, its quotation marks and backslashes escaped; control characters become spaces.
[[nodiscard]] std::string json_string(const std::string& value);

/// Strings as a JSON array, in one line.
[[nodiscard]] std::string json_array(const std::vector<std::string>& values);

/// @param indent  of the closing brace; the members are two spaces further in
[[nodiscard]] std::string json_object(const JsonMembers& members, const std::string& indent);

} // namespace nephroid::examples
