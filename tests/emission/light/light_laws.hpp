// SPDX-License-Identifier: MIT
/// @file  What holds for every light, and what the tests of lights compare their fluxes with.
#pragma once

#include "emission/statistics.hpp"
#include "nephroid/differential/transfer.hpp"
#include "nephroid/emission/light.hpp"
#include "nephroid/emission/target.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <limits>
#include <utility>
#include <vector>

namespace nephroid::tests {

/// Samples that are given, and how many of them were drawn; zeros beyond them.
class GivenSamples {
public:
    explicit GivenSamples(std::vector<double> samples) : samples_(std::move(samples)) {}

    template <class T>
    [[nodiscard]] T next() {
        return drawn_ < samples_.size() ? static_cast<T>(samples_[drawn_++]) : (++drawn_, T(0));
    }
    [[nodiscard]] std::size_t drawn() const { return drawn_; }

private:
    std::vector<double> samples_;
    std::size_t drawn_ = 0;
};

/// The photon with number i of n, from independent samples.
template <Light L>
[[nodiscard]] auto photon_of(const L& light, std::uint64_t i, double n, double smoothing = 1) {
    using T = scalar_t<typename L::vector>;
    const RandomSequence random(11);
    Sampler samples(random, i);
    return light.emit(samples, Spread<T>{T(n), T(smoothing)});
}

/// The light's flux, or what of it meets a sphere, from n photons, with its standard error.
template <Light L>
[[nodiscard]] Mean flux_of(const L& light, std::uint64_t n,
                           const BoundingSphere<typename L::vector>* sphere = nullptr) {
    Mean mean;
    for (std::uint64_t i = 0; i < n; ++i) {
        const auto photon = photon_of(light, i, 1); // as the only one: it stands for all of the flux
        bool counts = true;
        if (sphere != nullptr) {
            const typename L::vector towards = sphere->centre - photon.position;
            counts = length(cross(photon.direction, towards)) < sphere->radius && dot(photon.direction, towards) > 0;
        }
        mean.add(counts ? flux_traits<typename L::flux_type>::power(photon.flux) : 0.0);
    }
    return mean;
}

/// The same value to five standard errors (one failure in 1.7 million) and the roundings of some ten operations.
template <class T>
void check_same(const Mean& measured, double expected, double expected_error = 0) {
    const double error = std::hypot(measured.error(), expected_error);
    CAPTURE(measured.value());
    CAPTURE(expected);
    CAPTURE(error);
    CHECK(std::abs(measured.value() - expected) <=
          5 * error + 32 * double(std::numeric_limits<T>::epsilon()) * expected);
}

/// The laws that tests/emission/light/*_test.cpp hold each light to.
///
/// @param draws  how many samples a photon takes
template <Light L>
void check_light_laws(const L& light, std::size_t draws) {
    using V = typename L::vector;
    using T = scalar_t<V>;
    using Power = flux_traits<typename L::flux_type>;
    constexpr T epsilon = std::numeric_limits<T>::epsilon();
    CHECK(light.power() > 0);

    const auto check = [&](const std::vector<double>& values) {
        GivenSamples samples(values), again(values), scaled(values);
        const auto photon = light.emit(samples, Spread<T>{1000, 2});
        CHECK(samples.drawn() == draws);
        if constexpr (coordinates_of<L> != 0)
            CHECK(samples.drawn() == L::domain.coordinates + L::domain.extra_count());

        CHECK(all_finite(photon.position));
        CHECK(std::abs(length(photon.direction) - 1) <= 16 * epsilon);
        CHECK(std::isfinite(Power::power(photon.flux)));
        CHECK(Power::power(photon.flux) >= 0);
        const auto& [u, v] = photon.differential;
        const T dx = length(u.d_position), dw = length(u.d_direction);
        CHECK(std::isfinite(dx));
        CHECK(std::isfinite(dw));
        CHECK(dx + dw > 0);
        CHECK(std::abs(length(v.d_position) - dx) <= 64 * epsilon * dx);
        CHECK(std::abs(length(v.d_direction) - dw) <= 64 * epsilon * dw);
        CHECK(std::abs(dot(u.d_position, v.d_position)) <= 64 * epsilon * dx * dx);
        CHECK(std::abs(dot(u.d_direction, v.d_direction)) <= 64 * epsilon * dw * dw);
        CHECK(std::abs(dot(u.d_direction, photon.direction)) <= 64 * epsilon * dw);
        CHECK(std::abs(dot(v.d_direction, photon.direction)) <= 64 * epsilon * dw);

        // The same samples make the same photon, bit for bit.
        const auto same = light.emit(again, Spread<T>{1000, 2});
        CHECK(length(V(same.position - photon.position)) == 0);
        CHECK(length(V(same.direction - photon.direction)) == 0);
        CHECK(Power::power(same.flux) == Power::power(photon.flux));
        CHECK(length(V(same.differential[0].d_direction - u.d_direction)) == 0);
        CHECK(length(V(same.differential[1].d_position - v.d_position)) == 0);

        // Four times the photons: a quarter of the flux and half of the length, and all of it at double smoothing.
        const auto finer = light.emit(scaled, Spread<T>{4000, 4});
        CHECK(std::abs(4 * Power::power(finer.flux) - Power::power(photon.flux)) <=
              8 * epsilon * Power::power(photon.flux));
        CHECK(std::abs(length(finer.differential[0].d_position) - dx) <= 8 * epsilon * dx);
        CHECK(std::abs(length(finer.differential[1].d_direction) - dw) <= 8 * epsilon * dw);
    };

    const double last = 1 - double(epsilon) / 2; // below 1, as every sample is
    for (const double a : {0.0, 0.5, last}) {
        for (const double b : {0.0, 0.5, last}) {
            check({a, b, a, b, b});
            check({a, b, b, a, b});
            check({a, a, b, b, a});
        }
    }
    const RandomSequence random(12);
    for (std::uint64_t i = 0; i < 200; ++i) {
        std::vector<double> values;
        for (std::uint32_t d = 0; d < 5; ++d)
            values.push_back(random.sample<double>(i, d));
        check(values);
    }
}

/// Frisvad et al. 2014, Appendix A: at the first surface the extent's and the direction's parts of a tangent are
/// parallel and point the same way, for every photon above the horizon.
template <Light L>
void check_aligned(const L& light) {
    using V = typename L::vector;
    using T = scalar_t<V>;
    constexpr T epsilon = std::numeric_limits<T>::epsilon();
    for (std::uint64_t i = 0; i < 500; ++i) {
        const auto photon = photon_of(light, i, 1000);
        if (!(flux_traits<typename L::flux_type>::power(photon.flux) > 0))
            continue;
        const V plane = normalize(V(photon.direction + T(0.5) * frame_about(photon.direction).u));
        const auto flight = transfer(photon.direction, T(3), plane);
        REQUIRE(flight.has_value());
        const auto& [u, v] = photon.differential;
        const V normal = normalize(cross(u.d_position, v.d_position));
        const T sine = length(cross(normal, photon.direction));
        const T cosine = std::abs(dot(normal, photon.direction));
        // The basis turns by epsilon / sine, a few times; a source seen at a small angle shrinks v by the cosine.
        const T angle = 64 * epsilon / (sine * cosine);
        for (const auto& tangent : {u, v}) {
            const V extent = (*flight)({tangent.d_position, zero_vector<V>()}).d_position;
            const V direction = (*flight)({zero_vector<V>(), tangent.d_direction}).d_position;
            CHECK(length(cross(extent, direction)) <= angle * length(extent) * length(direction));
            if (angle < T(0.1))
                CHECK(dot(extent, direction) > 0);
        }
    }
}

/// ∫ max(0, cos) over the directions from a point to a sphere, by a midpoint rule in spherical coordinates about the
/// sphere's centre: a derivation that shares nothing with the library's. In double; n² directions.
template <Vector3 V>
[[nodiscard]] double projected_solid_angle(const BoundingSphere<V>& sphere, const V& position, const V& normal, int n) {
    const V towards = sphere.centre - position;
    const double distance = length(towards), angle = std::asin(sphere.radius / distance);
    const V axis = 1 / distance * towards;
    const V side = normalize(cross(axis, std::abs(axis.x) < 0.5 ? V(1, 0, 0) : V(0, 1, 0))), up = cross(side, axis);
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const double theta = (i + 0.5) / n * angle;
        for (int j = 0; j < n; ++j) {
            const double phi = 2 * pi<double> * (j + 0.5) / n;
            const V direction = std::cos(theta) * axis + std::sin(theta) * (std::cos(phi) * side + std::sin(phi) * up);
            sum += (std::max)(0.0, dot(direction, normal)) * std::sin(theta);
        }
    }
    return sum * (angle / n) * (2 * pi<double> / n);
}

/// An area light's flux into a target: radiance ∫∫ cos dω dA by midpoint rules; `point(a, b)` with a, b in (0, 1)
/// gives position, normal and area element. The last of two refinements, and as its error three times the change: a
/// midpoint rule's error falls by four where the integrand is smooth and by two or more at the horizon's kink.
struct Integral {
    double value;
    double error;
};

template <class Point>
[[nodiscard]] Integral flux_into(const BoundingSphere<glm::dvec3>& sphere, double radiance, const Point& point) {
    const auto midpoint = [&](int n) {
        double sum = 0;
        for (int i = 0; i < n; ++i) {
            for (int j = 0; j < n; ++j) {
                const auto [position, normal, area] = point((i + 0.5) / n, (j + 0.5) / n);
                sum += projected_solid_angle(sphere, position, normal, n) * area;
            }
        }
        return radiance * sum / (n * n);
    };
    const double coarse = midpoint(16), fine = midpoint(32);
    return {fine, 3 * std::abs(fine - coarse)};
}

/// Where a test's area element is.
struct SurfacePoint {
    glm::dvec3 position;
    glm::dvec3 normal;
    double area; ///< per unit of a and b
};

} // namespace nephroid::tests
