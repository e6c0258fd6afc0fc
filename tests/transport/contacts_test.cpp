// SPDX-License-Identifier: MIT
// Glass on a table, water in a glass: surfaces that touch, tilted as the floor of a real room never is, in float.
#include "nephroid/transport/contacts.hpp"

#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/sequence.hpp"
#include "nephroid/transport/walk.hpp"
#include "transport/tiny_scenes.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <optional>
#include <vector>

namespace nephroid::tests::contacts_test {

using tests::Sheet;
using tests::SheetScene;

namespace {

using V = tests::Vec<float>;
using H = SurfaceHit<V, Flat>;

/// Sheets that may touch: distances in double, as a careful renderer has them, from planes that are rounded to float.
struct TouchingSheets : SheetScene<float> {
    [[nodiscard]] std::optional<H> intersect(const V& o, const V& d, float t_min, float t_max) const {
        return intersect(o, d, t_min, t_max, Contacts<float>());
    }
    [[nodiscard]] std::optional<H> intersect(const V& o, const V& d, float t_min, float t_max,
                                             const Contacts<float>& contacts) const {
        std::optional<H> nearest;
        int nearest_rank = 0;
        for (std::size_t i = 0; i < sheets.size(); ++i) {
            const glm::dvec3 n = nephroid::normalize(glm::dvec3(sheets[i].normal));
            const double slope = nephroid::dot(n, glm::dvec3(d));
            const double distance = nephroid::dot(n, glm::dvec3(sheets[i].centre) - glm::dvec3(o)) / slope;
            if (!(distance > t_min && distance < t_max) || contacts.skips(i, float(distance), float(slope)))
                continue;
            const bool is_glass = sheets[i].event == Event::refract;
            const int rank = is_glass ? (slope > 0 ? 1 : 0) : 2;
            const double apart = nearest ? (distance - double(nearest->distance)) * std::abs(slope) : -1;
            if (apart > 1e-5 || (std::abs(apart) <= 1e-5 && rank >= nearest_rank))
                continue;
            const V p(glm::dvec3(o) + distance * glm::dvec3(d));
            nearest = H{float(distance), p, V(n), V(n), Flat{}, rounding_error(o, float(distance), p), i, i};
            nearest_rank = rank;
        }
        return nearest;
    }
};
static_assert(LetsSurfacesTouch<TouchingSheets, V>);
static_assert(!LetsSurfacesTouch<SheetScene<float>, V>);

/// Counts the surfaces of a path.
struct Surfaces {
    std::vector<std::size_t> met;
    void meet(const H& hit, bool, bool) { met.push_back(hit.surface); }
};

/// A frame at any tilt, somewhere within a few units, and points of its plane that are only as exact as float is.
struct Tilted {
    V up, middle;
    Frame<V> frame;
    Sampler<HaltonSequence>& random;

    explicit Tilted(Sampler<HaltonSequence>& numbers)
        : up(normalize(V(draw(numbers), draw(numbers), draw(numbers) + 0.01f))),
          middle(3 * draw(numbers), 3 * draw(numbers), 3 * draw(numbers)), frame(frame_about(up)), random(numbers) {}

    [[nodiscard]] static float draw(Sampler<HaltonSequence>& numbers) { return 2 * numbers.next<float>() - 1; }
    [[nodiscard]] V at(float height) const {
        return middle + (draw(random) * frame.u + (draw(random) * frame.v + height * up));
    }
    /// Downwards, 40 degrees off at most.
    [[nodiscard]] V ray() const {
        return normalize(0.5f * draw(random) * frame.u + (0.5f * draw(random) * frame.v - up));
    }
};

[[nodiscard]] std::vector<std::size_t> surfaces_of(const TouchingSheets& scene, const V& from, const V& direction,
                                                   std::optional<Deposit<V, float, 2>>* deposit = nullptr) {
    Surfaces surfaces;
    Statistics account;
    tests::Constant numbers;
    const auto found = walk(scene, tests::collimated<float>(from, direction), numbers, {}, account, surfaces);
    if (deposit != nullptr)
        *deposit = found;
    return surfaces.met;
}

} // namespace

// Water (1.33) down to height 1, glass (1.5) from there to the table at 0: at 1 and at 0 two sheets coincide.
TEST_CASE("contacts: light comes through water and glass onto the table below them at any tilt") {
    const HaltonSequence sequence;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        Sampler<HaltonSequence> random(sequence, i);
        const Tilted tilted(random);
        TouchingSheets scene;
        scene.sheets = {{tilted.at(2), tilted.up, Event::refract, 1, 1, 1.33f},  // the water's top
                        {tilted.at(0), tilted.up, Event::deposit},               // the table
                        {tilted.at(1), tilted.up, Event::refract, 1, 1, 1.5f},   // the glass's top
                        {tilted.at(1), -tilted.up, Event::refract, 1, 1, 1.33f}, // the water's bottom
                        {tilted.at(0), -tilted.up, Event::refract, 1, 1, 1.5f}}; // the glass's bottom
        std::optional<Deposit<V, float, 2>> deposit;
        const V direction = tilted.ray();
        CAPTURE(i);
        CHECK(surfaces_of(scene, tilted.at(4), direction, &deposit) == std::vector<std::size_t>{0, 2, 3, 4, 1});
        REQUIRE(deposit);
        CHECK(length(V(deposit->direction - direction)) <= 1e-5f); // as it was above: the sheets are parallel
    }
}

