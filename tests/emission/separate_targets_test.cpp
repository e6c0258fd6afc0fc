// SPDX-License-Identifier: MIT
// Lights that are aimed at one target each send light to all objects, and no light twice.
#include "nephroid/emission/separate_targets.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/disk.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/emission/light/spot.hpp"
#include "nephroid/emission/light_set.hpp"
#include "nephroid/sequence/random.hpp"
#include "nephroid/vector/glm.hpp"
#include "support/is_sanitized.hpp"
#include "support/sphere_direction.hpp"
#include "transport/tiny_scenes.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

namespace nephroid::tests::separate_targets_test {

namespace {

using V = tests::Vec<double>;
using Spheres = std::vector<BoundingSphere<V>>;

/// Clusters of balls, close together or far apart by the number of the scene.
[[nodiscard]] Spheres some_balls(std::uint64_t scene) {
    const RandomSequence random(23);
    Spheres balls;
    for (std::uint64_t i = 0; i < 3 + scene % 9; ++i) {
        const auto at = [&](std::uint32_t d) { return random.sample<double>(100 * scene + i, d) - 0.5; };
        const double spread = std::pow(10, at(7) + double(scene % 3));
        balls.push_back({spread * V{at(0), at(1), at(2)}, 0.1 + 0.5 * std::abs(at(3))});
    }
    return balls;
}

[[nodiscard]] V some_direction(std::uint64_t i) {
    const RandomSequence random(29);
    return sphere_direction<V>(random.sample<double>(i, 0), random.sample<double>(i, 1));
}

[[nodiscard]] bool is_in(const Cone<V>& cone, const V& direction) {
    return 0.5 * length2(V(direction - cone.axis)) <= cone.height;
}

/// Whether a ray meets a ball: its closest approach does, or it starts inside.
[[nodiscard]] bool meets(const V& from, const V& direction, const BoundingSphere<V>& ball) {
    const V towards = ball.centre - from;
    return length(towards) <= ball.radius ||
           (dot(towards, direction) > 0 && length(cross(direction, towards)) <= ball.radius);
}

[[nodiscard]] bool meets_any(const V& from, const V& direction, const Spheres& balls) {
    for (const auto& ball : balls)
        if (meets(from, direction, ball))
            return true;
    return false;
}

} // namespace

TEST_CASE("separate targets: each direction from a lamp to an object leads to one target and no direction to two") {
    int several = 0;
    for (std::uint64_t scene = 0; scene < 60; ++scene) {
        const Spheres balls = some_balls(scene);
        const V lamp = 3.0 * some_direction(1'000'000 + scene);
        const auto targets = targets_from(lamp, group_targets(balls));
        several += targets.size() > 1;
        std::vector<Cone<V>> cones;
        for (const auto& target : targets)
            cones.push_back(cone_towards(target.bounds, lamp));
        for (std::uint64_t i = 0; i < 2000; ++i) {
            // Half of the directions are towards points of the balls.
            const BoundingSphere<V>& ball = balls[i % balls.size()];
            V direction = some_direction(i);
            if (i % 2 == 0)
                direction = normalize(V(ball.centre + ball.radius * direction - lamp));
            int count = 0;
            for (const auto& cone : cones)
                count += is_in(cone, direction);
            CHECK(count <= 1);
            if (i % 2 == 0)
                CHECK(count == 1);
        }
    }
    CHECK(several >= 20);
}

// A lamp above stacked objects: the axes of the cones are the same, so that there is no way to turn from one to the
// other.
TEST_CASE_TEMPLATE("separate targets: objects that are stacked below a lamp are one target in float and double", T,
                   float, double) {
    using P = tests::Vec<T>;
    int merged = 0;
    for (int n = 0; n < 2000; ++n) {
        CAPTURE(n);
        // The second ball is all but as wide as the first as seen from the lamp, narrower and wider by turns.
        // Just below powers of two sums of angles are rounded.
        const T half_angle = T(0.5) / T(1 << n % 4) * (T(1) - T(n / 4) * T(0.25) * std::numeric_limits<T>::epsilon());
        const T first = std::sin(half_angle), ratio = T(1) + T(n % 9 - 4) * std::numeric_limits<T>::epsilon();
        const std::vector<TargetGroup<P>> groups{{{0}, {P{0, 0, -1}, first}},
                                                 {{1}, {P{0, 0, -3}, T(3) * first * ratio}},
                                                 {{2}, {P{0, 0, -7}, T(7) * first / ratio}}};
        const auto targets = targets_from(P{0, 0, 0}, groups);
        REQUIRE(targets.size() == 1);
        const auto& bounds = targets[0].bounds;
        CHECK(all_finite(bounds.centre));
        CHECK(bounds.radius > 0);
        merged += length(bounds.centre) > bounds.radius;
        const auto cone = cone_towards(bounds, P{0, 0, 0});
        for (const auto& group : groups) { // the cones' rims, which rounding may move by some units in the last place
            const T rim_angle = std::asin(group.bounds.radius / length(group.bounds.centre));
            const P rim{std::sin(rim_angle), 0, -std::cos(rim_angle)};
            CHECK(T(0.5) * length2(P(rim - cone.axis)) <= cone.height);
        }
    }
    CHECK(merged == 2000); // cones, and not every direction
}

// Two cones of almost 0.49 pi each, on opposite sides of the lamp, and narrower ones.
TEST_CASE_TEMPLATE("separate targets: wide cones that do not meet in theory do not meet after rounding", T, float,
                   double) {
    using P = tests::Vec<T>;
    int apart = 0;
    for (int n = 0; n < 4000; ++n) {
        const T half_angle = T(0.3 + 0.19 * n / 4000) * pi<T>;
        // Turned by twice that, and by a little more in units of rounding.
        const T turn = T(2) * half_angle + T(n % 40) * T(50) * std::numeric_limits<T>::epsilon();
        const P a{0, 0, 1}, b{std::sin(turn), 0, std::cos(turn)};
        const auto targets = targets_from(P{0, 0, 0}, std::vector<TargetGroup<P>>{{{0}, {a, std::sin(half_angle)}},
                                                                                  {{1}, {b, std::sin(half_angle)}}});
        if (targets.size() == 1)
            continue;
        ++apart;
        const auto half_angle_of = [](const Cone<P>& cone) { // exactly, of the cone as it is
            return std::acos((long double)(1) - (long double)(cone.height));
        };
        const auto first = cone_towards(targets[0].bounds, P{0, 0, 0}),
                   second = cone_towards(targets[1].bounds, P{0, 0, 0});
        const auto angle = 2 * std::atan2((long double)(length(P(first.axis - second.axis))),
                                          (long double)(length(P(first.axis + second.axis))));
        CHECK(half_angle_of(first) + half_angle_of(second) < angle);
    }
    CHECK(apart > 1000);
}

TEST_CASE("separate targets: what is no lamp is refused by name and value") {
    const Spheres balls{{{0, 0, 0}, 1}};
    const auto groups = group_targets(balls);
    const double none = std::numeric_limits<double>::quiet_NaN();
    const auto message = [](const auto& call) {
        try {
            (void)call();
        } catch (const std::invalid_argument& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const auto says = [](const std::string& text, const char* part) { return text.find(part) != std::string::npos; };
    CHECK(says(message([&] {
                   return targets_from(V{none, 0, 5}, groups);
               }),
               "targets_from: the lamp is at (nan, 0, 5)"));
    CHECK(says(message([&] { return targets_from(V{0, 0, 5}, groups, 1.5); }), "cos_outer is 1.5"));
    CHECK(says(message([&] { return targets_from(V{0, 0, 5}, groups, none); }), "cos_outer is nan"));
    CHECK(says(message([&] { return targets_from_area(balls, {{0, 0, 5}, -0.5}, groups); }), "with radius -0.5"));
    CHECK(says(message([&] { return targets_from_area(balls, {{0, 0, none}, 1}, groups); }), "at (0, 0, nan)"));
    CHECK(says(message([&] { return targets_across(balls, V{0, 0, -2}, groups); }), "direction is (0, 0, -2)"));
    CHECK(says(message([&] { return targets_across(balls, V{0, none, 0}, groups); }), "direction is (0, nan, 0)"));
    CHECK(targets_from(V{0, 0, 5}, groups, 1.0).size() == 1);
    CHECK(targets_from_area(balls, {{0, 0, 5}, 0}, groups).size() == 1);
}

TEST_CASE(
    "separate targets: each direction from a point of an area lamp to an object leads to one target, none to two") {
    int several = 0;
    for (std::uint64_t scene = 0; scene < 60; ++scene) {
        CAPTURE(scene);
        const Spheres balls = some_balls(scene);
        const RandomSequence random(37);
        const BoundingSphere<V> lamp{3.0 * some_direction(5'000'000 + scene), 0.4 * random.sample<double>(scene, 0)};
        const auto targets = targets_from_area(balls, lamp, group_targets(balls));
        several += targets.size() > 1;
        std::vector<std::size_t> target_of(balls.size());
        for (std::size_t t = 0; t < targets.size(); ++t)
            for (const std::size_t ball : targets[t].objects)
                target_of[ball] = t;
        for (std::uint64_t i = 0; i < 4000; ++i) {
            const std::size_t number = i % balls.size();
            const BoundingSphere<V>& ball = balls[number];
            const double depth = i % 3 == 0 ? 1 : std::cbrt(random.sample<double>(i, 1)); // a third on the surface
            const V at = lamp.centre + depth * lamp.radius * some_direction(6'000'000 + i);
            const bool is_aimed = i % 2 == 0 && length(V(ball.centre - at)) > ball.radius;
            const V direction =
                is_aimed ? normalize(V(ball.centre + ball.radius * some_direction(i) - at)) : some_direction(i);
            int count = 0;
            bool leads_to_own = false;
            for (std::size_t t = 0; t < targets.size(); ++t)
                if (is_in(cone_towards(targets[t].bounds, at), direction)) {
                    ++count;
                    leads_to_own = leads_to_own || t == target_of[number];
                }
            CHECK(count <= 1);
            if (is_aimed)
                CHECK(leads_to_own);
        }
    }
    CHECK(several >= 20);
}

TEST_CASE("separate targets: patches across a beam light all objects and no line of the beam twice") {
    int several = 0;
    for (std::uint64_t scene = 0; scene < 60; ++scene) {
        const Spheres balls = some_balls(scene);
        const V direction = some_direction(2'000'000 + scene);
        const auto targets = targets_across(balls, direction, group_targets(balls));
        several += targets.size() > 1;
        const auto covers = [&](const BeamPatch<V>& patch, const V& at) {
            if (const auto* disk = std::get_if<BeamDisk<V>>(&patch)) {
                const V away = at - disk->centre;
                return length(V(away - dot(away, direction) * direction)) <= disk->radius;
            }
            const auto& sides = std::get<Parallelogram<V>>(patch);
            const V away = at - sides.corner;
            const double u = dot(away, sides.edge_u) / length2(sides.edge_u),
                         v = dot(away, sides.edge_v) / length2(sides.edge_v);
            return u >= 0 && u <= 1 && v >= 0 && v <= 1;
        };
        std::vector<BeamPatch<V>> patches;
        for (const auto& target : targets) {
            std::vector<V> points; // of the balls, in all directions
            for (const std::size_t ball : target.objects)
                for (std::uint64_t i = 0; i < 200; ++i)
                    points.push_back(balls[ball].centre + balls[ball].radius * some_direction(i));
            patches.push_back(scene % 2 == 0 ? BeamPatch<V>(beam_over(direction, target.bounds))
                                             : smallest_beam_over(direction, points));
        }
        for (std::uint64_t i = 0; i < 2000; ++i) {
            const BoundingSphere<V>& ball = balls[i % balls.size()];
            const double reach = i % 2 == 0 ? 1 - 1e-12 : 4; // on the ball but for rounding, or about it
            int count = 0;
            for (const auto& patch : patches)
                count += covers(patch, ball.centre + reach * ball.radius * some_direction(i % 200));
            CHECK(count <= 1);
            if (i % 2 == 0)
                CHECK(count == 1);
        }
    }
    CHECK(several >= 20);
}

// The flux that rays from a lamp carry to the balls, by the lights with their targets and by one without.
TEST_CASE("separate targets: lights of all kinds send the objects as much light as one light without a target") {
    constexpr std::uint64_t photons = tests::is_sanitized ? 4'000 : 40'000;
    const RandomSequence random(31);
    const auto flux_to = [&](const Spheres& balls, const auto& light, std::uint64_t count) {
        double flux = 0;
        for (std::uint64_t i = 0; i < count; ++i) {
            Sampler samples(random, i);
            const auto photon = light.emit(samples, Spread<double>{double(count), 1});
            if (meets_any(photon.position, photon.direction, balls))
                flux += photon.flux;
        }
        return flux;
    };
    for (std::uint64_t scene = 0; scene < 12; ++scene) {
        CAPTURE(scene);
        const Spheres balls = some_balls(scene);
        const auto groups = group_targets(balls);
        const V lamp = 3.0 * some_direction(3'000'000 + scene), axis = some_direction(4'000'000 + scene);
        const auto check = [&](const auto& targets, const auto& light_at) {
            double sum = 0;
            for (const auto& target : targets)
                sum += flux_to(balls, light_at(std::optional<BoundingSphere<V>>(target.bounds)), photons);
            const auto all = light_at(std::optional<BoundingSphere<V>>());
            const double truth = flux_to(balls, all, 16 * photons);
            // A share p of random photons of equal flux arrives, which is off by sqrt(p / N) of the whole; falloffs and
            // cosines add as much at most. Five times that, for both counts: coarse, as the directions that lead to two
            // targets are counted above. This is about what lights make of the targets.
            const double noise = 2 * std::sqrt(all.power() * (std::max)(truth, all.power() / photons) / photons);
            CHECK(std::abs(sum - truth) <= 5 * noise);
        };
        check(targets_from(lamp, groups), [&](const auto& target) {
            return PointLight<V, double>({.position = lamp, .intensity = 1, .target = target});
        });
        for (const double cos_outer : {0.9, 0.3, -0.5})
            check(targets_from(lamp, groups, cos_outer), [&](const auto& target) {
                return SpotLight<V, double>({.position = lamp,
                                             .axis = axis,
                                             .cos_inner = 0.95,
                                             .cos_outer = cos_outer,
                                             .intensity = 1,
                                             .target = target});
            });
        for (const double radius : {0.05, 0.8})
            check(targets_from_area(balls, {lamp, radius}, groups), [&](const auto& target) {
                return DiskLight<V, double>(
                    {.centre = lamp, .normal = axis, .radius = radius, .radiance = 1, .target = target});
            });
    }
}

// Two mirrors on the ceiling, each with a target wider than itself; together they are one mirror. A photon that is sent
// twice would make the middle of the floor twice as bright.
TEST_CASE("separate targets: two targets that overlap light the floor once") {
    using Set = LightSet<PointLight<V, double>>;
    struct Vertex {
        V position, normal;
    };
    const tests::SheetScene<double> scene{{{{0, 0, 2}, {0, 0, -1}, Event::reflect}, {{0, 0, 0}, {0, 0, 1}}}};
    std::vector<Vertex> floor;
    for (int i = 0; i < 24 * 24; ++i)
        floor.push_back({{(i % 24 + 0.5) / 12 - 1, (i / 24 + 0.5) / 12 - 1, 0}, {0, 0, 1}});
    const EyePathMap map(floor, &Vertex::position, &Vertex::normal);
    const V lamp{0, 0, 1};
    const std::vector<TargetGroup<V>> mirrors{{{0}, {{-1, 0, 2}, 1.2}}, {{1}, {{1, 0, 2}, 1.2}}};
    const auto error = [&](const std::vector<TargetGroup<V>>& targets) {
        std::vector<Set::AnyLight> lights;
        for (const auto& target : targets)
            lights.push_back(PointLight<V, double>({.position = lamp, .intensity = 1, .target = target.bounds}));
        auto sums = nephroid::sums<double>(map);
        const Statistics account = caustics(scene, Set(lights), sums, {.count = 20'000});
        tests::check_balance(account);
        double squares = 0, sum = 0;
        sums.for_each([&](std::size_t i, double e) {
            const V& at = floor[i].position;
            const double truth = 3 / std::pow(9 + at.x * at.x + at.y * at.y, 1.5);
            squares += (e - truth) * (e - truth), sum += truth;
        });
        return std::sqrt(squares / double(floor.size())) / (sum / double(floor.size()));
    };
    CHECK(error(targets_from(lamp, mirrors)) <= 0.02); // as in lamp_over_mirror_test.cpp, with more photons here
    CHECK(error(mirrors) > 0.2);                       // what it is against
}

} // namespace nephroid::tests::separate_targets_test
