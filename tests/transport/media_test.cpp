// SPDX-License-Identifier: MIT
// Media within media, and lamps within them.
#include "nephroid/transport/media.hpp"

#include "nephroid/transport/walk.hpp"
#include "transport/tiny_scenes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace nephroid::tests::media_test {

using tests::Sheet;
using tests::SheetScene;

namespace {

using V = tests::Vec<double>;
using H = SurfaceHit<V, Flat>;

constexpr std::int32_t water = 0, glass = 1;
constexpr double water_index = 1.33, glass_index = 1.5, water_absorption = 0.5;

[[nodiscard]] constexpr double index_of(std::int32_t medium) {
    return medium == water ? water_index : medium == glass ? glass_index : 1;
}

struct Answer {
    Event event;
    double weight = 1, eta = 1;
    Media medium{};
};

/// Sheets that bound media: `material` of each, none for what is diffuse.
struct Tank {
    using medium = Media;
    SheetScene<double> scene;
    std::vector<std::int32_t> materials;
    std::int32_t glass_priority = 0;
    Media about_the_lamp{};

    [[nodiscard]] std::optional<H> intersect(const V& o, const V& d, double t_min, double t_max) const {
        return scene.intersect(o, d, t_min, t_max);
    }
    template <class Sampler>
    [[nodiscard]] Answer scatter(const H& hit, const V& d, Sampler&, const Media& media) const {
        return answer(hit, d, media);
    }
    [[nodiscard]] Answer answer(const H& hit, const V& d, const Media& media) const {
        const std::int32_t material = materials[hit.surface];
        if (material == Media::none)
            return {Event::deposit};
        const bool enters = dot(d, hit.geometric_normal) < 0;
        const auto at = media.at_surface_of(material, material == glass ? glass_priority : 0, enters);
        if (!at.is_real())
            return {Event::pass, 1, 1, at.beyond};
        return {Event::refract, 1, index_of(at.before) / index_of(at.after), at.beyond};
    }
    [[nodiscard]] double transmittance(const Media& media, double distance) const {
        return media.here() == water ? std::exp(-water_absorption * distance) : 1;
    }
    [[nodiscard]] Media medium_at(const V&) const { return about_the_lamp; }
};
static_assert(KnowsMediumOfLamps<Tank, V>);

[[nodiscard]] std::optional<Deposit<V, double, 2>> walk_in(const Tank& tank, const V& from, const V& direction,
                                                           Statistics& account) {
    tests::Constant numbers;
    return walk(tank, tests::collimated<double>(from, direction), numbers, {}, account);
}

/// The same with all ways, of which a part of the light goes back at real surfaces.
struct TankOfAllWays : Tank {
    static constexpr double reflectance = 0.25;

    [[nodiscard]] Ways<Answer> scatter_all(const H& hit, const V& d, const Media& media) const {
        Answer on = answer(hit, d, media);
        if (on.event != Event::refract)
            return on;
        on.weight = 1 - reflectance;
        return {{Event::reflect, reflectance, 1, media}, on};
    }
};
static_assert(ScattersAllWays<TankOfAllWays, V>);

struct AllDeposits {
    static constexpr bool follows_all_ways = true;
    std::vector<std::pair<unsigned, Deposit<V, double, 2>>> seen; ///< with its reflections and refractions
    void deposit(const Deposit<V, double, 2>& deposit, const WalkedPath<>& path) {
        seen.emplace_back(path.specular_events, deposit);
    }
};

constexpr V up{0, 0, 1}, down{0, 0, -1};

} // namespace

TEST_CASE("media: the one of the highest priority is there and then the one that was entered last") {
    Media media;
    CHECK(media.here() == Media::none);
    media.enter(3);
    media.enter(5);
    CHECK(media.here() == 5);
    media.enter(9, 1);
    CHECK(media.here() == 9);
    CHECK(media.leave(3));
    CHECK_FALSE(media.leave(3));
    CHECK(media.here() == 9);
    media.enter(2);
    CHECK(media.here() == 9);
    CHECK(media.leave(9));
    CHECK(media.here() == 2);
    CHECK(media.leave(2));
    CHECK(media.here() == 5);
    CHECK(media.has(5));
    CHECK_FALSE(media.has(3));
}

