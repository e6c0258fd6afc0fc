// SPDX-License-Identifier: MIT
#include "nephroid/vector/in_place.hpp"

#include <doctest/doctest.h>

#include <optional>
#include <utility>

namespace nephroid::tests::in_place_test {

namespace {

/// Counts how often it was copied or moved on its way.
struct Traveller {
    explicit Traveller(int v) : value(v) {}
    Traveller(const Traveller& other) : value(other.value), moves(other.moves + 1) {}
    Traveller& operator=(const Traveller&) = delete;

    int value;
    int moves = 0;
};

// Compilers without the resolution of CWG 2327 move it once.
#if defined(__GNUC__) && !defined(__clang__)
constexpr int most_moves = 0;
#else
constexpr int most_moves = 1;
#endif

} // namespace

TEST_CASE("in place: an optional's object is made in the optional") {
    int made = 0;
    const auto make = [&] {
        ++made;
        return Traveller(7);
    };
    const std::optional<Traveller> constructed(std::in_place, InPlace{make});
    REQUIRE(constructed.has_value());
    CHECK(constructed->value == 7);
    CHECK(constructed->moves <= most_moves);
    CHECK(made == 1);

    std::optional<Traveller> emplaced;
    emplaced.emplace(InPlace{make});
    REQUIRE(emplaced.has_value());
    CHECK(emplaced->value == 7);
    CHECK(emplaced->moves <= most_moves);
    CHECK(made == 2);
}

} // namespace nephroid::tests::in_place_test