TEST_CASE("contacts: a table with its normal down and glass on it is met after the glass and nothing passes it") {
    const HaltonSequence sequence;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        Sampler<HaltonSequence> random(sequence, i);
        const Tilted tilted(random);
        TouchingSheets scene;
        scene.sheets = {{tilted.at(0), -tilted.up, Event::deposit},
                        {tilted.at(0), -tilted.up, Event::refract, 1, 1, 1.5f},
                        {tilted.at(1), tilted.up, Event::refract, 1, 1, 1.5f}};
        CAPTURE(i);
        CHECK(surfaces_of(scene, tilted.at(4), tilted.ray()) == std::vector<std::size_t>{2, 1, 0});
        CHECK(surfaces_of(scene, tilted.at(-4), -tilted.ray()) == std::vector<std::size_t>{1, 0}); // from below
    }
}

// A mirror under the water, against its bottom: down through the bottom, back up through it, and out.
TEST_CASE("contacts: what is reflected at a surface that touches another comes back through that one") {
    const HaltonSequence sequence;
    for (std::uint64_t i = 0; i < 4000; ++i) {
        Sampler<HaltonSequence> random(sequence, i);
        const Tilted tilted(random);
        TouchingSheets scene;
        scene.sheets = {{tilted.at(2), tilted.up, Event::refract, 1, 1, 1.33f},
                        {tilted.at(1), tilted.up, Event::reflect},
                        {tilted.at(1), -tilted.up, Event::refract, 1, 1, 1.33f},
                        {tilted.at(6), -tilted.up, Event::deposit}};
        std::optional<Deposit<V, float, 2>> deposit;
        const V direction = tilted.ray();
        CAPTURE(i);
        CHECK(surfaces_of(scene, tilted.at(4), direction, &deposit) == std::vector<std::size_t>{0, 2, 1, 2, 0, 3});
        REQUIRE(deposit);
        const V mirrored = direction - 2 * dot(direction, tilted.up) * tilted.up;
        CHECK(length(V(deposit->direction - mirrored)) <= 1e-5f);
    }
}

TEST_CASE("contacts: a ball is met again from its inside and not from where it was left") {
    Contacts<double> contacts;
    contacts.leave(7, -0.6, 1e-6, true, false); // into the ball, whose normals point out
    CHECK(contacts.skips(7, 1e-9, -0.6));
    CHECK(contacts.skips(7, -1e-9, -0.6));
    CHECK(contacts.skips(7, 1e-4, -0.001)); // the same place, badly seen
    CHECK_FALSE(contacts.skips(7, 1.2, 0.6));
    CHECK_FALSE(contacts.skips(8, 1e-9, -0.6)); // another that touches
    CHECK(contacts.skips(8, -1e-3, -0.6));      // what lies behind
}

// Sheets that are found again where the ray begins: the one that was left, as if it were the triangle beside it.
struct LeavesNothingOut : SheetScene<float> {
    using SheetScene<float>::intersect;
    [[nodiscard]] std::optional<H> intersect(const V& o, const V& d, float t_min, float t_max,
                                             const Contacts<float>&) const {
        return intersect(o, d, t_min, t_max);
    }
};
static_assert(LetsSurfacesTouch<LeavesNothingOut, V>);

TEST_CASE("contacts: a photon ends as terminated where a scene leaves nothing out") {
    const LeavesNothingOut scene{
        {{{{0, 0, 1}, {0, 0, 1}, Event::refract, 1, 1, 1.5f}, {{0, 0, 0}, {0, 0, 1}, Event::deposit}}}};
    tests::Constant numbers;
    Statistics account;
    CHECK_FALSE(walk(scene, tests::collimated<float>({0, 0, 2}, {0, 0, -1}), numbers, {}, account));
    CHECK(account[Fate::terminated].photons == 1);
}

TEST_CASE("contacts: a vertex may have more triangles than are remembered") {
    constexpr float down = -0.8f, up = 0.8f;
    Contacts<float> contacts;
    contacts.leave(0, down, 1e-6f, true, false);
    unsigned met = 0;
    for (std::uint64_t triangle = 1; triangle < 40; ++triangle)
        if (!contacts.skips(triangle, 0, down)) { // each is met at most once
            contacts.leave_beside(triangle);
            CHECK(contacts.skips(triangle, 0, down));
            ++met;
        }
    CHECK(met == 8); // 7 more are remembered, and the next one ends the list
    for (std::uint64_t triangle = 0; triangle < 40; ++triangle)
        CHECK(contacts.skips(triangle, 0, down));
    CHECK_FALSE(contacts.skips(40, 0, up));        // a table there, which faces the ray
    CHECK_FALSE(contacts.skips(40, 0.001f, down)); // what lies ahead
    contacts.leave(40, down, 1e-6f, true, false);  // elsewhere nothing is left of it
    CHECK_FALSE(contacts.skips(1, 0, down));
}

} // namespace nephroid::tests::contacts_test
