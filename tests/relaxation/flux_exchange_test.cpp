// SPDX-License-Identifier: MIT
#include "nephroid/relaxation/flux_exchange.hpp"

#include "nephroid/relaxation/feature_detector.hpp"
#include "nephroid/relaxation/neighbourhood.hpp"

#include "relaxation/cloud.hpp"

#include <doctest/doctest.h>

#include <numeric>

namespace nephroid::tests::flux_exchange_test {

using namespace nephroid::detail;

namespace {

constexpr FluxDiffusion methods[] = {FluxDiffusion::conserving, FluxDiffusion::weighted_mean};

/// Random floor whose photons' fluxes are random too.
std::vector<Stored> flickering_floor(int count, std::uint32_t seed) {
    auto photons = random_floor(count, seed);
    Draws draw(seed + 1);
    for (Stored& photon : photons)
        photon.flux = draw.in(0, 2);
    return photons;
}

double total(const std::vector<Stored>& photons) {
    return std::accumulate(photons.begin(), photons.end(), 0.0,
                           [](double sum, const Stored& p) { return sum + p.flux; });
}

double variance(const std::vector<Stored>& photons) {
    const double mean = total(photons) / double(photons.size());
    double sum = 0;
    for (const Stored& photon : photons)
        sum += std::pow(photon.flux - mean, 2) / double(photons.size());
    return sum;
}

/// Evens out the fluxes of photons that stay where they are, `options.iterations` times.
template <class P>
void diffuse(std::vector<P>& photons, const RelaxationOptions& options) {
    using V = decltype(P::position);
    using T = scalar_t<V>;
    using Cloud = PhotonCloud<V, decltype(P::flux)>;
    SerialExecutor executor;
    Cloud cloud(photons, access_to<P>(), options.cos_same_surface, "test");
    const std::size_t slots = cloud.tree().slots();
    std::vector<PhotonConstraint<V>> constraints;
    if (options.constrain) {
        FeatureDetector<Cloud> detector(cloud, options);
        detector.run(executor);
        for (std::size_t slot = 0; slot < slots; ++slot)
            constraints.push_back(detector.constraint(slot));
    }
    FluxExchange<Cloud> exchange(cloud, options);
    const std::vector<T> guess(slots);
    exchange.find_partners(cloud, guess, executor);
    for (unsigned i = 0; i < options.iterations; ++i)
        exchange.run(cloud, constraints, options.flux_diffusion, executor);
    cloud.write_fluxes(photons, access_to<P>(), executor);
}

void diffuse(std::vector<Stored>& photons, FluxDiffusion method, unsigned steps, bool constrain = false,
             unsigned neighbours = 6) {
    diffuse(photons,
            RelaxationOptions{
                .iterations = steps, .neighbours = neighbours, .constrain = constrain, .flux_diffusion = method});
}

} // namespace

TEST_CASE("permeability: flux passes along a feature and not across") {
    using V = glm::dvec3;
    const V along(2, 0, 0), across(0, 3, 0);
    const PhotonConstraint<V> held{{1, 0, 0}, 1}, half{{1, 0, 0}, 0.5}, free{{0, 0, 0}, 0};
    CHECK(permeability(held, along, 2.0) == 1);
    CHECK(permeability(held, V(-along), 2.0) == 1);
    CHECK(permeability(held, across, 3.0) == 0);
    CHECK(permeability(half, across, 3.0) == 0.5);
    CHECK(permeability(half, V(3, 4, 0), 5.0) == doctest::Approx(0.5 * 0.6 + 0.5).epsilon(1e-15));
    CHECK(permeability(free, across, 3.0) == 1);
}

// Photons at 0, 1 and 2.5 along a line, K = 1: r = 2.5, 1.5, 2.5, and the partners are 1, 0 and 1.
TEST_CASE("flux diffusion: three photons exchange what the formulas say") {
    const std::vector<Stored> start{
        {0, {0, 0, 0}, {0, 0, 1}, 8}, {1, {1, 0, 0}, {0, 0, 1}, 2}, {2, {2.5, 0, 0}, {0, 0, 1}, 6}};
    auto photons = start;
    diffuse(photons, FluxDiffusion::weighted_mean, 1, false, 1);
    // W = 1 − d²/r²: 1 − 0.16, 1 − 1/2.25, 1 − 2.25/6.25
    CHECK(photons[0].flux == doctest::Approx((8 + 2 * 0.84) / 1.84).epsilon(1e-14));
    CHECK(photons[1].flux == doctest::Approx((2 + 8 * 5 / 9.0) / (1 + 5 / 9.0)).epsilon(1e-14));
    CHECK(photons[2].flux == doctest::Approx((6 + 2 * 0.64) / 1.64).epsilon(1e-14));

    photons = start;
    diffuse(photons, FluxDiffusion::conserving, 1, false, 1);
    // The first two use the smaller radius: half of 1 − 1/2.25 of 8 − 2. The third lies 1.5 away, r of the second.
    CHECK(photons[0].flux == doctest::Approx(8 - 6 * 5 / 18.0).epsilon(1e-14));
    CHECK(photons[1].flux == doctest::Approx(2 + 6 * 5 / 18.0).epsilon(1e-14));
    CHECK(photons[2].flux == 6);
}

// Each of n fluxes is rounded K + 1 times in each of 20 steps, by half an epsilon of at most 2 and either way.
TEST_CASE("flux diffusion: the exchange keeps the total to rounding and the weighted mean does not") {
    const auto start = flickering_floor(2000, 51);
    for (const bool constrain : {false, true}) {
        auto conserved = start, averaged = start;
        diffuse(conserved, FluxDiffusion::conserving, 20, constrain);
        diffuse(averaged, FluxDiffusion::weighted_mean, 20, constrain);
        const double rounding = 2000 * 7 * 20 * 2.3e-16;
        CHECK(std::abs(total(conserved) - total(start)) <= rounding);
        CHECK(std::abs(total(averaged) - total(start)) > 1000 * rounding);
        const double gained = total(averaged) / total(start) - 1; // 0.70% without constraints, 0.91% with them
        CHECK(gained > 0.006);
        CHECK(gained < 0.01);
    }
}

TEST_CASE("flux diffusion: differences even out and equal fluxes stay") {
    for (const FluxDiffusion method : methods) {
        auto photons = flickering_floor(2000, 52);
        double before = variance(photons);
        for (int step = 0; step < 5; ++step) {
            diffuse(photons, method, 1);
            CHECK(variance(photons) < before);
            before = variance(photons);
        }
        for (const Stored& photon : photons) // no flux overshoots
            CHECK((photon.flux >= 0 && photon.flux <= 2));
        for (Stored& photon : photons)
            photon.flux = 0.7;
        diffuse(photons, method, 5);
        for (const Stored& photon : photons)
            CHECK(photon.flux == doctest::Approx(0.7).epsilon(1e-13));
    }
}

TEST_CASE("flux diffusion: a photon alone and photons in one place keep their flux") {
    for (const FluxDiffusion method : methods) {
        std::vector<Stored> alone{floor_photon(0.3, 0.4)}, nobody;
        diffuse(alone, method, 5);
        CHECK(alone[0].flux == 1);
        diffuse(nobody, method, 5);
        std::vector<Stored> together(20, floor_photon(1, 1));
        together[3].flux = 5;
        diffuse(together, method, 5);
        CHECK(total(together) == 24);
    }
}

// Left of 0.5 flux 1, right of it 10: below α, so that nothing passes where a photon is held fully.
TEST_CASE("flux diffusion: does not cross an edge of flux") {
    const auto lit = [](bool constrain) {
        auto photons = random_floor(4000, 54);
        for (Stored& photon : photons)
            photon.flux = photon.position.x < 0.5 ? 1 : 10;
        diffuse(photons, FluxDiffusion::conserving, 10, constrain);
        double crossed = 0;
        for (const Stored& photon : photons)
            crossed += photon.position.x < 0.5 ? photon.flux - 1 : 0;
        return crossed;
    };
    CHECK(lit(true) == 0);
    CHECK(lit(false) > 100);
}

TEST_CASE("flux diffusion: works however far photons are from the origin") {
    auto photons = flickering_floor(500, 56);
    for (Stored& photon : photons)
        photon.position = 1e-3 * photon.position + glm::dvec3(1.0 / 3, 1e5 / 7, -1e9 / 11);
    const auto start = photons;
    diffuse(photons, FluxDiffusion::conserving, 3);
    CHECK(same_positions(photons, start));
    CHECK(variance(photons) < 0.9 * variance(start));
}

TEST_CASE("flux diffusion: colours are exchanged band by band") {
    using Coloured = StoredPhoton<glm::vec3, glm::vec3>;
    Draws draw(55);
    std::vector<Coloured> photons;
    for (int i = 0; i < 1000; ++i) {
        const float x = float(draw.in(0, 1)), y = float(draw.in(0, 1));
        const int band = int(draw.in(0, 3));
        photons.push_back({i, {x, y, 0}, {0, 0, 1}, {band == 0, band == 1, band == 2}});
    }
    const auto sums = [&] {
        glm::dvec3 sum(0), squares(0);
        for (const Coloured& p : photons)
            sum += glm::dvec3(p.flux), squares += glm::dvec3(p.flux * p.flux);
        return std::pair(sum, squares);
    };
    const auto before = sums();
    diffuse(photons,
            RelaxationOptions{.iterations = 10, .constrain = false, .flux_diffusion = FluxDiffusion::conserving});
    const auto after = sums();
    for (int band = 0; band < 3; ++band) {
        CHECK(std::abs(after.first[band] - before.first[band]) <= 1000 * 7 * 10 * 6e-8);
        CHECK(after.second[band] < 0.6 * before.second[band]);
    }
}

} // namespace nephroid::tests::flux_exchange_test
