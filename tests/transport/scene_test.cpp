// SPDX-License-Identifier: MIT
#include "transport/tiny_scenes.hpp"

#include <memory>

namespace nephroid::tests::scene_test {

using tests::Constant;

namespace {

using V = glm::vec3;

struct NakedHit {
    float distance;
    V geometric_normal;
    Flat curvature;
};
struct HitWithoutCurvature {
    float distance;
    V geometric_normal;
    float position_error;
};

/// Intersects with this kind of hit and scatters, no more.
template <class H>
struct Minimal {
    std::optional<H> intersect(const V&, const V&, float, float) const { return std::nullopt; }
    template <class S>
    Scattering<float, float> scatter(const H&, const V&, S&) const {
        return {};
    }
};
struct Spawner : Minimal<NakedHit> {
    V spawn(const NakedHit&, const V& direction) const { return direction; }
};
struct ReturnsPointer {
    std::unique_ptr<SurfaceHit<V, Flat>> intersect(const V&, const V&, float, float) const { return nullptr; }
};
struct NotConst {
    std::optional<SurfaceHit<V, Flat>> intersect(const V&, const V&, float, float) { return std::nullopt; }
};
struct NeverMisses {
    SurfaceHit<V, Flat> intersect(const V&, const V&, float, float) const { return {}; }
};
struct DoesNotScatter {
    std::optional<SurfaceHit<V, Flat>> intersect(const V&, const V&, float, float) const { return std::nullopt; }
};
struct ScattersWithoutEta : DoesNotScatter {
    struct Answer {
        Event event;
        float weight;
    };
    template <class S>
    Answer scatter(const SurfaceHit<V, Flat>&, const V&, S&) const {
        return {};
    }
};
struct Foggy : Minimal<SurfaceHit<V, Flat>> {
    using medium = float;
    float transmittance(float, float) const { return 1; }
};
struct FoggyWithoutMedium : Minimal<SurfaceHit<V, Flat>> {
    float transmittance(float, float) const { return 1; }
};

static_assert(Scene<tests::SheetScene<float>, V, Constant>);
static_assert(Scene<tests::SheetScene<double>, glm::dvec3, Constant>);
static_assert(Scene<Minimal<SurfaceHit<V, Flat>>, V, Constant>);
static_assert(RayTracer<ReturnsPointer, V>);

// A hit that does not say how its normal changes is no hit.
static_assert(RayTracer<Minimal<HitWithoutCurvature>, V> && !Hit<HitWithoutCurvature, V>); // enough without tangents
// Nor may a ray start where it would hit its own surface: the hit bounds its error, or the scene spawns.
static_assert(!KeepsRaysOffSurfaces<Minimal<NakedHit>, V> && !RayTracer<Minimal<NakedHit>, V>);
static_assert(SpawnsRays<Spawner, V> && RayTracer<Spawner, V> && Scene<Spawner, V, Constant>);

static_assert(!Intersects<NotConst, V> && !Intersects<NeverMisses, V> && !Intersects<int, V> && !RayTracer<int, V>);
static_assert(RayTracer<DoesNotScatter, V> && !Scatters<DoesNotScatter, V, Constant>);
static_assert(!Scene<DoesNotScatter, V, Constant> && !Scene<ScattersWithoutEta, V, Constant>);

static_assert(Absorbs<Foggy, V> && Scene<Foggy, V, Constant>);
static_assert(!Absorbs<FoggyWithoutMedium, V> && !Absorbs<tests::SheetScene<float>, V>);

} // namespace

// Its hit is given by pointer, as some ray tracers do.
TEST_CASE("scene: a hit may come in anything that reads like an optional") {
    struct OneFloor : ReturnsPointer {
        std::unique_ptr<SurfaceHit<V, Flat>> intersect(const V& o, const V& d, float, float) const {
            const float distance = -o.z / d.z;
            const V n{0, 0, 1};
            return distance > 0 ? std::make_unique<SurfaceHit<V, Flat>>(
                                      SurfaceHit<V, Flat>{distance, o + distance * d, n, n, {}, 1e-6f})
                                : nullptr;
        }
        Scattering<float, float> scatter(const SurfaceHit<V, Flat>&, const V&, Constant&) const {
            return Scattering<float, float>::deposit();
        }
    };
    Statistics account;
    Constant sampler;
    const auto deposit = walk(OneFloor{}, tests::collimated<float>({0, 0, 1}, {0, 0, -1}), sampler, {}, account);
    CHECK(!deposit);
    CHECK(account[Fate::direct].photons == 1);
    (void)walk(OneFloor{}, tests::collimated<float>({0, 0, 1}, {0, 0, 1}), sampler, {}, account);
    CHECK(account[Fate::escaped].photons == 1);
}

} // namespace nephroid::tests::scene_test
