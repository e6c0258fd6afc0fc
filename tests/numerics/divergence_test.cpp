// SPDX-License-Identifier: MIT
/// @file  Tangents that outgrow their scalar are bounded and counted, and photons whose ray lies in a surface to
///        rounding end and are counted: there is never infinity or NaN.
#include "support/vertex.hpp"

#include "nephroid/splat/splat.hpp"
#include "nephroid/transport/walk.hpp"
#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace nephroid::tests::divergence_test {

namespace {

template <class T>
using Vec = glm::vec<3, T>;

struct NoChoice {
    template <class T>
    [[nodiscard]] T next() const {
        return T(0.5);
    }
};

/// Two mirror balls, one above the other and a unit apart, met along the line through their centres; after so many
/// reflections the lower one is diffuse.
template <class T>
struct TwoBalls {
    using Hit = SurfaceHit<Vec<T>, ShapeOperator<Vec<T>>>;

    T radius;
    unsigned reflections;
    mutable unsigned met = 0;

    std::optional<Hit> intersect(const Vec<T>& o, const Vec<T>& d, T, T) const {
        ++met;
        const T z = d.z < T(0) ? T(0) : T(1), up = d.z < T(0) ? T(1) : T(-1);
        const Vec<T> at(o.x, o.y, z), normal(0, 0, up);
        return Hit{abs(z - o.z), at, normal, normal, sphere_curvature<Vec<T>>(radius), rounding_error(o, T(1), at)};
    }
    Scattering<T, T> scatter(const Hit&, const Vec<T>&, auto&) const {
        return met > reflections ? Scattering<T, T>::deposit() : Scattering<T, T>::reflect(T(1));
    }
};

template <class T>
Photon<Vec<T>, T> downwards(T z) {
    using V = Vec<T>;
    return {V(0, 0, z), V(0, 0, -1), T(1), {Tangent<V>{V(T(1e-3), 0, 0), V(0)}, Tangent<V>{V(0, T(1e-3), 0), V(0)}}};
}

template <class T>
using Vertex = tests::Vertex<Vec<T>>;

/// A lattice on the floor.
template <class T>
std::vector<Vertex<T>> lattice() {
    std::vector<Vertex<T>> vertices;
    for (int i = 0; i < 16; ++i)
        for (int j = 0; j < 16; ++j)
            vertices.push_back({Vec<T>(T(i) / 16, T(j) / 16, 0), Vec<T>(0, 0, 1)});
    return vertices;
}

/// A pane of index 1, and behind it a floor.
template <class T>
struct PaneAndFloor {
    using Hit = SurfaceHit<Vec<T>, Flat>;

    mutable bool first = true;

    std::optional<Hit> intersect(const Vec<T>& o, const Vec<T>& d, T, T) const {
        const Vec<T> normal = first ? Vec<T>(-1, 0, 0) : Vec<T>(0, 0, 1);
        return Hit{T(1), o + d, normal, normal, {}, rounding_error(o, T(1), o), first ? 0u : 1u};
    }
    Scattering<T, T> scatter(const Hit& hit, const Vec<T>&, auto&) const {
        first = false;
        return hit.surface == 1 ? Scattering<T, T>::deposit() : Scattering<T, T>::refract(T(1), T(1));
    }
};

} // namespace

// Each reflection between balls of radius r a unit apart multiplies a footprint by about 4/r: after sixty by 1e36 for
// r = 4, by 1e216 for r = 1e-3, by 1e396 for r = 1e-6.
TEST_CASE_TEMPLATE("divergence: tangents between two small balls outgrow the scalar and the footprint is bounded", T,
                   float, double) {
    const auto vertices = lattice<T>();
    const EyePathMap map(vertices, &Vertex<T>::position, &Vertex<T>::normal);
    for (const T radius : {T(4), T(1), T(1e-1), T(1e-3), T(1e-6)})
        for (const unsigned reflections : {2u, 20u, 60u}) {
            CAPTURE(radius);
            CAPTURE(reflections);
            Statistics account;
            NoChoice sampler;
            const auto deposit =
                walk(TwoBalls<T>{radius, reflections}, downwards<T>(T(0.5)), sampler, WalkLimits{}, account);
            REQUIRE(deposit.has_value());
            for (const Vec<T>& d : deposit->d_position) {
                CHECK(all_finite(d));
                CHECK(abs(d.x) + abs(d.y) <= T(4) * detail::longest_tangent<T>);
            }
            const auto outcome = make_splat(*deposit, map, Published{});
            CHECK(outcome.fate == Fate::splatted);
            REQUIRE(outcome.splat.has_value());
            const double exact = 1e-3 * std::pow(2 / double(radius), double(reflections)); // at least
            if (exact > 10)
                CHECK(outcome.bounded);
            CHECK(all_finite(outcome.splat->row_a));
            CHECK(all_finite(outcome.splat->row_b));
            CHECK(std::isfinite(double(outcome.splat->peak)));
        }
}

