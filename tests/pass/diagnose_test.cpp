// SPDX-License-Identifier: MIT
// Each sentence is provoked by the mistake that it is about.
#include "nephroid/pass/diagnose.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/directional.hpp"
#include "nephroid/emission/light/point.hpp"
#include "nephroid/pass/photons_to_emit.hpp"
#include "nephroid/sequence/random.hpp"
#include "transport/follow.hpp"

#include <string>
#include <vector>

namespace nephroid::tests::diagnose_test {

using tests::SheetScene;

namespace {

using V = tests::Vec<double>;

template <class S, class L>
[[nodiscard]] Statistics fates_of(const S& scene, const L& light, const WalkLimits& limits = {}) {
    constexpr int photons = 1000;
    const RandomSequence random(5);
    Statistics account;
    for (int i = 0; i < photons; ++i) {
        Sampler samples(random, std::uint64_t(i));
        const auto photon = light.emit(samples, Spread<double>{photons, 1});
        if (const auto deposit = walk(scene, photon, samples, limits, account))
            account.end(Fate::splatted, deposit->flux);
    }
    return account;
}

[[nodiscard]] bool says(const std::vector<std::string>& sentences, std::size_t which, const char* what) {
    CAPTURE(sentences.size());
    if (which >= sentences.size())
        return false;
    CAPTURE(sentences[which]);
    return sentences[which].find(what) != std::string::npos;
}

/// Straight down from z = 1, a disk of radius 1.
[[nodiscard]] DirectionalLight<V, double> sun() {
    return DirectionalLight<V, double>({.direction = {0, 0, -1}, .irradiance = 1, .patch = BeamDisk<V>{{0, 0, 1}, 1}});
}

/// The mirror z = 0 below the sun, and a ceiling at z = 2.
[[nodiscard]] SheetScene<double> good_scene() { return tests::mirror_above_floor<double>(); }

/// The mirror answers something else.
template <class Change>
struct Changed {
    SheetScene<double> sheets = good_scene();
    Change change;
    [[nodiscard]] auto intersect(const V& o, const V& d, double t_min, double t_max) const {
        auto hit = sheets.intersect(o, d, t_min, t_max);
        if (hit)
            change(*hit, o, d);
        return hit;
    }
    template <class Sampler>
    [[nodiscard]] auto scatter(const SurfaceHit<V, Flat>& hit, const V& d, Sampler& sampler) const {
        return sheets.scatter(hit, d, sampler);
    }
};
template <class Change>
Changed(SheetScene<double>, Change) -> Changed<Change>;

/// Finds the surface that a ray leaves up to 0.001 behind its origin: more than its position error says.
struct Sloppy {
    SheetScene<double> sheets = good_scene();
    [[nodiscard]] auto intersect(const V& o, const V& d, double t_min, double t_max) const {
        auto hit = sheets.intersect(o - 1e-3 * d, d, t_min, t_max);
        if (hit) {
            hit->distance = (std::max)(0.0, hit->distance - 1e-3);
            hit->position = o + hit->distance * d;
        }
        return hit;
    }
    template <class Sampler>
    [[nodiscard]] auto scatter(const SurfaceHit<V, Flat>& hit, const V& d, Sampler& sampler) const {
        return sheets.scatter(hit, d, sampler);
    }
};

/// Leaves out footprints that are longer than the scene.
struct DiscardWide {
    template <class Vector>
    [[nodiscard]] Verdict operator()(Ellipse<Vector>& ellipse, scalar_t<Vector> diagonal) const {
        return length(ellipse.a) > diagonal ? Verdict::discarded : Verdict::kept;
    }
};

/// The sun with other tangents than its own.
struct Laser : DirectionalLight<V, double> {
    double scale;
    template <class Samples>
    [[nodiscard]] Photon<V, double> emit(Samples& samples, const Spread<double>& spread) const {
        auto photon = DirectionalLight<V, double>::emit(samples, spread);
        for (auto& tangent : photon.differential)
            tangent.d_position *= scale;
        return photon;
    }
};

/// Finds nothing, and counts.
struct Counting {
    mutable std::uint64_t rays = 0;
    [[nodiscard]] std::optional<SurfaceHit<V, Flat>> intersect(const V&, const V&, double, double) const {
        ++rays;
        return std::nullopt;
    }
    template <class Sampler>
    [[nodiscard]] Scattering<double, double> scatter(const SurfaceHit<V, Flat>&, const V&, Sampler&) const {
        return {};
    }
};

} // namespace

TEST_CASE("diagnose: nothing is said where all is well") { CHECK(diagnose(fates_of(good_scene(), sun())).empty()); }

TEST_CASE("diagnose: no photons and no light") {
    CHECK(says(diagnose(Statistics{}), 0, "no photon was emitted"));
    const PointLight<V, double> dark({.position = {0, 0, 1}, .intensity = 0});
    CHECK(says(diagnose(fates_of(good_scene(), dark)), 0, "emits nothing"));
}

TEST_CASE("diagnose: a lamp in a shade, and a light that is not aimed") {
    SheetScene<double> shaded = good_scene();
    shaded.sheets.push_back({{0, 0, 0.5}, {0, 0, 1}, Event::absorb});
    CHECK(says(diagnose(fates_of(shaded, sun())), 0, "100% of the photons ended at the first surface"));

    const SheetScene<double> nothing{};
    CHECK(says(diagnose(fates_of(nothing, sun())), 0, "no photon met a mirror or glass: aim the light"));

    SheetScene<double> small = good_scene();
    small.sheets[0].radius = 0.5; // a quarter of the beam
    const auto sentences = diagnose(fates_of(small, sun()));
    CHECK(says(sentences, 0, "% of the photons missed the mirrors and glass"));
    CHECK(says(sentences, 0, "7")); // 75%, to 1000 photons' noise of 1.4%
}

TEST_CASE("diagnose: light that lands nowhere") {
    SheetScene<double> open = good_scene();
    open.sheets.pop_back();
    CHECK(says(diagnose(fates_of(open, sun())), 0, "100% of the light leaves the scene"));
    // A few percent land, the others leave.
    open.sheets.push_back({{0, 0, 2}, {0, 0, 1}, Event::deposit, 1, 1, 1, 0.4});
    CHECK(says(diagnose(fates_of(open, sun())), 0, "of the photons that met a mirror or glass leave the scene"));
}

TEST_CASE("diagnose: invalid photons") {
    const auto long_normal = [](auto& hit, const V&, const V&) { hit.geometric_normal *= 1.5; };
    const Changed scene{good_scene(), long_normal};
    const auto sentences = diagnose(fates_of(scene, sun()));
    CHECK(says(sentences, 0, "no photon met") != says(sentences, 0, "100% of the photons are invalid"));
    CHECK(says(sentences, sentences.size() - 1, "100% of the photons are invalid"));
}

TEST_CASE("diagnose: surfaces that are found again, and long paths") {
    const auto sentences = diagnose(fates_of(Sloppy{}, sun(), {.specular_events = 6}));
    bool again = false, terminated = false;
    for (const std::string& sentence : sentences) {
        again = again || sentence.find("hit something where they began") != std::string::npos;
        terminated = terminated || sentence.find("terminated on long paths") != std::string::npos;
    }
    CHECK(again);
    CHECK(terminated);
}

TEST_CASE("diagnose: shading normals on the wrong side") {
    const auto turned = [](auto& hit, const V&, const V&) {
        if (hit.surface == 0)
            hit.shading_normal = normalize(V{1, 0, -0.1});
    };
    const Changed scene{good_scene(), turned};
    CHECK(says(diagnose(fates_of(scene, sun())), 0, "used the geometric normal"));

    // Bounces have such normals as well, and are counted among what could have one.
    Statistics account;
    account.emitted = {100, 1};
    account.diffuse_events = 300;
    account.diffuse_bounces = 200;
    account.corrected_normals = 20;
    CHECK(says(diagnose(account), 0, "10% of the reflections, refractions and bounces used the geometric normal"));
    account.corrected_normals = 9;
    CHECK(diagnose(account).empty());
    account.specular_events = 20;
    account.corrected_normals = 22;
    CHECK(says(diagnose(account), 0, "10% of the reflections, refractions and bounces used the geometric normal"));
}

// Each by a pass that makes the mistake.
TEST_CASE("diagnose: what happens to caustic photons at their end") {
    struct Vertex {
        V position, normal;
    };
    const auto pass_in = [](const auto& scene, const V& normal, const auto& light, std::uint64_t photons,
                            const auto& policies) {
        std::vector<Vertex> ceiling;
        for (int i = 0; i < 400; ++i)
            ceiling.push_back({{(i % 20 - 9.5) / 10, (i / 20 - 9.5) / 10, 2}, normal});
        const EyePathMap map(ceiling, &Vertex::position, &Vertex::normal);
        auto sums = nephroid::sums<double>(map);
        return diagnose(caustics(scene, light, sums, {.count = photons}, policies));
    };
    const auto pass = [&](const V& normal, const auto& light, std::uint64_t photons, const auto& policies) {
        return pass_in(good_scene(), normal, light, photons, policies);
    };
    const V down{0, 0, -1}, up{0, 0, 1};
    CHECK(pass(down, sun(), 2000, Default{}).empty());
    CHECK(says(pass(up, sun(), 2000, Default{}), 0, "100% of the caustic photons fell where no eye path vertex sees"));
    // A mirror of flat strips, each tilted by its own angle, between which tangents know nothing of one another.
    const auto strips = [](auto& hit, const V&, const V&) {
        const double tilt = 0.2 * std::sin(2.4 * std::floor(16 * hit.position.x));
        if (hit.surface == 0)
            hit.shading_normal = {std::sin(tilt), 0, std::cos(tilt)};
    };
    CHECK(says(pass_in(Changed{good_scene(), strips}, down, sun(), 6000, Default{}), 0,
               "100% of the caustic photons were splatted as published"));

    // A lamp that forgot its tangents, and no pixel filter that would hide it.
    const auto unfiltered = Published{}.with_filter(NoPixelFilter{});
    CHECK(says(pass(down, Laser{sun(), 0}, 2000, unfiltered), 0,
               "100% of the caustic photons had footprints without area"));
    // One whose tangents are the size of its beam, and a policy that leaves out what is as wide as the ceiling.
    const auto small_only = unfiltered.with_excess(DiscardWide{});
    CHECK(says(pass(down, Laser{sun(), 1000}, 2000, small_only), 0,
               "100% of the caustic photons had footprints without bounds"));
    CHECK(pass(down, sun(), 2000, small_only).empty());
}

TEST_CASE("diagnose: the worst comes first, and small shares have their decimals") {
    CHECK(nephroid::detail::percent(0.97) == "97%");
    CHECK(nephroid::detail::percent(1.0) == "100%");
    CHECK(nephroid::detail::percent(0.003) == "0.3%");
    CHECK(nephroid::detail::percent(1e-6) == "less than 0.1%");
    Statistics account = fates_of(good_scene(), sun());
    account.opaque_first = 500;
    account.fates[std::size_t(Fate::invalid)].photons = 20;
    const auto sentences = diagnose(account);
    REQUIRE(sentences.size() == 2);
    CHECK(says(sentences, 0, "50%"));
    CHECK(says(sentences, 1, "2.0%"));
}

TEST_CASE("photons to emit: the search ends early where no photon meets a mirror or glass") {
    const Counting scene;
    CHECK(photons_to_emit(scene, sun(), 1000) == 0);
    CHECK(scene.rays == 262'144);
}

} // namespace nephroid::tests::diagnose_test
