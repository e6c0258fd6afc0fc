// SPDX-License-Identifier: MIT
#include "nephroid/transport/visitor.hpp"

#include "transport/follow.hpp"

#include "nephroid/differential/reemission.hpp"
#include "nephroid/emission/warp.hpp"
#include "nephroid/sequence/random.hpp"
#include "support/sphere_direction.hpp"

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <vector>

namespace nephroid::tests::visitor_test {

using tests::check_balance;
using tests::check_close;
using tests::collimated;
using tests::Constant;
using tests::from_point;
using tests::SheetScene;
using tests::Vec;

namespace {

using D = Vec<double>;
using Landed = Deposit<D, double>;

struct Flights {
    std::vector<Flight<D, double>> seen;
    void flight(const Flight<D, double>& flight) { seen.push_back(flight); }
};

/// Keeps deposits and what it was told of their paths.
struct Deposits {
    using trail = PathSignature;
    struct One {
        Landed deposit;
        WalkedPath<PathSignature> path;
    };
    std::vector<One> seen;
    void deposit(const Landed& deposit, const WalkedPath<PathSignature>& path) { seen.push_back({deposit, path}); }
    [[nodiscard]] double flux() const {
        double sum = 0;
        for (const One& one : seen)
            sum += one.deposit.flux;
        return sum;
    }
};

struct AllWays : Deposits {
    static constexpr bool follows_all_ways = true;
};

/// A slab of glass between z = 0 and z = 1 above a floor and below a ceiling. Each face reflects a share and refracts
/// the rest; of that a part is absorbed. By chance, or all ways.
struct Slab {
    double reflectance = 0.25, kept = 1;
    SheetScene<double> sheets{{{{0, 0, 1}, {0, 0, 1}, Event::refract, 1.0, 1, 1.5},
                               {{0, 0, 0}, {0, 0, 1}, Event::refract, 1.0, 1.5, 1},
                               {{0, 0, -1}, {0, 0, 1}, Event::deposit},
                               {{0, 0, 2}, {0, 0, 1}, Event::deposit}}};
    using Hit = SurfaceHit<D, Flat>;

