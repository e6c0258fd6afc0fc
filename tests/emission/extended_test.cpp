// SPDX-License-Identifier: MIT
#include "nephroid/emission/extended.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/spectrum/spectral.hpp"
#include "nephroid/sequence/halton.hpp"
#include "support/glass_ball.hpp"
#include "transport/follow.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::extended_test {

namespace {

using V = glm::dvec3;
using Beam = DirectionalLight<V, double>;
using Ball = GlassBall<V, double>;
constexpr int rows = 48;

struct Receiver {
    Floor<V> vertices = floor_of<V>(rows, 0.9);
    EyePathMap<V> map = map_of(vertices);
};

/// Sunlight over the ball, from a direction near the vertical; of irradiance 1 across itself.
Beam beam(const V& direction) {
    return Beam({.direction = direction, .irradiance = 1, .patch = BoundingSphere<V>{{0, 0, 1.6}, 0.9}});
}

template <class L, class... Arguments>
std::vector<double> picture(const Receiver& receiver, const L& light, const PhotonPass& pass,
                            const Arguments&... arguments) {
    auto sums = nephroid::sums<double>(receiver.map);
    check_balance(caustics(Ball{.height = 1.6, .tint = 1}, light, sums, pass, arguments...));
    std::vector<double> pixels(receiver.vertices.size());
    sums.for_each([&](std::size_t i, double e) { pixels[i] = e; });
    return pixels;
}

double relative_error(const std::vector<double>& a, const std::vector<double>& b) {
    double squares = 0, sum = 0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        squares += square(a[i] - b[i]);
        sum += b[i];
    }
    return std::sqrt(squares / double(a.size())) / (sum / double(a.size()));
}

const V down = normalize(V(0.15, 0, -1));

/// The mean of collimated pictures over n × n points of a disk in the sky.
std::vector<double> disk_of(const Receiver& receiver, double angular_radius, int n, std::uint64_t photons) {
    const auto [u, v] = frame_about(down);
    std::vector<double> mean(receiver.vertices.size());
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const DiskPoint<double> at = concentric_disk((i + 0.5) / n, (j + 0.5) / n);
            const V direction = normalize(V(down + angular_radius * (at.x * u + at.y * v)));
            const auto one = picture(receiver, beam(direction), {.count = photons});
            for (std::size_t k = 0; k < mean.size(); ++k)
                mean[k] += one[k] / double(n * n);
        }
    return mean;
}

} // namespace

static_assert(Light<Extended<Beam>>);
static_assert(tangent_kinds<4, DirectionExtent>[1] == TangentKind::footprint);
static_assert(tangent_kinds<4, DirectionExtent>[2] == TangentKind::extent);

// The mean of 8 × 8 suns is a disk whose variance is 4% less than the whole disk's in the worst case, and 1% on
// average.
TEST_CASE("extended: the picture is the mean of those of all points of the disk") {
    const Receiver receiver;
    const double radius = 0.06;
    const auto exact = disk_of(receiver, radius, 8, 1200);
    const Extended sun(beam(down), {.angular_radius = radius, .pivot = {0, 0, 1.6}});
    const double point = relative_error(picture(receiver, beam(down), {.count = 4000}), exact);
    const double second = relative_error(picture(receiver, sun, {.count = 4000}), exact);
    const double first = relative_error(picture(receiver, sun, {.count = 4000, .smoothing = 6}, Published{}), exact);
    CAPTURE(point);
    CHECK(second < 0.15 * point);
    CHECK(first < 0.15 * point);
}