// Two tangents that share a scale keep their ratio and their direction when they are scaled down.
TEST_CASE_TEMPLATE("divergence: a tangent within range is untouched and one beyond keeps its direction", T, float,
                   double) {
    using V = Vec<T>;
    const auto brought = [](Tangent<V> tangent) {
        detail::bring_into_range(tangent);
        return tangent;
    };
    const T longest = detail::longest_tangent<T>;
    CHECK(longest > T(1e15));
    CHECK(std::isfinite(longest * longest * T(1e6)));
    const Tangent<V> inside{V(longest, 0, -longest), V(1, 2, 3)};
    CHECK(brought(inside).d_position == inside.d_position);
    CHECK(brought(inside).d_direction == inside.d_direction);
    const Tangent<V> outside{V(0, T(-4) * longest, longest), V(longest, T(8), T(0))};
    CHECK(brought(outside).d_position == V(0, -longest, longest / T(4)));
    CHECK(brought(outside).d_direction == V(longest / T(4), T(2), T(0)));
    const Tangent<V> steep{V(1, 1, 1), V(0, 0, T(16) * longest)};
    CHECK(brought(steep).d_position == V(T(1) / T(16)));
}

// A ray may meet a plane at any small angle: the footprint grows like one over the cosine, until it overflows. Then the
// photon ends, and its flux counts as invalid.
TEST_CASE_TEMPLATE("divergence: a ray that lies in its surface ends in the account and one that nearly does is bounded",
                   T, float, double) {
    const auto vertices = lattice<T>();
    const EyePathMap map(vertices, &Vertex<T>::position, &Vertex<T>::normal);
    int bounded = 0, ended = 0;
    for (int power = 0; power <= 400; power += 4) {
        CAPTURE(power);
        const T rise = T(std::ldexp(1.0, -power));
        Statistics account;
        NoChoice sampler;
        const Vec<T> d = normalize(Vec<T>(1, 0, -rise)), up(-d.z, 0, d.x);
        const Photon<Vec<T>, T> photon{
            Vec<T>(0, 0, 1),
            d,
            T(1),
            {Tangent<Vec<T>>{T(1e-3) * up, up}, Tangent<Vec<T>>{Vec<T>(0, T(1e-3), 0), Vec<T>(0)}}};
        const auto deposit = walk(PaneAndFloor<T>(), photon, sampler, WalkLimits{}, account);
        if (!deposit) {
            CHECK(account[Fate::invalid].photons == 1);
            CHECK(account[Fate::invalid].flux == 1);
            CHECK(power > 36); // never where a footprint is useful
            ++ended;
            continue;
        }
        for (const Vec<T>& d_position : deposit->d_position)
            CHECK(all_finite(d_position));
        const auto outcome = make_splat(*deposit, map, Published{});
        CHECK(outcome.fate == Fate::splatted);
        REQUIRE(outcome.splat.has_value());
        CHECK(all_finite(outcome.splat->row_a));
        CHECK(all_finite(outcome.splat->row_b));
        bounded += outcome.bounded;
    }
    CHECK(bounded > 0);
    CHECK(ended > 0);
}

// Not by std::isfinite, which -ffast-math makes always true: the account would then miss photons.
TEST_CASE_TEMPLATE("divergence: infinity and NaN are known by their bits with any compiler flags", T, float, double) {
    const std::vector<T> bad{std::numeric_limits<T>::infinity(), -std::numeric_limits<T>::infinity(),
                             std::numeric_limits<T>::quiet_NaN()};
    for (const T& x : bad) {
        CHECK(!isfinite(x));
        CHECK(!all_finite(Vec<T>(1, x, 2)));
    }
    for (const T x : {T(0), T(-1), std::numeric_limits<T>::max(), std::numeric_limits<T>::denorm_min()})
        CHECK(isfinite(x));
}

} // namespace nephroid::tests::divergence_test
