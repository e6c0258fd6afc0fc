// SPDX-License-Identifier: MIT
#include "nephroid/vector/text.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <glm/vec3.hpp>

#include <cstdint>
#include <limits>
#include <string>

namespace nephroid::tests::text_test {

// Written by hand: the shortest text of a number is unique but for where exponents begin, at 1e+17 at the latest.
TEST_CASE("text_of: has as few digits as read back as the same number") {
    CHECK(detail::text_of(0.1) == "0.1");
    CHECK(detail::text_of(0.5f) == "0.5");
    CHECK(detail::text_of(-3.0) == "-3");
    CHECK(detail::text_of(1.0 / 3) == "0.3333333333333333");
    CHECK(detail::text_of(1e30) == "1e+30");
    CHECK(detail::text_of(glm::vec3(1, -0.25f, 2)) == "(1, -0.25, 2)");
}

TEST_CASE("text_of: what is no number has a name") {
    CHECK(detail::text_of(std::numeric_limits<double>::infinity()) == "inf");
    CHECK(detail::text_of(-std::numeric_limits<double>::infinity()) == "-inf");
    CHECK(detail::text_of(std::numeric_limits<double>::quiet_NaN()) == "nan");
}

// The oracle of the one is the other: both read back as the number, and neither can have fewer digits.
TEST_CASE("text_of: without the library's std::to_chars the digits are the same") {
    std::uint64_t bits = 1;
    for (int i = 0; i < 2000; ++i) {
        bits = bits * 6364136223846793005u + 1442695040888963407u;
        const double fraction = double(bits >> 11) / 9007199254740992.0, x = (fraction - 0.5) * (i % 2 ? 1 : 256);
        const std::string printed = detail::shortest_printed(x);
        CHECK(std::stod(printed) == x);
        if constexpr (detail::HasToChars<double>)
            CHECK(detail::shortest_text(x).size() <= printed.size());
    }
    CHECK(detail::shortest_printed(0.1) == "0.1");
    CHECK(detail::shortest_printed(1.0 / 3) == "0.3333333333333333");
    CHECK(detail::shortest_printed(std::numeric_limits<double>::quiet_NaN()).find("nan") != std::string::npos);
    CHECK(detail::shortest_printed(-std::numeric_limits<double>::infinity()) == "-inf");
}

} // namespace nephroid::tests::text_test
