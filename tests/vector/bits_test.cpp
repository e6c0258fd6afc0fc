// SPDX-License-Identifier: MIT
#include "nephroid/vector/bits.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <limits>

namespace nephroid::tests::bits_test {

// By IEEE 754: sign, exponent plus its bias, fraction.
TEST_CASE("bit_cast: shows a number's sign, exponent and fraction, also while compiling") {
    static_assert(detail::bit_cast<std::uint32_t>(1.f) == 0x3f800000u);
    static_assert(detail::bit_cast<std::uint64_t>(-2.0) == 0xc000000000000000u);
    CHECK(detail::bit_cast<std::uint32_t>(-0.f) == 0x80000000u);
    CHECK(detail::bit_cast<float>(std::uint32_t(0x7f800000)) == std::numeric_limits<float>::infinity());
}

} // namespace nephroid::tests::bits_test