    [[nodiscard]] auto intersect(const D& o, const D& d, double t_min, double t_max) const {
        return sheets.intersect(o, d, t_min, t_max);
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const Hit& hit, const D& d, Sampler& sampler) const {
        auto plain = sheets.scatter(hit, d, sampler);
        if (plain.event == Event::deposit)
            return plain;
        if (sampler.template next<double>() < reflectance)
            return Scattering<double, double>::reflect(kept);
        return Scattering<double, double>::refract(kept, plain.eta);
    }
    [[nodiscard]] Ways<Scattering<double, double>> scatter_all(const Hit& hit, const D& d) const {
        Constant none;
        const auto plain = sheets.scatter(hit, d, none);
        if (plain.event == Event::deposit)
            return plain;
        return {Scattering<double, double>::reflect(reflectance * kept),
                Scattering<double, double>::refract((1 - reflectance) * kept, plain.eta)};
    }
};

/// Reflects a tenth, scatters six and absorbs the rest.
struct Lacquer : Slab {
    [[nodiscard]] Ways<Scattering<double, double>, 3> scatter_all(const Hit& hit, const D&) const {
        Ways<Scattering<double, double>, 3> ways;
        if (hit.surface < 2) {
            ways.add(Scattering<double, double>::reflect(0.1));
            ways.add({Event::deposit, 0.6, 1});
            ways.add(Scattering<double, double>::absorb());
        } else {
            ways.add(Scattering<double, double>::deposit());
        }
        return ways;
    }
};

struct DirectToo : AllWays {
    static constexpr bool wants_direct_light = true;
};

struct Mirrors : SheetScene<double> {
    static constexpr bool scatters_by_chance = false;
};

struct BareHit {
    double distance;
    D geometric_normal;
    double position_error;
};
struct Bare {
    SheetScene<double> sheets = tests::mirror_above_floor<double>();
    [[nodiscard]] std::optional<BareHit> intersect(const D& o, const D& d, double t_min, double t_max) const {
        const auto hit = sheets.intersect(o, d, t_min, t_max);
        if (!hit)
            return std::nullopt;
        return BareHit{hit->distance, hit->geometric_normal, hit->position_error};
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const BareHit&, const D& d, Sampler&) const {
        return d.z < 0 ? Scattering<double, double>::reflect(1) : Scattering<double, double>::deposit();
    }
};

template <class Visitor, class S>
[[nodiscard]] Statistics visit(Visitor& visitor, const S& scene, const Photon<D, double>& photon,
                               const WalkLimits& limits = {}) {
    Statistics account;
    Constant sampler;
    walk(scene, photon, sampler, limits, account, visitor);
    return account;
}

} // namespace

static_assert(ScattersDeterministically<Slab, D>);
static_assert(!ScattersDeterministically<SheetScene<double>, D>); // for all one knows its scatter may draw numbers

TEST_CASE("visitor: each flight has its ends, its flux and its tangents at the origin") {
    // Down onto a mirror at 45 degrees, which sends it along x to a wall.
    const SheetScene<double> scene{
        {{{0, 0, 0}, normalize(D{1, 0, 1}), Event::reflect, 0.5}, {{3, 0, 0}, {1, 0, 0}, Event::deposit}}};
    Flights flights;
    Statistics account;
    Constant sampler;
    const auto photon = from_point<double>({0, 0, 2}, {0, 0, -1}, 4.0);
    const auto deposit = walk(scene, photon, sampler, {}, account, flights); // and the deposit comes back
    REQUIRE(deposit);
    REQUIRE(flights.seen.size() == 2);
    const auto &down = flights.seen[0], &aside = flights.seen[1];

    CHECK(down.origin == photon.position);
    CHECK(!down.origin_normal);
    CHECK(down.distance == doctest::Approx(2));
    REQUIRE(down.end_normal);
    check_close(*down.end_normal, normalize(D{1, 0, 1}), 1e-15);
    CHECK(down.flux == 4);
    CHECK(down.specular_events == 0);
    CHECK(down.tangents[0].d_direction == photon.differential[0].d_direction);
    check_close(down.end(), D{0, 0, 0}, 1e-15);

    check_close(aside.origin, D{0, 0, 0}, 1e-14); // on the mirror, not where the next ray was started
    check_close(aside.direction, D{1, 0, 0}, 1e-15);
    CHECK(aside.distance == doctest::Approx(3).epsilon(1e-14));
    REQUIRE((aside.origin_normal && aside.end_normal));
    check_close(*aside.origin_normal, normalize(D{1, 0, 1}), 1e-15);
    check_close(*aside.end_normal, D{-1, 0, 0}, 1e-15); // on the side that the photon comes from
    CHECK(aside.flux == 2);
    CHECK(aside.specular_events == 1);
    // A point's fan is as wide as the way is long: 2 at the mirror, where it hits at 45 degrees, 5 at the wall.
    CHECK(length(cross(aside.tangents[0].d_position, aside.tangents[1].d_position)) ==
          doctest::Approx(4 * std::sqrt(2.0)));
    CHECK(length(cross(deposit->d_position[0], deposit->d_position[1])) == doctest::Approx(25));
}

TEST_CASE("visitor: a flight out of the scene is without end, and one through glass leaves on the other side") {
    const SheetScene<double> pane{{{{0, 0, 0}, {0, 0, 1}, Event::refract, 1.0, 1, 1.5}}};
    Flights flights;
    Statistics account;
    Constant sampler;
    CHECK(!walk(pane, collimated<double>({0, 0, 1}, {0, 0, -1}), sampler, {}, account, flights));
    REQUIRE(flights.seen.size() == 2);
    REQUIRE(flights.seen[1].origin_normal);
    check_close(*flights.seen[1].origin_normal, D{0, 0, -1}, 1e-15);
    CHECK(flights.seen[1].leaves_scene());
    CHECK(flights.seen[1].distance == std::numeric_limits<double>::infinity());
    CHECK(account[Fate::escaped].flux == 1);
}

// Of a slab of reflectance r per face 2r / (1 + r) comes back and (1 − r) / (1 + r) goes through: geometric series.
TEST_CASE("visitor: all ways through a slab carry the flux that its series add up to") {
    const double r = 0.25;
    const Slab slab{r, 1};
    AllWays visitor;
    const WalkLimits limits{.least_share = 1e-9};
    const Statistics account = visit(visitor, slab, collimated<double>({0, 0, 1.5}, {0.1, 0, -1}), limits);
    double up = 0, down = 0;
    for (const auto& one : visitor.seen)
        (one.deposit.position.z > 1 ? up : down) += one.deposit.flux;
    // The ways that end below the least share: one after the other, each r times the one before.
    CHECK(std::abs(up - 2 * r / (1 + r)) <= 1e-8);
    CHECK(std::abs(down - (1 - r) / (1 + r)) <= 1e-8);
    check_balance(account, visitor.flux(), visitor.seen.size() - account.branches);
}

TEST_CASE("visitor: ways are followed in the scene's order, each to its end") {
    AllWays visitor;
    (void)visit(visitor, Slab{}, collimated<double>({0, 0, 1.5}, {0, 0, -1}), {.least_share = 0.02});
    std::vector<double> fluxes;
    std::set<std::uint32_t> signatures;
    for (const auto& one : visitor.seen) {
        fluxes.push_back(one.deposit.flux);
        signatures.insert(one.path.trail.value());
    }
    // Reflected at once; then into the glass: reflected at the bottom, and there again up before it leaves.
    const double r = 0.25, t = 0.75;
    const std::vector<double> expected{r, t * r * r * t, t * r * t, t * t};
    REQUIRE(fluxes.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i)
        CHECK(fluxes[i] == doctest::Approx(expected[i]).epsilon(1e-14));
    CHECK(signatures.size() == 4); // each is a path of its own
    CHECK(visitor.seen[0].path.specular_events == 1);
    CHECK(visitor.seen[1].path.specular_events == 4);

    AllWays again;
    (void)visit(again, Slab{}, collimated<double>({0, 0, 1.5}, {0, 0, -1}), {.least_share = 0.02});
    REQUIRE(again.seen.size() == visitor.seen.size());
    for (std::size_t i = 0; i < again.seen.size(); ++i)
        CHECK(again.seen[i].path.trail.value() == visitor.seen[i].path.trail.value());
}

// A path's signature, tangents and flux per probability are those of the same path taken by chance.
TEST_CASE("visitor: each of all ways is the path that chance would have taken") {
    const auto photon = from_point<double>({0, 0, 1.5}, {0.2, 0.1, -1});
    AllWays all;
    (void)visit(all, Slab{}, photon, {.least_share = 1e-6});
    int compared = 0;
    const RandomSequence random(5);
    for (std::uint64_t i = 0; i < 200; ++i) {
        Sampler<RandomSequence> sampler(random, i);
        PathSignature signature;
        Statistics account;
        const auto deposit = walk(Slab{}, photon, sampler, {}, account, signature);
        REQUIRE(deposit);
        for (const auto& one : all.seen)
            if (one.path.trail.value() == signature.value()) {
                CHECK(one.deposit.position == deposit->position);
                CHECK(one.deposit.d_position == deposit->d_position);
                ++compared;
            }
    }
    CHECK(compared == 200);
}

TEST_CASE("visitor: the account is exact whatever is absorbed, pruned or cut off") {
    for (const double kept : {1.0, 0.7})
        for (const unsigned branches : {0u, 1u, 5u, 1000u})
            for (const unsigned events : {0u, 1u, 7u, 200u})
                for (const double least : {0.0, 1e-3, 0.3}) {
                    CAPTURE(kept);
                    CAPTURE(branches);
                    CAPTURE(events);
                    CAPTURE(least);
                    AllWays visitor;
                    const Statistics account =
                        visit(visitor, Slab{0.4, kept}, collimated<double>({0, 0, 1.5}, {0.3, 0, -1}, 5.0),
                              {.specular_events = events, .branches = branches, .least_share = least});
                    double flux = visitor.flux();
                    std::uint64_t photons = visitor.seen.size();
                    for (const Tally& tally : account.fates) {
                        flux += tally.flux;
                        photons += tally.photons;
                    }
                    CHECK(std::abs(flux - account.emitted.flux) <= 1e-14 * account.emitted.flux);
                    CHECK(photons == account.emitted.photons + account.branches);
                }
}

TEST_CASE("visitor: a surface that reflects and scatters deposits the share that it does not reflect") {
    DirectToo all;
    const auto photon = collimated<double>({0, 0, 1.5}, {0, 0, -1}, 10.0);
    const Statistics account = visit(all, Lacquer{}, photon);
    REQUIRE(all.seen.size() == 2);
    CHECK(all.seen[0].deposit.flux == doctest::Approx(1)); // by way of the mirror onto the ceiling
    CHECK(all.seen[1].deposit.flux == doctest::Approx(6));
    CHECK(all.seen[1].path.is_direct());
    CHECK(account[Fate::absorbed].flux == doctest::Approx(3));

    AllWays caustics; // who does not want direct light finds it in the account
    const Statistics other = visit(caustics, Lacquer{}, photon);
    CHECK(caustics.seen.size() == 1);
    CHECK(other[Fate::direct].flux == doctest::Approx(6));
}

TEST_CASE("visitor: a surface without any way absorbs and a weight that is no number makes the photon invalid") {
    struct Black : Slab {
        double weight = 0;
        [[nodiscard]] std::vector<Scattering<double, double>> scatter_all(const Hit&, const D&) const {
            if (weight == 0)
                return {};
            return {Scattering<double, double>::reflect(weight), Scattering<double, double>::reflect(0.5)};
        }
    };
    const auto photon = collimated<double>({0, 0, 1.5}, {0, 0, -1});
    AllWays visitor;
    CHECK(visit(visitor, Black{}, photon)[Fate::absorbed].flux == 1);
    Black wrong;
    wrong.weight = std::nan("");
    CHECK(visit(visitor, wrong, photon)[Fate::invalid].flux == 1);
    CHECK(visitor.seen.empty());
}

TEST_CASE("visitor: a scene whose scatter says that it draws nothing has one way, which is all ways") {
    static_assert(ScattersDeterministically<Mirrors, D>);
    const auto above = tests::mirror_above_floor<double>(0.5);
    const Mirrors scene{above};
    const auto photon = collimated<double>({0, 0, 1}, {0.5, 0, -1});
    AllWays visitor;
    (void)visit(visitor, scene, photon);
    Statistics account;
    const auto deposit = tests::follow(above, photon, account);
    REQUIRE((deposit && visitor.seen.size() == 1));
    CHECK(visitor.seen[0].deposit.position == deposit->position);
    CHECK(visitor.seen[0].deposit.flux == deposit->flux);
}

namespace {

/// Sends each photon on from diffuse surfaces of this albedo, and adds up what they receive.
struct Bounces {
    static constexpr bool wants_direct_light = true;
    double albedo;
    Sampler<RandomSequence>* sampler;
    std::vector<double> received_by_bounce{};

