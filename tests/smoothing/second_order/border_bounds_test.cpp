// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/second_order/border_bounds.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/warp.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/transport/scene.hpp"
#include "nephroid/vector/glm.hpp"

#include "smoothing/second_order/fields.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <vector>

namespace nephroid::tests::border_bounds_test {

using namespace fields;

using namespace nephroid::detail;

TEST_CASE("border bounds: footprints reach to the border of the domain and no further") {
    const Field field = field_of(affine);
    const double s2 = straight_radius2(), width = side * step;
    for (const double u : {0.001, 0.02, 0.1, 0.32, 0.5, 0.9, 0.999})
        for (const double v : {0.01, 0.4, 0.5, 0.97}) {
            CAPTURE(u);
            CAPTURE(v);
            const auto here = at(field, affine, u, v);
            REQUIRE(here);
            const Symmetric2 expected{between(s2, u * width, width), 0, between(s2, v * width, width)};
            check_close(here->shape, expected, 1e-9 * s2);
            CHECK(std::sqrt(here->shape.xx) <= (std::max)(2.0, (std::min)(u, 1 - u) * width));
        }
}

// Within a cell, a 21st of the square's side, the map onto the disk turns by (π/4) (2/21) = 0.075 at most, and so may
// the distance to the rim be off by that share: 0.15 of its square. Along the diagonals the map has kinks.
TEST_CASE("border bounds: a disk bounds footprints by the distance to its rim, at the corners of the square too") {
    const auto on_disk = [](const std::array<double, 2>& sample) {
        const DiskPoint<double> at = concentric_disk(sample[0], sample[1]);
        const double tangent = 2 * unit_of(all, pi<double>);
        const glm::dvec3 zero(0), place(at.x, at.y, 1);
        const Photon<glm::dvec3, double> emitted{
            place, {0, 0, -1}, 1 / all, {Tangent<glm::dvec3>{{tangent, 0, 0}, zero}, {{0, tangent, 0}, zero}}};
        const Deposit<glm::dvec3, double, 2> landed{
            {at.x, at.y, 0}, {0, 0, 1}, {0, 0, -1}, emitted.flux, {{{tangent, 0, 0}, {0, tangent, 0}}}};
        return MapPhoton{{sample, 0, 2}, EmissionFrame(emitted), 1, landed};
    };
    std::vector<MapPhoton> photons;
    for (const auto& sample : lattice(std::size_t(side), std::size_t(side)))
        photons.push_back(on_disk(sample));
    const Field field = field_of(photons, stratified());
    const double s2 = straight_radius2();
    for (const double radius : {0.75, 0.85, 0.92})
        for (int i = 0; i < 64; ++i) {
            // A point of the square that is mapped to this radius, next to a corner for every eighth one.
            const double around = (i % 16 - 7.5) / 8 * 0.999;
            const double a = (i & 16 ? 1 : -1) * radius, b = around * radius;
            const std::array<double, 2> sample{0.5 + 0.5 * (i & 32 ? a : b), 0.5 + 0.5 * (i & 32 ? b : a)};
            const DiskPoint<double> place = concentric_disk(sample[0], sample[1]);
            CAPTURE(place.x);
            CAPTURE(place.y);
            const MapPhoton photon = on_disk(sample);
            const auto here = field.at(photon.sample.at, photon.frame, photon.signature);
            REQUIRE(here);
            const Plane2 outwards{place.x / radius, place.y / radius};
            const double expected = narrowed(s2, (1 - radius) * std::sqrt(all));
            CHECK(inner(outwards, here->shape(outwards)) == doctest::Approx(expected).epsilon(0.15));
        }
}

// A kernel with twice the second moment reaches as far with half of S, up to borders too.
TEST_CASE("border bounds: a wider kernel gets smaller footprints at a border") {
    FieldOptions wide = stratified();
    wide.scale = 0.5;
    const Field biweight = field_of(affine), other = field_of(affine, wide);
    for (const double u : {0.02, 0.35}) {
        const auto narrow = at(biweight, affine, u, 0.4), half = at(other, affine, u, 0.4);
        REQUIRE((narrow && half));
        check_close(half->shape, 0.5 * narrow->shape, 1e-12 * narrow->shape.trace());
    }
}

TEST_CASE("border bounds: a repeating domain has no borders") {
    FieldOptions options = stratified();
    options.repeats = true;
    const Field field = field_of(affine, options);
    const double s2 = straight_radius2();
    for (const double u : {0.0, 0.01, 0.4, 0.999})
        for (const double v : {0.001, 0.5, 0.98}) {
            const auto here = at(field, affine, u, v);
            REQUIRE(here);
            check_close(here->shape, Symmetric2::isotropic(s2), 1e-9 * s2);
            CHECK(std::abs(here->divergence.x) + std::abs(here->divergence.y) <= 1e-9 * s2);
        }
}

// 240 × 30 photons over 8 × 1, 53 units from side to side.
TEST_CASE("border bounds: a long domain bounds footprints by the distance to its borders") {
    constexpr double extent = 8, photons = 240 * 30;
    const Field field =
        field_of(photons_of(affine, lattice(240, 30), 0, extent), {.stratified = true, .photons = photons});
    const double s2 = straight_radius2(photons), width = 30 * step;
    for (const double u : {0.002, 0.02, 0.5, 0.985})
        for (const double v : {0.05, 0.5, 0.8}) {
            const MapPhoton photon = photon_at(affine, {u, v}, photons, extent);
            const auto here = field.at(photon.sample.at, photon.frame, 1);
            REQUIRE(here);
            check_close(here->shape,
                        {between(s2, extent * u * width, extent * width), 0, between(s2, v * width, width)}, 1e-6 * s2);
        }
}

/// A mirror at y = 2 over a table at y = 1, turned by 20°, on a floor at y = 0. Table and floor are one surface, as if
/// only their material were told.
struct TurnedTable {
    using V = glm::dvec3;
    using Hit = SurfaceHit<V, Flat>;

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, double t_min, double t_max) const {
        const auto at_height = [&](double y, const V& normal, std::uint64_t surface) -> std::optional<Hit> {
            const double t = (y - o.y) / d.y;
            if (!(t > t_min && t < t_max))
                return std::nullopt;
            return Hit{t, o + t * d, normal, normal, Flat{}, rounding_error(o, t, o + t * d), surface};
        };
        if (d.y > 0)
            return at_height(2, {0, -1, 0}, 1);
        if (const auto table = at_height(1, {0, 1, 0}, 0); table && is_on_table(table->position))
            return table;
        return at_height(0, {0, 1, 0}, 0);
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const Hit& hit, const V&, Sampler&) const {
        return {hit.surface == 1 ? Event::reflect : Event::deposit, 1, 1};
    }
    [[nodiscard]] static bool is_on_table(const V& p) {
        const double c = std::cos(0.35), s = std::sin(0.35);
        return std::abs(c * p.x + s * p.z) < 0.5 && std::abs(c * p.z - s * p.x) < 0.5;
    }
};

