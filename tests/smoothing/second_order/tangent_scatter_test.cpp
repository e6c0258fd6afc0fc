// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/tangent_scatter.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <vector>

namespace nephroid::tests::tangent_scatter_test {

using namespace nephroid::detail;

namespace {

/// A photon whose tangents are the map's, J, times 1 + off.
[[nodiscard]] TangentResidual off_by(double off) {
    const Double3 u{2, 0.3, 0}, v{-0.4, 1, 0.2};
    return {{}, {(1 + off) * u, (1 + off) * v}, {off * u, off * v}};
}

} // namespace

// The tangents J (1 ± e) have residuals ±e J: e² over the mean of (1 ± e)², which is 1 + e².
TEST_CASE("tangent scatter: it is the part of the tangents that the map does not explain") {
    for (const double e : {0.01, 0.3, 2.0})
        CHECK(tangent_scatter({off_by(e), off_by(-e)}) == doctest::Approx(e * e / (1 + e * e)).epsilon(1e-12));
    CHECK(tangent_scatter({off_by(0), off_by(0)}) == 0);
    CHECK(tangent_scatter({off_by(-1), off_by(0)}) == doctest::Approx(1).epsilon(1e-12)); // one has no tangents at all
    CHECK(tangent_scatter({}) == 0);
    CHECK(!(tangent_scatter({off_by(std::numeric_limits<double>::quiet_NaN())}) > 0));
}

// The published footprint has a smoothing of 8: S = 64 in each direction.
TEST_CASE("tangent scatter: footprints have no more area than the published ones where a fifth is not explained") {
    const Symmetric2 wide{400, 30, 100};
    for (const double scatter : {0.2, 0.5, 1.0}) {
        const Symmetric2 bounded = bounded_by_scatter(wide, scatter, 5);
        CHECK(bounded.determinant() == doctest::Approx(64.0 * 64).epsilon(1e-12));
        CHECK(bounded.xx / bounded.yy == doctest::Approx(4).epsilon(1e-12)); // as long and thin as before
        CHECK(bounded.xy / bounded.yy == doctest::Approx(0.3).epsilon(1e-12));
    }
    CHECK(bounded_by_scatter(wide, 0.1, 5).determinant() == doctest::Approx(128.0 * 128).epsilon(1e-12));
    const Symmetric2 narrow{100, 0, 36};
    for (const double scatter : {0.0, 0.05, 1.0})
        CHECK(bounded_by_scatter(narrow, scatter, 5).determinant() == narrow.determinant());
    CHECK(bounded_by_scatter(wide, 0, 5).determinant() == wide.determinant());
}

} // namespace nephroid::tests::tangent_scatter_test
