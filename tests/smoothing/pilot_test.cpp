// SPDX-License-Identifier: MIT
// Second-order splatting as a whole, from the lamp to the picture, and what first-order splatting keeps beside it.
#include "nephroid/smoothing/pilot.hpp"

#include "emission/light/coloured_sun.hpp"

#include "support/foreign_vectors.hpp"
#include "support/glass_ball.hpp"
#include "transport/tiny_scenes.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/dual.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::tests::pilot_test {

using tests::check_balance;
using tests::Floor;
using tests::floor_of;
using tests::GlassBall;
using tests::map_of;
using tests::Sheet;
using tests::SheetScene;
using tests::Vec;

namespace {

template <class V, class F = scalar_t<V>>
[[nodiscard]] GlassBall<V, F> ball() {
    return {.tint = F(1)};
}

template <class V>
[[nodiscard]] BoundingSphere<V> about_ball() {
    using T = scalar_t<V>;
    return {make_vector<V>(T(0), T(0), T(1.5)), T(1.25)};
}

template <class V, class F = scalar_t<V>>
[[nodiscard]] DirectionalLight<V, F> sun() {
    using T = scalar_t<V>;
    return DirectionalLight<V, F>(
        {.direction = make_vector<V>(T(0.1), T(0), T(-1)), .irradiance = F(1), .patch = about_ball<V>()});
}

template <class V, class F = scalar_t<V>>
[[nodiscard]] PointLight<V, F> bulb() {
    using T = scalar_t<V>;
    return PointLight<V, F>(
        {.position = make_vector<V>(T(0.5), T(0), T(6)), .intensity = F(8), .target = about_ball<V>()});
}

template <class V, class F = scalar_t<V>>
[[nodiscard]] DiskLight<V, F> disk() {
    using T = scalar_t<V>;
    return DiskLight<V, F>({.centre = make_vector<V>(T(-0.5), T(0), T(6)),
                            .normal = make_vector<V>(T(0), T(0), T(-1)),
                            .radius = T(0.2),
                            .radiance = F(60),
                            .target = about_ball<V>()});
}

template <class F>
struct Picture {
    std::vector<F> irradiance;
    Statistics account;
};

template <class Policies = Default, class S, class L, class Sequence = HaltonSequence, class E = SerialExecutor>
[[nodiscard]] auto render(const S& scene, const L& light, const PhotonPass& pass,
                          const Sequence& sequence = Sequence(1), E&& executor = E{}, const Policies& policies = {}) {
    using V = typename L::vector;
    using F = typename L::flux_type;
    const Floor<V> vertices = floor_of<V>(24);
    const EyePathMap<V> map = map_of(vertices);
    auto sums = nephroid::sums<F>(map);
    Picture<F> picture{std::vector<F>(vertices.size(), flux_traits<F>::zero()), {}};
    picture.account = nephroid::caustics(scene, light, sums, pass, policies, sequence, executor);
    sums.for_each([&](std::size_t i, const F& e) { picture.irradiance[i] = e; });
    return picture;
}

/// Photons splatted one by one, by hand: emitted with the footprint's smoothing, walked, added.
template <class L, class S>
[[nodiscard]] auto render_by_hand(const S& scene, const L& light, const PhotonPass& pass, double smoothing) {
    using V = typename L::vector;
    using F = typename L::flux_type;
    using T = scalar_t<V>;
    const Floor<V> vertices = floor_of<V>(24);
    const EyePathMap<V> map = map_of(vertices);
    auto sums = nephroid::sums<F>(map);
    detail::Splatter splatter(sums, Published{});
    std::vector<detail::SplatChunk<V, F>> chunk(1);
    Picture<F> picture{std::vector<F>(vertices.size(), flux_traits<F>::zero()), {}};
    const HaltonSequence sequence(1);
    for (std::uint64_t i = 0; i < pass.count; ++i) {
        Sampler<HaltonSequence> sampler(sequence, pass.first + i);
        const auto photon = light.emit(sampler, Spread<T>{T(pass.count), T(smoothing)});
        if (const auto deposit = walk(scene, photon, sampler, pass.limits, picture.account))
            splatter.prepare(*deposit, chunk[0], picture.account);
    }
    SerialExecutor executor;
    splatter.add(std::span<const detail::SplatChunk<V, F>>(chunk), executor);
    sums.for_each([&](std::size_t i, const F& e) { picture.irradiance[i] = e; });
    return picture;
}

void check_same(const Statistics& a, const Statistics& b) {
    CHECK(a.emitted.photons == b.emitted.photons);
    CHECK(a.rays == b.rays);
    CHECK(a.specular_events == b.specular_events);
    CHECK(a.bounded_footprints == b.bounded_footprints);
    CHECK(a.bounded_shifts == b.bounded_shifts);
    CHECK(a.splatted_as_published == b.splatted_as_published);
    for (std::size_t i = 0; i < fate_count; ++i) {
        CHECK(a.fates[i].photons == b.fates[i].photons);
        CHECK(a.fates[i].flux == doctest::Approx(b.fates[i].flux).epsilon(1e-12)); // the chunks' sums differ in order
    }
}

/// Hits 2 in 3 photons with something: no flux at all, tangents that are no numbers, none at all.
template <class L>
struct Flawed : L {
    using V = typename L::vector;
    using T = scalar_t<V>;
    template <class S>
    [[nodiscard]] auto emit(S& samples, const Spread<T>& spread) const {
        auto photon = L::emit(samples, spread);
        const int which = std::abs(int(photon.position.x * 997)) % 6; // by where it starts: any light's photons do
        if (which == 1)
            photon.flux = 0;
        if (which == 2)
            photon.differential[0].d_position.x = std::numeric_limits<T>::quiet_NaN();
        if (which == 3)
            photon.differential[1] = photon.differential[0];
        if (which == 4)
            photon.differential = {};
        return photon;
    }
};

} // namespace

