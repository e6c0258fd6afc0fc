// SPDX-License-Identifier: MIT
/// @file  Messages of the glTF reader about a file, and a limit on the memory that a file may use.
#pragma once

#include <cstddef>
#include <initializer_list>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::examples::gltf {

/// The text in one printable line: control characters become spaces, and what is too long is cut off.
[[nodiscard]] std::string one_line(std::string_view text);

/// An object of the file as messages call it: `mesh 3 ("sphere")`, without the brackets where it has no name.
[[nodiscard]] std::string named(std::string_view kind, std::size_t index, std::string_view name);

/// Throws std::runtime_error with the parts joined, in one line. The caller of the reader adds the file's name.
[[noreturn]] void fail(std::initializer_list<std::string_view> parts);

/// Fails unless `value`, as tinygltf gives it, is an index into something of the given size.
///
/// @param owner  of the index, such as `node 3`; @param kind  of what it points to, such as "mesh"
[[nodiscard]] std::size_t checked_index(int value, std::size_t size, std::string_view owner, std::string_view kind);

/// Collects warnings, each once; after the hundredth it only counts.
class Warnings {
public:
    void add(std::string_view text);

    /// All warnings, and a last line with the number of further ones.
    [[nodiscard]] std::vector<std::string> take();

private:
    std::vector<std::string> lines_;
    std::size_t more_ = 0;
};

/// Limits the memory of a scene by the size of its file: a few bytes can show a mesh many times.
class Budget {
public:
    /// 256 MiB and 256 times the file with its buffers.
    explicit Budget(std::size_t file_bytes);

    /// Takes `count` times `bytes_each` off, before that memory is asked for; fails when it is used up.
    void charge(std::size_t count, std::size_t bytes_each);

    /// The same, but returns whether it is enough; if not, takes nothing.
    [[nodiscard]] bool try_to_charge(std::size_t count, std::size_t bytes_each);

    /// For another file that belongs to the scene: 256 times its size.
    void grow(std::size_t file_bytes);

    /// Gives back what was charged for memory that is free again.
    void give_back(std::size_t bytes) { left_ += bytes; }

private:
    std::size_t left_;
};

} // namespace nephroid::examples::gltf
