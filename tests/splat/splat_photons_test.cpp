// SPDX-License-Identifier: MIT
#include "nephroid/splat/splat_photons.hpp"

#include "nephroid/execution/thread_executor.hpp"

#include "support/brute_force.hpp"
#include "support/discard_excess.hpp"
#include "support/is_sanitized.hpp"
#include "support/space.hpp"

#include <doctest/doctest.h>

#include <array>

namespace nephroid::tests::splat_photons_test {

using tests::Draws;
using tests::is_sanitized;
using tests::Received;
using tests::Vertex;

namespace {

template <class T>
using Vec = glm::vec<3, T>;

template <class T>
constexpr double epsilon = double(std::numeric_limits<T>::epsilon());

constexpr double spacing = 1.0 / 32;

template <class V>
EyePathMap<V> map_of(const std::vector<Vertex<V>>& vertices) {
    return EyePathMap<V>(vertices, &Vertex<V>::position, &Vertex<V>::normal);
}

/// A floor, close below it its back, and a wall beside it: vertices that face up, down, and across.
template <class T>
std::vector<Vertex<Vec<T>>> room() {
    std::vector<Vertex<Vec<T>>> vertices;
    tests::add_lattice<T>(vertices, 32, 32, spacing, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    tests::add_lattice<T>(vertices, 32, 32, spacing, {0, 0, -0.001}, {1, 0, 0}, {0, 1, 0}, {0, 0, -1});
    tests::add_lattice<T>(vertices, 32, 32, spacing, {1.25, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0});
    return vertices;
}

/// Photons on the floor, on its back, on the wall, and on planes in between that are tilted at random.
template <class T, class F = T>
std::vector<Deposit<Vec<T>, F>> photons(int count, F flux = F(1)) {
    Draws draw(71);
    std::vector<Deposit<Vec<T>, F>> deposits;
    for (int i = 0; i < count; ++i) {
        Vec<T> n{0, 0, 1}, p{T(draw.in(0, 1)), T(draw.in(0, 1)), 0};
        if (i % 4 == 1)
            n = {0, 0, -1}, p.z = T(-0.001);
        if (i % 4 == 2)
            n = {-1, 0, 0}, p = {T(1.25), T(draw.in(0, 1)), T(draw.in(0, 1))};
        if (i % 4 == 3)
            n = tests::narrow<Vec<T>>(draw.direction()), p.z = T(draw.in(-0.05, 0.05));
        const auto frame = frame_about(n);
        const double size = std::pow(10.0, draw.in(-3, 0));
        const auto in_plane = [&] {
            return Vec<T>(T(draw.in(-size, size)) * frame.u + T(draw.in(-size, size)) * frame.v);
        };
        deposits.push_back({p, n, -n, flux * T(draw.in(0.5, 1)), {in_plane(), in_plane()}});
    }
    return deposits;
}

template <class V, class F, class R>
auto image_of(const Sums<V, F, R>& sums, std::size_t count) {
    std::vector<F> image(count, flux_traits<F>::zero());
    std::vector<int> times(count);
    sums.for_each([&](std::size_t i, const F& sum) {
        image.at(i) = sum;
        ++times[i];
    });
    CHECK(std::all_of(times.begin(), times.end(), [](int n) { return n == 1; }));
    return image;
}

/// Splats in so many chunks at once.
template <class V, class F, class R, class E = SerialExecutor>
void splat_in_chunks(const std::vector<Deposit<V, F>>& deposits, Sums<V, F, R>& sums, std::size_t count,
                     E&& executor = E{}) {
    detail::Splatter splatter(sums, Published{});
    std::vector<detail::SplatChunk<V, F>> chunks(count);
    Statistics unused;
    for (std::size_t i = 0; i < deposits.size(); ++i)
        splatter.prepare(deposits[i], chunks[i * count / deposits.size()], unused);
    splatter.add(std::span<const detail::SplatChunk<V, F>>(chunks), executor);
}

/// The same by brute force, with the spacing that the map reports where each photon landed.
template <class T, class Kernel, class F>
std::vector<Received> expected(const std::vector<Vertex<Vec<T>>>& vertices, const EyePathMap<Vec<T>>& map,
                               const std::vector<Deposit<Vec<T>, F>>& deposits, const Kernel& kernel, double width,
                               double normal_distance = 0.25) {
    std::vector<Received> image(vertices.size());
    for (const auto& deposit : deposits) {
        const double p = double(map.spacing_at(deposit.position));
        tests::receive(image, vertices, deposit, flux_traits<F>::power(deposit.flux), kernel, width * p, p, epsilon<T>,
                       normal_distance);
    }
    return image;
}

template <class F>
void check_image(const std::vector<F>& image, const std::vector<Received>& expected, double scale = 1) {
    double lit = 0;
    for (std::size_t i = 0; i < image.size(); ++i) {
        CAPTURE(i);
        CAPTURE(double(image[i]));
        CAPTURE(expected[i].value * scale);
        REQUIRE(std::abs(double(image[i]) - expected[i].value * scale) <= expected[i].tolerance * scale);
        lit += expected[i].value > 100 * expected[i].tolerance ? 1 : 0;
    }
    CHECK(lit > 0.5 * double(image.size())); // else the tolerance would prove nothing
}

} // namespace

TEST_CASE_TEMPLATE("splat photons: the sums are those of brute force over all vertices", T, float, double) {
    const auto vertices = room<T>();
    const auto map = map_of(vertices);
    const auto deposits = photons<T>(400);
    const double pi = std::numbers::pi;
    const auto biweight = [&](double r2) { return 3 / pi * (1 - r2) * (1 - r2); };
    const auto epanechnikov = [&](double r2) { return 2 / pi * (1 - r2); };
    const auto uniform = [&](double) { return 1 / pi; };
    SUBCASE("with the default policies") {
        auto sums = nephroid::sums<T>(map);
        splat(deposits, sums);
        check_image(image_of(sums, vertices.size()), expected(vertices, map, deposits, biweight, std::sqrt(2.0 / 3)));
    }
    SUBCASE("with another kernel") {
        auto sums = nephroid::sums<T>(map);
        splat(deposits, sums, {}, Published{}.with_kernel(EpanechnikovKernel{}));
        check_image(image_of(sums, vertices.size()), expected(vertices, map, deposits, epanechnikov, std::sqrt(0.5)));
    }
    SUBCASE("with a kernel that jumps at the edge") {
        auto sums = nephroid::sums<T>(map);
        splat(deposits, sums, {}, Published{}.with_kernel(UniformKernel{}));
        check_image(image_of(sums, vertices.size()), expected(vertices, map, deposits, uniform, std::sqrt(1.0 / 3)));
    }
    SUBCASE("with a wider filter and a thicker slab") {
        const Published policies{.filter = {2}, .normal_distance = 1.5};
        auto sums = nephroid::sums<T>(map);
        splat(deposits, sums, {}, policies);
        check_image(image_of(sums, vertices.size()),
                    expected(vertices, map, deposits, biweight, 2 * std::sqrt(2.0 / 3), 1.5));
    }
}

// Floor and back are a thousandth apart, thinner than any slab: what counts is which way they face.
TEST_CASE_TEMPLATE("splat photons: a vertex that faces away receives nothing", T, float, double) {
    const auto vertices = room<T>();
    const auto map = map_of(vertices);
    const Vec<T> up{0, 0, 1}, a{T(0.3), 0, 0}, b{0, T(0.3), 0};
    for (const T side : {T(1), T(-1)}) {
        auto sums = nephroid::sums<T>(map);
        splat(std::vector<Deposit<Vec<T>, T>>{{{T(0.5), T(0.5), 0}, side * up, -side * up, T(1), {a, b}}}, sums);
        const auto image = image_of(sums, vertices.size());
        double floor = 0, back = 0, wall = 0;
        for (std::size_t i = 0; i < 1024; ++i)
            floor += double(image[i]), back += double(image[1024 + i]), wall += double(image[2048 + i]);
        CHECK((side > 0 ? floor : back) * spacing * spacing == doctest::Approx(1).epsilon(0.01));
        CHECK((side > 0 ? back : floor) == 0);
        CHECK(wall == 0);
    }
}

// One leaf whose vertices face every way: each is asked on its own.
TEST_CASE_TEMPLATE("splat photons: in a leaf of mixed normals each vertex is checked", T, float, double) {
    Draws draw(72);
    std::vector<Vertex<Vec<T>>> vertices;
    for (int i = 0; i < 61; ++i) // not a multiple of the lanes
        vertices.push_back({{T(draw.in(0, 1)), T(draw.in(0, 1)), 0}, tests::narrow<Vec<T>>(draw.direction())});
    const auto map = map_of(vertices);
    REQUIRE(map.tree().leaves().size() == 1);
    for (int i = 0; i < 20; ++i) {
        const auto n = tests::narrow<Vec<T>>(draw.direction());
        const auto [u, v] = frame_about(n);
        auto sums = nephroid::sums<T>(map);
        splat(std::vector<Deposit<Vec<T>, T>>{{{T(0.5), T(0.5), 0}, n, -n, T(1), {T(4) * u, T(4) * v}}}, sums, {},
              Published{.normal_distance = 2}); // so that all are near enough
        const auto image = image_of(sums, vertices.size());
        for (std::size_t k = 0; k < vertices.size(); ++k)
            CHECK((image[k] > T(0)) == (dot(vertices[k].normal, n) > T(0)));
    }
}

TEST_CASE_TEMPLATE("splat photons: a vertex off the tangent plane receives nothing", T, float, double) {
    std::vector<Vertex<Vec<T>>> vertices;
    for (int layer = 0; layer < 20; ++layer) // stairs of a hundredth
        tests::add_lattice<T>(vertices, 8, 8, 0.125, {0, 0, 0.01 * layer}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const auto map = map_of(vertices);
    const Vec<T> up{0, 0, 1};
    // A fifth of the minor radius, 0.5; the vertices are less than a tenth apart.
    REQUIRE(double(map.spacing_at({T(0.4375), T(0.4375), 0})) < 0.1);
    const auto policies = Published{.normal_distance = 0.21}.with_filter(NoPixelFilter{});
    auto sums = nephroid::sums<T>(map);
    splat(std::vector<Deposit<Vec<T>, T>>{{{T(0.4375), T(0.4375), 0}, up, -up, T(1), {Vec<T>{2, 0, 0}, {0, 1, 0}}}},
          sums, {}, policies);
    const auto image = image_of(sums, vertices.size());
    for (std::size_t layer = 0; layer < 20; ++layer)
        CHECK((image[64 * layer + 27] > T(0)) == (0.01 * double(layer) < 0.105)); // the step nearest to the middle
}

namespace {

/// A glossy BRDF with a texture: depends on the vertex and on where the light comes from.
struct Gloss {
    float operator()(std::size_t vertex, const glm::vec3& direction) const {
        return (1 + float(vertex % 7)) * (direction.z * direction.z);
    }
};
struct Tint {
    glm::vec3 operator()(std::size_t vertex, const glm::vec3&) const { return {1, float(vertex % 2), 0}; }
};

} // namespace

TEST_CASE("splat photons: a response weighs each photon by vertex and direction") {
    const auto vertices = room<float>();
    const auto map = map_of(vertices);
    auto deposits = photons<float>(200);
    Draws draw(73);
    auto sums = nephroid::sums<float>(map, Gloss{});
    std::vector<Received> expected(vertices.size());
    for (auto& deposit : deposits) {
        deposit.direction = tests::narrow<glm::vec3>(draw.direction());
        std::vector<Received> one(vertices.size());
        const double p = double(map.spacing_at(deposit.position)), pi = std::numbers::pi;
        tests::receive(
            one, vertices, deposit, double(deposit.flux), [&](double r2) { return 3 / pi * (1 - r2) * (1 - r2); },
            std::sqrt(2.0 / 3) * p, p, epsilon<float>);
        for (std::size_t i = 0; i < one.size(); ++i) {
            const double response = double(Gloss{}(i, deposit.direction));
            expected[i].value += response * one[i].value;
            expected[i].tolerance += response * one[i].tolerance;
        }
    }
    splat(deposits, sums);
    check_image(image_of(sums, vertices.size()), expected);
}

// Three bands do what three fluxes do: each is the same product and sum, bit for bit unless a compiler fuses some of
// them. 100 photons round 100 times then.
TEST_CASE("splat photons: colours are summed band by band") {
    const auto vertices = room<float>();
    const auto map = map_of(vertices);
    const auto grey = photons<float>(100);
    std::vector<Deposit<glm::vec3, glm::vec3>> coloured;
    for (const auto& d : grey)
        coloured.push_back({d.position, d.normal, d.direction, {d.flux, 2 * d.flux, 0}, d.d_position});
    auto one = nephroid::sums<float>(map);
    auto three = nephroid::sums<glm::vec3>(map);
    auto tinted = nephroid::sums<glm::vec3>(map, Tint{});
    splat(grey, one);
    const Statistics account = splat(coloured, three);
    splat(coloured, tinted);
    const auto grey_image = image_of(one, vertices.size());
    const auto image = image_of(three, vertices.size()), tinted_image = image_of(tinted, vertices.size());
#if defined(__FMA__)
    const double roundings = 100 * epsilon<float>;
#else
    const double roundings = 0;
#endif
    const auto is_close = [&](const glm::vec3& a, const glm::vec3& b) {
        return double(length(a - b)) <= roundings * double(length(b));
    };
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        REQUIRE(is_close(image[i], {grey_image[i], 2 * grey_image[i], 0}));
        REQUIRE(is_close(tinted_image[i], {grey_image[i], i % 2 == 1 ? 2 * grey_image[i] : 0, 0}));
    }
    double power = 0;
    for (const auto& d : coloured)
        power += flux_traits<glm::vec3>::power(d.flux);
    CHECK(account.accounted_flux() == doctest::Approx(power).epsilon(1e-12));
}

// The order of summation is that of the photons, however they are cut into chunks and calls.
TEST_CASE_TEMPLATE("splat photons: the sums do not depend on chunks or calls", T, float, double) {
    const auto vertices = room<T>();
    const auto map = map_of(vertices);
    const auto deposits = photons<T>(300);
    auto reference = nephroid::sums<T>(map);
    splat_in_chunks(deposits, reference, 1);
    const auto image = image_of(reference, vertices.size());
    for (const std::size_t chunks : {300u, 43u, 5u}) {
        auto sums = nephroid::sums<T>(map);
        splat_in_chunks(deposits, sums, chunks);
        CHECK(image_of(sums, vertices.size()) == image);
        // Cleared, it starts anew; in two calls.
        sums.clear();
        CHECK(image_of(sums, vertices.size()) == std::vector<T>(vertices.size()));
        splat(std::span(deposits).first(111), sums);
        splat(std::span(deposits).subspan(111), sums);
        CHECK(image_of(sums, vertices.size()) == image);
    }
}

TEST_CASE("splat photons: several threads give the same sums bit for bit") {
    const auto vertices = room<float>();
    const auto map = map_of(vertices);
    const auto deposits = photons<float>(300);
    std::vector<std::vector<float>> images;
    for (const unsigned threads : {1u, 2u, 7u}) {
        ThreadExecutor executor(threads);
        auto sums = nephroid::sums<float>(map);
        splat(deposits, sums, {}, executor);
        images.push_back(image_of(sums, vertices.size()));
    }
    CHECK(images[1] == images[0]);
    CHECK(images[2] == images[0]);
}

// More than 32,768 leaves, which then are in groups of more than four. Against the sums of one chunk after another.
TEST_CASE("splat photons: several threads sum a map of many leaves bit for bit" * doctest::skip(is_sanitized)) {
    using V = glm::vec3;
    constexpr std::size_t side = 1500;
    std::vector<Vertex<V>> vertices;
    tests::add_lattice<float>(vertices, side, side, 1.0 / side, {0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const auto map = map_of(vertices);
    CHECK(map.tree().leaves().size() > 32768);
    Draws draw(72);
    std::vector<Deposit<V, float>> deposits;
    for (int i = 0; i < 4000; ++i)
        deposits.push_back({{float(draw.in(0, 1)), float(draw.in(0, 1)), 0},
                            {0, 0, 1},
                            {0, 0, -1},
                            1,
                            {V(draw.in(0.005, 0.03), 0, 0), V(draw.in(-0.01, 0.01), draw.in(0.005, 0.03), 0)}});
    auto reference = nephroid::sums<float>(map);
    splat_in_chunks(deposits, reference, 1);
    const auto image = image_of(reference, vertices.size());
    CHECK(std::count(image.begin(), image.end(), 0.0f) < std::ptrdiff_t(image.size() / 2));
    ThreadExecutor threads(3);
    for (const std::size_t count : {5u, 17u, 64u}) {
        auto sums = nephroid::sums<float>(map);
        splat_in_chunks(deposits, sums, count, threads);
        CAPTURE(count);
        CHECK(image_of(sums, vertices.size()) == image);
    }
}

TEST_CASE_TEMPLATE("splat photons: books the fate of each photon", T, float, double) {
    const auto vertices = room<T>();
    const auto map = map_of(vertices);
    const Vec<T> up{0, 0, 1}, centre{T(0.5), T(0.5), 0}, a{T(0.1), 0, 0}, b{0, T(0.1), 0}, zero{0, 0, 0};
    const std::vector<Deposit<Vec<T>, T>> deposits{
        {centre, up, -up, T(1), {a, b}},                // splatted
        {{T(50), T(50), T(50)}, up, -up, T(2), {a, b}}, // unseen
        {centre, up, -up, T(4), {a, zero}},             // collapsed, without a filter
        {centre, up, -up, T(8), {T(1e4) * a, b}},       // excessive
        {centre, up, -up, T(16), {T(NAN) * a, b}},      // invalid
    };
    auto sums = nephroid::sums<T>(map);
    const Statistics account =
        splat(deposits, sums, {}, Published{}.with_filter(NoPixelFilter{}).with_excess(tests::DiscardExcess{}));
    CHECK(account[Fate::splatted].flux == 1);
    CHECK(account[Fate::unseen].flux == 2);
    CHECK(account[Fate::collapsed].flux == 4);
    CHECK(account[Fate::excessive].flux == 8);
    CHECK(account[Fate::invalid].flux == 16);
    CHECK(account.accounted_flux() == 31);
    CHECK(account.caustic_photons() == 4);
    CHECK(account.bounded_footprints == 0);

    // With the default policies nothing is discarded that has a position, and what is changed is counted.
    auto keeps = nephroid::sums<T>(map);
    const Statistics kept = splat(deposits, keeps);
    CHECK(kept[Fate::splatted].flux == 13);
    CHECK(kept[Fate::collapsed].photons == 0);
    CHECK(kept[Fate::excessive].photons == 0);
    CHECK(kept.bounded_footprints == 1);
    for (const T sum : image_of(keeps, vertices.size()))
        CHECK(isfinite(sum));
}

TEST_CASE_TEMPLATE("splat photons: on an empty map every photon is unseen", T, float, double) {
    const std::vector<Vertex<Vec<T>>> nothing;
    const auto map = map_of(nothing);
    auto sums = nephroid::sums<T>(map);
    const auto deposits = photons<T>(50);
    const Statistics account = splat(deposits, sums);
    CHECK(account[Fate::unseen].photons + account[Fate::collapsed].photons == 50);
    CHECK(account[Fate::unseen].photons >= 49);
    CHECK(image_of(sums, 0).empty());
}

// Distances across a needle overflow at a far vertex, and their difference would be no number.
TEST_CASE_TEMPLATE("splat photons: the thinnest needle makes no vertex NaN", T, float, double) {
    std::vector<Vertex<Vec<T>>> vertices;
    tests::add_lattice<T>(vertices, 8, 8, 1e4, {-35000, -35000, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1});
    const auto map = map_of(vertices);
    auto sums = nephroid::sums<T>(map);
    const Vec<T> up{0, 0, 1}, diagonal{1, 1, 0}, across{-1, 1, 0};
    for (const T width : {T(1e-30), T(1e-34), T(1e-36), (std::numeric_limits<T>::min)() * 8})
        splat(std::vector<Deposit<Vec<T>, T>>{{{1, 2, 0}, up, -up, T(1), {diagonal, width * across}},
                                              {{1, 2, 0}, up, -up, T(1), {width * diagonal, width * across}}},
              sums, {}, Published{}.with_filter(NoPixelFilter{}));
    for (const T sum : image_of(sums, vertices.size()))
        CHECK(isfinite(sum));
}

TEST_CASE("splat photons: rescaling multiplies tangents and fluxes") {
    const auto vertices = room<float>();
    const auto map = map_of(vertices);
    auto deposits = photons<float>(100);
    auto sums = nephroid::sums<float>(map), expected = nephroid::sums<float>(map);
    splat(deposits, sums, {.smoothing = 4, .flux = 0.5});
    for (auto& deposit : deposits) {
        deposit.flux *= 0.5f;
        for (glm::vec3& tangent : deposit.d_position)
            tangent *= 4.0f;
    }
    splat(deposits, expected);
    CHECK(image_of(sums, vertices.size()) == image_of(expected, vertices.size()));
}

TEST_CASE("splat photons: an invalid rescaling is refused") {
    const auto vertices = room<float>();
    const auto map = map_of(vertices);
    const auto deposits = photons<float>(4);
    auto sums = nephroid::sums<float>(map);
    CHECK_THROWS_WITH_AS(splat(deposits, sums, {.smoothing = 0}),
                         "nephroid::splat: smoothing is 0; it must be positive and finite", std::invalid_argument);
    CHECK_THROWS_WITH_AS(splat(deposits, sums, {.flux = -1}), "nephroid::splat: flux is -1; it must not be negative",
                         std::invalid_argument);
}

} // namespace nephroid::tests::splat_photons_test