TEST_CASE_TEMPLATE("first order: the picture is the same bit for bit as of photons splatted one by one", T, float,
                   double) {
    using V = Vec<T>;
    for (const std::optional<double> smoothing : {std::optional<double>(), std::optional<double>(3.7)}) {
        const PhotonPass pass{.first = 5, .count = 3000, .smoothing = smoothing};
        const auto check = [&](const auto& light) {
            const auto picture = render<Published>(ball<V>(), light, pass);
            const auto by_hand = render_by_hand(ball<V>(), light, pass, smoothing.value_or(8));
            CHECK(picture.irradiance == by_hand.irradiance);
            check_same(picture.account, by_hand.account);
            CHECK(picture.account[Fate::splatted].photons > 1000);
        };
        check(sun<V>());
        check(bulb<V>());
        check(disk<V>());
    }
}

TEST_CASE_TEMPLATE("second order: no flux is lost and shifts change no photon's fate", T, float, double) {
    using V = Vec<T>;
    const auto check = [&](const auto& light, const auto& sequence) {
        const auto second = render(ball<V>(), light, {.count = 5000}, sequence),
                   first = render<Published>(ball<V>(), light, {.count = 5000}, sequence);
        check_balance(second.account);
        CHECK(second.account.emitted.photons == 5000);
        CHECK(second.account.rays == first.account.rays);
        CHECK(second.account[Fate::absorbed].flux ==
              doctest::Approx(first.account[Fate::absorbed].flux).epsilon(1e-12));
        CHECK(second.account[Fate::escaped].flux == doctest::Approx(first.account[Fate::escaped].flux).epsilon(1e-12));
        CHECK(second.account[Fate::invalid].photons == first.account[Fate::invalid].photons);
        CHECK(second.account[Fate::splatted].photons > 1000);
        CHECK(second.irradiance != first.irradiance);
    };
    check(sun<V>(), HaltonSequence(1));
    check(bulb<V>(), HaltonSequence(1));
    check(bulb<V>(), RandomSequence(1));
    check(disk<V>(), HaltonSequence(1));
    check(disk<V>(), RandomSequence(1));
    check(StandardLights<V, T>({bulb<V>(), disk<V>(), sun<V>()}), HaltonSequence(1));
}

