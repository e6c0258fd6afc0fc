// SPDX-License-Identifier: MIT
#include "nephroid/tree/smallest.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>

namespace nephroid::tests::smallest_test {

using tests::Draws;

// What the limit keeps is counted, and compared with the sorted values.
TEST_CASE_TEMPLATE("smallest: the limit keeps as many as are wanted and at most a few more", T, float, double) {
    Draws draw(1);
    for (const std::size_t size : {1u, 2u, 24u, 333u})
        for (int kind = 0; kind < 4; ++kind)
            for (const std::size_t spare : {0u, 5u}) {
                std::vector<T> values;
                for (std::size_t i = 0; i < size; ++i) {
                    const double u = draw.in(0, 1);
                    values.push_back(T(kind == 0   ? u
                                       : kind == 1 ? std::pow(10.0, 60 * u - 30)
                                       : kind == 2 ? std::floor(5 * u)
                                                   : 0.0));
                }
                std::vector<T> sorted = values;
                std::sort(sorted.begin(), sorted.end());
                for (std::size_t wanted = 1; wanted <= size; wanted += 1 + size / 7) {
                    CAPTURE(size);
                    CAPTURE(kind);
                    CAPTURE(wanted);
                    const auto [limit, at_limit] = detail::limit_of_smallest<T>(values, wanted, spare, sorted.back());
                    const std::size_t kept = detail::count_below<T>(values, limit) + at_limit;
                    CHECK(kept >= wanted);
                    CHECK(kept <= wanted + spare);
                    CHECK(sorted[kept - 1] <= limit);
                    CHECK((kept == size || sorted[kept] >= limit));
                    if (at_limit > 0)
                        CHECK(sorted[kept - 1] == limit); // there are so many at it
                }
            }
}

} // namespace nephroid::tests::smallest_test
