// SPDX-License-Identifier: MIT
#include "nephroid/splat/spectral_splat.hpp"

#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/spectrum/spectral.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/splat/splat_caustics.hpp"
#include "support/vertex.hpp"
#include "transport/prism.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace nephroid::tests::spectral_splat_test {

namespace {

constexpr std::size_t bands = 16;
using V = glm::dvec3;
using Flux16 = Bands<double, bands>;
using Hero = Wavelength<EqualBands<bands>>;

/// A square of the floor, 1 by 1 about the origin.
std::vector<Vertex<V>> floor(int rows) {
    std::vector<Vertex<V>> vertices;
    for (int y = 0; y < rows; ++y)
        for (int x = 0; x < rows; ++x)
            vertices.push_back({{(x + 0.5) / rows - 0.5, (y + 0.5) / rows - 0.5, 0}, {0, 0, 1}});
    return vertices;
}

/// What one band of a picture adds up to: its flux, its mean place, and its variance along x.
struct Moments {
    double flux = 0;
    V mean{};
    double variance = 0;
};
std::array<Moments, bands> moments_of(const Sums<V, Flux16>& sums, const std::vector<Vertex<V>>& vertices) {
    std::array<Moments, bands> moments;
    const double area = 1 / double(vertices.size());
    sums.for_each([&](std::size_t i, const Flux16& e) {
        for (std::size_t b = 0; b < bands; ++b) {
            moments[b].flux += area * e[b];
            moments[b].mean += area * e[b] * vertices[i].position;
            moments[b].variance += area * e[b] * vertices[i].position.x * vertices[i].position.x;
        }
    });
    for (Moments& m : moments) {
        m.mean = (1 / m.flux) * m.mean;
        m.variance = m.variance / m.flux - m.mean.x * m.mean.x;
    }
    return moments;
}

/// One photon's splats.
Statistics splat_one(const Hero& hero, const V& streak, Sums<V, Flux16>& sums) {
    const detail::Splatter splatter(sums, Published{});
    detail::Splatter adding(sums, Published{});
    std::vector<detail::SplatChunk<V, Flux16>> chunks(1);
    Statistics account;
    ++account.emitted.photons;
    account.emitted.add(1);
    const Deposit<V, Flux16, 3> deposit{
        {0, 0.1, 0}, {0, 0, 1}, {0, 0, -1}, Flux16(1), {V{0.12, 0, 0}, V{0, 0.16, 0}, streak}};
    detail::prepare_bands(splatter, deposit, hero, chunks[0], account);
    SerialExecutor executor;
    adding.add({chunks.data(), chunks.size()}, executor);
    return account;
}

/// Where a band of a photon's light lies, by the closed form: linear in λ⁻².
double steps(double from, double to) { return 0.5 * from * (1 - square(from / to)); }

} // namespace

TEST_CASE("band groups: every band is in one group, and they are as many as the streak asks for") {
    const Hero hero{520, {}};
    const double whole = std::abs(hero.steps_to(690.625) - hero.steps_to(409.375)); // between middles of bands
    for (const double apart : {1e9, whole / 2, whole / 5, 1e-9}) {
        std::size_t next = 0, groups = 0;
        detail::for_each_band_group(hero, apart, [&](const detail::BandGroup<EqualBands<bands>>& group) {
            CHECK(group.begin == next);
            CHECK(group.end > group.begin);
            for (std::size_t b = 0; b < bands; ++b)
                CHECK(group.share[b] == double(b >= group.begin && b < group.end));
            const EqualBands<bands> spectrum;
            for (std::size_t b = group.begin; b < group.end; ++b)
                CHECK(std::abs(hero.steps_to(spectrum.wavelength(double(b) + 0.5)) - group.steps) <=
                      0.5 * apart + 1e-12);
            next = group.end;
            ++groups;
        });
        CHECK(next == bands);
        CHECK(groups >= (std::min)(double(bands), whole / apart));
        CHECK(groups <= (std::min)(double(bands), 2 * whole / apart + 1));
    }
}