    [[nodiscard]] std::optional<Photon<D, double>> deposit(const Landed& deposit, const WalkedPath<>& path) {
        received_by_bounce.resize((std::max)(received_by_bounce.size(), std::size_t(path.diffuse_bounces) + 1));
        received_by_bounce[path.diffuse_bounces] += deposit.flux;
        const double u = sampler->next<double>(), v = sampler->next<double>();
        const D direction = cosine_direction(deposit.normal, frame_about(deposit.normal), concentric_disk(u, v));
        const PhotonDifferential<D, 2> arrived{Tangent<D>{deposit.d_position[0], D(0)},
                                               Tangent<D>{deposit.d_position[1], D(0)}};
        return Photon<D, double>{deposit.position, direction, albedo * deposit.flux, reemit(arrived, direction, 0.1)};
    }
};

/// A room of six walls.
[[nodiscard]] SheetScene<double> room() {
    SheetScene<double> walls;
    for (const D n : {D{1, 0, 0}, D{-1, 0, 0}, D{0, 1, 0}, D{0, -1, 0}, D{0, 0, 1}, D{0, 0, -1}})
        walls.sheets.push_back({-n, n, Event::deposit});
    return walls;
}

} // namespace

// In a closed room of one albedo each bounce receives the albedo's share of what the one before received.
TEST_CASE("visitor: a photon that is sent on from diffuse surfaces lights a furnace by the geometric series") {
    const RandomSequence random(8);
    const double albedo = 0.5;
    const unsigned bounces = 20;
    Statistics account;
    Bounces visitor{albedo, nullptr};
    for (std::uint64_t i = 0; i < 100; ++i) {
        Sampler<RandomSequence> sampler(random, i);
        visitor.sampler = &sampler;
        const double u = sampler.next<double>(), v = sampler.next<double>();
        const auto photon = from_point<double>({0.1, 0.2, 0.3}, sphere_direction<D>(u, v), 2.0);
        walk(room(), photon, sampler, {.diffuse_bounces = bounces}, account, visitor);
    }
    REQUIRE(visitor.received_by_bounce.size() == bounces + 1);
    for (unsigned b = 0; b <= bounces; ++b) {
        CAPTURE(b);
        CHECK(visitor.received_by_bounce[b] == doctest::Approx(200 * std::pow(albedo, b)).epsilon(1e-12));
    }
    check_balance(account); // what did not go on is absorbed, the rest cut off
    CHECK(account[Fate::terminated].flux == doctest::Approx(200 * std::pow(albedo, bounces + 1)));
}

TEST_CASE("visitor: flights after a bounce count it and begin at the surface") {
    struct Both : Bounces, Flights {
    } visitor{{0.5, nullptr}, {}};
    const RandomSequence random(9);
    Sampler<RandomSequence> sampler(random, 0);
    visitor.sampler = &sampler;
    Statistics account;
    walk(room(), from_point<double>({0, 0, 0}, {1, 0.2, 0.3}), sampler, {.diffuse_bounces = 3}, account, visitor);
    REQUIRE(visitor.seen.size() == 4);
    for (unsigned i = 0; i < 4; ++i) {
        CHECK(visitor.seen[i].diffuse_bounces == i);
        CHECK(visitor.seen[i].origin_normal.has_value() == (i > 0));
        if (i > 0) {
            check_close(visitor.seen[i].origin, visitor.seen[i - 1].end(), 1e-12);
            check_close(*visitor.seen[i].origin_normal, *visitor.seen[i - 1].end_normal, 0);
        }
    }
}

TEST_CASE("visitor: photons without tangents ask no curvature of a hit") {
    static_assert(Scene<Bare, D, Constant, 0> && !Scene<Bare, D, Constant>);
    Statistics account;
    Constant sampler;
    const auto deposit =
        walk(Bare{}, Photon<D, double, 0>{{0, 0, 1}, normalize(D{1, 0, -1}), 1, {}}, sampler, {}, account);
    REQUIRE(deposit);
    check_close(deposit->position, D{3, 0, 2}, 1e-12);
}

} // namespace nephroid::tests::visitor_test