TEST_CASE("media: more than there is room for are not known and nothing is written beyond it") {
    Media media;
    for (std::int32_t i = 20; i > 0; --i)
        media.enter(i);
    CHECK(media.here() == 13); // 20 to 13: the last for which there was room
    for (std::int32_t i = 1; i <= 20; ++i)
        CHECK(media.leave(i) == (i >= 13));
    CHECK(media == Media());
}

TEST_CASE("media: light that leaves what nobody knew of came from it") {
    const auto at = Media().at_surface_of(4, 0, false);
    CHECK(at.before == 4);
    CHECK(at.after == Media::none);
    CHECK(at.is_real());
    CHECK(at.beyond == Media());
}

TEST_CASE("media: a body within another of the same material is not there") {
    Media media;
    media.enter(4);
    const auto in = media.at_surface_of(4, 0, true);
    CHECK_FALSE(in.is_real());
    CHECK_FALSE(in.beyond.at_surface_of(4, 0, false).is_real());
    CHECK(in.beyond.at_surface_of(4, 0, false).beyond.at_surface_of(4, 0, false).is_real());
}

// The lamp is at depth 1, and shines up: exp(-1/2 / cos) arrives, refracted, and a lamp that is not known to lie in
// water would lose nothing.
TEST_CASE("media: a lamp under water loses light on its first way and its rays leave the water as they should") {
    Tank tank{{{{{0, 0, 0}, up, Event::refract}, {{0, 0, 2}, down, Event::deposit}}}, {water, Media::none}};
    tank.about_the_lamp.enter(water);
    const double sine = 0.4, cosine = std::sqrt(1 - sine * sine);
    Statistics account;
    const auto deposit = walk_in(tank, {0, 0, -1}, {sine, 0, cosine}, account);
    REQUIRE(deposit);
    CHECK(std::abs(deposit->flux - std::exp(-water_absorption / cosine)) <= 1e-12);
    CHECK(std::abs(deposit->direction.x - water_index * sine) <= 1e-12);
    tests::check_balance(account, deposit->flux, 1);
}

// A glass slab in water: sin = 0.8 / 1.33 in the water, 0.8 / 1.5 in the glass.
TEST_CASE("media: glass in water bends light by the ratio of both and light leaves it into water again") {
    const Tank tank{{{{{0, 0, 4}, up, Event::refract},
                      {{0, 0, 3}, up, Event::refract},
                      {{0, 0, 2}, down, Event::refract},
                      {{0, 0, 0}, up, Event::deposit}}},
                    {water, glass, glass, Media::none}};
    Statistics account;
    const auto deposit = walk_in(tank, {0, 0, 5}, {0.8, 0, -0.6}, account);
    REQUIRE(deposit);
    const double in_water = 0.8 / water_index, in_glass = 0.8 / glass_index;
    CHECK(std::abs(deposit->direction.x - in_water) <= 1e-12);
    const auto slope = [](double sine) { return sine / std::sqrt(1 - sine * sine); };
    CHECK(std::abs(deposit->position.x - (slope(0.8) + 3 * slope(in_water) + slope(in_glass))) <= 1e-12);
    CHECK(std::abs(deposit->flux - std::exp(-3 * water_absorption / std::sqrt(1 - in_water * in_water))) <= 1e-12);
    CHECK(account.specular_events == 3);
}

/// Water that reaches down to 2.5, below the top of a glass at 3.
///
/// @param priority  of the glass
[[nodiscard]] Tank overlapping(std::int32_t priority) {
    return {{{{{0, 0, 4}, up, Event::refract},
              {{0, 0, 3}, up, Event::refract},
              {{0, 0, 2.5}, down, Event::refract},
              {{0, 0, 0}, up, Event::deposit}}},
            {water, glass, water, Media::none},
            priority};
}

