// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/curved_footprints.hpp"

#include "smoothing/second_order/maps.hpp"
#include "support/glass_ball.hpp"
#include "support/space.hpp"
#include "support/vertex.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/directional.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

namespace nephroid::tests::curved_footprints_test {

using namespace nephroid::detail;

namespace {

using D = glm::dvec3;
using Whole = Deposit<D, double, 2>;
using SecondDerivatives = std::array<Double3, 3>;

constexpr double epsilon = std::numeric_limits<double>::epsilon();

[[nodiscard]] Whole deposit_of(const D& half_u, const D& half_v) {
    return {{0.3, -0.2, 0}, {0, 0, 1}, {0, 0, -1}, 3, {2.0 * half_u, 2.0 * half_v}};
}

/// Mean and covariance of what pieces light; the kernel has this second moment.
struct Moments {
    D mean{0};
    Symmetric2 covariance{};
    double flux = 0;

    Moments(std::span<const Whole> pieces, double second_moment) {
        for (const Whole& piece : pieces) {
            flux += piece.flux;
            mean += piece.flux * piece.position;
        }
        mean /= flux;
        for (const Whole& piece : pieces) {
            const D away = piece.position - mean;
            covariance += (piece.flux / flux) * Symmetric2::outer({away.x, away.y});
            for (const D& t : piece.d_position)
                covariance += (0.25 * second_moment * piece.flux / flux) * Symmetric2::outer({t.x, t.y});
        }
    }
};

using Vec = glm::vec3;

struct Picture {
    std::vector<float> irradiance;
    Statistics account;
};

/// A glass ball under the sun, on 24 × 24 places of the floor.
template <class Order, class E = SerialExecutor>
[[nodiscard]] Picture picture_of(const Order& order, std::uint64_t photons, E&& executor = E{}) {
    std::vector<tests::FloorVertex<Vec>> vertices;
    for (int i = 0; i < 24 * 24; ++i)
        vertices.push_back({Vec(0.0667f * float(i % 24) - 0.767f, 0.0667f * float(i / 24) - 0.767f, 0), Vec(0, 0, 1)});
    const EyePathMap<Vec> map(vertices, &tests::FloorVertex<Vec>::position, &tests::FloorVertex<Vec>::normal);
    const DirectionalLight<Vec, float> sun(
        {.direction = {0.1f, 0, -1}, .irradiance = 1, .patch = BoundingSphere<Vec>{{0, 0, 1.5f}, 1.25f}});
    auto sums = nephroid::sums<float>(map);
    Picture picture{std::vector<float>(vertices.size()), {}};
    picture.account = nephroid::caustics(tests::GlassBall<Vec, float>{.tint = 1}, sun, sums, {.count = photons},
                                         Default{}.with_order(order), HaltonSequence(1), executor);
    sums.for_each([&](std::size_t i, float e) { picture.irradiance[i] = e; });
    return picture;
}

} // namespace

// ∫ r⁴ over the biweight is 1/10. A biweight of half the size at q has q⁴ + q² r² + r⁴/10 with r² = 1/4.
TEST_CASE("curved footprints: pieces of the disk have the weight and the moments of one biweight") {
    double weight = 0, second = 0, fourth = 0, mixed = 0;
    D mean(0);
    for (const auto& piece : detail::disk_pieces) {
        const double q2 = inner(piece.centre, piece.centre);
        weight += piece.weight;
        mean += piece.weight * D(piece.centre.x, piece.centre.y, 0);
        second += piece.weight * (square(piece.centre.x) + 0.25 / 8);
        mixed += piece.weight * piece.centre.x * piece.centre.y;
        fourth += piece.weight * (q2 * q2 + q2 / 4 + 0.1 / 16);
        CHECK(std::sqrt(q2) + 0.5 <= 1 + 1e-15); // nothing reaches beyond the disk
    }
    CHECK(weight == 1);
    CHECK(length(mean) < 1e-15);
    CHECK(second == doctest::Approx(1.0 / 8).epsilon(1e-14));
    CHECK(std::abs(mixed) < 1e-15);
    CHECK(fourth == doctest::Approx(1.0 / 10).epsilon(1e-14));
}

TEST_CASE("curved footprints: the pieces keep the flux and the mean of the one splat and on a straight map its shape") {
    const Whole flat = deposit_of({0.2, 0.05, 0}, {-0.1, 0.15, 0});
    const Moments one(std::span<const Whole>(&flat, 1), 0.125);
    for (const double moment :
         {BiweightKernel::second_moment, UniformKernel::second_moment, TruncatedGaussianKernel::second_moment}) {
        const auto straight = curved(flat, {}, {{}, 0}, moment);
        REQUIRE(straight.count == 1); // nothing bends, even by the least bound
        const SecondDerivatives faint{Double3{1e-9, 0, 0}, {}, {}};
        const auto apart = curved(flat, faint, {{}, 0}, moment);
        REQUIRE(apart.count == 7);
        const Moments seven(apart.pieces(), moment);
        CHECK(seven.flux == doctest::Approx(flat.flux).epsilon(4 * epsilon));
        CHECK(length(seven.mean - flat.position) < 1e-8);
        const double share = moment / 0.125; // of the variance that `one` was asked for
        CHECK(seven.covariance.xx == doctest::Approx(share * one.covariance.xx).epsilon(1e-7));
        CHECK(seven.covariance.xy == doctest::Approx(share * one.covariance.xy).epsilon(1e-7));
        CHECK(seven.covariance.yy == doctest::Approx(share * one.covariance.yy).epsilon(1e-7));
        const auto bent =
            curved(flat, SecondDerivatives{Double3{0.1, 0.3, 0}, Double3{-0.2, 0.1, 0}, Double3{0.15, -0.1, 0}},
                   {{}, 0}, moment);
        CHECK(length(Moments(bent.pieces(), moment).mean - flat.position) < 1e-15);
    }
}

// Along a fold F = (u, u²/2 + …) the exact image of a disk bends; the pieces lie on it, moved by the mean of what
// they bend.
TEST_CASE("curved footprints: pieces lie where the map takes them and have its tangents there") {
    const D a(0.4, 0, 0), b(0, 0.05, 0);
    const SecondDerivatives second{Double3{0, 0.3, 0}, Double3{0.02, 0, 0}, Double3{0, 0, 0}};
    const auto result = curved(deposit_of(a, b), second, {}, 0.125);
    REQUIRE(result.count == 7);
    const D mean(0, 0.5 * 3.0 / 32 * 0.3, 0);
    for (std::size_t i = 0; i < 7; ++i) {
        const Plane2 q = detail::disk_pieces[i].centre;
        const D at = q.x * a + q.y * b + D(q.x * q.y * 0.02, 0.5 * q.x * q.x * 0.3, 0);
        CHECK(length(result.all[i].position - (D(0.3, -0.2, 0) + at - mean)) < 1e-15);
        CHECK(length(result.all[i].d_position[0] - (a + D(q.y * 0.02, q.x * 0.3, 0))) < 1e-15); // 2 · 1/2 of a half
        CHECK(length(result.all[i].d_position[1] - (b + D(q.x * 0.02, 0, 0))) < 1e-15);
    }
}

TEST_CASE("curved footprints: footprints that hardly bend stay whole") {
    const Whole flat = deposit_of({0.4, 0, 0}, {0, 0.05, 0});
    const auto pieces_for = [&](double bend, double least) {
        return curved(flat, SecondDerivatives{Double3{0, bend, 0}, {}, {}}, {{}, least}, 0.125).count;
    };
    CHECK(pieces_for(0.024, 0.5) == 1); // of 0.05, the minor radius
    CHECK(pieces_for(0.026, 0.5) == 7);
    CHECK(pieces_for(0.024, 0) == 7);
    CHECK(pieces_for(1e6, std::numeric_limits<double>::infinity()) == 1);
    CHECK(pieces_for(std::numeric_limits<double>::quiet_NaN(), 0.5) == 1);
    CHECK(pieces_for(std::numeric_limits<double>::infinity(), 0.5) == 1);
    const auto whole = curved(flat, {}, {}, 0.125);
    CHECK(whole.all[0].position == flat.position);
    CHECK(whole.all[0].flux == flat.flux);
}

TEST_CASE("curved footprints: a pass loses no flux and counts each photon once") {
    const auto flat = picture_of(SecondOrder{}, 5000), bent = picture_of(CurvedFootprints{}, 5000);
    CHECK(std::abs(bent.account.accounted_flux() - bent.account.emitted.flux) <= 1e-12 * bent.account.emitted.flux);
    std::uint64_t photons = 0;
    for (const Tally& tally : bent.account.fates)
        photons += tally.photons;
    CHECK(photons == 5000);
    CHECK(bent.account.caustic_photons() == flat.account.caustic_photons());
    CHECK(bent.account.bounded_shifts == flat.account.bounded_shifts);
    CHECK(bent.irradiance != flat.irradiance);
    double light = 0, light_flat = 0;
    for (std::size_t i = 0; i < bent.irradiance.size(); ++i) {
        light += double(bent.irradiance[i]);
        light_flat += double(flat.irradiance[i]);
    }
    CHECK(light == doctest::Approx(light_flat).epsilon(0.02)); // moved, but for what crosses the film's border
}

TEST_CASE("curved footprints: on a straight map the picture is that of plain second order bit for bit") {
    const auto flat = picture_of(SecondOrder{}, 3000),
               whole = picture_of(CurvedFootprints{{}, std::numeric_limits<double>::infinity()}, 3000);
    CHECK(whole.irradiance == flat.irradiance);
    CHECK(whole.account.accounted_flux() == doctest::Approx(flat.account.accounted_flux()).epsilon(1e-15));
}

TEST_CASE("curved footprints: any number of threads renders the same picture bit for bit") {
    const auto serial = picture_of(CurvedFootprints{}, 4000);
    for (const unsigned threads : {2u, 5u})
        CHECK(picture_of(CurvedFootprints{}, 4000, ThreadExecutor(threads)).irradiance == serial.irradiance);
}

// A photon whose one piece lies off the map: what is seen and what is not add up to it.
TEST_CASE("curved footprints: pieces out of view are booked as unseen") {
    std::vector<tests::Vertex<D>> vertices;
    for (int i = 0; i < 100; ++i)
        vertices.push_back({D(0.1 * (i % 10), 0.1 * (i / 10), 0)});
    const EyePathMap<D> map(vertices, &tests::Vertex<D>::position, &tests::Vertex<D>::normal);
    auto sums = nephroid::sums<double>(map);
    const detail::Splatter splatter(sums, Published{});
    std::vector<Whole> pieces{deposit_of({0.05, 0, 0}, {0, 0.05, 0}), deposit_of({0.05, 0, 0}, {0, 0.05, 0})};
    pieces[0].position = D(50, 0, 0);
    pieces[1].position = D(0.5, 0.5, 0);
    detail::SplatChunk<D, double> chunk;
    Statistics account;
    splatter.prepare(std::span<const Whole>(pieces), chunk, account);
    CHECK(account[Fate::splatted].photons == 1);
    CHECK(account[Fate::splatted].flux == 3);
    CHECK(account[Fate::unseen].photons == 0);
    CHECK(account[Fate::unseen].flux == 3);
    splatter.prepare(std::span<const Whole>(pieces.data(), 1), chunk, account);
    CHECK(account[Fate::unseen].photons == 1);
    CHECK(account[Fate::unseen].flux == 6);
}

TEST_CASE("curved footprints: the message names the option that makes no sense") {
    const auto message = [](const CurvedFootprints& order) {
        try {
            (void)picture_of(order, 100);
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    CHECK(message({{}, -0.5}).find("least_bend is -0.5") != std::string::npos);
    CHECK(message({{}, std::numeric_limits<double>::quiet_NaN()}).find("least_bend is nan") != std::string::npos);
    CHECK(message({{.largest_shift = -1}, 0.5}).find("largest_shift is -1") != std::string::npos);
}

} // namespace nephroid::tests::curved_footprints_test
