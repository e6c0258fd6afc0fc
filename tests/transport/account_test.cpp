// SPDX-License-Identifier: MIT
#include "nephroid/transport/account.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <string>

namespace nephroid::tests::account_test {

namespace {

/// Numbers that are all different, so that a forgotten one shows.
Statistics counted(double from) {
    Statistics s;
    s.emitted = {std::uint64_t(from), from + 0.5};
    for (std::size_t i = 0; i < fate_count; ++i)
        s.fates[i] = {std::uint64_t(from) + i + 1, from + 2.0 * double(i)};
    s.rays = std::uint64_t(from) + 20;
    s.specular_events = std::uint64_t(from) + 21;
    s.corrected_normals = std::uint64_t(from) + 22;
    s.bounded_footprints = std::uint64_t(from) + 23;
    return s;
}

} // namespace

TEST_CASE("statistics: start from nothing") {
    const Statistics nothing;
    CHECK(nothing.accounted_flux() == 0);
    CHECK(nothing.emitted.photons == 0);
    CHECK(nothing.caustic_photons() == 0);
}

TEST_CASE("statistics: every number is summed up") {
    Statistics sum = counted(100);
    sum += counted(2000);
    CHECK(sum.emitted.photons == 2100);
    CHECK(sum.emitted.flux == 2101);
    for (std::size_t i = 0; i < fate_count; ++i) {
        CHECK(sum.fates[i].photons == 2100 + 2 * (i + 1));
        CHECK(sum.fates[i].flux == 2100 + 4.0 * double(i));
    }
    CHECK(sum.rays == 2140);
    CHECK(sum.specular_events == 2142);
    CHECK(sum.corrected_normals == 2144);
    CHECK(sum.bounded_footprints == 2146);
}

TEST_CASE("statistics: an end counts the photon and its flux and a loss the flux alone") {
    Statistics s;
    s.end(Fate::escaped, 0.5);
    s.lose(Fate::escaped, 0.25);
    CHECK(s[Fate::escaped].photons == 1);
    CHECK(s[Fate::escaped].flux == 0.75);
    CHECK(s.accounted_flux() == 0.75);
}

TEST_CASE("statistics: caustic photons are those that reached a diffuse surface through a specular one") {
    Statistics s;
    std::uint64_t count = 1;
    for (std::size_t i = 0; i < fate_count; ++i, count *= 10)
        s.fates[i].photons = count;
    // splatted 1, unseen 10, collapsed 10^6, excessive 10^7; not direct, absorbed, escaped, terminated, invalid.
    CHECK(s.caustic_photons() == 11000011);
}

TEST_CASE("fates: have as many names as there are and each its own") {
    CHECK(fate_count == std::size_t(Fate::invalid) + 1);
    CHECK(fate_names[std::size_t(Fate::splatted)] == std::string("splatted"));
    CHECK(fate_names[std::size_t(Fate::unseen)] == std::string("unseen"));
    CHECK(fate_names[std::size_t(Fate::direct)] == std::string("direct"));
    CHECK(fate_names[std::size_t(Fate::absorbed)] == std::string("absorbed"));
    CHECK(fate_names[std::size_t(Fate::escaped)] == std::string("escaped"));
    CHECK(fate_names[std::size_t(Fate::terminated)] == std::string("terminated"));
    CHECK(fate_names[std::size_t(Fate::collapsed)] == std::string("collapsed"));
    CHECK(fate_names[std::size_t(Fate::excessive)] == std::string("excessive"));
    CHECK(fate_names[std::size_t(Fate::invalid)] == std::string("invalid"));
}

// A plain sum of ten million tenths is off by 1e-10 of it, as its additions err alike for as long as the sum stays
// within a power of two; what is left to a compensated one is a rounding of each of its 1000 parts and of the result.
// Ten million times the double nearest to 0.1 has 53 + 24 bits: the product is rounded once.
TEST_CASE("statistics: millions of photons lose no flux to rounding") {
    const double each = 0.1, rounding = std::numeric_limits<double>::epsilon();
    const int chunks = 1000, per_chunk = 10'000;
    Statistics whole;
    double plain = 0;
    for (int chunk = 0; chunk < chunks; ++chunk) {
        Statistics part;
        for (int i = 0; i < per_chunk; ++i) {
            part.end(Fate::splatted, each);
            plain += each;
        }
        whole += part;
    }
    const double exact = each * (double(chunks) * per_chunk);
    CHECK(whole[Fate::splatted].photons == std::uint64_t(chunks) * per_chunk);
    CHECK(std::abs(whole[Fate::splatted].flux - exact) <= 2 * rounding * exact);
    CHECK(std::abs(plain - exact) > 100 * rounding * exact); // else this would prove nothing
}

} // namespace nephroid::tests::account_test