/// The rms error of the light that falls straight down onto the table and what of the floor lies in the open, all of
/// which gets 1.
///
/// @param half  side of the square about the middle of the table, half of it
template <class Policies>
[[nodiscard]] double error_on_table_and_floor(double half, std::uint64_t photons, const Policies& policies) {
    using V = glm::dvec3;
    const DirectionalLight<V, double> light(
        {.direction = {0, 1, 0},
         .irradiance = 1,
         .patch = Parallelogram<V>{V(-2.3, 1.5, -2.1), V(4.5, 0, 0), V(0, 0, 4.5)}});
    std::vector<V> vertices;
    for (int i = 0; i < 60 * 60; ++i) {
        V p(half * ((i % 60 + 0.5) / 30 - 1), 0, half * ((i / 60 + 0.5) / 30 - 1));
        p.y = TurnedTable::is_on_table(p) ? 1 : 0;
        vertices.push_back(p);
    }
    const EyePathMap map(
        vertices, [](const V& p) { return p; }, [](const V&) { return V(0, 1, 0); });
    ThreadExecutor threads;
    auto sums = nephroid::sums<double>(map);
    caustics(TurnedTable{}, light, sums, {.count = photons}, policies, threads);
    double squares = 0;
    sums.for_each([&](std::size_t, double e) { squares += square(e - 1); });
    return std::sqrt(squares / double(vertices.size()));
}

// The table gets a twentieth of the light, and the pilot has a third of the photons. Footprints that reached as far as
// the borders that were found had an error of 0.036, where those of one size have 0.029.
TEST_CASE("border bounds: in the middle of a small group light is as even as with footprints of one size") {
    CHECK(error_on_table_and_floor(0.3, 200'000, Default{}) < error_on_table_and_floor(0.3, 200'000, Published{}));
}

// A border is then found to many units. Long footprints that turned with it had an error of 0.073, where those of one
// size have 0.072.
TEST_CASE("border bounds: a pilot of few photons makes light beside borders no worse than footprints of one size") {
    SecondOrder few;
    few.pilot = 8192;
    CHECK(error_on_table_and_floor(1, 200'000, Default{}.with_order(few)) <
          error_on_table_and_floor(1, 200'000, Published{}));
}

} // namespace nephroid::tests::border_bounds_test
