// SPDX-License-Identifier: MIT
#include "nephroid/smoothing/cross_validated_smoothing.hpp"

#include "support/foreign_vectors.hpp"
#include "support/glass_ball.hpp"
#include "support/space.hpp"
#include "transport/tiny_scenes.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <vector>

namespace nephroid::tests::cross_validation_test {

using detail::QuarterPictures;
using tests::Draws;
using tests::floor_of;
using tests::map_of;
using tests::Vec;

namespace {

template <class V>
using Ball = tests::GlassBall<V, scalar_t<V>>;

template <class V>
[[nodiscard]] Ball<V> ball() {
    return {.tint = scalar_t<V>(1)};
}

template <class V>
[[nodiscard]] DirectionalLight<V, scalar_t<V>> sun() {
    using T = scalar_t<V>;
    return DirectionalLight<V, T>({.direction = make_vector<V>(T(0.1), T(0), T(-1)),
                                   .irradiance = 1,
                                   .patch = BoundingSphere<V>{make_vector<V>(T(0), T(0), T(1.5)), T(1.25)}});
}

/// A light of the caller's own that declares no domain: nobody knows its photons' neighbours.
template <class L>
struct Undescribed {
    using vector = typename L::vector;
    using flux_type = typename L::flux_type;
    L light;