TEST_CASE("spectral splat: bands that nothing has parted are one splat") {
    const auto vertices = floor(16);
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    auto sums = nephroid::sums<Flux16>(map);
    const detail::Splatter splatter(sums, Published{});
    detail::SplatChunk<V, Flux16> chunk;
    Statistics account;
    const Deposit<V, Flux16, 3> deposit{
        {0, 0.1, 0}, {0, 0, 1}, {0, 0, -1}, Flux16(1), {V{0.12, 0, 0}, V{0, 0.16, 0}, V{0, 0, 0}}};
    detail::prepare_bands(splatter, deposit, Hero{550, {}}, chunk, account);
    CHECK(chunk.splats().size() == 1);
}

// The group's middle is at most half a group from the band, a tenth of the reach. Vertices 1/128 apart: the kernel's
// sums are exact to 10⁻³ of its width.
TEST_CASE("spectral splat: each band lies where the tangent says, as wide as the footprint and the band are together") {
    const auto vertices = floor(128);
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    for (const double stretch : {0.0, 1e-4, 1e-3}) { // world units per nanometre
        CAPTURE(stretch);
        auto sums = nephroid::sums<Flux16>(map);
        const Hero hero{510, {}};
        const Statistics account = splat_one(hero, {stretch, 0, 0}, sums);
        CHECK(account[Fate::splatted].flux == doctest::Approx(1).epsilon(1e-12));
        CHECK(account[Fate::splatted].photons == 1);
        const auto moments = moments_of(sums, vertices);
        const double own = square(0.06) / 8 + square(1.0 / 128) / 12;        // of the biweight, and the pixel's
        const double reach = std::sqrt(square(0.06) + square(0.8165 / 128)); // along the streak
        for (std::size_t b = 0; b < bands; ++b) {
            const double from = 400 + 18.75 * double(b), middle = from + 18.75 / 2;
            CHECK(moments[b].flux == doctest::Approx(1).epsilon(2e-3));
            CHECK(std::abs(moments[b].mean.x - stretch * steps(510, middle)) <= 0.11 * reach);
            CHECK(std::abs(moments[b].mean.y - 0.1) <= 1e-4);
            // Of a group's bands the mean width is taken, and those of the shortest are twice as wide as the longest.
            const double box = stretch * (steps(510, from + 18.75) - steps(510, from));
            CHECK(moments[b].variance == doctest::Approx(own + box * box / 12).epsilon(stretch > 5e-4 ? 0.02 : 0.06));
        }
    }
}

TEST_CASE(
    "spectral splat: bands beyond total reflection get nothing and the others their share of the spectrum's flux") {
    const auto vertices = floor(128);
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    auto sums = nephroid::sums<Flux16>(map);
    Hero hero{600, {}};
    hero.shortest = 550; // the middle of the spectrum
    const Statistics account = splat_one(hero, {2e-4, 0, 0}, sums);
    const auto moments = moments_of(sums, vertices);
    for (std::size_t b = 0; b < bands; ++b)
        CHECK(moments[b].flux == doctest::Approx(b < 8 ? 0 : 2).epsilon(2e-3));
    check_balance(account);

    auto sliver = nephroid::sums<Flux16>(map);
    hero.shortest = hero.longest = 600; // one wavelength alone: its band stands for it
    check_balance(splat_one(hero, {2e-4, 0, 0}, sliver));
    const auto alone = moments_of(sliver, vertices);
    for (std::size_t b = 0; b < bands; ++b)
        CHECK(alone[b].flux == doctest::Approx(b == 10 ? 16 : 0).epsilon(2e-3));
}

TEST_CASE("spectral splat: a streak that is not finite makes the photon invalid") {
    const auto vertices = floor(16);
    const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
    auto sums = nephroid::sums<Flux16>(map);
    const Statistics account = splat_one({500, {}}, {std::numeric_limits<double>::infinity(), 0, 0}, sums);
    CHECK(account[Fate::invalid].photons == 1);
    CHECK(account[Fate::invalid].flux == doctest::Approx(1));
}

namespace {

/// A laser of these bands through the prism to a screen 0.5 behind it: the screen's vertices, and the picture.
struct Screened {
    ThroughPrism exact{1.1028, 0, {}};
    Prism<double, Flux16> prism{};
    Vec<double> across, centre;
    std::vector<Vertex<V>> vertices;