// A slab or a mirror of flat glass under the sun is an affine map: nothing to shift, so that a given smoothing makes
// the same picture to either order. Of products instead of sums of rounded tangents some 16 roundings are left, at the
// edge of a kernel as much as anywhere.
TEST_CASE_TEMPLATE("second order: a straight map's picture is that of plain splats", T, float, double) {
    using V = Vec<T>;
    const SheetScene<T> water{
        {{{0, 0, 1}, {0, 0, 1}, Event::refract, T(1), 1, T(1.33)}, {{0, 0, 0}, {0, 0, 1}, Event::deposit}}};
    const PhotonPass pass{.count = 3000, .smoothing = 6};
    const auto second = render(water, sun<V>(), pass), first = render<Published>(water, sun<V>(), pass);
    CHECK(second.account.bounded_shifts == 0);
    double furthest = 0;
    for (std::size_t i = 0; i < first.irradiance.size(); ++i)
        furthest = (std::max)(furthest, std::abs(double(second.irradiance[i]) - double(first.irradiance[i])));
    CHECK(furthest <= 256 * double(std::numeric_limits<T>::epsilon()));
    CHECK(first.irradiance != std::vector<T>(first.irradiance.size(), T(0)));
}

TEST_CASE("second order: photons after the pilot get footprints chosen from the pilot") {
    using V = Vec<double>;
    const auto whole = render(ball<V>(), sun<V>(), {.count = 8000});
    const Default policies{.order = {.pilot = 4000}};
    const auto by_half = render(ball<V>(), sun<V>(), {.count = 8000}, HaltonSequence(1), SerialExecutor{}, policies);
    check_balance(by_half.account);
    CHECK(by_half.account[Fate::splatted].photons > 3000);
    double difference2 = 0, sum2 = 0;
    for (std::size_t i = 0; i < whole.irradiance.size(); ++i) {
        difference2 += square(whole.irradiance[i] - by_half.irradiance[i]);
        sum2 += square(whole.irradiance[i]);
    }
    CHECK(difference2 > 0);
    CHECK(difference2 < square(0.1) * sum2); // the same photons with footprints of about the same size
}

TEST_CASE("second order: a pass stopped within its pilot counts only the photons that were splatted") {
    using V = Vec<float>;
    PhotonPass pass{.count = 20000};
    std::uint64_t reached = 0;
    pass.progress = [&](std::uint64_t done) {
        reached = done;
        return false;
    };
    const auto stopped = render(ball<V>(), sun<V>(), pass);
    REQUIRE(reached > 0);
    REQUIRE(reached < 20000); // and all of them were pilot photons
    CHECK(stopped.account.emitted.photons == reached);
    CHECK(stopped.account.emitted.flux == doctest::Approx(sun<V>().power() * double(reached) / 20000).epsilon(1e-4));
    check_balance(stopped.account);
    // Rays and fates are those of these photons, as to first order.
    const auto first = render<Published>(ball<V>(), sun<V>(), {.count = reached, .total = 20000});
    CHECK(stopped.account.rays == first.account.rays);
    CHECK(stopped.account.specular_events == first.account.specular_events);
    CHECK(stopped.account.caustic_photons() == first.account.caustic_photons());
}

TEST_CASE_TEMPLATE("second order: a pass of a few photons is splatted", T, float, double) {
    using V = Vec<T>;
    for (const std::uint64_t count : {1u, 2u, 10u, 63u, 64u, 65u, 200u}) {
        CAPTURE(count);
        for (const std::optional<double> smoothing : {std::optional<double>(), std::optional<double>(6)}) {
            const auto picture = render(ball<V>(), bulb<V>(), {.count = count, .smoothing = smoothing});
            CHECK(picture.account.emitted.photons == count);
            check_balance(picture.account);
            for (const T e : picture.irradiance)
                CHECK((std::isfinite(e) && e >= 0));
        }
    }
}

TEST_CASE_TEMPLATE("second order: photons without flux or with invalid tangents do not spoil the picture", T, float,
                   double) {
    using V = Vec<T>;
    const Flawed<DirectionalLight<V, T>> light{sun<V>()};
    for (const std::optional<double> smoothing : {std::optional<double>(), std::optional<double>(6)}) {
        const auto picture = render(ball<V>(), light, {.count = 6000, .smoothing = smoothing});
        check_balance(picture.account);
        CHECK(picture.account[Fate::invalid].photons > 0); // tangents that are no numbers
        CHECK(picture.account[Fate::splatted].photons > 1000);
        T sum(0);
        for (const T e : picture.irradiance) {
            CHECK((std::isfinite(e) && e >= 0));
            sum += e;
        }
        CHECK(sum > 0);
    }
}

