// SPDX-License-Identifier: MIT
#include "nephroid/caustics.hpp"

#include "nephroid/quality/reference/wave.hpp"
#include "support/brute_force.hpp"
#include "support/discard_excess.hpp"
#include "support/foreign_vectors.hpp"
#include "support/untidy_scene.hpp"
#include "transport/tiny_scenes.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <stdexcept>
#include <string>

namespace nephroid::tests::caustics_test {

using tests::ceiling;
using tests::check_balance;
using tests::image_of;
using tests::lamp;
using tests::map_of;
using tests::still_water;
using tests::untidy;
using tests::Vec;
using tests::Vertex;

namespace {

/// A sequence of the user's own: the centres of n x n cells in the first two dimensions, one half in all others.
struct Grid {
    static constexpr bool stratified = true;
    std::uint64_t n = 1;
    template <std::floating_point T>
    [[nodiscard]] T sample(std::uint64_t index, std::uint32_t dimension) const {
        const std::uint64_t cell = dimension == 0 ? index % n : index / n % n;
        return dimension < 2 ? (T(cell) + T(0.5)) / T(n) : T(0.5);
    }
};
static_assert(SampleSequence<Grid>);

/// A floor's pixels: n x n from low to high in x and y.
template <class T>
std::vector<Vertex<Vec<T>>> floor_of(int n, double low, double high) {
    std::vector<Vertex<Vec<T>>> vertices;
    const double p = (high - low) / n;
    tests::add_lattice<T>(vertices, n, n, p, {low + p / 2, low + p / 2, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    return vertices;
}

/// A point light whose photons have spread one way only: needles for ever.
struct NoSpread : PointLight<glm::vec3, float> {
    template <class S>
    Photon<glm::vec3, float> emit(S& samples, const Spread<float>& spread) const {
        auto photon = PointLight<glm::vec3, float>::emit(samples, spread);
        photon.differential[1] = photon.differential[0];
        return photon;
    }
};

} // namespace

// A grid of 70 x 70 photons, 1/70 apart, each with a disk of radius s/sqrt(π 4900) and the pixel's in quadrature: by
// Poisson's formula their sum is 1 but for the kernel's transform 48 |J₃(ω)| / ω³ at the grid's frequencies, ω =
// 2π 70 r |k|. With |J₃(ω)| <= 0.8 / sqrt(ω) and Σ |k|^(−7/2) < 8 over the plane: 2.5e-3 for s = 8.
TEST_CASE_TEMPLATE("caustics: under still water the light is as it was above", T, float, double) {
    const auto vertices = floor_of<T>(32, 0.2, 0.8);
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<T>(map);
    const Statistics account =
        nephroid::caustics(still_water<T>(), lamp<T>(), sums, {.count = 4900, .smoothing = 8}, Grid{70});
    const double p = 0.6 / 32, r = std::sqrt(64 / (std::numbers::pi * 4900) + 2.0 / 3 * p * p);
    const double tolerance = 48 * 0.8 * std::pow(2 * std::numbers::pi * 70 * r, -3.5) * 8;
    REQUIRE(tolerance < 2.5e-3);
    double furthest = 0;
    for (const T irradiance : image_of(sums))
        furthest = (std::max)(furthest, std::abs(double(irradiance) - 1));
    // 4900 fluxes in the type's own precision; 200 kernels are added up at each vertex.
    CHECK(furthest <= tolerance + 200 * double(std::numeric_limits<T>::epsilon()));
    CHECK(account.emitted.photons == 4900);
    CHECK(account.emitted.flux == doctest::Approx(1).epsilon(1e-5));
    CHECK(account.specular_events == 4900);
    CHECK(account.rays == 9800);
    CHECK(account[Fate::splatted].photons + account[Fate::unseen].photons == 4900);
    check_balance(account);
}

namespace {

/// The reference's wave, z = 1 + a sin(2π (2x + y)), over its floor, for light that comes straight down.
template <class T>
struct WaveScene {
    using V = Vec<T>;
    using Hit = SurfaceHit<V, ShapeOperator<V>>;
    T amplitude;

    [[nodiscard]] std::optional<Hit> intersect(const V& o, const V& d, T, T) const {
        constexpr T tau = 2 * pi<T>;
        const V up{0, 0, 1}, zero{0, 0, 0};
        if (o.z > T(1.5)) {
            const T phase = tau * (2 * o.x + o.y), z = 1 + amplitude * std::sin(phase);
            const T slope = tau * amplitude * std::cos(phase), bend = -tau * tau * amplitude * std::sin(phase);
            const T steepness = std::sqrt(1 + 5 * slope * slope);
            const V n = T(1) / steepness * V{-2 * slope, -slope, 1};
            const auto column = [&](T per_x) { // the change of (−2 slope, −slope, 1) / steepness
                const V change = per_x * bend / steepness * V{-2, -1, 0};
                return V(change - dot(n, change) * n);
            };
            return Hit{
                o.z - z, {o.x, o.y, z}, n, n, {column(2), column(1), zero}, rounding_error(o, o.z - z, V{o.x, o.y, z}),
                0};
        }
        const T t = -o.z / d.z;
        return Hit{t, o + t * d, up, up, {zero, zero, zero}, 0, 1};
    }
    template <class Sampler>
    [[nodiscard]] Scattering<T, T> scatter(const Hit& hit, const V&, Sampler&) const {
        return hit.surface == 0 ? Scattering<T, T>::refract(1, T(1 / 1.33)) : Scattering<T, T>::deposit();
    }
};

struct WaveErrors {
    double relative; ///< rms(E − E_ref) / mean(E_ref)
    double energy;   ///< sum(E) / sum(E_ref) − 1
};

/// N photons over one period; what lands outside of it is brought back, as the pattern is periodic.
template <class T, class Policies = Default>
WaveErrors render_wave(double amplitude, std::uint64_t photons, double smoothing) {
    constexpr int n = 64, border = 32;
    const auto vertices = floor_of<T>(n + 2 * border, -double(border) / n, 1 + double(border) / n);
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<T>(map);
    const Statistics account =
        nephroid::caustics(WaveScene<T>{T(amplitude)}, lamp<T>(), sums, {.count = photons, .smoothing = smoothing},
                           HaltonSequence{1}, Policies{});
    check_balance(account);
    CHECK(account[Fate::splatted].photons == photons);
    std::vector<double> image(n * n);
    sums.for_each([&](std::size_t i, const T& sum) {
        const std::size_t column = i % (n + 2 * border) % n, row = i / (n + 2 * border) % n; // border is half of n
        image[(row + border) % n * n + (column + border) % n] += double(sum);
    });
    const auto exact = reference::wave({.amplitude = amplitude, .fresnel = false}, {0, 1, 0, 1, n, n});
    double squares = 0, sum = 0, exact_sum = 0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
        squares += square(image[i] - exact[i]);
        sum += image[i], exact_sum += exact[i];
    }
    return {std::sqrt(squares / (n * n)) / (exact_sum / (n * n)), sum / exact_sum - 1};
}

} // namespace

// Where it is emitted a photon's disk has r² = s²/(π N), and its kernel the variance r²/8: a wave of wavenumber k
// is damped by half of that times k². For the first harmonic, k² = 5 (2π)², 5 % of its 0.5 rms, for the second four
// times that of its 0.2: together a relative error of 0.05, and half as much again for the noise of 64 photons on each
// other. (Random photons would have noise of 1/sqrt(64) · sqrt(9/5) = 0.17 alone.)
TEST_CASE_TEMPLATE("caustics: those of a wave before its focus come near the exact picture", T, float, double) {
    const WaveErrors errors = render_wave<T>(0.012, 5000, 8);
    CAPTURE(errors.relative);
    CAPTURE(errors.energy);
    CHECK(errors.relative < 0.075);
    CHECK(std::abs(errors.energy) < 0.001);
}

// At its folds the footprints are needles: the pixel filter keeps the energy. Of the thinnest footprints a lone one
// gains or loses up to 0.43 of its flux on the lattice (3/π · 3/2 at a vertex, splat_test.cpp), of either sign: 5000
// of nothing else would leave 0.43 / sqrt(5000).
TEST_CASE_TEMPLATE("caustics: those of a focused wave keep the energy", T, float, double) {
    const WaveErrors errors = render_wave<T>(0.04, 5000, 3);
    CAPTURE(errors.relative);
    CAPTURE(errors.energy);
    CHECK(std::abs(errors.energy) < 0.43 / std::sqrt(5000.0));
}

TEST_CASE("caustics: more photons come nearer to the exact picture") {
    const WaveErrors few = render_wave<float, Published>(0.012, 2000, 8),
                     many = render_wave<float, Published>(0.012, 32000, 8);
    // A sixteenth of the footprint's area, and of the blur; what remains is the filter and the pixels.
    CHECK(many.relative < few.relative / 3);
}

TEST_CASE("caustics: photons meet every fate and the account balances") {
    const auto vertices = ceiling<float>();
    const auto map = map_of(vertices);
    // The bound, as a multiple of the map's diagonal: some radii of footprints are above it, and some below.
    const auto policies = Default{}
                              .with_filter(NoPixelFilter{})
                              .with_collapse(tests::WidenCollapsed{})
                              .with_excess(tests::DiscardExcess{0.165});
    auto sums = nephroid::sums<float>(map);
    const PointLight<glm::vec3, float> light({.position = {0.5f, 0.5f, 1}, .intensity = 1});
    Statistics account = nephroid::caustics(
        untidy(), light, sums, {.count = 20000, .smoothing = 4, .limits = {.roulette_after = 1}}, policies);
    check_balance(account);
    CHECK(account.emitted.photons == 20000);
    CHECK(account.emitted.flux == doctest::Approx(4 * std::numbers::pi).epsilon(1e-4));
    for (const Fate fate : {Fate::splatted, Fate::unseen, Fate::direct, Fate::absorbed, Fate::escaped, Fate::terminated,
                            Fate::excessive, Fate::invalid}) {
        CAPTURE(std::string(fate_names[std::size_t(fate)]));
        CAPTURE(account[fate].photons);
        CHECK(account[fate].photons > 0);
    }
    // And what a policy may discard at the other end.
    auto bare = nephroid::sums<float>(map);
    struct Focus : tests::SheetScene<float> {
        Scattering<float, float> scatter(const SurfaceHit<glm::vec3, Flat>& hit, const glm::vec3&,
                                         Sampler<HaltonSequence>&) const {
            return {hit.surface == 0 ? Event::reflect : Event::deposit, 1, 1};
        }
    };
    account = nephroid::caustics(Focus{untidy()}, NoSpread{light}, bare, {.count = 1000},
                                 Default{}.with_filter(NoPixelFilter{}));
    check_balance(account);
    CHECK(account[Fate::collapsed].photons > 0);
    CHECK(account[Fate::splatted].photons + account[Fate::unseen].photons == 0);
    for (const float sum : image_of(bare))
        CHECK(sum == 0);
}

TEST_CASE("caustics: the callback is told the progress and can stop it") {
    const auto vertices = floor_of<float>(16, 0, 1);
    const auto map = map_of(vertices);
    constexpr std::uint64_t count = 20000;
    std::vector<std::uint64_t> heard;
    PhotonPass pass{.count = count, .smoothing = 4};
    pass.progress = [&](std::uint64_t done) {
        heard.push_back(done);
        return heard.size() < 3;
    };
    auto sums = nephroid::sums<float>(map);
    const Statistics stopped = nephroid::caustics(still_water<float>(), lamp<float>(), sums, pass);
    REQUIRE(heard.size() == 3);
    CHECK(stopped.emitted.photons == heard.back());
    CHECK(heard.back() < count);
    CHECK(std::is_sorted(heard.begin(), heard.end()));
    // Each photon keeps its share of the total.
    CHECK(stopped.emitted.flux == doctest::Approx(double(heard.back()) / double(count)).epsilon(1e-4));
    check_balance(stopped);

    // The first photons of the sequence: the same as a pass of that many.
    auto first_part = nephroid::sums<float>(map);
    nephroid::caustics(still_water<float>(), lamp<float>(), first_part,
                       {.count = heard.back(), .total = count, .smoothing = 4});
    CHECK(image_of(first_part) == image_of(sums));

    heard.clear();
    pass.count = 3000;
    pass.progress = [&](std::uint64_t done) {
        heard.push_back(done);
        return true;
    };
    CHECK(nephroid::caustics(still_water<float>(), lamp<float>(), sums, pass).emitted.photons == 3000);
    CHECK(heard.back() == 3000);
}

TEST_CASE("caustics: zero photons and impossible footprints are refused") {
    const auto vertices = floor_of<float>(8, 0, 1);
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<float>(map);
    const auto complaint = [&](const PhotonPass& pass) -> std::string {
        try {
            (void)nephroid::caustics(still_water<float>(), lamp<float>(), sums, pass);
        } catch (const std::invalid_argument& error) {
            return error.what();
        }
        return "none";
    };
    CHECK(complaint({}).starts_with("nephroid::caustics: zero photons"));
    for (const double smoothing :
         {0.0, -1.0, std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()})
        CHECK(complaint({.count = 10, .smoothing = smoothing}).starts_with("nephroid::caustics: smoothing"));
    CHECK(complaint({.count = 10}) == "none");
}

TEST_CASE_TEMPLATE("caustics: without eye path vertices every photon is unseen", T, float, double) {
    const std::vector<Vertex<Vec<T>>> nothing;
    const auto map = map_of(nothing);
    auto sums = nephroid::sums<T>(map);
    const Statistics account = nephroid::caustics(still_water<T>(), lamp<T>(), sums, {.count = 1000});
    CHECK(account[Fate::unseen].photons == 1000);
    CHECK(image_of(sums).empty());
    check_balance(account);
}

TEST_CASE("caustics: light comes in colours") {
    const auto vertices = floor_of<float>(16, 0.3, 0.7);
    const auto map = map_of(vertices);
    auto water = still_water<float, glm::vec3>();
    water.sheets[0].weight = {1, 0.5f, 0};
    auto sums = nephroid::sums<glm::vec3>(map);
    auto grey = nephroid::sums<float>(map);
    const auto account =
        nephroid::caustics(water, lamp<float, glm::vec3>(2, {1, 1, 1}), sums, {.count = 4900}, Grid{70});
    nephroid::caustics(still_water<float>(), lamp<float>(), grey, {.count = 4900}, Grid{70});
    const auto colours = image_of(sums);
    const auto greys = image_of(grey);
    for (std::size_t i = 0; i < colours.size(); ++i)
        REQUIRE(colours[i] == glm::vec3{greys[i], 0.5f * greys[i], 0}); // halves are exact
    CHECK(account[Fate::absorbed].flux == doctest::Approx(0.5).epsilon(1e-5));
    check_balance(account);
}

namespace {

/// Still water again, in the vectors of another library.
template <class V>
struct ForeignWater {
    using T = scalar_t<V>;
    using t = vector_traits<V>;
    std::optional<SurfaceHit<V, Flat>> intersect(const V& o, const V&, T, T) const {
        const T z = t::z(o) > T(1.5) ? T(1) : T(0);
        const V n = t::make(0, 0, 1), p = t::make(t::x(o), t::y(o), z);
        return SurfaceHit<V, Flat>{t::z(o) - z, p, n, n, {}, T(1e-6), z > 0 ? 0u : 1u};
    }
    template <class Sampler>
    Scattering<T, T> scatter(const SurfaceHit<V, Flat>& hit, const V&, Sampler&) const {
        return hit.surface == 0 ? Scattering<T, T>::refract(1, T(1 / 1.33)) : Scattering<T, T>::deposit();
    }
};

} // namespace

// In float: smoothing/pilot_test.cpp has them in double. Each is the whole library once more, seconds of the compiler's
// time.
TEST_CASE("caustics: they are rendered with any vectors") {
    using T = float;
    tests::for_each_vector<T>([]<class V>() {
        std::vector<Vertex<V>> vertices;
        for (int i = 0; i < 16 * 16; ++i)
            vertices.push_back(
                {make_vector<V>(T(0.3) + T(i % 16) / 40, T(0.3) + T(i / 16) / 40, 0), make_vector<V>(0, 0, 1)});
        const auto map = map_of(vertices);
        const DirectionalLight<V, T> light(
            {make_vector<V>(0, 0, -1), T(1),
             Parallelogram<V>{make_vector<V>(0, 0, 2), make_vector<V>(1, 0, 0), make_vector<V>(0, 1, 0)}});
        auto sums = nephroid::sums<T>(map);
        const Statistics account =
            nephroid::caustics(ForeignWater<V>{}, light, sums, {.count = 900, .smoothing = 5}, Grid{30});
        check_balance(account);
        // As under still water above: s = 5 on a grid of 1/30, and the filter; ω = 2π 30 r.
        const double r = std::sqrt(25 / (std::numbers::pi * 900) + 2.0 / 3 / 1600);
        const double tolerance = 48 * 0.8 * std::pow(2 * std::numbers::pi * 30 * r, -3.5) * 8;
        REQUIRE(tolerance < 0.02);
        for (const T irradiance : image_of(sums))
            CHECK(std::abs(double(irradiance) - 1) <= tolerance);
    });
}

namespace {

struct Lamp { // no power, so no light
    using vector = glm::vec3;
    using flux_type = float;
    template <class S>
    Photon<glm::vec3, float> emit(S&, const Spread<float>&) const;
};

template <class S, class L, class P>
concept Renders = requires(const S& scene, const L& light, P& sums) {
    nephroid::caustics(scene, light, sums, PhotonPass{});
};

using Water = tests::SheetScene<float>;
using Sun = DirectionalLight<glm::vec3, float>;
static_assert(Renders<Water, Sun, Sums<glm::vec3, float>>);
// A wrong call ends in a sentence, not in "no": tests/messages/ reads those sentences. What they are about:
static_assert(!Light<Lamp>);
static_assert(!detail::EmitsFor<Sun, glm::dvec3, double>); // another vector
static_assert(!detail::EmitsFor<Sun, glm::vec3, double>);  // another flux
static_assert(!Scene<int, glm::vec3, Sampler<HaltonSequence>>);

} // namespace

} // namespace nephroid::tests::caustics_test
