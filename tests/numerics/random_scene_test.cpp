// SPDX-License-Identifier: MIT
/// @file  For any scene and any photon walks and splats end, all numbers are finite, and the account balances.
///        NEPHROID_TESTS_LONG=1 follows a million photons of each precision.
#if __has_include("common/scene.hpp")

#include "common/scene.hpp"
#include "support/space.hpp"
#include "support/vertex.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/emission/light/standard_lights.hpp"
#include "nephroid/sequence/random.hpp"

#include <doctest/doctest.h>

#include <cfenv>
#include <cstdlib>
#include <string>
#include <vector>

namespace nephroid::tests::random_scene_test {
namespace {

constexpr int photons_per_world = 1000;

using examples::Follow;
using examples::Material;
using examples::Medium;
using examples::MeshData;
using examples::TriangleMesh;
template <class T>
using ExampleScene = examples::Scene<T>;
using nephroid::tests::Draws;

template <class T>
using Vec = glm::vec<3, T>;

// GCC respects floating-point exceptions by default; clang may raise them for numbers that are not used.
#if defined(__GNUC__) && !defined(__clang__) && !defined(__FAST_MATH__)
constexpr bool exceptions_are_kept = true;
#else
constexpr bool exceptions_are_kept = false;
#endif

/// Stops the program at an invalid operation in its scope, where the C library can: in the long run only.
class Traps {
public:
    Traps() {
#if defined(__GLIBC__)
        if (exceptions_are_kept && is_long())
            feenableexcept(FE_INVALID);
#endif
        std::feclearexcept(FE_ALL_EXCEPT);
    }
    Traps(const Traps&) = delete;
    ~Traps() {
#if defined(__GLIBC__)
        fedisableexcept(FE_INVALID);
#endif
    }

    static bool is_long() {
        const char* wanted = std::getenv("NEPHROID_TESTS_LONG");
        return wanted && *wanted == '1';
    }
};

/// Allows exceptions in the user's code in between: a box test multiplies zero by infinity.
class Unwatched {
public:
    Unwatched() { std::feholdexcept(&before_); }
    Unwatched(const Unwatched&) = delete;
    ~Unwatched() { std::fesetenv(&before_); }

private:
    std::fenv_t before_;
};

template <class T>
struct UnwatchedScene {
    using medium = Medium;
    const ExampleScene<T>& scene;

    auto intersect(const Vec<T>& o, const Vec<T>& d, T t_min, T t_max) const {
        const Unwatched here;
        return scene.intersect(o, d, t_min, t_max);
    }
    template <class Sampler>
    auto scatter(const examples::Hit<T>& hit, const Vec<T>& d, Sampler& sampler) const {
        const Unwatched here;
        return scene.scatter(hit, d, sampler);
    }
    Vec<T> transmittance(const Medium& through, T distance) const {
        const Unwatched here;
        return scene.transmittance(through, distance);
    }
};

/// A scene of any size, at any distance from the origin.
template <class T>
class World {
public:
    explicit World(std::uint32_t seed) : draws_(seed) {
        size_ = std::pow(10.0, draws_.in(-3, 3));
        if (flip())
            middle_ = point(100 * size_);
        std::vector<Material<Vec<T>>> materials;
        for (int i = 0; i < 6; ++i)
            materials.push_back(material());
        materials.push_back(Material<Vec<T>>::diffuse(color()));
        const auto any = [&] { return static_cast<std::size_t>(draws_.in(0, 7)); };
        std::vector<typename ExampleScene<T>::Part> parts;
        const int count = static_cast<int>(draws_.in(1, 9));
        for (int i = 0; i < count; ++i)
            parts.push_back(part(any()));
        parts.push_back({examples::Floor<T>(middle_.z - T(size_)), 6});
        scene_ = ExampleScene<T>(std::move(parts), std::move(materials));
    }

    [[nodiscard]] const ExampleScene<T>& scene() const { return scene_; }
    [[nodiscard]] double size() const { return size_; }

