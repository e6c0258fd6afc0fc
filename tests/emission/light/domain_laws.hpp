// SPDX-License-Identifier: MIT
/// @file  What a light's declared domain must be true of: the laws that tests hold each light to.
#pragma once

#include "emission/light/distance_to_kink.hpp"
#include "emission/light/light_laws.hpp"
#include "nephroid/emission/emit_at.hpp"
#include "nephroid/emission/light.hpp"
#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace nephroid::tests {

/// A ray's six numbers.
using RayNumbers = std::array<double, 6>;

template <class L>
[[nodiscard]] RayNumbers ray_at(const L& light, const std::array<double, coordinates_of<L>>& point) {
    using t = vector_traits<typename L::vector>;
    using T = scalar_t<typename L::vector>;
    const auto photon = emit_at(light, point, Spread<T>{1, 1});
    const auto &x = photon.position, &w = photon.direction;
    return {double(t::x(x)), double(t::y(x)), double(t::z(x)), double(t::x(w)), double(t::y(w)), double(t::z(w))};
}

/// The greatest difference of two rays' numbers.
[[nodiscard]] inline double apart(const RayNumbers& a, const RayNumbers& b) {
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = (std::max)(most, std::abs(a[i] - b[i]));
    return most;
}

/// How much slopes on both sides of a point differ, along one coordinate: |f(x + h) − 2 f(x) + f(x − h)| / h. Where
/// f is smooth it vanishes with h.
template <class L, class Point>
[[nodiscard]] double bend_at(const L& light, const Point& point, const Point& step, double h) {
    Point before = point, after = point;
    for (std::size_t i = 0; i < point.size(); ++i)
        before[i] -= h * step[i], after[i] += h * step[i];
    const RayNumbers a = ray_at(light, before), b = ray_at(light, point), c = ray_at(light, after);
    double most = 0;
    for (std::size_t i = 0; i < a.size(); ++i)
        most = (std::max)(most, std::abs(a[i] - 2 * b[i] + c[i]) / h);
    return most;
}

/// Checks a declaration against its light, in double precision.
///
/// @param light  whose rays change by about 1 over its domain, world units
template <class L>
void check_domain(const L& light) {
    constexpr std::size_t n = coordinates_of<L>;
    static_assert(n == 2 || n == 4);
    using Point = std::array<double, n>;
    const EmissionDomain domain = domain_of(light);
    CHECK(domain.coordinates == L::domain.coordinates);
    CHECK(domain.extras == L::domain.extras);
    const RandomSequence random(21);
    const auto point_of = [&](std::uint64_t i) {
        Point point;
        for (std::size_t d = 0; d < n; ++d)
            point[d] = 0.02 + 0.96 * random.sample<double>(i, std::uint32_t(d));
        return point;
    };

    // The ray is a function of the coordinates: of each of them, and of nothing else, bit for bit.
    std::array<bool, n> matters{};
    for (std::uint64_t i = 0; i < 50; ++i) {
        const Point point = point_of(i);
        std::vector<double> low(point.begin(), point.end()), high = low;
        low.resize(12, 0.125), high.resize(12, 0.875);
        GivenSamples first(low), second(high);
        const auto a = light.emit(first, Spread<double>{1, 1}), b = light.emit(second, Spread<double>{1, 1});
        CHECK(first.drawn() == n + domain.extra_count());
        CHECK(length(typename L::vector(a.position - b.position)) == 0);
        CHECK(length(typename L::vector(a.direction - b.direction)) == 0);
        for (std::size_t d = 0; d < n; ++d) {
            Point other = point;
            other[d] = 1 - 0.7 * other[d];
            matters[d] = matters[d] || apart(ray_at(light, point), ray_at(light, other)) > 1e-3;
        }
    }
    for (const bool it : matters)
        CHECK(it);

    // Smooth away from kinks: the change of slope vanishes with the step. A step of 1e-4 leaves h f'', where second
    // derivatives stay below a few hundred as far from the borders and from the middle, where kinks meet.
    constexpr double h = 1e-4;
    for (std::uint64_t i = 0; i < 400; ++i) {
        const Point point = point_of(i);
        bool is_smooth = true;
        for (std::size_t pair = 0; pair < n / 2; ++pair) {
            const double u = point[2 * pair], v = point[2 * pair + 1];
            is_smooth = is_smooth && distance_to_kink(domain.kinks[pair], u, v) > 4 * h;
            is_smooth = is_smooth && std::hypot(u - 0.5, v - 0.5) > 0.05;
        }
        if (!is_smooth)
            continue;
        for (std::size_t d = 0; d < n; ++d) {
            Point step{};
            step[d] = 1;
            CAPTURE(d);
            CAPTURE(i);
            CHECK(bend_at(light, point, step, h) < 0.05);
        }
    }

    // And kinks are where they are declared: some line of them has a jump in the slope across it.
    for (std::size_t pair = 0; pair < n / 2; ++pair) {
        if (domain.kinks[pair] == Kinks::nowhere || domain.kinks[pair] == Kinks::unknown)
            continue;
        double sharpest = 0;
        for (std::uint64_t i = 0; i < 100; ++i) {
            Point point = point_of(i), step{};
            const double along = point[2 * pair];
            point[2 * pair] = point[2 * pair + 1] = along;
            step[2 * pair] = 1;
            CHECK(distance_to_kink(domain.kinks[pair], point[2 * pair], point[2 * pair + 1]) < 1e-12);
            sharpest = (std::max)(sharpest, bend_at(light, point, step, h));
        }
        CHECK(sharpest > 0.1);
    }

    // Edges that are no borders: what meets there is the same ray.
    for (std::uint64_t i = 0; i < 50; ++i)
        for (std::size_t d = 0; d < n; ++d) {
            Point at = point_of(i), there = at;
            const std::size_t partner = d ^ 1u;
            if (domain.edges[d] == DomainEdge::repeats) {
                at[d] = 0, there[d] = 1;
                CHECK(apart(ray_at(light, at), ray_at(light, there)) < 1e-7);
            } else if (domain.edges[d] == DomainEdge::closes) {
                for (const double side : {0.0, 1.0}) {
                    at[d] = side, there[d] = 1;
                    there[partner] = 0.3 * at[partner];
                    CHECK(apart(ray_at(light, at), ray_at(light, there)) < 1e-7);
                }
            } else {
                at[d] = 0, there[d] = 1;
                CHECK(apart(ray_at(light, at), ray_at(light, there)) > 1e-3);
            }
        }
}

} // namespace nephroid::tests
