// SPDX-License-Identifier: MIT
#include "common/gltf/report.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <utility>

namespace nephroid::examples::gltf {
namespace {

constexpr std::size_t longest_line = 400;
constexpr std::size_t longest_name = 60;
constexpr std::size_t most_warnings = 100;

/// The first bytes of a UTF-8 text, without cutting a character in two.
std::string_view shortened(std::string_view text, std::size_t longest) {
    if (text.size() <= longest)
        return text;
    std::size_t end = longest;
    while (end > 0 && (static_cast<unsigned char>(text[end]) & 0xC0u) == 0x80u)
        --end;
    return text.substr(0, end);
}
} // namespace

std::string one_line(std::string_view text) {
    const std::string_view kept = shortened(text, longest_line);
    std::string line;
    for (const char c : kept) {
        const bool control = static_cast<unsigned char>(c) < 0x20 || c == 0x7F;
        if (!control)
            line += c;
        else if (!line.empty() && line.back() != ' ')
            line += ' ';
    }
    while (!line.empty() && line.back() == ' ')
        line.pop_back();
    return kept.size() < text.size() ? line + "..." : line;
}

std::string named(std::string_view kind, std::size_t index, std::string_view name) {
    std::string text = std::string(kind) + " " + std::to_string(index);
    if (!name.empty()) {
        const std::string_view kept = shortened(name, longest_name);
        text += " (\"" + std::string(kept) + (kept.size() < name.size() ? "...\")" : "\")");
    }
    return text;
}

void fail(std::initializer_list<std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts)
        text += part;
    throw std::runtime_error(one_line(text));
}

std::size_t checked_index(int value, std::size_t size, std::string_view owner, std::string_view kind) {
    if (value < 0 || static_cast<std::size_t>(value) >= size)
        fail({owner, " refers to ", kind, " ", std::to_string(value), ", but the file has ", std::to_string(size)});
    return static_cast<std::size_t>(value);
}

void Warnings::add(std::string_view text) {
    const std::string line = one_line(text);
    if (std::find(lines_.begin(), lines_.end(), line) != lines_.end())
        return;
    if (lines_.size() < most_warnings)
        lines_.push_back(line);
    else
        ++more_;
}

std::vector<std::string> Warnings::take() {
    if (more_ > 0)
        lines_.push_back("and " + std::to_string(more_) + " more warnings");
    more_ = 0;
    return std::move(lines_);
}

Budget::Budget(std::size_t file_bytes) : left_(std::size_t{256} << 20) { grow(file_bytes); }

void Budget::grow(std::size_t file_bytes) {
    constexpr std::size_t factor = 256;
    const std::size_t most = std::numeric_limits<std::size_t>::max();
    left_ = file_bytes > (most - left_) / factor ? most : left_ + factor * file_bytes;
}

bool Budget::try_to_charge(std::size_t count, std::size_t bytes_each) {
    if (bytes_each != 0 && count > left_ / bytes_each)
        return false;
    left_ -= count * bytes_each;
    return true;
}

void Budget::charge(std::size_t count, std::size_t bytes_each) {
    if (!try_to_charge(count, bytes_each))
        fail({"the scene is out of all proportion to its file: it shows its meshes too often, or a count is wrong"});
}

} // namespace nephroid::examples::gltf
