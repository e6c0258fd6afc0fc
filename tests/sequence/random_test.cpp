// SPDX-License-Identifier: MIT
#include "nephroid/sequence/random.hpp"

#include "sequence/sequence_laws.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::tests::random_test {

TEST_CASE("RandomSequence: is a sequence") { tests::check_sequence_laws<RandomSequence>(20); }

// Chi squared with k - 1 degrees of freedom: mean k - 1, variance 2 (k - 1). Along the index, along the dimension and
// along the seed, each with the other two fixed.
TEST_CASE("RandomSequence: pairs of successive numbers fill 16 by 16 cells evenly") {
    const RandomSequence one(1);
    for (int along = 0; along < 3; ++along) {
        const auto draw = [&](std::uint32_t i) {
            return along == 0   ? one.sample<float>(i, 0)
                   : along == 1 ? one.sample<float>(0, i)
                                : RandomSequence(i).sample<float>(0, 0);
        };
        const std::uint32_t n = 65536;
        std::vector<int> count(256);
        for (std::uint32_t i = 0; i < n; ++i)
            ++count[static_cast<std::size_t>(draw(2 * i) * 16) * 16 + static_cast<std::size_t>(draw(2 * i + 1) * 16)];
        double chi2 = 0;
        for (const int c : count)
            chi2 += (c - n / 256.0) * (c - n / 256.0) / (n / 256.0);
        CHECK(std::abs(chi2 - 255) < 5 * std::sqrt(2.0 * 255)); // too even is a failure as well
    }
}

TEST_CASE("RandomSequence: integrates with the error of independent samples") {
    const std::uint64_t n = 1024;
    const double expected = std::sqrt((std::pow(13.0 / 12, 4) - 1) / double(n));
    const double error = tests::integration_error<RandomSequence>(tests::product_of_four, 1, n);
    // The root mean square of 64 errors has relative standard deviation 1 / sqrt(128) = 9%.
    CHECK(error > expected * 0.6);
    CHECK(error < expected * 1.4);
}

} // namespace nephroid::tests::random_test
