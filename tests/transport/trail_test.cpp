// SPDX-License-Identifier: MIT
#include "nephroid/transport/trail.hpp"

#include "transport/tiny_scenes.hpp"

#include "nephroid/sequence/random.hpp"

#include <cstring>
#include <set>

namespace nephroid::tests::trail_test {

using tests::Constant;
using tests::from_point;
using tests::SheetScene;
using tests::Vec;

namespace {

struct Meeting {
    std::uint64_t surface;
    bool from_front, passed;
};

[[nodiscard]] std::uint32_t signature_of(const std::vector<Meeting>& path) {
    PathSignature signature;
    for (const Meeting& meeting : path)
        signature.meet(meeting, meeting.from_front, meeting.passed);
    return signature.value();
}

/// What a trail was told of.
struct Notes {
    std::vector<Meeting> met;
    template <class Hit>
    void meet(const Hit& hit, bool from_front, bool passed) {
        met.push_back({hit.surface, from_front, passed});
    }
};

/// A slab of glass over a floor, and a mirror behind its left half that throws light up again onto a ceiling.
[[nodiscard]] SheetScene<double> slab() {
    return {{{{0, 0, 1}, {0, 0, 1}, Event::refract, 0.9, 1, 1.5},
             {{0, 0, 0.5}, {0, 0, 1}, Event::refract, 0.9, 1.5, 1},
             {{-1, 0, 0}, {0, 0, 1}, Event::reflect, 0.9, 1, 1, 1},
             {{0, 0, -1}, {0, 0, 1}, Event::deposit},
             {{0, 0, 3}, {0, 0, 1}, Event::deposit}}};
}

struct Outcome {
    std::optional<Deposit<Vec<double>, double>> deposit;
    Statistics account;
};

template <class... Trail>
[[nodiscard]] Outcome outcome(const Vec<double>& direction, Trail&&... trail) {
    Outcome result;
    const RandomSequence random(1);
    Sampler<RandomSequence> sampler(random, 0);
    result.deposit = walk(slab(), from_point<double>({0, 0, 2}, direction), sampler, {.roulette_after = 1},
                          result.account, trail...);
    return result;
}

[[nodiscard]] bool same_bits(const Outcome& a, const Outcome& b) {
    if (a.deposit.has_value() != b.deposit.has_value() || a.account.rays != b.account.rays ||
        a.account.emitted.flux != b.account.emitted.flux)
        return false;
    for (std::size_t i = 0; i < fate_count; ++i)
        if (a.account.fates[i].flux != b.account.fates[i].flux ||
            a.account.fates[i].photons != b.account.fates[i].photons)
            return false;
    return !a.deposit || std::memcmp(&*a.deposit, &*b.deposit, sizeof *a.deposit) == 0;
}

} // namespace

TEST_CASE("trail: equal paths have equal signatures and paths that differ in anything have different ones") {
    const std::vector<Meeting> path{{3, true, true}, {4, false, true}, {0, true, false}};
    CHECK(signature_of(path) == signature_of(path));
    for (std::size_t i = 0; i < path.size(); ++i) {
        CAPTURE(i);
        auto other = path;
        other[i].surface = 7;
        CHECK(signature_of(other) != signature_of(path));
        other = path;
        other[i].from_front = !path[i].from_front;
        CHECK(signature_of(other) != signature_of(path));
        other = path;
        other[i].passed = !path[i].passed;
        CHECK(signature_of(other) != signature_of(path));
    }
    CHECK(signature_of({path[1], path[0], path[2]}) != signature_of(path)); // the order counts
    CHECK(signature_of({path[0], path[1]}) != signature_of(path));          // and the length
    CHECK(signature_of({}) != signature_of(path));
}

// 4 surfaces, 2 sides and 2 events for up to 4 meetings: 16 + 16² + 16³ + 16⁴ = 69904 paths. Among so many random
// numbers of 32 bits 0.57 pairs would coincide on average; a hash that drops a bit of its input would have thousands.
TEST_CASE("trail: no short path shares its signature with another") {
    std::set<std::uint32_t> seen;
    std::size_t paths = 0;
    std::vector<PathSignature> ends{PathSignature{}};
    for (int meetings = 1; meetings <= 4; ++meetings) {
        std::vector<PathSignature> longer;
        for (const PathSignature& end : ends)
            for (unsigned i = 0; i < 16; ++i) {
                PathSignature next = end;
                const Meeting meeting{i / 4, (i & 1) != 0, (i & 2) != 0};
                next.meet(meeting, meeting.from_front, meeting.passed);
                longer.push_back(next);
                seen.insert(next.value());
                ++paths;
            }
        ends = std::move(longer);
    }
    CHECK(paths == 69904);
    CHECK(seen.size() + 5 >= paths); // more than five pairs by chance: a probability below 1e-5
}

TEST_CASE("trail: surfaces are told apart where hits name them") {
    struct Nameless {};
    PathSignature once, twice;
    once.meet(Nameless{}, true, true);
    twice.meet(Nameless{}, true, true);
    CHECK(once.value() == twice.value());
    twice.meet(Nameless{}, true, true);
    CHECK(once.value() != twice.value());
    struct Narrow {
        unsigned short surface;
    };
    PathSignature narrow, wide;
    narrow.meet(Narrow{5}, true, false);
    wide.meet(Meeting{5, true, false}, true, false);
    CHECK(narrow.value() == wide.value());
}

TEST_CASE("trail: a walk notes each surface with its side and whether the photon went on through it") {
    Notes notes;
    REQUIRE(outcome({0.3, 0, -1}, notes).deposit);
    REQUIRE(notes.met.size() == 3);
    for (const Meeting& meeting : notes.met)
        CHECK(meeting.from_front);
    CHECK(notes.met[0].surface == 0);
    CHECK(notes.met[0].passed);
    CHECK(notes.met[1].surface == 1);
    CHECK(notes.met[1].passed);
    CHECK(notes.met[2].surface == 3); // the floor, where it stays
    CHECK(!notes.met[2].passed);

    Notes back; // by way of the mirror: through the slab again, from below
    WalkLimits limits;
    Statistics account;
    Constant sampler;
    REQUIRE(walk(slab(), from_point<double>({0, 0, 2}, {-0.3, 0, -1}), sampler, limits, account, back));
    const std::vector<Meeting> expected{{0, true, true},  {1, true, true},  {2, true, false},
                                        {1, false, true}, {0, false, true}, {4, false, false}};
    REQUIRE(back.met.size() == expected.size());
    for (std::size_t i = 0; i < expected.size(); ++i) {
        CAPTURE(i);
        CHECK(back.met[i].surface == expected[i].surface);
        CHECK(back.met[i].from_front == expected[i].from_front);
        CHECK(back.met[i].passed == expected[i].passed);
    }
}

// sin a = 1.5 sin a': from inside, beyond 41.8 degrees, the photon that was to be refracted is reflected.
TEST_CASE("trail: total internal reflection is another path") {
    const SheetScene<double> glass{{{{0, 0, 0}, {0, 0, 1}, Event::refract, 1.0, 1.5, 1},
                                    {{0, 0, -1}, {0, 0, 1}, Event::deposit},
                                    {{0, 0, 2}, {0, 0, 1}, Event::deposit}}};
    const auto notes_of = [&](double tangent) {
        Notes notes;
        Statistics account;
        Constant sampler;
        REQUIRE(walk(glass, from_point<double>({0, 0, 1}, {tangent, 0, -1}), sampler, WalkLimits{}, account, notes));
        return notes.met;
    };
    const auto refracted = notes_of(0.85), reflected = notes_of(0.95); // the critical angle's tangent: 0.894
    CHECK(refracted[0].passed);
    CHECK(!reflected[0].passed);
    CHECK(signature_of(refracted) != signature_of(reflected));
}

TEST_CASE("trail: whatever is noted the walk is the same bit for bit") {
    int arrived = 0;
    for (int i = -20; i <= 20; ++i) {
        const Vec<double> direction{0.05 * i, 0.1, -1};
        const Outcome plain = outcome(direction);
        Notes notes;
        PathSignature signature;
        CHECK(same_bits(plain, outcome(direction, NoVisitor{})));
        CHECK(same_bits(plain, outcome(direction, notes)));
        CHECK(same_bits(plain, outcome(direction, signature)));
        CHECK(signature.value() == signature_of(notes.met));
        arrived += plain.deposit.has_value();
    }
    CHECK(arrived > 10);
    CHECK(arrived < 41); // roulette took some
}

} // namespace nephroid::tests::trail_test
