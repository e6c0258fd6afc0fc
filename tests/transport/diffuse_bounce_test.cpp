// SPDX-License-Identifier: MIT
#include "nephroid/transport/diffuse_bounce.hpp"

#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/without_tangents.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/transport/walk.hpp"

#include "bounce/closed_rooms.hpp"
#include "transport/tiny_scenes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <optional>
#include <vector>

namespace nephroid::tests::diffuse_bounce_test {

/// Of two bands, with no more than a flux needs.
struct Spectrum {
    float a, b;

    friend Spectrum operator+(const Spectrum& x, const Spectrum& y) { return {x.a + y.a, x.b + y.b}; }
    friend Spectrum operator*(const Spectrum& x, const Spectrum& y) { return {x.a * y.a, x.b * y.b}; }
    friend Spectrum operator*(const Spectrum& x, float s) { return {x.a * s, x.b * s}; }
};

} // namespace nephroid::tests::diffuse_bounce_test

template <>
struct nephroid::flux_traits<nephroid::tests::diffuse_bounce_test::Spectrum> {
    using Spectrum = nephroid::tests::diffuse_bounce_test::Spectrum;
    static double power(const Spectrum& s) { return (double(s.a) + double(s.b)) / 2; }
    static Spectrum zero() { return {0, 0}; }
};

namespace nephroid::tests::diffuse_bounce_test {

using D = glm::dvec3;
using Landed = Deposit<D, double, 0>;

namespace {

/// All deposits of photons, and how many bounces were behind each.
struct Everything {
    static constexpr bool follows_bounces = true;
    static constexpr bool wants_direct_light = true;
    std::vector<Landed> deposits{};
    std::vector<unsigned> bounces{};

    void deposit(const Landed& deposit, const WalkedPath<>& path) {
        deposits.push_back(deposit);
        bounces.push_back(path.diffuse_bounces);
    }
};
struct AllButDirect : Everything {
    static constexpr bool wants_direct_light = false;
};

template <class S, class L, class Visitor>
Statistics follow(const S& scene, const L& lamp, std::uint64_t photons, Visitor& visitor,
                  const WalkLimits& limits = {}) {
    const RandomSequence random(5);
    Statistics account;
    for (std::uint64_t i = 0; i < photons; ++i) {
        Sampler<RandomSequence> sampler(random, i);
        const auto photon = WithoutTangents(lamp).emit(sampler, {typename L::T(photons), 1});
        walk(scene, photon, sampler, limits, account, visitor);
    }
    return account;
}

/// In a sphere of radius 1, with an off-centre lamp of flux 1.
[[nodiscard]] PointLight<D, double> lamp_in_sphere() {
    return PointLight<D, double>({{0.5, 0.3, -0.2}, 1 / (4 * std::numbers::pi)});
}

/// Of two bands: a red and a green wall.
using Bands = glm::dvec3;
[[nodiscard]] Room<double, Bands> coloured_room() {
    auto walls = box_walls<double, Bands>(Bands(0.7));
    walls[0].albedo = {0.6, 0.1, 0.1};
    walls[1].albedo = {0.1, 0.5, 0.2};
    return {walls};
}
struct Count {
    static constexpr bool follows_bounces = true;
    std::uint64_t seen = 0;
    void deposit(const Deposit<D, Bands, 0>&, const WalkedPath<>& path) { seen += path.diffuse_bounces > 0; }
};

/// A room as a renderer writes it whose surfaces are grey: the weight is a number, and the light a spectrum that cannot
/// be made from one.
struct GreyRoom {
    struct Scattered {
        Event event;
        float weight, eta;
    };
    Room<float> room{box_walls<float, float>(0.5f)};

