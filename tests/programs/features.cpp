// SPDX-License-Identifier: MIT
/// @file  One photon's emission and walk, with one feature of the library at a time: compiled by
///        pay_for_what_you_use.sh, which counts instructions. Without a feature it is a planar mirror, a directional
///        light and float flux.
///
/// Every variant takes the same path through the same two planes: straight down onto the mirror (or glass) at 45
/// degrees, and on to the receiver. So what differs is what the feature costs.
#include <nephroid/emission/light/directional.hpp>
#include <nephroid/sequence/halton.hpp>
#include <nephroid/sequence/sequence.hpp>
#include <nephroid/transport/walk.hpp>
#include <nephroid/vector/glm.hpp>

#if defined(WITHOUT_TANGENTS)
#include <nephroid/emission/without_tangents.hpp>
#elif defined(FINITE_DIFFERENCES)
#include <nephroid/differential/finite_difference_curvature.hpp>
#elif defined(POINT_LIGHT)
#include <nephroid/emission/light/point.hpp>
#elif defined(AREA_LIGHT)
#include <nephroid/emission/light/quad.hpp>
#elif defined(ALL_LIGHTS)
#include <nephroid/emission/light/standard_lights.hpp>
#endif

#include <array>
#include <cstdio>
#include <cstdlib>

#if defined(DOUBLE)
using T = double;
#else
using T = float;
#endif
using V = glm::vec<3, T>;

#if defined(RGB)
using F = V;
const F one(1);
#elif defined(BANDS)
/// A spectrum of 16 bands.
struct F {
    std::array<T, 16> band{};
    friend F operator+(const F& a, const F& b) {
        return combined(a, b, [](T x, T y) { return x + y; });
    }
    friend F operator*(const F& a, const F& b) {
        return combined(a, b, [](T x, T y) { return x * y; });
    }
    friend F operator*(const F& a, T s) {
        return combined(a, a, [s](T x, T) { return s * x; });
    }
    template <class Operation>
    static F combined(const F& a, const F& b, const Operation& operation) {
        F c;
        for (std::size_t i = 0; i < c.band.size(); ++i)
            c.band[i] = operation(a.band[i], b.band[i]);
        return c;
    }
};
template <>
struct nephroid::flux_traits<F> {
    static double power(const F& f) {
        double sum = 0;
        for (const T band : f.band)
            sum += double(band);
        return sum / 16;
    }
    static F zero() { return {}; }
};
const F one{{1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1, 1}};
#else
using F = T;
const F one = 1;
#endif

struct Planes;

#if defined(SHAPE_OPERATOR)
using Curvature = nephroid::ShapeOperator<V>;
#elif defined(PARAMETRIC)
using Curvature = nephroid::ParametricCurvature<V>;
#elif defined(INTERPOLATED)
using Curvature = nephroid::InterpolatedCurvature<V>;
#elif defined(ANY_CURVATURE)
using Curvature =
    nephroid::AnyCurvature<nephroid::Flat, nephroid::ShapeOperator<V>, nephroid::InterpolatedCurvature<V>>;
#elif defined(FINITE_DIFFERENCES)
using Curvature = nephroid::FiniteDifferenceCurvature<V, Planes>;
#else
using Curvature = nephroid::Flat;
#endif

struct Hit {
    T distance;
    V position, geometric_normal;
#if defined(SHADING_NORMAL)
    V shading_normal;
#endif
    Curvature curvature;
    T position_error;
    bool receives;
};

#if defined(GLASS) || defined(WAVELENGTH)
#define REFRACTION
#endif

struct Bounce {
    nephroid::Event event;
    F weight;
#if defined(REFRACTION)
    T eta = T(1);
#else
    static constexpr bool refracts = false;
#endif
#if defined(MEDIUM)
    int medium = 1;
#endif
#if defined(WAVELENGTH)
    std::array<T, 3> d_eta{T(0), T(0), T(0.01)};
#endif
};

/// Numbers that the compiler does not know.
struct Surface {
    V normal;
    Curvature curvature;
    F weight = one;
    T eta = T(1.5);
};

