// SPDX-License-Identifier: MIT
/// @file  A picture in the making as bytes: sums, account and the next photon, checked when they are read.
#pragma once

#include "nephroid/receiver/sums.hpp"
#include "nephroid/sequence/hash.hpp"
#include "nephroid/transport/account.hpp"
#include "nephroid/vector/error.hpp"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <type_traits>

namespace nephroid {

namespace detail {

/// What stands before the account and the sums.
struct CheckpointHeader {
    static constexpr std::array<char, 8> name{'n', 'e', 'p', 'h', 'r', 'o', 'i', 'd'};
    static constexpr std::uint64_t this_version = 1; // read as another number on a machine of another byte order

    std::array<char, 8> magic = name;
    std::uint64_t version = this_version;
    std::uint64_t size = 0;                     ///< of all bytes
    std::uint64_t number_size = 0, numbers = 0; ///< of each sum, of all sums
    std::uint64_t account_size = sizeof(Statistics);
    double unit = 1;
    std::uint64_t receiver = 0, scene = 0; ///< their hashes
    std::uint64_t next = 0;
};

/// Hashes bytes, eight at a time; as many zeros as lack to the last eight stand for themselves, so hash the size too.
[[nodiscard]] inline std::uint64_t hash_bytes(std::uint64_t seed, const char* bytes, std::size_t size) {
    for (std::size_t i = 0; i < size; i += sizeof(std::uint64_t)) {
        std::uint64_t word = 0;
        std::memcpy(&word, bytes + i, (std::min)(sizeof word, size - i));
        seed = hash_bits(seed, word);
    }
    return hash_bits(seed, size);
}

template <class T>
[[nodiscard]] std::uint64_t hash_values(std::uint64_t seed, const T* values, std::size_t count) {
    return hash_bytes(seed, reinterpret_cast<const char*>(values), count * sizeof(T));
}

template <class V>
[[nodiscard]] std::uint64_t hash_of(const EyePathMap<V>& map) {
    const std::size_t slots = map.tree().slots();
    std::uint64_t hash = hash_bits(0, slots);
    using t = vector_traits<V>;
    const V at = map.tree().origin();
    const std::array<scalar_t<V>, 3> origin{t::x(at), t::y(at), t::z(at)};
    hash = hash_values(hash, origin.data(), origin.size()); // the coordinates are relative to it
    for (const auto* coordinates : {map.tree().x(), map.tree().y(), map.tree().z()})
        hash = hash_values(hash, coordinates, slots);
    for (const auto* normals : {map.normal_x(), map.normal_y(), map.normal_z()})
        hash = hash_values(hash, normals, slots);
    return hash;
}

/// The header of what these sums are written as, and must be read from.
template <class V, class F, class R>
[[nodiscard]] CheckpointHeader header_of(const Sums<V, F, R>& sums, std::uint64_t scene) {
    using Number = typename Sums<V, F, R>::number;
    static_assert(std::is_trivially_copyable_v<Number>, "nephroid: the flux type is not trivially copyable: its sums "
                                                        "cannot be written as bytes (receiver/checkpoint.hpp)");
    CheckpointHeader header;
    header.number_size = sizeof(Number);
    header.numbers = sums.values().size();
    header.unit = sums.unit();
    header.receiver = hash_of(sums.map());
    header.scene = scene;
    header.size = sizeof header + sizeof(Statistics) + header.number_size * header.numbers + sizeof(std::uint64_t);
    return header;
}

[[noreturn]] NEPHROID_NOINLINE inline void refuse_checkpoint(const char* why) {
    invalid_argument(std::string("nephroid::resume: ") + why);
}

inline void check(const CheckpointHeader& read, const CheckpointHeader& expected, std::size_t size) {
    if (read.magic != expected.magic)
        refuse_checkpoint("these bytes are no checkpoint");
    if (read.version != expected.version || read.account_size != expected.account_size)
        refuse_checkpoint("the checkpoint is of another version of nephroid or another kind of machine; begin again");
    if (read.size != size)
        refuse_checkpoint("the checkpoint is truncated, or something was appended to it; use an older one");
    if (read.scene != expected.scene)
        refuse_checkpoint("the checkpoint is of another scene, lamp or options (the hash that was given)");
    if (read.receiver != expected.receiver || read.numbers != expected.numbers)
        refuse_checkpoint("the checkpoint is of another receiver: its eye path vertices differ");
    if (read.number_size != expected.number_size || !(read.unit == expected.unit))
        refuse_checkpoint("the checkpoint's sums are made of other numbers: another flux, accumulator or power");
    if (read.size != expected.size)
        refuse_checkpoint("the checkpoint is damaged: its size is not that of its sums; use an older one");
}

} // namespace detail

/// Writes down what has been added so far, so that `resume` can go on from there.
///
/// ```cpp
/// const std::string bytes = nephroid::checkpoint(sums, statistics, next, my_scene_hash); // write them to a new file,
///                                                                                        // then rename that
/// next = nephroid::resume(bytes, sums, statistics, my_scene_hash);                       // and go on from photon next
/// ```
///
/// @param next   index of the first photon that is not in the sums
/// @param scene  a number that says what is rendered: the caller's hash of scene, lamps, number of photons, options
template <class V, class F, class R>
[[nodiscard]] std::string checkpoint(const Sums<V, F, R>& sums, const Statistics& statistics, std::uint64_t next,
                                     std::uint64_t scene) {
    detail::CheckpointHeader header = detail::header_of(sums, scene);
    header.next = next;
    std::string bytes(std::size_t(header.size), '\0');
    char* to = bytes.data();
    const auto put = [&to](const void* from, std::size_t size) {
        if (size > 0)
            std::memcpy(to, from, size);
        to += size;
    };
    put(&header, sizeof header);
    put(&statistics, sizeof statistics);
    put(sums.values().data(), sums.values().size_bytes());
    const std::uint64_t hash = detail::hash_bytes(0, bytes.data(), bytes.size() - sizeof hash);
    put(&hash, sizeof hash);
    return bytes;
}

/// Reads what `checkpoint` has written. Sums and statistics are replaced, if all is well.
///
/// @return  index of the photon to go on with
/// Throws std::invalid_argument, and changes nothing, if the bytes are damaged or are those of another picture.
template <class V, class F, class R>
[[nodiscard]] std::uint64_t resume(std::string_view bytes, Sums<V, F, R>& sums, Statistics& statistics,
                                   std::uint64_t scene) {
    detail::CheckpointHeader header;
    std::uint64_t hash = 0;
    if (bytes.size() < sizeof header + sizeof statistics + sizeof hash)
        detail::refuse_checkpoint("these bytes are no checkpoint, or truncated");
    std::memcpy(&header, bytes.data(), sizeof header);
    detail::check(header, detail::header_of(sums, scene), bytes.size());
    std::memcpy(&hash, bytes.data() + bytes.size() - sizeof hash, sizeof hash);
    if (hash != detail::hash_bytes(0, bytes.data(), bytes.size() - sizeof hash))
        detail::refuse_checkpoint("the checkpoint is damaged: its checksum differs; use an older one");
    std::memcpy(&statistics, bytes.data() + sizeof header, sizeof statistics);
    if (!sums.values().empty())
        std::memcpy(sums.values().data(), bytes.data() + sizeof header + sizeof statistics, sums.values().size_bytes());
    return header.next;
}

} // namespace nephroid