// Central differences of the direction by h = 10⁻⁵ are exact to 10⁻¹⁰ of the map's third derivatives.
TEST_CASE("extended: a tangent is the derivative of where a photon lands by its direction") {
    const Ball ball{.height = 1.6, .tint = 1};
    const V pivot{0.1, 0, 2};
    const Extended sun(beam(down), {.angular_radius = 0.05, .pivot = pivot});
    const HaltonSequence halton;
    for (std::uint64_t i = 0; i < 20; ++i) {
        Sampler sampler(halton, i);
        const auto photon = sun.emit(sampler, {100, 1});
        Statistics account;
        Constant constant;
        const auto deposit = walk(ball, photon, constant, {}, account);
        REQUIRE(deposit);
        // Where the photon crosses the plane of the pivot, its other directions do too.
        const V crossing = photon.position + dot(V(pivot - photon.position), photon.direction) * photon.direction;
        for (std::size_t t = 2; t < 4; ++t) {
            const double h = 1e-5;
            std::array<V, 2> places{};
            for (std::size_t side = 0; side < 2; ++side) {
                const V turned = photon.direction + (side == 0 ? -h : h) * photon.differential[t].d_direction;
                Photon<V, double> other = collimated<double>(V(crossing - 3. * normalize(turned)), turned);
                const auto there = walk(ball, other, constant, {}, account);
                REQUIRE(there);
                places[side] = there->position;
            }
            const V expected = (0.5 / h) * (places[1] - places[0]);
            check_close(deposit->d_position[t], expected, 1e-6 * (length(expected) + 0.1));
        }
    }
}

TEST_CASE("extended: second order leaves the extent as it is and a disk without size changes nothing") {
    const Receiver receiver;
    const Extended none(beam(down), {.angular_radius = 0, .pivot = {0, 0, 1.6}});
    const auto plain = picture(receiver, beam(down), {.count = 2000});
    // The ellipse of four tangents is computed in another way.
    CHECK(relative_error(picture(receiver, none, {.count = 2000}), plain) < 1e-9);
    // Twenty times as many photons have much smaller footprints, and the same sun.
    const Extended sun(beam(down), {.angular_radius = 0.06, .pivot = {0, 0, 1.6}});
    const auto few = picture(receiver, sun, {.count = 3000}), many = picture(receiver, sun, {.count = 60000});
    CHECK(relative_error(few, many) < 0.1);
}

TEST_CASE("extended: a sun of several wavelengths keeps both kinds of tangents") {
    using Six = Bands<double, 6>;
    const DirectionalLight<V, Six> coloured(
        {.direction = down, .irradiance = Six(1), .patch = BoundingSphere<V>{{0, 0, 1.6}, 0.9}});
    const Spectral sun(Extended(coloured, {.angular_radius = 0.05, .pivot = {0, 0, 1.6}}), EqualBands<6>{});
    using P = detail::parameters_t<Spectral<Extended<DirectionalLight<V, Six>>, EqualBands<6>>>;
    static_assert(tangent_kinds<5, P>[1] == TangentKind::footprint && tangent_kinds<5, P>[3] == TangentKind::extent &&
                  tangent_kinds<5, P>[4] == TangentKind::wavelength);
    const HaltonSequence halton;
    Sampler sampler(halton, 3);
    const auto photon = sun.emit(sampler, {100, 1});
    CHECK(length(photon.differential[2].d_direction) == doctest::Approx(0.05 * std::sqrt(8.0)));
    CHECK(length(photon.differential[4].d_direction) == 0);
}

TEST_CASE("extended: it is refused without a size, a pivot or a kernel that can be") {
    const auto refuses = [](const DiskInSky<V>& options, const char* name) {
        CHECK_THROWS_WITH_AS(Extended(beam(down), options), doctest::Contains(name), std::invalid_argument);
    };
    const double nan = std::numeric_limits<double>::quiet_NaN();
    refuses({.angular_radius = -0.1, .pivot = V(0)}, "angular_radius");
    refuses({.angular_radius = 0.3, .pivot = V(0)}, "angular_radius");
    refuses({.angular_radius = nan, .pivot = V(0)}, "angular_radius");
    refuses({.angular_radius = 0.01, .pivot = V(nan)}, "pivot");
    refuses({.angular_radius = 0.01, .pivot = V(0), .second_moment = 0}, "second_moment");
}

} // namespace nephroid::tests::extended_test
