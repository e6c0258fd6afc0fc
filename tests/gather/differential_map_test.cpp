// SPDX-License-Identifier: MIT
#include "nephroid/gather/differential_map.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/gather/estimate_at.hpp"
#include "nephroid/splat/splat_photons.hpp"

#include "support/brute_force.hpp"
#include "support/foreign_vectors.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

namespace nephroid::tests::differential_map_test {

using tests::Draws;
using tests::Received;
using tests::Vertex;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
constexpr double epsilon = double(std::numeric_limits<T>::epsilon());

constexpr double spacing = 1.0 / 32;

/// A floor, its back close below it, and a wall beside it.
template <class T>
std::vector<Vertex<Vec<T>>> room() {
    std::vector<Vertex<Vec<T>>> vertices;
    tests::add_lattice<T>(vertices, 32, 32, spacing, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    tests::add_lattice<T>(vertices, 32, 32, spacing, {0, 0, -0.001}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    tests::add_lattice<T>(vertices, 32, 32, spacing, {1.25, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0});
    return vertices;
}

/// Photons on all three, of sizes from a thousandth to one.
template <class T>
std::vector<Deposit<Vec<T>, T>> photons(int count) {
    Draws draw(94);
    std::vector<Deposit<Vec<T>, T>> deposits;
    for (int i = 0; i < count; ++i) {
        Vec<T> n{0, 0, 1}, p{T(draw.in(0, 1)), T(draw.in(0, 1)), 0};
        if (i % 3 == 1)
            n = {0, 0, -1}, p.z = T(-0.001);
        if (i % 3 == 2)
            n = {-1, 0, 0}, p = {T(1.25), T(draw.in(0, 1)), T(draw.in(0, 1))};
        const auto frame = frame_about(n);
        const double size = std::pow(10.0, draw.in(-3, 0));
        const auto in_plane = [&] {
            return Vec<T>(T(draw.in(-size, size)) * frame.u + T(draw.in(-size, size)) * frame.v);
        };
        deposits.push_back({p, n, -n, T(draw.in(0.5, 1)), {in_plane(), in_plane()}});
    }
    return deposits;
}

template <class V>
EyePathMap<V> map_of(const std::vector<Vertex<V>>& vertices) {
    return EyePathMap<V>(vertices, &Vertex<V>::position, &Vertex<V>::normal);
}

/// The splatter's sums.
template <class V, class F, class Policies>
std::vector<F> splatted(const EyePathMap<V>& map, const std::vector<Deposit<V, F>>& deposits, const Policies& policies,
                        Statistics& account) {
    auto sums = nephroid::sums<F>(map);
    account = splat(deposits, sums, {}, policies);
    std::vector<F> image(map.tree().slots(), flux_traits<F>::zero());
    sums.for_each([&](std::size_t i, const F& sum) { image[i] = sum; });
    return image;
}

template <class T, class Policies, class Kernel>
void check(const Policies& policies, const Kernel& kernel, double width) {
    const auto vertices = room<T>();
    const auto map = map_of(vertices);
    const auto deposits = photons<T>(400);
    const DifferentialMap estimate(deposits, map, policies);
    Statistics account;
    const auto image = splatted(map, deposits, policies, account);
    std::vector<Received> expected(vertices.size());
    for (const auto& deposit : deposits) {
        const double p = double(map.spacing_at(deposit.position));
        tests::receive(expected, vertices, deposit, double(deposit.flux), kernel, width * p, p, epsilon<T>);
    }
    double lit = 0;
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const double e = double(estimate(vertices[i].position, vertices[i].normal));
        CAPTURE(i);
        // 400 terms, none negative, added up in two orders, each off by a few roundings of its own.
        REQUIRE(std::abs(e - double(image[i])) <= 512 * epsilon<T> * e);
        REQUIRE(std::abs(e - expected[i].value) <= expected[i].tolerance);
        lit += expected[i].value > 100 * expected[i].tolerance;
    }
    CHECK(lit > 0.5 * double(vertices.size())); // else the tolerance would prove nothing
    // Photons that the splatter counts as unseen are stored here: an estimate may need them later.
    const Statistics& stored = estimate.statistics();
    CHECK(stored[Fate::splatted].photons == account[Fate::splatted].photons + account[Fate::unseen].photons);
    CHECK(stored[Fate::collapsed].photons == account[Fate::collapsed].photons);
    CHECK(stored.bounded_footprints == account.bounded_footprints);
}

} // namespace

TEST_CASE_TEMPLATE("differential map: gathers what the splatter splats and brute force adds up", T, float, double) {
    const double pi = std::numbers::pi;
    SUBCASE("with the pixel filter") {
        check<T>(
            Published{}, [&](double r2) { return 3 / pi * (1 - r2) * (1 - r2); }, std::sqrt(2.0 / 3));
    }
    SUBCASE("without") {
        check<T>(
            Published{}.with_filter(NoPixelFilter{}), [&](double r2) { return 3 / pi * (1 - r2) * (1 - r2); }, 0);
    }
    SUBCASE("with another kernel") {
        check<T>(
            Published{}.with_kernel(EpanechnikovKernel{}), [&](double r2) { return 2 / pi * (1 - r2); },
            std::sqrt(0.5));
    }
}

TEST_CASE_TEMPLATE("differential map: takes any vector", T, float, double) {
    tests::for_each_vector<T>([]<class V>() {
        const auto at = [](double x, double y) { return make_vector<V>(T(x), T(y), 0); };
        std::vector<Vertex<V>> vertices;
        for (int i = 0; i < 100; ++i)
            vertices.push_back({at(0.1 * (i % 10), 0.1 * (i / 10)), make_vector<V>(0, 0, 1)});
        const std::vector<Deposit<V, T>> one{
            {at(0.5, 0.5), make_vector<V>(0, 0, 1), make_vector<V>(0, 0, -1), T(2), {at(1, 0), at(0, 2)}}};
        const DifferentialMap estimate(one, map_of(vertices),
                                       Published{}.with_kernel(EpanechnikovKernel{}).with_filter(NoPixelFilter{}));
        // Semi-axes 1/2 and 1; half way along the first.
        CHECK(double(estimate(at(0.75, 0.5), make_vector<V>(0, 0, 1))) ==
              doctest::Approx(2 / 0.5 * 2 / std::numbers::pi * 0.75));
        CHECK(estimate(at(0.75, 0.5), make_vector<V>(0, 0, -1)) == 0);
        CHECK(estimate(at(1.1, 0.5), make_vector<V>(0, 0, 1)) == 0);
    });
}

TEST_CASE("differential map: is dark without photons and where there is no place") {
    using V = glm::vec3;
    const auto vertices = room<float>();
    const auto map = map_of(vertices);
    const V up{0, 0, 1};
    const float nan = std::numeric_limits<float>::quiet_NaN();
    CHECK(DifferentialMap(std::vector<Deposit<V, float>>{}, map)({0, 0, 0}, up) == 0);
    auto deposits = photons<float>(10);
    deposits[3].d_position[0].x = nan;
    deposits[4].position.y = nan;
    const DifferentialMap estimate(deposits, map);
    CHECK(estimate.statistics()[Fate::invalid].photons == 2);
    CHECK(estimate.statistics()[Fate::splatted].photons == 8);
    CHECK(estimate({nan, 0, 0}, up) == 0);
    CHECK(estimate(deposits[0].position, {0, 0, nan}) == 0);
    const float irradiance = estimate(deposits[0].position, up);
    CHECK(irradiance > 0);
    CHECK(estimate(deposits[0].position, up, [](const V&) { return 2.0f; }) == doctest::Approx(2 * irradiance));
}

TEST_CASE("differential map: is the same bit for bit for any number of threads") {
    const auto vertices = room<float>();
    const auto map = map_of(vertices);
    const auto deposits = photons<float>(3000);
    std::vector<std::vector<float>> images;
    for (const unsigned threads : {1u, 4u}) {
        ThreadExecutor executor(threads);
        const DifferentialMap estimate(deposits, map, Published{}, executor);
        images.emplace_back(vertices.size());
        estimate_at(vertices, &Vertex<glm::vec3>::position, &Vertex<glm::vec3>::normal, estimate, executor,
                    [&](std::size_t i, float e) { images.back()[i] = e; });
    }
    CHECK(images[0] == images[1]);
}

} // namespace nephroid::tests::differential_map_test