struct Planes {
    Surface mirror;

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, T t_min, T t_max) const {
        std::optional<Hit> nearest;
        const T t = -nephroid::dot(mirror.normal, o) / nephroid::dot(mirror.normal, d);
        if (t > t_min && t < t_max) {
            nearest = hit(o, d, t, mirror.normal, mirror.curvature, false);
            t_max = t;
        }
        const T down = (T(-4) - o.z) / d.z, across = (T(4) - o.x) / d.x; // straight on from glass, aside from a mirror
        if (down > t_min && down < t_max)
            nearest = hit(o, d, down, V(0, 0, 1), mirror.curvature, true);
        else if (across > t_min && across < t_max)
            nearest = hit(o, d, across, V(-1, 0, 0), mirror.curvature, true);
        return nearest;
    }

    [[nodiscard]] Hit hit(const V& o, const V& d, T t, const V& n, const Curvature& curvature, bool receives) const {
        const V at = o + t * d;
        Hit found {
            t, at, n,
#if defined(SHADING_NORMAL)
                n,
#endif
                curvature, nephroid::rounding_error(o, t, at), receives
        };
#if defined(FINITE_DIFFERENCES)
        found.curvature = nephroid::finite_difference_curvature(*this, found, T(1));
#endif
        return found;
    }

    template <class Sampler>
    [[nodiscard]] Bounce scatter(const Hit& hit, const V&, Sampler&) const {
        if (hit.receives)
            return {nephroid::Event::deposit, mirror.weight};
#if defined(REFRACTION)
        return {nephroid::Event::refract, mirror.weight, mirror.eta};
#else
        return {nephroid::Event::reflect, mirror.weight};
#endif
    }

#if defined(MEDIUM)
    using medium = int;
    [[nodiscard]] F transmittance(int medium, T distance) const { return medium == 0 ? one : F(std::exp(-distance)); }
#endif
};

const nephroid::BoundingSphere<V> target{{0, 0, 0}, T(0.5)};

#if defined(WITHOUT_TANGENTS)
using Light = nephroid::WithoutTangents<nephroid::DirectionalLight<V, F>>;
const Light light(nephroid::DirectionalLight<V, F>({{0, 0, -1}, one, target}));
#elif defined(POINT_LIGHT)
using Light = nephroid::PointLight<V, F>;
const Light light({{0, 0, 8}, one, target});
#elif defined(AREA_LIGHT)
using Light = nephroid::QuadLight<V, F>;
const Light light({{T(-0.01), T(-0.01), 8}, {0, T(0.02), 0}, {T(0.02), 0, 0}, one, target});
#elif defined(ALL_LIGHTS)
using Light = nephroid::StandardLights<V, F>;
const Light light({nephroid::DirectionalLight<V, F>({{0, 0, -1}, one, target}),
                   nephroid::PointLight<V, F>({{0, 0, 8}, one, target})});
#elif defined(WAVELENGTH)
/// A sun whose photons have a third tangent, by wavelength.
struct Light {
    using vector = V;
    using flux_type = F;
    static constexpr nephroid::EmissionDomain domain = nephroid::DirectionalLight<V, F>::domain;
    nephroid::DirectionalLight<V, F> sun{{{0, 0, -1}, one, target}};

    template <class S>
    [[nodiscard]] nephroid::Photon<V, F, 3> emit(S& samples, const nephroid::Spread<T>& spread) const {
        const auto photon = sun.emit(samples, spread);
        return {photon.position,
                photon.direction,
                photon.flux,
                {photon.differential[0], photon.differential[1], {V(0), V(0)}}};
    }
    [[nodiscard]] double power() const { return sun.power(); }
};
const Light light;
#else
using Light = nephroid::DirectionalLight<V, F>;
const Light light({{0, 0, -1}, one, target});
#endif

using Sampler = nephroid::Sampler<nephroid::HaltonSequence>;
using Photon = decltype(light.emit(std::declval<Sampler&>(), std::declval<const nephroid::Spread<T>&>()));
constexpr std::size_t tangents = Photon::tangent_count;
using Deposit = nephroid::Deposit<V, F, tangents>;

extern "C" {
[[gnu::noinline]] void emit_one(Sampler& sampler, Photon& photon) {
    photon = light.emit(sampler, nephroid::Spread<T>{T(1000), T(5)});
}
[[gnu::noinline]] void walk_one(const Planes& scene, const Photon& photon, Sampler& sampler,
                                nephroid::Statistics& account, std::optional<Deposit>& deposit) {
    deposit = nephroid::walk(scene, photon, sampler, nephroid::WalkLimits{}, account);
}
}

int main(int argc, char**) {
    const T slant = T(argc) * T(0.70710678118654752); // 1 argument: the program itself
    Planes scene{{{slant, 0, slant}, Curvature{}}};
#if defined(ANY_CURVATURE)
    scene.mirror.curvature = nephroid::sphere_curvature<V>(T(3));
#elif defined(PARAMETRIC)
    scene.mirror.curvature = {{1, 0, -1}, {0, 1, 0}, {slant / 3, 0, -slant / 3}, {0, slant / 3, 0}};
#endif
    const nephroid::HaltonSequence sequence;
    nephroid::Statistics account;
    Photon photon{};
    std::optional<Deposit> deposit;
    std::size_t deposits = 0;
    for (std::uint64_t i = 0; i < 1000; ++i) {
        Sampler sampler(sequence, i);
        emit_one(sampler, photon);
        walk_one(scene, photon, sampler, account, deposit);
        deposits += deposit ? 1 : 0;
    }
    std::printf("%zu %zu %zu\n", sizeof(Photon), sizeof(Deposit), deposits);
}