TEST_CASE("second order: footprints of a light are chosen from its own photons") {
    using V = Vec<double>;
    const auto lights = StandardLights<V, double>({bulb<V>(), disk<V>()});
    const auto picture = render(ball<V>(), lights, {.count = 20000}, RandomSequence(3));
    // Emitted alone, with as many photons of its own: the same light, photons apart.
    const double share = bulb<V>().power() / lights.power();
    const auto of_bulb = render(ball<V>(), bulb<V>(), {.count = std::uint64_t(20000 * share)}, RandomSequence(4)),
               of_disk = render(ball<V>(), disk<V>(), {.count = std::uint64_t(20000 * (1 - share))}, RandomSequence(5));
    double difference2 = 0, sum2 = 0;
    for (std::size_t i = 0; i < picture.irradiance.size(); ++i) {
        const double apart = of_bulb.irradiance[i] + of_disk.irradiance[i];
        difference2 += square(picture.irradiance[i] - apart);
        sum2 += square(apart);
    }
    // Noise of two pictures, 1.8/s² relative variance each with s from 5: a relative 0.27 at most, less where light
    // is.
    CHECK(difference2 < square(std::sqrt(2 * 1.8) / 5) * sum2);
    check_balance(picture.account);
}

// In double: caustics_test.cpp has them in float. Each is the whole library once more, seconds of the compiler's time.
TEST_CASE("second order: takes any vector") {
    std::vector<double> expected;
    tests::for_each_vector<double>([&]<class V>() {
        const auto picture = render(ball<V>(), bulb<V>(), {.count = 1500});
        check_balance(picture.account);
        if (expected.empty())
            expected = picture.irradiance;
        REQUIRE(picture.irradiance.size() == expected.size());
        double difference2 = 0, sum2 = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
            difference2 += square(picture.irradiance[i] - expected[i]);
            sum2 += square(expected[i]);
        }
        // The vectors' products round differently, fused or not: a photon at a border may change its mind.
        CHECK(std::sqrt(difference2 / sum2) < 1e-6);
    });
}

// Shapes and shifts are constants to dual numbers; where the map is straight and the smoothing given they are
// constants.
TEST_CASE("second order: dual numbers carry derivatives through a straight map") {
    const auto at_height = []<class T>(const T& depth) {
        using V = foreign::Plain<T>;
        struct Water {
            T depth;
            std::optional<SurfaceHit<V, Flat>> intersect(const V& o, const V& d, T, T) const {
                const bool above = double(o.z) > 1;
                const V up{T(0), T(0), T(1)};
                const T z = above ? T(1) : T(1) - depth, t = (z - o.z) / d.z;
                const V p = o + t * d;
                return SurfaceHit<V, Flat>{t, p, up, up, {}, T(0), above ? 0u : 1u};
            }
            Scattering<T, T> scatter(const SurfaceHit<V, Flat>& hit, const V&, Sampler<HaltonSequence>&) const {
                return hit.surface == 0 ? Scattering<T, T>::refract(T(1), T(1 / 1.33)) : Scattering<T, T>::deposit();
            }
        };
        const DirectionalLight<V, T> light(
            {.direction = {T(0.5), T(0), T(-1)}, .irradiance = T(1), .patch = about_ball<V>()});
        return render(Water{depth}, light, {.count = 500, .smoothing = 5}).irradiance;
    };
    constexpr double h = 1e-6;
    const auto here = at_height(Dual<double>::parameter(1));
    const auto above = at_height(1 + h), below = at_height(1 - h);
    double furthest = 0, largest = 0;
    for (std::size_t i = 0; i < here.size(); ++i) {
        const double difference = (above[i] - below[i]) / (2 * h);
        largest = (std::max)(largest, std::abs(difference));
        furthest = (std::max)(furthest, std::abs(here[i].derivative() - difference));
    }
    CHECK(largest > 0.1);
    CHECK(furthest <= 1e-6 * largest); // as in dual_caustic_test.cpp, and S = 25 to rounding only
}