    [[nodiscard]] StandardLights<Vec<T>, Vec<T>> lights() {
        using V = Vec<T>;
        using Set = StandardLights<V, V>;
        std::vector<typename Set::AnyLight> lights;
        const int count = static_cast<int>(draws_.in(1, 4));
        while (static_cast<int>(lights.size()) < count) {
            std::optional<BoundingSphere<V>> target;
            if (flip())
                target = BoundingSphere<V>{place(), length(0.05, 1)};
            switch (static_cast<int>(draws_.in(0, 7))) {
            case 0:
                lights.push_back(PointLight<V, V>({place(), color(), target}));
                break;
            case 1:
                lights.push_back(SpotLight<V, V>(
                    {place(), direction(), T(draws_.in(0.6, 1)), T(draws_.in(-1, 0.5)), color(), target}));
                break;
            case 2:
                lights.push_back(DirectionalLight<V, V>(
                    {direction(), color(), target ? *target : BoundingSphere<V>{place(), length(0.1, 1)}}));
                break;
            case 3:
                lights.push_back(DiskLight<V, V>({place(), direction(), length(0.01, 1), color(), target}));
                break;
            case 4: {
                const V u = length(0.01, 1) * direction(), v = length(0.01, 1) * direction();
                if (nephroid::length(cross(u, v)) > T(1e-5 * size_ * size_))
                    lights.push_back(QuadLight<V, V>({place(), u, v, color(), target}));
                break;
            }
            case 5: {
                const BoundingSphere<V> ball{place(), length(0.01, 1)};
                // A light inside of its target is refused, as documented: the target may not reach into it.
                if (target && !(nephroid::length(V(target->centre - ball.centre)) > target->radius + ball.radius))
                    target.reset();
                lights.push_back(SphereLight<V, V>({ball.centre, ball.radius, color(), target}));
                break;
            }
            default: {
                const V p = place();
                lights.push_back(
                    MeshLight<V, V>({{{p, p + length(0.1, 1) * V(1, 0, 0), p + length(0.1, 1) * V(0, 1, 0)},
                                      {p, p + length(0.1, 1) * V(0, 1, 0), p + length(0.1, 1) * V(0, 0, 1)}},
                                     color(),
                                     target}));
            }
            }
        }
        return Set(std::move(lights));
    }

    /// Any ray with any tangents: zero, tiny, as long as the scene, orthogonal to the ray.
    [[nodiscard]] Photon<Vec<T>, Vec<T>> photon() {
        using V = Vec<T>;
        const V d = flip() ? direction() : V(T(0), T(0), flip() ? T(1) : T(-1)); // along an axis as well
        const Frame<V> across = frame_about(d);
        const auto tangent = [&](double most) -> V {
            const T scale = draws_.in(0, 1) < 0.2 ? T(0) : T(most * std::pow(10.0, draws_.in(-8, 0)));
            return scale * V(T(draws_.in(-1, 1)) * across.u + T(draws_.in(-1, 1)) * across.v);
        };
        return {place(), d, color(), {Tangent<V>{tangent(size_), tangent(1)}, Tangent<V>{tangent(size_), tangent(1)}}};
    }

    /// Vertices on the floor as a camera might see them.
    using Vertex = tests::Vertex<Vec<T>>;
    [[nodiscard]] std::vector<Vertex> vertices() {
        std::vector<Vertex> seen;
        for (int i = 0; i < 256; ++i)
            seen.push_back(
                {middle_ + Vec<T>(T(draws_.in(-1, 1) * size_), T(draws_.in(-1, 1) * size_), T(-size_)), {0, 0, 1}});
        return seen;
    }

private:
    bool flip() { return draws_.in(0, 1) < 0.5; }
    Vec<T> direction() { return tests::narrow<Vec<T>>(draws_.direction()); }
    Vec<T> point(double most) {
        return {T(draws_.in(-most, most)), T(draws_.in(-most, most)), T(draws_.in(-most, most))};
    }
    Vec<T> place() { return middle_ + point(size_); }
    T length(double low, double high) { return T(size_ * draws_.in(low, high)); }
    Vec<T> color() { return {T(draws_.in(0.1, 1)), T(draws_.in(0, 1)), T(draws_.in(0, 1))}; }

