// SPDX-License-Identifier: MIT
#include "footprint/kernel_laws.hpp"

#include <string>

namespace nephroid::tests::kernel_test {

using detail::HasSecondMoment;

namespace {

/// A user's own: 4/π (1 − r²)³, with moments 1 and 1/10.
struct TriweightKernel {
    static constexpr double second_moment = 0.1;
    template <class T>
    T operator()(const T& radius2) const {
        const T rest = radius2 < T(1) ? T(1) - radius2 : T(0);
        return T(4) / pi<T> * rest * rest * rest;
    }
};

/// A user's own with a parameter: a biweight on top of a uniform one. Moments add up in the same shares.
struct TableKernel {
    static constexpr double second_moment = 0.5 / 8 + 0.5 / 4;
    double share = 0.5;
    template <class T>
    T operator()(T radius2) const {
        return T(share) * BiweightKernel{}(radius2) + T(1 - share) * UniformKernel{}(radius2);
    }
};

struct NoSecondMoment {
    float operator()(float) const { return 0; }
};
struct OnlyFloat {
    [[maybe_unused]] static constexpr double second_moment = 0.25;
    float operator()(float) const { return 0; }
};

static_assert(Kernel<TriweightKernel, float> && Kernel<TableKernel, double>);
static_assert(Kernel<OnlyFloat, float>);
static_assert(!Kernel<OnlyFloat, double>); // would round in the middle of a double's way
static_assert(Kernel<NoSecondMoment, float> && !HasSecondMoment<NoSecondMoment>); // the pixel filter wants one
static_assert(!Kernel<int, float>);
static_assert(!Kernel<BiweightKernel, int>);
static_assert(!Kernel<BiweightKernel, std::string>);

} // namespace

TEST_CASE_TEMPLATE("kernels: every kernel obeys the laws", T, float, double) {
    SUBCASE("biweight") { tests::check_kernel_laws<BiweightKernel, T>(); }
    SUBCASE("Epanechnikov") { tests::check_kernel_laws<EpanechnikovKernel, T>(); }
    SUBCASE("cone") { tests::check_kernel_laws<ConeKernel, T>(); }
    SUBCASE("uniform") { tests::check_kernel_laws<UniformKernel, T>(); }
    SUBCASE("truncated Gaussian") { tests::check_kernel_laws<TruncatedGaussianKernel, T>(); }
    SUBCASE("a user's own") { tests::check_kernel_laws<TriweightKernel, T>(); }
    SUBCASE("a user's own with a state") { tests::check_kernel_laws<TableKernel, T>(TableKernel{}); }
}

// K(0) of the formulas as printed: eq. 11 of Frisvad et al. 2014 is 3/π, Jensen's cone 3/π, the others by hand.
TEST_CASE("kernels: heights are those in the papers") {
    const double pi = std::numbers::pi, tolerance = 4e-16;
    CHECK(std::abs(BiweightKernel{}(0.0) - 3 / pi) <= tolerance);
    CHECK(std::abs(BiweightKernel{}(0.5) - 0.75 / pi) <= tolerance);
    CHECK(std::abs(EpanechnikovKernel{}(0.5) - 1 / pi) <= tolerance);
    CHECK(std::abs(ConeKernel{}(0.25) - 1.5 / pi) <= tolerance);
    CHECK(std::abs(UniformKernel{}(0.25) - 1 / pi) <= tolerance);
    // Standard deviation 1/3: at r = 1/3 it has fallen by exp(−1/2).
    const double fallen = TruncatedGaussianKernel{}(1.0 / 9) / TruncatedGaussianKernel{}(0.0);
    CHECK(std::abs(fallen - std::exp(-0.5)) <= tolerance);
    CHECK(std::abs(TruncatedGaussianKernel::cut - std::exp(-4.5)) <= 1e-17);
}

// The rule of eight points is exact for polynomials of r, which all but the Gaussian are. Of that one it leaves 1.5e-9.
TEST_CASE("kernels: the mass by quadrature is that of the formula") {
    for (int i = 0; i <= 10; ++i) {
        const double r = 0.1 * i;
        CHECK(std::abs(detail::mass_by_quadrature(BiweightKernel{}, r) - BiweightKernel{}.mass_within(r * r)) < 1e-14);
        CHECK(std::abs(detail::mass_by_quadrature(ConeKernel{}, r) - ConeKernel{}.mass_within(r * r)) < 1e-14);
        CHECK(std::abs(detail::mass_by_quadrature(TruncatedGaussianKernel{}, r) -
                       TruncatedGaussianKernel{}.mass_within(r * r)) < 2e-9);
    }
}

TEST_CASE("pixel filter width: it is the square root of two thirds for the biweight kernel") {
    CHECK(std::abs(pixel_filter_width<BiweightKernel> - std::sqrt(2.0 / 3)) <= 2.3e-16);
    CHECK(std::abs(pixel_filter_width<UniformKernel> - std::sqrt(1.0 / 3)) <= 2.3e-16);
    CHECK(std::abs(pixel_filter_width<EpanechnikovKernel> - std::sqrt(0.5)) <= 2.3e-16);
}

// By r2: −6/π (1 − r2), −2/π, −3/(2π r), 0, −9/2 k. Central differences in double with h = 1e-5 are off
// by h²/6 times the third derivative, which is largest for the cone at 0.045, 9/(8π) r⁻⁵ < 900, plus rounding,
// epsilon / h: below 1e-7.
TEST_CASE("kernels: derivatives inside the disk are those of the formulas") {
    const double h = 1e-5;
    const auto slope = [&](const auto& kernel, double r2) { return (kernel(r2 + h) - kernel(r2 - h)) / (2 * h); };
    for (int i = 5; i < 100; ++i) {
        const double r2 = 0.01 * i - 0.005;
        CAPTURE(r2);
        CHECK(std::abs(slope(BiweightKernel{}, r2) + 6 / pi<double> * (1 - r2)) < 1e-7);
        CHECK(std::abs(slope(EpanechnikovKernel{}, r2) + 2 / pi<double>) < 1e-7);
        CHECK(std::abs(slope(ConeKernel{}, r2) + 1.5 / (pi<double> * std::sqrt(r2))) < 1e-7);
        CHECK(slope(UniformKernel{}, r2) == 0);
        CHECK(std::abs(slope(TruncatedGaussianKernel{}, r2) + 4.5 * TruncatedGaussianKernel{}(r2)) < 1e-7);
    }
    // The default's slope reaches zero at the edge, so that a splat has no rim: from outside it is zero as well.
    CHECK(std::abs(slope(BiweightKernel{}, 1.0)) < 2 * h);
}

} // namespace nephroid::tests::kernel_test
