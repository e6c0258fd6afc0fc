// SPDX-License-Identifier: MIT
#include "nephroid/receiver/leaf_spacing.hpp"

#include <doctest/doctest.h>

#include <vector>

namespace nephroid::tests::leaf_spacing_test {

TEST_CASE("leaf spacing: unknown spacings become the median of the others") {
    std::vector<double> spacings{0, 3, 1, 0, 2};
    detail::fill_unknown_spacings(spacings);
    CHECK(spacings == std::vector<double>{2, 3, 1, 2, 2});
    std::vector<double> unknown{0, 0};
    detail::fill_unknown_spacings(unknown);
    CHECK(unknown == std::vector<double>{0, 0});
}

} // namespace nephroid::tests::leaf_spacing_test