    Material<Vec<T>> material() {
        using M = Material<Vec<T>>;
        switch (static_cast<int>(draws_.in(0, 6))) {
        case 0:
            return M::mirror(color());
        case 1:
            return M::conductor(color(), T(3) * color());
        case 2:
            return M::diffuse(color());
        case 3:
            return M::black();
        default: {
            M glass = M::dielectric(flip() ? draws_.in(1, 2.5) : draws_.in(0.4, 1), flip(),
                                    flip() ? Follow::both : Follow::refraction);
            if (flip())
                glass.absorption = T(draws_.in(0, 5) / size_) * color();
            return glass;
        }
        }
    }

    typename ExampleScene<T>::Part part(std::size_t material) {
        switch (static_cast<int>(draws_.in(0, 6))) {
        case 0:
            return {examples::Sphere<T>(place(), length(1e-3, 1)), material};
        case 1:
            return {examples::Cylinder<T>({.base = place(),
                                           .radius = length(0.01, 1),
                                           .height = length(0.1, 2),
                                           .least_cosine = T(draws_.in(-2, 1))}),
                    material};
        case 2:
            return {examples::SineWave<T>({.height = place().z,
                                           .amplitude = length(0, 0.1),
                                           .kx = T(draws_.in(0, 3) / size_),
                                           .ky = T(draws_.in(0, 3) / size_)}),
                    material};
        case 3:
            return {examples::Quad<T>(place(), length(0.1, 1) * direction(), length(0.1, 1) * direction()), material};
        case 4:
            return {examples::Disk<T>(place(), direction(), length(0.01, 1)), material};
        default:
            return {mesh(static_cast<std::uint32_t>(material)), material};
        }
    }

    /// A heap of triangles: some needles, some without area, some with normals that lean over.
    TriangleMesh<T> mesh(std::uint32_t material) {
        MeshData<T> data;
        const Vec<T> at = place();
        const bool smooth = flip();
        const std::uint32_t count = static_cast<std::uint32_t>(draws_.in(1, 40));
        for (std::uint32_t i = 0; i < count; ++i) {
            const Vec<T> p = at + point(0.5 * size_), e = length(0, 0.3) * direction(),
                         f = length(0, 0.3) * direction();
            const double kind = draws_.in(0, 1);
            for (const Vec<T>& q : {p, p + e, kind < 0.1 ? p : kind < 0.2 ? p + T(2) * e + T(1e-4) * f : p + f}) {
                data.positions.push_back(q);
                if (smooth)
                    data.normals.push_back(kind < 0.3 ? direction()
                                                      : Vec<T>(normalize(Vec<T>(cross(direction(), f) + direction()))));
            }
            data.triangles.push_back({3 * i, 3 * i + 1, 3 * i + 2});
            data.materials.push_back(material);
        }
        for (Vec<T>& n : data.normals)
            if (!all_finite(n))
                n = Vec<T>(0);
        return TriangleMesh<T>(std::move(data));
    }