    template <class S>
    [[nodiscard]] auto emit(S& samples, const Spread<scalar_t<vector>>& spread) const {
        return light.emit(samples, spread);
    }
    [[nodiscard]] double power() const { return light.power(); }
};

template <class Policies, class L, class S, class E = SerialExecutor>
[[nodiscard]] auto render(const S& scene, const L& light, const PhotonPass& pass, E&& executor = E{}) {
    using V = typename L::vector;
    using F = typename L::flux_type;
    const auto vertices = floor_of<V>(32);
    const EyePathMap<V> map = map_of(vertices);
    auto sums = nephroid::sums<F>(map);
    (void)nephroid::caustics(scene, light, sums, pass, Policies{}, HaltonSequence(1), executor);
    std::vector<F> picture(vertices.size());
    sums.for_each([&](std::size_t i, const F& e) { picture[i] = e; });
    return picture;
}

template <class L, class S, class Sequence = HaltonSequence, class E = SerialExecutor>
[[nodiscard]] double chosen_for(const S& scene, const L& light, const PhotonPass& pass,
                                const Sequence& sequence = Sequence(1), E&& executor = E{}, int side = 32) {
    using V = typename L::vector;
    const auto vertices = floor_of<V>(side);
    const EyePathMap<V> map = map_of(vertices);
    const auto sums = nephroid::sums<typename L::flux_type>(map);
    return cross_validated_smoothing(scene, light, sums, pass, sequence, executor);
}

/// About normal: of mean 0 and variance 1.
[[nodiscard]] double noise(Draws& draw) {
    double sum = 0;
    for (int i = 0; i < 12; ++i)
        sum += draw.in(-0.5, 0.5);
    return sum;
}

constexpr std::size_t many = 20000;

/// Pictures of quarters whose noise falls as n^−β: what the two of each half differ by is 2^(β/2) times what the
/// halves do.
[[nodiscard]] QuarterPictures noisy(double order) {
    Draws draw(3);
    QuarterPictures quarters;
    for (std::size_t i = 0; i < many; ++i) {
        const double halves = noise(draw);
        for (std::size_t half = 0; half < 2; ++half) {
            const double middle = 5 + (half == 0 ? halves : -halves), apart = std::exp2(0.5 * order) * noise(draw);
            quarters[2 * half].push_back(middle + apart);
            quarters[2 * half + 1].push_back(middle - apart);
        }
    }
    return quarters;
}

} // namespace

// The ratio of two variances of 20000 numbers each is right to 1.4%: five such are 0.1 in its logarithm.
TEST_CASE("cross-validation: quarters and halves show how fast the noise falls") {
    Draws draw(7);
    QuarterPictures random; // independent quarters
    for (std::size_t i = 0; i < many; ++i)
        for (auto& quarter : random)
            quarter.push_back(1 + noise(draw));
    CHECK(std::abs(detail::noise_order(random) - 1) < 0.1);
    CHECK(std::abs(detail::noise_order(noisy(1.3)) - 1.3) < 0.1);
    CHECK(std::abs(detail::noise_order(noisy(1.7)) - 1.7) < 0.1);
    // Never less than random ones nor more than in two dimensions.
    CHECK(detail::noise_order(noisy(0.5)) == 1);
    CHECK(detail::noise_order(noisy(3)) == 2);
}

TEST_CASE("cross-validation: pictures without noise count as random photons") {
    CHECK(detail::noise_order(QuarterPictures{}) == 1);
    const std::vector<double> even(10, 3.0);
    CHECK(detail::noise_order({even, even, even, even}) == 1);
}

namespace {

/// How flat a wave of height 1 has become, and how much of the noise is left.
struct Trial {
    double bias, noise_level;
};

[[nodiscard]] QuarterPictures pictures(const Trial& trial, const QuarterPictures& noises) {
    QuarterPictures result;
    for (std::size_t quarter = 0; quarter < 4; ++quarter)
        for (std::size_t i = 0; i < many; ++i)
            result[quarter].push_back(2 + (1 - trial.bias) * std::sin(0.01 * double(i)) +
                                      trial.noise_level * noises[quarter][i]);
    return result;
}

[[nodiscard]] double true_error(const QuarterPictures& q) {
    double sum = 0;
    for (std::size_t i = 0; i < many; ++i)
        sum += square((q[0][i] + q[1][i] + q[2][i] + q[3][i]) / 4 - 2 - std::sin(0.01 * double(i)));
    return sum;
}

} // namespace

// Trials share the photons: the noise of the smooth ones is that of the sharp ones, damped. What is computed differs
// from the true error by a constant and by sums of n products of noise with noise or bias, each at most 1 wide: 4
// sqrt(n).
TEST_CASE("cross-validation: the error is that against the truth plus a constant") {
    const double tolerance = 4 * std::sqrt(double(many));
    for (const bool stratified : {false, true}) {
        // Noise of four quarters, each of variance 1, whose correlation makes halves and the whole quieter.
        Draws draw(11);
        QuarterPictures noises;
        const double correlation = stratified ? -0.3 : 0; // between any two of them
        for (std::size_t i = 0; i < many; ++i) {
            std::array<double, 4> own;
            double mean = 0;
            for (double& n : own)
                n = noise(draw), mean += n / 4;
            // own − c mean has the covariance (c²/4 − c/2) between quarters, and 1 more with itself.
            const double c = 1 - std::sqrt(1 + 4 * correlation / (1 - correlation));
            for (std::size_t quarter = 0; quarter < 4; ++quarter)
                noises[quarter].push_back(std::sqrt(1 - correlation) * (own[quarter] - c * mean));
        }
        // Halves: variance (1 + r)/2, covariance r; so ρ = 2 r/(1 + r), and an order that says so.
        const double rho = 2 * correlation / (1 + correlation), order = 1 - std::log2(1 + rho);
        const QuarterPictures sharp = pictures({0, 1}, noises);
        std::vector<double> difference;
        for (const Trial& trial : {Trial{0, 1}, Trial{0.1, 0.5}, Trial{0.3, 0.3}, Trial{0.6, 0.1}}) {
            const QuarterPictures smooth = pictures(trial, noises);
            difference.push_back(detail::validated_error(smooth, sharp, order) - true_error(smooth));
        }
        for (std::size_t i = 1; i < difference.size(); ++i) {
            CAPTURE(stratified);
            CAPTURE(i);
            CHECK(std::abs(difference[i] - difference[0]) < tolerance);
        }
    }
}

TEST_CASE("leaf sample: one leaf is chosen out of every few") {
    const auto vertices = floor_of<Vec<double>>(128);
    const auto map = map_of(vertices);
    for (const std::size_t wanted : {1000u, 4096u, 16384u, 1000000u}) {
        const detail::LeafSample sample(map.tree(), wanted);
        std::size_t taken = 0, leaves = 0, accepted = 0;
        std::uint32_t last = 0;
        sample.for_each([&](std::uint32_t leaf) {
            CHECK(sample(leaf));
            CHECK((leaves == 0 || leaf > last));
            last = leaf;
            ++leaves;
            taken += map.tree().leaves()[leaf].size;
        });
        for (std::uint32_t leaf = 0; leaf < map.tree().leaves().size(); ++leaf)
            accepted += sample(leaf);
        CHECK(accepted == leaves);
        const double share = double(taken) / double((std::min)(wanted, vertices.size()));
        CHECK(share > 0.6); // leaves of different sizes, and whole numbers of them
        CHECK(share < 1.6);
    }
}

TEST_CASE_TEMPLATE("cross-validation: all photons of a light without a domain get the chosen smoothing", T, float,
                   double) {
    using V = Vec<T>;
    const Undescribed<DirectionalLight<V, T>> light{sun<V>()};
    PhotonPass pass{.count = 3000};
    const auto second = render<Default>(ball<V>(), light, pass);
    pass.smoothing = chosen_for(ball<V>(), light, pass);
    CHECK(*pass.smoothing > 2.5);
    CHECK(*pass.smoothing < 20);
    const auto first = render<Published>(ball<V>(), light, pass);
    double furthest = 0, brightest = 0;
    for (std::size_t i = 0; i < first.size(); ++i) {
        furthest = (std::max)(furthest, std::abs(double(first[i]) - double(second[i])));
        brightest = (std::max)(brightest, double(first[i]));
    }
    // Tangents are scaled after the walk instead of before it.
    CHECK(furthest <= 1e4 * double(std::numeric_limits<T>::epsilon()) * brightest);
}

// The light's own photons have cells; only those of the light without may change when its smoothing does.
TEST_CASE("cross-validation: lights with a domain are splatted as if lights without one were absent") {
    using V = Vec<double>;
    using Known = DirectionalLight<V, double>;
    using Set = LightSet<Known, Undescribed<Known>>;
    const Set both({Set::AnyLight(sun<V>()), Set::AnyLight(Undescribed<Known>{sun<V>()})});
    const auto picture = render<Default>(ball<V>(), both, {.count = 4000});
    const auto known = render<Default>(ball<V>(), sun<V>(), {.count = 2000});
    double sum = 0, of_known = 0;
    for (std::size_t i = 0; i < known.size(); ++i)
        sum += picture[i], of_known += known[i];
    CHECK(sum ==
          doctest::Approx(2 * of_known).epsilon(0.05)); // the same light twice, by chance half of the photons each
}

TEST_CASE("cross-validation: any number of threads chooses the same smoothing bit for bit") {
    using V = Vec<float>;
    const double serial = chosen_for(ball<V>(), sun<V>(), {.count = 3000});
    for (const unsigned threads : {1u, 2u, 5u}) {
        ThreadExecutor executor(threads);
        CHECK(chosen_for(ball<V>(), sun<V>(), {.count = 3000}, HaltonSequence(1), executor) == serial);
    }
}

TEST_CASE("cross-validation: too few photons in view give the default smoothing") {
    using V = Vec<double>;
    CHECK(chosen_for(ball<V>(), sun<V>(), {.count = 60}) == default_smoothing);
    CHECK(chosen_for(ball<V>(), sun<V>(), {.count = 3000}, HaltonSequence(1), SerialExecutor{}, 0) ==
          default_smoothing);
    auto away = floor_of<V>(16);
    for (auto& vertex : away)
        vertex.position.x += 100;
    const auto map = map_of(away);
    const auto sums = nephroid::sums<double>(map);
    CHECK(cross_validated_smoothing(ball<V>(), sun<V>(), sums, {.count = 3000}) == default_smoothing);
}

TEST_CASE("cross-validation: a pass of no photons is refused") {
    using V = Vec<double>;
    CHECK_THROWS_WITH_AS((void)chosen_for(ball<V>(), sun<V>(), {}),
                         "nephroid::cross_validated_smoothing: zero photons; count must be at least 1",
                         std::invalid_argument);
}

// What is compared is the same, so that only the number of photons to come makes a difference: its cube root for random
// ones.
TEST_CASE("cross-validation: a longer pass gets a larger smoothing and smaller footprints") {
    using V = Vec<double>;
    const auto vertices = floor_of<V>(32);
    const auto map = map_of(vertices);
    const auto sums = nephroid::sums<double>(map);
    const RandomSequence sequence(1);
    constexpr std::size_t count = 3000;
    SerialExecutor executor;
    const auto chosen = [&](double photons) {
        const auto deposit_of = [&](std::size_t i) {
            Sampler<RandomSequence> sampler(sequence, i);
            Statistics account;
            return walk(ball<V>(), sun<V>().emit(sampler, Spread<double>{photons, 1}), sampler, {}, account);
        };
        return detail::cross_validated(sums, Default{}, count, photons, false, deposit_of, executor);
    };
    const double same = chosen(count), longer = chosen(64 * count);
    CHECK(longer == doctest::Approx(4 * same).epsilon(1e-9));
    CHECK(same == chosen_for(ball<V>(), sun<V>(), {.count = count}, sequence));
}

TEST_CASE_TEMPLATE("cross-validation: takes any vector", T, float, double) {
    double expected = 0;
    tests::for_each_vector<T>([&]<class V>() {
        const double s = chosen_for(ball<V>(), sun<V>(), {.count = 1500});
        if (expected == 0)
            expected = s;
        CHECK(s == doctest::Approx(expected).epsilon(0.01)); // a photon at a border may change its mind
    });
}

} // namespace nephroid::tests::cross_validation_test