    [[nodiscard]] auto intersect(const glm::vec3& o, const glm::vec3& d, float t_min, float t_max) const {
        return room.intersect(o, d, t_min, t_max);
    }
    template <class Sampler>
    [[nodiscard]] Scattered scatter(const Room<float>::Hit& hit, const glm::vec3&, Sampler&) const {
        return {room.walls[hit.surface].event, room.walls[hit.surface].albedo, 1};
    }
};
struct CountSpectra {
    static constexpr bool follows_bounces = true;
    std::uint64_t seen = 0;
    void deposit(const Deposit<glm::vec3, Spectrum, 0>&, const WalkedPath<>&) { ++seen; }
};

/// A room whose shading normals are not unit, or not numbers.
struct BadNormals : Room<double> {
    double scale;
    [[nodiscard]] std::optional<Hit> intersect(const D& o, const D& d, double t_min, double t_max) const {
        auto hit = Room<double>::intersect(o, d, t_min, t_max);
        if (hit)
            hit->shading_normal *= scale;
        return hit;
    }
};

[[nodiscard]] double sum_of_fates(const Statistics& account) { return account.accounted_flux(); }

} // namespace

// cos cos'/(π t²) is 1/(4π r²) between any two points of a sphere: wherever a photon comes from, each bounce lands
// evenly and independently. χ² of 80 cells of one area has a mean of 79 and a deviation of √158; five of these.
TEST_CASE("diffuse bounce: in a sphere photons land evenly, wherever the lamp is") {
    Everything visitor;
    follow(SphereRoom<double>{1, 0.8}, lamp_in_sphere(), 5000, visitor);
    std::vector<double> cells(80, 0);
    double landed = 0;
    for (std::size_t i = 0; i < visitor.deposits.size(); ++i)
        if (visitor.bounces[i] > 0) {
            const D p = visitor.deposits[i].position;
            const int belt = std::min(7, int((p.z + 1) / 2 * 8));
            const int sector = std::min(9, int((std::atan2(p.y, p.x) / (2 * std::numbers::pi) + 0.5) * 10));
            ++cells[std::size_t(belt * 10 + sector)];
            ++landed;
        }
    double chi2 = 0;
    for (const double n : cells)
        chi2 += square(n - landed / 80) / (landed / 80);
    CHECK(std::abs(chi2 - 79) < 5 * std::sqrt(2 * 79.0));
    // ρ/(1 − ρ) = 4 for each photon, with a deviation of √ρ/(1 − ρ) = 4.5: four standard errors.
    CHECK(std::abs(landed / 5000 - 4) < 4 * std::sqrt(0.8) / 0.2 / std::sqrt(5000.0));
}

TEST_CASE("diffuse bounce: the account of a closed room is that of its emission, and received light is beside it") {
    const auto room = coloured_room();
    const PointLight<D, Bands> lamp({{0.4, 0.5, 0.6}, Bands(1, 2, 3)});
    Count visitor;
    const Statistics account = follow(room, lamp, 4000, visitor);
    CHECK(std::abs(sum_of_fates(account) - account.emitted.flux) <= 1e-12 * account.emitted.flux);
    CHECK(account[Arrival::direct].photons == 4000);
    CHECK(account[Arrival::direct].flux == doctest::Approx(account.emitted.flux));
    CHECK(account[Arrival::caustic].photons == 0);
    CHECK(account[Arrival::indirect].photons == visitor.seen);
    CHECK(account[Arrival::indirect].photons == account.diffuse_bounces); // closed: each lands again
    CHECK(account.diffuse_events == 4000 + account.diffuse_bounces);
    CHECK(account[Fate::absorbed].photons == 4000);
}

// A photon ends with a probability of 1 − albedo at each surface, with all that it carries.
TEST_CASE("diffuse bounce: on average surfaces absorb what they received, times what their albedo leaves out") {
    const Room<double> room{box_walls<double, double>(0.6)};
    const PointLight<D, double> lamp({{0.4, 0.5, 0.6}, 1 / (4 * std::numbers::pi)});
    Everything visitor;
    const Statistics account = follow(room, lamp, 20000, visitor);
    const double received = account[Arrival::direct].flux + account[Arrival::indirect].flux;
    CHECK(account[Fate::absorbed].flux == doctest::Approx(1).epsilon(1e-9));
    // Photons arrive 2.5 times, with a deviation of √0.6/0.4 = 1.94: four standard errors of 0.4 times that.
    CHECK(std::abs(0.4 * received - account[Fate::absorbed].flux) < 4 * 0.4 * 1.94 / std::sqrt(20000.0));
}

TEST_CASE("diffuse bounce: direct light is passed over unless it is wanted, and its photons go on") {
    Everything all;
    AllButDirect others;
    const SphereRoom<double> room{1, 0.5};
    follow(room, lamp_in_sphere(), 500, all);
    const Statistics account = follow(room, lamp_in_sphere(), 500, others);
    CHECK(all.deposits.size() == others.deposits.size() + 500);
    CHECK(account[Fate::direct].photons == 0);
    CHECK(std::count(others.bounces.begin(), others.bounces.end(), 0u) == 0);
}

TEST_CASE("diffuse bounce: photons end at a surface that says deposit, and after the largest number of bounces") {
    Room<double> room{box_walls<double, double>(1.0)};
    const PointLight<D, double> lamp({{0.4, 0.5, 0.6}, 1 / (4 * std::numbers::pi)});
    Everything endless;
    const Statistics cut = follow(room, lamp, 100, endless, {.diffuse_bounces = 3});
    CHECK(endless.deposits.size() == 400);
    CHECK(cut[Fate::terminated].flux == doctest::Approx(1));
    for (Wall<double, double>& wall : room.walls)
        wall.event = Event::deposit;
    Everything once;
    const Statistics account = follow(room, lamp, 100, once);
    CHECK(once.deposits.size() == 100);
    CHECK(account[Fate::absorbed].flux == doctest::Approx(1));
    CHECK(account.diffuse_events == 0);
}

TEST_CASE("diffuse bounce: an albedo that cannot be makes the photon invalid, and is named") {
    for (const double albedo : {-0.1, 1.5, std::numeric_limits<double>::quiet_NaN()}) {
        Room<double> room{box_walls<double, double>(0.5)};
        for (Wall<double, double>& wall : room.walls)
            wall.albedo = albedo;
        Everything visitor;
        const Statistics account = follow(room, PointLight<D, double>({{0.4, 0.5, 0.6}, 1.0}), 50, visitor);
        CHECK(account[Fate::invalid].photons == 50);
        CHECK(account.invalid_albedos == 50);
        CHECK((account.invalid_albedo == doctest::Approx(albedo) || albedo != albedo));
        CHECK(account.invalid_albedo_surface < 6);
    }
    Room<double, Bands> one_band = coloured_room(); // whose mean is below 1
    for (Wall<double, Bands>& wall : one_band.walls)
        wall.albedo = {0.1, 1.2, 0.1};
    Count visitor;
    CHECK(follow(one_band, PointLight<D, Bands>({{0.4, 0.5, 0.6}, Bands(1)}), 10, visitor).invalid_albedos == 10);
}

// Such as one from a mirror that reflects nothing.
TEST_CASE("diffuse bounce: a photon that carries nothing any more is absorbed, and no albedo is to blame") {
    Room<double> room{box_walls<double, double>(0.5)};
    room.walls[3].event = Event::reflect;
    room.walls[3].albedo = 0;
    Everything visitor;
    const Statistics account = follow(room, PointLight<D, double>({{0.4, 0.5, 0.6}, 1.0}), 500, visitor);
    CHECK(account.specular_events > 0);
    CHECK(account.invalid_albedos == 0);
    CHECK(account[Fate::invalid].photons == 0);
    CHECK(account[Fate::absorbed].photons == 500);
    CHECK(account[Fate::absorbed].flux == doctest::Approx(account.emitted.flux));
}

TEST_CASE("diffuse bounce: a shading normal that is not unit makes the photon invalid") {
    for (const double scale : {0.9, 1.1, 0.0, std::numeric_limits<double>::quiet_NaN()}) {
        const BadNormals room{{box_walls<double, double>(0.5)}, scale};
        Everything visitor;
        const Statistics account = follow(room, PointLight<D, double>({{0.4, 0.5, 0.6}, 1.0}), 50, visitor);
        CHECK(account[Fate::invalid].photons == 50);
        CHECK(account.invalid_albedos == 0);
        CHECK(account.diffuse_bounces == 0);
    }
    Everything visitor;
    const BadNormals rounded{{box_walls<double, double>(0.5)}, 1.001};
    CHECK(follow(rounded, PointLight<D, double>({{0.4, 0.5, 0.6}, 1.0}), 50, visitor)[Fate::invalid].photons == 0);
}

TEST_CASE("diffuse bounce: an albedo may be a number where light is a spectrum") {
    const PointLight<glm::vec3, Spectrum> lamp({{0.4f, 0.5f, 0.6f}, Spectrum{1, 3}});
    CountSpectra visitor;
    const Statistics account = follow(GreyRoom{}, lamp, 2000, visitor);
    CHECK(account[Fate::invalid].photons == 0);
    CHECK(account[Fate::absorbed].flux == doctest::Approx(account.emitted.flux));
    // Photons arrive once more after they were direct, with a deviation of √0.5/0.5 = 1.41: four standard errors.
    CHECK(std::abs(double(visitor.seen) / 2000 - 1) < 4 * 1.41 / std::sqrt(2000.0));
    GreyRoom bright;
    bright.room.walls = box_walls<float, float>(1.5f);
    CHECK(follow(bright, lamp, 10, visitor).invalid_albedos == 10);
}

TEST_CASE("diffuse bounce: about a tilted shading normal light never goes into the surface") {
    SurfaceHit<D, Flat> hit{1, D(0), D(0, 0, 1), normalize(D(1, 0, 0.3)), Flat{}, 1e-12};
    const RandomSequence random(3);
    Statistics account;
    D sum(0);
    for (std::uint64_t i = 0; i < 4000; ++i) {
        Sampler<RandomSequence> sampler(random, i);
        const D d = detail::diffuse_direction(D(0, 0, -1), hit, sampler, account);
        CHECK(d.z > 0);
        CHECK(std::abs(length(d) - 1) < 1e-12);
        sum += d;
    }
    CHECK(sum.x / 4000 > 0.2); // towards the shading normal
    CHECK(account.corrected_normals > 0);
    // From below: the same on the other side.
    Sampler<RandomSequence> sampler(random, 0);
    CHECK(detail::diffuse_direction(D(0, 0, 1), hit, sampler, account).z < 0);
}

TEST_CASE("diffuse bounce: without it a diffuse surface is one that says deposit, bit for bit") {
    Room<float> diffuse{box_walls<float, float>(0.5f)}, deposit = diffuse;
    for (Room<float>* room : {&diffuse, &deposit})
        room->walls[2].event = Event::reflect;
    for (std::size_t i = 0; i < 6; ++i)
        if (i != 2)
            deposit.walls[i].event = Event::deposit;
    const PointLight<glm::vec3, float> lamp({{0.4f, 0.5f, 0.6f}, 1.0f});
    const RandomSequence random(9);
    Statistics a, b;
    for (std::uint64_t i = 0; i < 200; ++i) {
        Sampler<RandomSequence> one(random, i), other(random, i);
        const auto first = walk(diffuse, lamp.emit(one, {200, 1}), one, {}, a);
        const auto second = walk(deposit, lamp.emit(other, {200, 1}), other, {}, b);
        REQUIRE(first.has_value() == second.has_value());
        if (first)
            CHECK((first->position == second->position && first->d_position == second->d_position));
    }
    CHECK(a[Fate::direct].photons == b[Fate::direct].photons);
}

namespace {
/// Notes with which density photons leave, and which tangents they have on their flights.
struct FreshTangents {
    static constexpr bool follows_bounces = true;
    double sum_of_inverses = 0;
    std::uint64_t started = 0, wrong = 0;

