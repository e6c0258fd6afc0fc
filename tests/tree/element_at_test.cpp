// SPDX-License-Identifier: MIT
#include "nephroid/tree/element_at.hpp"

#include <doctest/doctest.h>

#include <deque>
#include <type_traits>
#include <utility>
#include <vector>

using nephroid::detail::element_at;

TEST_CASE("an element is the range's own, and may be written where the range may") {
    std::deque<int> numbers{3, 4, 5};
    element_at(numbers, 1) = 7;
    CHECK(numbers[1] == 7);
    static_assert(std::is_same_v<decltype(element_at(std::as_const(numbers), 0)), const int&>);
}

TEST_CASE("an element of a range that makes its values is a value, and bits of a vector<bool> can be written") {
    const std::vector<bool> one{false, true};
    static_assert(std::is_same_v<decltype(element_at(one, 1)), bool>);
    CHECK(element_at(one, 1));
    std::vector<bool> bits(3);
    element_at(bits, 2) = true;
    CHECK(bits == std::vector<bool>{false, false, true});
}