// What a lamp draws besides its coordinates is no reason to lose its photons' neighbours: each splat lies where that of
// the plain sun does.
TEST_CASE_TEMPLATE("second order: a light that also draws a wavelength still has fields", T, float, double) {
    using V = Vec<T>;
    const auto placed = [](const auto& light) {
        using L = std::remove_cvref_t<decltype(light)>;
        static_assert(detail::emission_domains<L>.two && !detail::emission_domains<L>.others);
        const PhotonPass pass{.count = 3000};
        const HaltonSequence sequence(1);
        SerialExecutor executor;
        const Default policies;
        const auto pilot = detail::trace_pilot(ball<V>(), light, pass, policies.order, sequence, executor);
        const auto footprints =
            detail::fit_footprints<detail::emission_domains<L>>(pilot, pass, policies, 100.0, true, executor);
        std::vector<V> places;
        std::size_t moved = 0;
        for (auto photon : pilot.photons) {
            CHECK(footprints.has_neighbours(photon.sample));
            if (!photon.deposit)
                continue;
            const V before = photon.deposit->position;
            (void)footprints.apply(photon);
            moved += !(photon.deposit->position == before);
            places.push_back(photon.deposit->position);
        }
        CHECK(moved > places.size() / 2);
        return places;
    };
    const auto plain = placed(sun<V>()), coloured = placed(tests::ColouredSun<V>{sun<V>()});
    REQUIRE(plain.size() > 1000);
    CHECK(plain == coloured);
}

namespace {

/// Water whose surface is made of flat strips, each tilted by its own angle.
template <class T>
struct FacetedWater : SheetScene<T> {
    using V = Vec<T>;
    [[nodiscard]] std::optional<SurfaceHit<V, Flat>> intersect(const V& o, const V& d, T t_min, T t_max) const {
        auto hit = SheetScene<T>::intersect(o, d, t_min, t_max);
        if (hit && hit->surface == 0) {
            const T tilt = T(0.4) * std::sin(T(2.4) * std::floor(T(16) * hit->position.x));
            hit->shading_normal = V(std::sin(tilt), T(0), std::cos(tilt));
        }
        return hit;
    }
};

} // namespace

// Each strip's light is an affine image of the lamp's, and tangents know no other. Where it falls says that the map is
// none, and then the two methods are one.
TEST_CASE_TEMPLATE("second order: facets give the published picture bit for bit, for any number of threads", T, float,
                   double) {
    using V = Vec<T>;
    const FacetedWater<T> water{
        {{{{0, 0, 1}, {0, 0, 1}, Event::refract, T(1), 1, T(1.33)}, {{0, 0, 0}, {0, 0, 1}, Event::deposit}}}};
    const PhotonPass pass{.count = 6000};
    const auto published = render<Published>(water, sun<V>(), pass);
    ThreadExecutor threads(3);
    for (const bool by_threads : {false, true}) {
        const auto second =
            by_threads ? render(water, sun<V>(), pass, HaltonSequence(1), threads) : render(water, sun<V>(), pass);
        CHECK(second.irradiance == published.irradiance);
        CHECK(second.account.splatted_as_published == second.account.caustic_photons());
        CHECK(second.account.bounded_shifts == 0);
    }
    CHECK(published.account.splatted_as_published == 0);
    const auto unchecked = render(water, sun<V>(), pass, HaltonSequence(1), SerialExecutor{},
                                  Default{.order = {.largest_miss = std::numeric_limits<double>::infinity()}});
    CHECK(unchecked.irradiance != published.irradiance);
    CHECK(unchecked.account.splatted_as_published == 0);
}

TEST_CASE("second order: on smooth glass next to nothing is splatted as published") {
    const auto smooth = render(ball<Vec<double>>(), sun<Vec<double>>(), {.count = 5000});
    CHECK(double(smooth.account.splatted_as_published) <= 0.05 * double(smooth.account.caustic_photons()));
}

} // namespace nephroid::tests::pilot_test
