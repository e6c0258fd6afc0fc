// SPDX-License-Identifier: MIT
/// @file  Vector registers, by an extension of GCC and Clang.
#pragma once

#include <cstddef>

namespace nephroid::examples {

/// A vector of numbers by GCC's and Clang's extension: as many as fit into one register of any machine.
template <class T>
struct RegisterOf {
    typedef T type __attribute__((vector_size(16)));
    static constexpr std::size_t lanes = 16 / sizeof(T);
};

/// Turns the results of comparisons into bits: bit first + i is set if the comparison in lane i was true.
template <class Results>
[[nodiscard]] Results bits_from(std::size_t first, const Results& results) {
    Results bits;
    for (int i = 0; i < int(sizeof(Results) / sizeof(results[0])); ++i)
        bits[i] = 1 << (int(first) + i);
    return results & bits;
}

/// The bits of all lanes combined.
template <class Bits>
[[nodiscard]] unsigned all_bits(const Bits& bits) {
    using Halves = typename RegisterOf<long long>::type;
    const Halves halves = reinterpret_cast<Halves>(bits);
    const auto both = static_cast<unsigned long long>(halves[0] | halves[1]);
    return static_cast<unsigned>(both | both >> 32);
}

} // namespace nephroid::examples