    Screened() {
        const Vec<double> out = exact.direction_out(520);
        prism.add_screen(out, 0.5);
        across = {-out.y, out.x, 0};
        centre = 0.5 * out;
        for (int i = 0; i < 200; ++i)
            for (int j = 0; j < 40; ++j)
                vertices.push_back({centre + (0.0025 * (i - 140.5)) * across + V{0, 0, 0.0025 * (j - 19.5)}, -out});
    }
    /// Irradiance by vertex.
    std::vector<Flux16> picture(std::uint64_t photons, Statistics& account, unsigned threads,
                                std::size_t parts = 1) const {
        const EyePathMap<V> map(vertices, &Vertex<V>::position, &Vertex<V>::normal);
        auto sums = nephroid::sums<Flux16>(map);
        const V in = exact.direction_in();
        const Spectral laser(
            DirectionalLight<V, Flux16>(
                {.direction = in, .irradiance = Flux16(1), .patch = BeamDisk<V>{V{0, -0.05, 0} - 0.1 * in, 0.01}}),
            EqualBands<bands>{}, parts);
        ThreadExecutor executor(threads);
        account = splat_caustics(prism, laser, sums, {.count = photons, .smoothing = 4}, executor);
        std::vector<Flux16> picture(vertices.size());
        sums.for_each([&](std::size_t i, const Flux16& e) { picture[i] = e; });
        return picture;
    }
};

} // namespace

// A band's mean place: the chief ray's, whose place on the screen varies by a third of the band's width within it. To
// first order the tangents miss the streak's bend: the deviation per λ⁻² grows by half over this spectrum, so an
// eighth of the streak at the most where a photon predicts all of it, and 64 times less where it predicts an eighth of
// it.
TEST_CASE("spectral splat: a laser's bands fall through a prism onto a screen where Snell's law sends them") {
    const Screened screened;
    const double streak = 0.5 * std::abs(screened.exact.angle(400) - screened.exact.angle(700));
    std::array<double, 2> worst{};
    for (const std::size_t parts : {1u, 8u}) {
        Statistics account;
        const auto picture = screened.picture(1024, account, 1, parts);
        check_balance(account);
        CHECK(account[Fate::splatted].photons == 1024);
        double power = 0;
        for (std::size_t b = 0; b < bands; ++b) {
            const double wavelength = 400 + 18.75 * (double(b) + 0.5);
            // The chief ray of this wavelength: through both faces by hand.
            const double n = screened.exact.glass.index(wavelength),
                         r = std::asin(std::sin(screened.exact.incident) / n), a = Prism<double>::apex;
            const V inside{std::cos(r), std::sin(r), 0}, from{0, -0.05, 0}, edge{std::cos(a), std::sin(a), 0};
            const V leaves = from + (-dot(from, edge) / dot(inside, edge)) * inside,
                    out = screened.exact.direction_out(wavelength), normal = normalize(screened.centre);
            const V lands = leaves + (dot(V(screened.centre - leaves), normal) / dot(out, normal)) * out;
            double flux = 0, mean = 0;
            for (std::size_t i = 0; i < picture.size(); ++i) {
                flux += picture[i][b];
                mean += picture[i][b] * dot(V(screened.vertices[i].position - screened.centre), screened.across);
            }
            power += flux * square(0.0025);
            const double width = 18.75 * 0.5 * std::abs(screened.exact.angle_slope(wavelength));
            const double error = std::abs(mean / flux - dot(V(lands - screened.centre), screened.across));
            CHECK(error <= 0.34 * width + (parts == 1 ? streak / 8 : streak / 500));
            worst[parts > 1] = (std::max)(worst[parts > 1], error);
        }
        CHECK(power / bands == doctest::Approx(std::numbers::pi * 1e-4).epsilon(0.01));
    }
    CHECK(worst[1] < 0.3 * worst[0]);
}

TEST_CASE("spectral splat: the picture is the same bit for bit with several threads") {
    const Screened screened;
    Statistics account;
    CHECK(screened.picture(600, account, 1) == screened.picture(600, account, 3));
}

} // namespace nephroid::tests::spectral_splat_test