// With the higher priority the glass begins at 3, and the water's bottom is no surface; with the lower one it begins
// where the water ends.
TEST_CASE("media: where water and glass overlap the priority says which of them is there") {
    for (const std::int32_t priority : {1, -1}) {
        const Tank tank = overlapping(priority);
        Statistics account;
        const auto deposit = walk_in(tank, {0, 0, 5}, {0.8, 0, -0.6}, account);
        REQUIRE(deposit);
        const double border = priority > 0 ? 3 : 2.5;
        const auto slope = [](double sine) { return sine / std::sqrt(1 - sine * sine); };
        const double x = slope(0.8) + (4 - border) * slope(0.8 / water_index) + border * slope(0.8 / glass_index);
        CHECK(std::abs(deposit->position.x - x) <= 1e-12);
        CHECK(account.specular_events == 2); // the false surface is none
    }
}

// The straightest of all ways is the one that a scene without reflections takes, but for the shares; the others stay in
// their media too, so that those that end on the floor come at the floor's own angle.
TEST_CASE("media: photons that follow all ways know the medium on each of them") {
    for (const std::int32_t priority : {1, -1}) {
        const Tank tank = overlapping(priority);
        Statistics account, of_all_ways;
        const auto expected = walk_in(tank, {0, 0, 5}, {0.8, 0, -0.6}, account);
        REQUIRE(expected);
        const TankOfAllWays all_ways{tank};
        AllDeposits visitor;
        tests::Constant numbers;
        walk(all_ways, tests::collimated<double>({0, 0, 5}, {0.8, 0, -0.6}), numbers, {.least_share = 1e-6},
             of_all_ways, visitor);
        double flux = 0;
        int straight = 0;
        for (const auto& [events, deposit] : visitor.seen) {
            flux += deposit.flux;
            CHECK(std::abs(deposit.direction.x - expected->direction.x) <= 1e-12);
            if (events != 2)
                continue;
            ++straight;
            CHECK(std::abs(deposit.position.x - expected->position.x) <= 1e-12);
            CHECK(std::abs(deposit.flux - 0.75 * 0.75 * expected->flux) <= 1e-12);
        }
        CHECK(straight == 1);
        CHECK(visitor.seen.size() >= 3); // up and down between the two surfaces: not at all, once, twice
        tests::check_balance(of_all_ways, flux, visitor.seen.size() - of_all_ways.branches);
    }
}

TEST_CASE("media: false surfaces alone make no caustic and one without end ends as terminated") {
    Tank tank{{{{{0, 0, 1}, up, Event::refract}, {{0, 0, 0}, up, Event::deposit}}}, {glass, Media::none}};
    tank.about_the_lamp.enter(glass);
    Statistics account;
    CHECK_FALSE(walk_in(tank, {0, 0, 2}, {0, 0, -1}, account));
    CHECK(account[Fate::direct].photons == 1);
    struct Endless : Tank {
        [[nodiscard]] std::optional<H> intersect(const V& o, const V&, double, double) const {
            return H{0, o, up, up, Flat{}, 1e-12, 0};
        }
    };
    const Endless endless{tank};
    tests::Constant numbers;
    Statistics of_endless;
    CHECK_FALSE(walk(endless, tests::collimated<double>({0, 0, 2}, {0, 0, -1}), numbers, {}, of_endless));
    CHECK(of_endless[Fate::terminated].photons == 1);
}

TEST_CASE("media: flights end and begin at false surfaces too") {
    struct Flights {
        std::vector<Flight<V, double>> seen;
        void flight(const Flight<V, double>& flight) { seen.push_back(flight); }
    } flights;
    Tank tank{{{{{0, 0, 1}, up, Event::refract}, {{0, 0, 0}, up, Event::deposit}}}, {glass, Media::none}};
    tank.about_the_lamp.enter(glass);
    tests::Constant numbers;
    Statistics account;
    CHECK_FALSE(walk(tank, tests::collimated<double>({0, 0, 3}, {0, 0, -1}), numbers, {}, account, flights));
    REQUIRE(flights.seen.size() == 2);
    CHECK(flights.seen[0].origin.z == 3);
    CHECK(std::abs(flights.seen[0].distance - 2) <= 1e-12);
    CHECK(std::abs(flights.seen[1].origin.z - 1) <= 1e-12);
    CHECK(std::abs(flights.seen[1].distance - 1) <= 1e-12);
}

} // namespace nephroid::tests::media_test
