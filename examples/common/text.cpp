// SPDX-License-Identifier: MIT
#include "common/text.hpp"

#include <cmath>

namespace nephroid::examples {

std::string grouped(std::uint64_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t i = digits.size(); i > 3; i -= 3)
        digits.insert(i - 3, 1, ' ');
    return digits;
}

std::string json_number(double value) { return std::isfinite(value) ? text("%.9g", value) : "null"; }

std::string json_string(const std::string& value) {
    std::string result = "\"";
    for (const char c : value) {
        if (c == '"' || c == '\\')
            result += '\\';
        result += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
    return result + "\"";
}

std::string json_array(const std::vector<std::string>& values) {
    std::string result = "[";
    for (const std::string& value : values)
        result += (result.size() > 1 ? ", " : "") + json_string(value);
    return result + "]";
}

std::string json_object(const JsonMembers& members, const std::string& indent) {
    std::string result = "{";
    for (const auto& [name, value] : members)
        result += (result.size() > 1 ? ",\n" : "\n") + indent + "  " + json_string(name) + ": " + value;
    return result + "\n" + indent + "}";
}

} // namespace nephroid::examples