    void flight(const Flight<D, double, 2>& flight) {
        if (flight.diffuse_bounces > 0)
            wrong += flight.tangents[0].d_direction != D(1, 2, 3) || flight.tangents[1].d_position != D(4, 5, 6);
    }
    void deposit(const Deposit<D, double, 2>&, const WalkedPath<>&) {}
    PhotonDifferential<D, 2> reemitted(const D&, double density) {
        ++started;
        sum_of_inverses += 1 / density;
        return {Tangent<D>{D(0), D(1, 2, 3)}, Tangent<D>{D(4, 5, 6), D(0)}};
    }
};
} // namespace

// The mean of 1/p over directions of density p is their solid angle, 2π. Its variance has no bound, but that of all
// with a cosine above 0.01 is 2 π² ln 100 − 4π² = (7.2)², so that 8,000 of them give 0.08, and five of those.
TEST_CASE("diffuse bounce: a visitor starts tangents anew, of directions with the density that it is told") {
    const Room<double> room{box_walls<double, double>(0.5)};
    FreshTangents visitor;
    const PointLight<D, double> lamp({{0.4, 0.5, 0.6}, 1.0});
    const RandomSequence random(4);
    Statistics account;
    for (std::uint64_t i = 0; i < 8000; ++i) {
        Sampler<RandomSequence> sampler(random, i);
        walk(room, lamp.emit(sampler, {8000, 1}), sampler, {}, account, visitor);
    }
    CHECK(visitor.wrong == 0);
    CHECK(visitor.started == account.diffuse_bounces);
    CHECK(std::abs(visitor.sum_of_inverses / double(visitor.started) - 2 * std::numbers::pi) < 0.4);
    check_balance(account);
}

} // namespace nephroid::tests::diffuse_bounce_test
