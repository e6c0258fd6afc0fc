// SPDX-License-Identifier: MIT
#include "nephroid/differential/reemission.hpp"

#include "nephroid/differential/transfer.hpp"
#include "nephroid/emission/spread.hpp"

#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>

namespace nephroid::tests::reemission_test {

using tests::Draws;
using tests::Space;
using tests::Wide;

namespace {

template <class V, std::size_t N>
Wide wide_area(const PhotonDifferential<V, N>& differential) {
    return tests::widen(differential[0].d_position).cross(tests::widen(differential[1].d_position)).length();
}

/// Of the footprint on its plane, as seen along a direction.
template <class V, std::size_t N>
Wide area_across(const PhotonDifferential<V, N>& differential, const V& direction) {
    const Wide volume = tests::widen(differential[0].d_position)
                            .cross(tests::widen(differential[1].d_position))
                            .dot(tests::widen(direction));
    return volume < Wide(0) ? -volume : volume;
}

template <class V, std::size_t N>
double area(const PhotonDifferential<V, N>& differential) {
    return static_cast<double>(wide_area(differential));
}

template <class V>
PhotonDifferential<V, 2> drawn(Draws& draw) {
    const auto vector = [&] { return tests::narrow<V>(draw.in_cube()); };
    const V a = vector(), b = vector(), c = vector(), d = vector();
    return {Tangent<V>{a, b}, Tangent<V>{c, d}};
}

// In halves u of epsilon: the cross product's components 4 u, the product with the direction 4 u more of the whole
// area; quotient 1; the frame's vectors are off by up to 16 epsilon = 32 u (frame_test.cpp), two products each: 2 (4 +
// 1 + 32 + 2) u for the area of two. < 40 epsilon of the area on the surface, of which a grazing direction sees little.
TEST_CASE_TEMPLATE("reemit: the footprint keeps its area on the surface at the bounce", T, float, double, Wide) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(71);
        for (int i = 0; i < 100; ++i) {
            const PhotonDifferential<V, 2> arrived = drawn<V>(draw);
            const V direction = tests::narrow<V>(draw.direction());
            const T length = T(draw.in(0.01, 1));
            const PhotonDifferential<V, 2> sent = reemit(arrived, direction, length);
            const double tolerance = 40 * double(std::numeric_limits<T>::epsilon());
            const double across = double(area_across(arrived, direction));
            CHECK(std::abs(double(wide_area(sent)) - across) <= tolerance * area(arrived));

            // The tangents are |dω| long, across the ray and each other, and positions are the virtual flight along
            // them.
            const Space d_u = tests::widen(sent[0].d_direction), d_v = tests::widen(sent[1].d_direction);
            const double l = double(length), flown = std::sqrt(area(sent)) / l; // in double only: 2 of its epsilons
            CHECK(std::abs(double(d_u.length() - Wide(length))) <= tolerance * l);
            CHECK(std::abs(double(d_v.length() - Wide(length))) <= tolerance * l);
            CHECK(std::abs(double(d_u.dot(d_v))) <= tolerance * l * l);
            CHECK(tests::distance(direction, (Wide(1) / square(Wide(length))) * d_u.cross(d_v)) <= tolerance);
            CHECK(tests::distance(sent[0].d_position, Wide(flown) * d_u) <= (tolerance + 1e-15) * flown * l);
            CHECK(tests::distance(sent[1].d_position, Wide(flown) * d_v) <= (tolerance + 1e-15) * flown * l);
        }
    });
}

// From a virtual point at distance v, the footprint at v + t: ((v + t) / v)² times the area, across the ray.
// The bound above, and that of transfer (8 epsilon per length), doubled for an area.
TEST_CASE_TEMPLATE("reemit: the footprint then grows as if it had flown the virtual distance already", T, float,
                   double) {
    tests::for_each_vector<T>([]<class V>() {
        Draws draw(72);
        for (int i = 0; i < 50; ++i) {
            const PhotonDifferential<V, 2> arrived = drawn<V>(draw);
            const V direction = tests::narrow<V>(draw.direction());
            const T length = T(0.25), distance = T(3);
            const PhotonDifferential<V, 2> sent = reemit(arrived, direction, length);
            const auto flight = transfer(direction, distance, direction);
            REQUIRE(flight.has_value());
            const PhotonDifferential<V, 2> hit{(*flight)(sent[0]), (*flight)(sent[1])};
            const double across = double(area_across(arrived, direction));
            const double flown = std::sqrt(across) / 0.25, expected = square((flown + 3) * 0.25);
            CHECK(std::abs(area(hit) - expected) <=
                  (40 * area(arrived) / across + 4 * 10) * double(std::numeric_limits<T>::epsilon()) * expected);
        }
    });
}

// A diffuse bounce of N photons has the density cos/π; where the photon came from a collimated beam, with no spread of
// directions, its footprint on a facing wall at a great distance t is the part t² π/(N cos) of the hemisphere.
TEST_CASE("reemit: with the bounce's own density light that came as a beam spreads") {
    using V = foreign::Plain<double>;
    const double photons = 1e4, smoothing = 1, cosine = 0.6, far = 1e6;
    const V zero{0, 0, 0}, direction{0.8, 0, cosine};
    const PhotonDifferential<V, 2> beam{Tangent<V>{{1e-2, 0, 0}, zero}, Tangent<V>{{0, 1e-2, 0}, zero}};
    const double l = Spread<double>{photons, smoothing}.length(pi<double> / cosine);
    const PhotonDifferential<V, 2> sent = reemit(beam, direction, l);
    const auto flight = transfer(direction, far, direction);
    REQUIRE(flight.has_value());
    const double ellipse = pi<double> / 4 * area(PhotonDifferential<V, 2>{(*flight)(sent[0]), (*flight)(sent[1])});
    CHECK(ellipse == doctest::Approx(far * far * pi<double> / (photons * cosine)).epsilon(1e-5));
    CHECK(double(area_across(sent, direction)) == doctest::Approx(cosine * 1e-4).epsilon(1e-12));
}

TEST_CASE_TEMPLATE("reemit: a footprint without area starts again as a point", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const V dx = make_vector<V>(1, 2, 3), zero = zero_vector<V>();
        const PhotonDifferential<V, 2> line{Tangent<V>{dx, zero}, Tangent<V>{dx, zero}};
        const PhotonDifferential<V, 2> sent = reemit(line, make_vector<V>(0, 1, 0), T(0.1));
        CHECK(area(sent) == 0);
        CHECK(tests::magnitude(tests::widen(sent[0].d_position)) == 0);
        CHECK(std::abs(tests::magnitude(tests::widen(sent[0].d_direction)) - double(T(0.1))) <=
              double(std::numeric_limits<T>::epsilon()));
    });
}

TEST_CASE_TEMPLATE("reemit: only the first two of more tangents span the footprint", T, float, double) {
    using V = foreign::Plain<T>;
    const Tangent<V> u{{2, 0, 0}, {}}, v{{0, 3, 0}, {}}, wavelength{{100, 100, 100}, {7, 7, 7}};
    const PhotonDifferential<V, 3> three{u, v, wavelength};
    const PhotonDifferential<V, 2> two{u, v};
    const auto a = reemit(three, V{0, 0, 1}, T(0.5)), b = reemit(two, V{0, 0, 1}, T(0.5));
    CHECK(tests::distance(a[0].d_position, tests::widen(b[0].d_position)) == 0);
    CHECK(tests::distance(a[1].d_position, tests::widen(b[1].d_position)) == 0);
}

} // namespace

} // namespace nephroid::tests::reemission_test
