// SPDX-License-Identifier: MIT
#include "nephroid/quality/spectrum.hpp"

#include "nephroid/execution/thread_executor.hpp"
#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <array>
#include <limits>
#include <vector>

namespace nephroid::tests::spectrum_test {

namespace {

using Points = std::vector<std::array<double, 2>>;

[[nodiscard]] Points random_points(std::size_t count, std::uint64_t seed) {
    const RandomSequence random(seed);
    Points points;
    for (std::size_t i = 0; i < count; ++i)
        points.push_back({random.sample<double>(i, 0), random.sample<double>(i, 1)});
    return points;
}

/// One point in each of n × n cells, in its middle (jitter 0) to anywhere in it (jitter 1).
[[nodiscard]] Points grid(int n, double jitter, std::uint64_t seed) {
    const RandomSequence random(seed);
    Points points;
    for (int i = 0; i < n; ++i)
        for (int j = 0; j < n; ++j) {
            const double u = random.sample<double>(static_cast<std::uint64_t>(i * n + j), 0) - 0.5;
            const double v = random.sample<double>(static_cast<std::uint64_t>(i * n + j), 1) - 0.5;
            points.push_back({(i + 0.5 + jitter * u) / n, (j + 0.5 + jitter * v) / n});
        }
    return points;
}

[[nodiscard]] double sinc(double x) { return x == 0 ? 1 : std::sin(std::numbers::pi * x) / (std::numbers::pi * x); }

} // namespace

// A periodogram of random points is exponential at each frequency, up to terms of order 1/N: the mean of n frequencies
// and M sets has the standard deviation 1/sqrt(n M); their sample variance has sqrt((2 + 6/M)/n)/M, so their quotient
// by the mean² about the same. Five of them: less than one annulus in a million would miss by chance.
TEST_CASE("PowerSpectrum: white noise has power 1 and an anisotropy of one over the number of sets") {
    for (const std::size_t sets : {std::size_t(1), std::size_t(8)}) {
        PowerSpectrum spectrum(50);
        for (std::size_t set = 0; set < sets; ++set)
            spectrum.add(random_points(1000, 10 + set));
        CHECK(spectrum.sets() == sets);
        const double m = static_cast<double>(sets);
        const auto annuli = spectrum.radial();
        REQUIRE(annuli.size() == 49);
        std::size_t outliers = 0;
        for (const Annulus& annulus : annuli) {
            const double n = static_cast<double>(annulus.frequencies);
            outliers += std::abs(annulus.power - 1) > 5 / std::sqrt(n * m);
            outliers += n > 50 && std::abs(annulus.anisotropy * m - 1) > 5 * std::sqrt((2 + 6 / m) / n);
        }
        CHECK(outliers == 0);
        CHECK(std::abs(spectrum.band_power(0, 50) - 1) < 5 / std::sqrt(std::numbers::pi / 2 * 2500 * m));
    }
}

// Integer frequencies other than 0 are the zeros of the square's own transform, so only what varies in a cell is left:
// E P = 1 - sinc²(fx/n) sinc²(fy/n) for cells of side 1/n; where fx and fy are multiples of n that is 1 as well.
TEST_CASE("PowerSpectrum: a jittered grid has the spectrum that the cells' sinc gives") {
    const int n = 24, sets = 16;
    PowerSpectrum spectrum(48);
    for (std::uint64_t set = 0; set < sets; ++set)
        spectrum.add(grid(n, 1, 100 + set));
    double worst = 0;
    for (int annulus = 2; annulus < 48; ++annulus) {
        double found = 0, expected = 0, variance = 0;
        for (int i = 0; i <= 48; ++i)
            for (int j = i == 0 ? 1 : -48; j <= 48; ++j)
                if (std::lround(std::hypot(i, j)) == annulus) {
                    const double s = sinc(double(i) / n) * sinc(double(j) / n), mean = 1 - s * s;
                    found += spectrum.power(i, j);
                    expected += mean;
                    variance += mean * mean / sets;
                }
        worst = (std::max)(worst, std::abs(found - expected) / std::sqrt(variance));
    }
    CHECK(worst < 5); // standard deviations, of 46 annuli
    // Near zero that is π²|f|²/(3n²), 0.103 on average over |f| < 6, where |f|² is 18 on average; known to 7%.
    CHECK(std::abs(spectrum.band_power(0, 6) - 0.103) < 0.02);
}

// Its cells' middles cancel but at multiples of n along both axes, where all N = n² are in phase: P = N.
TEST_CASE("PowerSpectrum: a grid has its points' number at multiples of its own frequency and nothing elsewhere") {
    const int n = 16;
    PowerSpectrum spectrum(40);
    spectrum.add(grid(n, 0, 1));
    double peaks = 0, rest = 0;
    for (int i = -40; i <= 40; ++i)
        for (int j = -40; j <= 40; ++j)
            if (i * i + j * j <= 1600 && (i != 0 || j != 0)) {
                const bool is_peak = i % n == 0 && j % n == 0;
                double& worst = is_peak ? peaks : rest;
                worst = (std::max)(worst, std::abs(spectrum.power(i, j) - (is_peak ? n * n : 0)));
            }
    CHECK(peaks < 1e-3); // 256 ± 256 * 2 * 1e-6
    CHECK(rest < 1e-9);  // (1e-7 sqrt(256))² / 256, with room
    CHECK(spectrum.power(0, 0) == doctest::Approx(n * n));
    CHECK(spectrum.power(41, 0) == 0);
    CHECK(std::isinf(decibels(0)));
}

// A hexagonal packing of spacing d has its reciprocal lattice's shortest vectors at 2/(√3 d), and N = 2/(√3 d²).
// With rows that are 4/7 of √3/2 times as far apart as points in a row it is periodic but for 1%.
TEST_CASE("PowerSpectrum: the first peak of a hexagonal packing lies at its principal frequency") {
    const int columns = 28, rows = 32;
    Points points;
    for (int row = 0; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            points.push_back({(column + 0.5 * (row % 2)) / columns, double(row) / rows});
    PowerSpectrum spectrum(50);
    spectrum.add(points);
    const auto annuli = spectrum.radial();
    const auto first = std::ranges::find_if(annuli, [](const Annulus& annulus) { return annulus.power > 1e-3; });
    REQUIRE(first != annuli.end());
    CHECK(std::abs(first->frequency - principal_frequency(columns * rows)) < 0.5 + 0.01 * first->frequency);
}

TEST_CASE("PowerSpectrum: one point has power 1 at every frequency and no anisotropy") {
    PowerSpectrum spectrum(20);
    spectrum.add(Points{{0.3, 0.7}});
    for (const Annulus& annulus : spectrum.radial()) {
        CHECK(std::abs(annulus.power - 1) < 1e-6);
        CHECK(annulus.anisotropy < 1e-12);
    }
}

TEST_CASE("PowerSpectrum: the plane is periodic and sets are averaged each by its own number of points") {
    PowerSpectrum inside(12), outside(12);
    inside.add(Points{{0.25, 0.5}, {0.75, 0.125}});
    outside.add(std::vector<std::array<float, 2>>{{-3.75f, 2.5f}, {0.75f, -0.875f}});
    CHECK(inside.power(3, -5) == outside.power(3, -5));
    CHECK(inside.power(-3, 5) == inside.power(3, -5));

    const double before = inside.power(3, -5);
    inside.add(Points{{0.5, 0.5}});
    CHECK(inside.power(3, -5) == doctest::Approx((before + 1) / 2));
}

// Cut out of a grid that the square does not fit, the border shows at all frequencies; faded out, near the peaks alone.
TEST_CASE("PowerSpectrum: a Hann window keeps a cut from spreading the peaks") {
    Points cut;
    for (const auto& [x, y] : grid(23, 0, 1))
        if (x > 0.1 && x < 0.95 && y > 0.1 && y < 0.95)
            cut.push_back({(x - 0.1) / 0.85, (y - 0.1) / 0.85});
    PowerSpectrum plain(16), faded(16);
    plain.add(cut);
    PowerSpectrum hann(16, SpectralWindow::hann);
    hann.add(cut);
    CHECK(plain.band_power(3, 14) > 0.01);
    CHECK(hann.band_power(3, 14) < 1e-3 * plain.band_power(3, 14));

    // The window's own peak, where four in nine of the weights' square sum lie at f = 0, is not low-frequency noise.
    CHECK(hann.power(1, 0) > 1);
    CHECK(hann.band_power(0.5, 2.5) < 1e-3);
    CHECK(std::isnan(hann.band_power(0.5, 1.5)));

    PowerSpectrum white(40, SpectralWindow::hann);
    for (std::uint64_t set = 0; set < 8; ++set)
        white.add(random_points(400, 200 + set));
    // Normalised by the squared weights' sum. Neighbours' amplitudes are correlated by 2/3, the next by 1/6, along
    // either axis: the sum of the squares is 1.94² = 3.8, so four frequencies count as one.
    CHECK(std::abs(white.band_power(3, 40) - 1) < 5 * std::sqrt(4 / (std::numbers::pi / 2 * 1600 * 8)));
}

TEST_CASE("PowerSpectrum: is the same for any number of threads") {
    const Points points = random_points(300, 5);
    PowerSpectrum alone(30), together(30);
    ThreadExecutor threads(3);
    alone.add(points);
    together.add(points, threads);
    bool same = true;
    for (int i = -30; i <= 30; ++i)
        for (int j = -30; j <= 30; ++j)
            same = same && alone.power(i, j) == together.power(i, j);
    CHECK(same);
}

TEST_CASE("PowerSpectrum: a wrong call is refused with the value that is wrong") {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    PowerSpectrum spectrum(4);
    CHECK_THROWS_WITH_AS(spectrum.add(Points{}), "nephroid::PowerSpectrum: 0 points that count; a spectrum needs one",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(spectrum.add(Points{{0, 0}, {0.5, nan}}),
                         "nephroid::PowerSpectrum: point 1 is at (0.500000, nan), it must be finite",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(PowerSpectrum(4, SpectralWindow::hann).add(Points{{0.5, 1.5}}),
                         "nephroid::PowerSpectrum: point 0 is at (0.500000, 1.500000), it must be in the unit square",
                         std::invalid_argument);
    CHECK_THROWS_WITH_AS(PowerSpectrum(0),
                         "nephroid::PowerSpectrum: the highest frequency is 0; it must be 1 to 8192 cycles per side",
                         std::invalid_argument);
    CHECK_THROWS_AS(PowerSpectrum(8193), std::invalid_argument);
    CHECK(spectrum.sets() == 0);
    CHECK(spectrum.power(1, 1) == 0);
    CHECK(std::isnan(spectrum.band_power(0, 4)));
    CHECK(std::isnan(spectrum.band_power(0, 0.5)));
}

} // namespace nephroid::tests::spectrum_test