    Draws draws_;
    double size_ = 1;
    Vec<T> middle_{0};
    ExampleScene<T> scene_;
};

/// The relative error of an account by rounding: fluxes are weighted in T and summed in double, a few sums for each
/// photon.
template <class T>
constexpr double account_rounding = 64 * double(std::numeric_limits<T>::epsilon()) +
                                    2 * photons_per_world* std::numeric_limits<double>::epsilon();

template <class T>
void require_sound(const Deposit<Vec<T>, Vec<T>>& deposit) {
    constexpr T rounding = T(64) * std::numeric_limits<T>::epsilon();
    bool sound = all_finite(deposit.position) && all_finite(deposit.flux) && deposit.flux.x >= 0 &&
                 deposit.flux.y >= 0 && deposit.flux.z >= 0;
    sound = sound && abs(length2(deposit.direction) - T(1)) < T(16) * rounding &&
            abs(length2(deposit.normal) - T(1)) < rounding;
    sound = sound && dot(deposit.normal, deposit.direction) <= T(0);
    for (const Vec<T>& d : deposit.d_position)
        sound = sound && all_finite(d);
    if (!sound) // a million CHECKs take their time
        CHECK_MESSAGE(sound, "position, direction or footprint of a deposit is unsound");
}

std::uint32_t seed_of(int world) { return 0x9e3779b9u * static_cast<std::uint32_t>(world + 1) | 1u; }

int worlds() { return Traps::is_long() ? 1000 : 30; }

} // namespace

TEST_CASE_TEMPLATE("random scenes: every walk ends in finite numbers and all its flux is accounted for", T, float,
                   double) {
    std::uint64_t deposits = 0, bent = 0;
    for (int w = 0; w < worlds(); ++w) {
        CAPTURE(w);
        World<T> world(seed_of(w));
        const auto lights = world.lights();
        const UnwatchedScene<T> scene{world.scene()};
        const RandomSequence sequence(static_cast<std::uint64_t>(w));
        Statistics account;
        double deposited = 0;
        std::uint64_t deposited_here = 0;
        {
            const Traps traps;
            for (std::uint64_t i = 0; i < photons_per_world; ++i) {
                Sampler<RandomSequence> sampler(sequence, i);
                const auto photon =
                    i % 2 == 0 ? lights.emit(sampler, Spread<T>{T(photons_per_world), T(8)}) : world.photon();
                const auto deposit = walk(scene, photon, sampler, WalkLimits{}, account);
                if (!deposit)
                    continue;
                require_sound<T>(*deposit);
                ++deposited_here;
                deposited += double(flux_traits<Vec<T>>::power(deposit->flux));
            }
            if (exceptions_are_kept)
                CHECK(std::fetestexcept(FE_INVALID) == 0);
        }
        std::uint64_t ended = 0;
        for (const Tally& tally : account.fates)
            ended += tally.photons;
        CHECK(ended + deposited_here == photons_per_world);
        deposits += deposited_here;
        CHECK(account.emitted.photons == photons_per_world);
        CHECK(std::abs(account.emitted.flux - account.accounted_flux() - deposited) <=
              account_rounding<T> * account.emitted.flux);
        for (const Fate fate : {Fate::invalid, Fate::absorbed, Fate::escaped, Fate::direct})
            CHECK(account[fate].flux >= -account_rounding<T> * account.emitted.flux);
        CHECK(account[Fate::invalid].photons <= photons_per_world / 20);
        bent += account.specular_events;
    }
    CHECK(deposits > std::uint64_t(worlds()) * photons_per_world / 50);
    CHECK(bent > std::uint64_t(worlds()) * photons_per_world / 10);
}

TEST_CASE_TEMPLATE("random scenes: every splat is finite and the whole pass balances", T, float, double) {
    using V = Vec<T>;
    std::uint64_t splatted = 0, bounded = 0;
    for (int w = 0; w < worlds() / 5; ++w) {
        CAPTURE(w);
        World<T> world(seed_of(w + 100000));
        const auto lights = world.lights();
        const UnwatchedScene<T> scene{world.scene()};
        const auto vertices = world.vertices();
        const EyePathMap map(vertices, &World<T>::Vertex::position, &World<T>::Vertex::normal);
        auto sums = nephroid::sums<V>(map);
        const Traps traps;
        const Statistics account = caustics(scene, lights, sums, {.count = photons_per_world, .smoothing = 10});
        if (exceptions_are_kept)
            CHECK(std::fetestexcept(FE_INVALID) == 0);
        CHECK(std::abs(account.emitted.flux - account.accounted_flux()) <= account_rounding<T> * account.emitted.flux);
        bool finite = true;
        sums.for_each(
            [&](std::size_t, const V& e) { finite = finite && all_finite(e) && e.x >= 0 && e.y >= 0 && e.z >= 0; });
        CHECK(finite);
        splatted += account[Fate::splatted].photons;
        bounded += account.bounded_footprints;
    }
    CHECK(splatted > 0);
    CHECK(bounded > 0);
}

} // namespace nephroid::tests::random_scene_test
#endif
