// SPDX-License-Identifier: MIT
// The passes are made up here, pass by pass, so that mean, noise and number follow from a few lines of arithmetic.
#include "common/caustics/passes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::examples::passes_test {

namespace {

constexpr std::uint64_t photons = 100;

/// Traces passes whose pixels are pixels(number of the pass), and notes the first photon of each.
template <class Pixels>
PassedLayer<float> layer_of(const std::optional<double>& error, const Pixels& pixels,
                            std::vector<std::uint64_t>& firsts, std::uint64_t photons_in_all = UINT64_MAX) {
    return trace_passes(
        error, photons,
        [&](std::uint64_t first, const auto& progress) {
            firsts.push_back(first);
            const std::uint64_t left = photons_in_all - first;
            const std::uint64_t emitted = left < photons ? left : photons;
            CHECK(progress(emitted));
            return emitted;
        },
        [&]() -> std::vector<float> { return pixels(firsts.size() - 1); });
}

} // namespace

TEST_CASE("Without an error a layer is a single pass and has no variance") {
    std::vector<std::uint64_t> firsts;
    const auto layer = layer_of(
        {},
        [](std::size_t) {
            return std::vector<float>{2, 5};
        },
        firsts);
    CHECK(firsts == std::vector<std::uint64_t>{0});
    CHECK(layer.pixels == std::vector<float>{2, 5});
    CHECK(layer.variance.empty());
    CHECK(layer.report.passes == 1);
    CHECK_FALSE(layer.report.noise);
    CHECK_FALSE(layer.report.is_interrupted);
}

TEST_CASE("Passes follow each other in the sequence, and their mean and its variance are those of their pixels") {
    std::vector<std::uint64_t> firsts;
    // 1, 3, 2, 6: the mean is 3, the squares of the distances from it 4 + 0 + 1 + 9 = 14, over 4 * 3.
    const auto layer = layer_of(
        10.,
        [](std::size_t pass) {
            return std::vector<float>{std::vector<float>{1, 3, 2, 6}.at(pass), 4};
        },
        firsts);
    CHECK(firsts == std::vector<std::uint64_t>{0, photons, 2 * photons, 3 * photons}); // four, though two would do
    REQUIRE(layer.pixels.size() == 2);
    REQUIRE(layer.variance.size() == 2);
    // A few roundings of single precision, each of 2^-24 of the value.
    CHECK(std::abs(layer.pixels[0] - 3) < 3e-6F);
    CHECK(std::abs(layer.pixels[1] - 4) < 3e-6F);
    CHECK(std::abs(layer.variance[0] - 14.F / 12) < 1e-6F);
    CHECK(layer.variance[1] == 0);
    // The root mean square of the pixels' standard errors over the mean of the pixels.
    CHECK(std::abs(layer.report.noise.value() - std::sqrt(14. / 12 / 2) / 3.5) < 1e-12);
}

TEST_CASE("Passes end with the first whose mean is less noisy than the error") {
    std::vector<std::uint64_t> firsts;
    // 1, 3, 1, 3: after an even number n the noise is 1 / (2 sqrt(n - 1)), which is 0.1147 of 20 and 0.1091 of 22;
    // after n = 2m + 1 it is sqrt(2(m + 1)) / (4m + 1), which is 0.1144 of 21.
    const auto layer = layer_of(
        0.11, [](std::size_t pass) { return std::vector<float>{pass % 2 == 0 ? 1.F : 3.F}; }, firsts);
    CHECK(layer.report.passes == 22);
    CHECK(std::abs(layer.report.noise.value() - 0.5 / std::sqrt(21.)) < 1e-12);
}

TEST_CASE("Four dark passes are enough, and a single one with light among 64") {
    std::vector<std::uint64_t> dark, flash, flashes;
    const auto of_dark = layer_of(
        0.01,
        [](std::size_t) {
            return std::vector<float>{0, 0};
        },
        dark);
    CHECK(of_dark.report.passes == 4);
    CHECK(std::isinf(of_dark.report.noise.value()));

    // Of n passes one is x: the mean is x / n, the standard error of it x / n as well.
    const auto of_flash = layer_of(
        0.01, [](std::size_t pass) { return std::vector<float>{pass == 2 ? 8.F : 0.F}; }, flash);
    CHECK(of_flash.report.passes == 64);
    CHECK(std::abs(of_flash.report.noise.value() - 1) < 1e-12);

    // Light in every 32nd pass goes on: the noise of k flashes in n passes is sqrt((n - k) / (k (n - 1))). As the
    // fourth comes, with n = 97, it is sqrt(93 / 384) = 0.4921, and before it sqrt(93 / 285) = 0.5712.
    const auto of_flashes = layer_of(
        0.5, [](std::size_t pass) { return std::vector<float>{pass % 32 == 0 ? 8.F : 0.F}; }, flashes);
    CHECK(of_flashes.report.passes == 97);
    CHECK(std::abs(of_flashes.report.noise.value() - std::sqrt(93. / 384)) < 1e-12);
}

TEST_CASE("A pass that ended early weighs what it emitted and is none of the whole ones") {
    std::vector<std::uint64_t> firsts;
    // Two whole passes of 2 and a quarter of one, whose photons brought 2.75: (2 + 2 + 2.75) / 2.25 = 3.
    const auto layer = layer_of(
        1e-9, [](std::size_t pass) { return std::vector<float>{pass < 2 ? 2.F : 2.75F}; }, firsts, 2 * photons + 25);
    CHECK(layer.report.is_interrupted);
    CHECK(layer.report.passes == 2);
    CHECK(std::abs(layer.pixels.at(0) - 3) < 3e-6F);
    CHECK(layer.variance == std::vector<float>{0});
}

TEST_CASE("The fluxes of an account of passes are those of one pass and its numbers those of all") {
    Statistics account;
    account.emitted.flux = 12;
    account.emitted.photons = 400;
    account.fates.back().flux = 8;
    account.received.front().excess = 2;
    divide_flux(account, 4);
    CHECK(account.emitted.flux == 3);
    CHECK(account.emitted.photons == 400);
    CHECK(account.fates.back().flux == 2);
    CHECK(account.received.front().excess == 0.5);
}

} // namespace nephroid::examples::passes_test
