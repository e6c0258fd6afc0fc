// SPDX-License-Identifier: MIT
/// @file  Caustics in a renderer in the manner of pbrt: separate types for points, vectors and normals, hits with dpdu,
///        dpdv, dndu, dndv, a spectrum class, several lights, and a film of tiles that threads add to atomically.
#include "picture.hpp"

#include <array>
#include <atomic>
#include <cmath>
#include <iostream>
#include <memory>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

/// The renderer as it was before.
namespace pbrtish {

using Float = float;

struct Vector3f {
    Float x = 0, y = 0, z = 0;
    Vector3f operator*(Float s) const { return {s * x, s * y, s * z}; }
};
struct Point3f {
    Float x = 0, y = 0, z = 0;
    Vector3f operator-(Point3f p) const { return {x - p.x, y - p.y, z - p.z}; }
    Point3f operator+(Vector3f v) const { return {x + v.x, y + v.y, z + v.z}; }
};
struct Normal3f {
    Float x = 0, y = 0, z = 0;
};
inline Float Dot(Vector3f a, Vector3f b) { return a.x * b.x + a.y * b.y + a.z * b.z; }
inline Float Dot(Vector3f v, Normal3f n) { return v.x * n.x + v.y * n.y + v.z * n.z; }

struct RGBSpectrum {
    std::array<Float, 3> c{};
    RGBSpectrum operator+(const RGBSpectrum& s) const { return {{c[0] + s.c[0], c[1] + s.c[1], c[2] + s.c[2]}}; }
    RGBSpectrum operator*(const RGBSpectrum& s) const { return {{c[0] * s.c[0], c[1] * s.c[1], c[2] * s.c[2]}}; }
    RGBSpectrum operator*(Float s) const { return {{c[0] * s, c[1] * s, c[2] * s}}; }
    [[nodiscard]] Float Average() const { return (c[0] + c[1] + c[2]) / 3; }
};

struct Ray {
    Point3f o;
    Vector3f d;
    Float tMin, tMax;
};

struct Primitive;

struct SurfaceInteraction {
    Float t;
    Point3f p;
    Vector3f pError;
    Normal3f n, ns; ///< geometric and shading
    Vector3f dpdu, dpdv;
    Normal3f dndu, dndv;
    const Primitive* primitive;
};

struct Primitive {
    virtual ~Primitive() = default;
    [[nodiscard]] virtual std::optional<SurfaceInteraction> Intersect(const Ray& ray) const = 0;
    Float eta = 0; ///< of a smooth dielectric; 0 is a diffuse surface
};

/// A sphere in spherical coordinates: u about the z axis, v from the south pole to the north pole.
struct Sphere : Primitive {
    Point3f center;
    Float radius = 1;

    [[nodiscard]] std::optional<SurfaceInteraction> Intersect(const Ray& ray) const override {
        const Vector3f o = ray.o - center;
        const Float middle = -Dot(o, ray.d);
        const Vector3f closest{o.x + middle * ray.d.x, o.y + middle * ray.d.y, o.z + middle * ray.d.z};
        const Float half2 = radius * radius - Dot(closest, closest);
        if (half2 < 0)
            return {};
        Float t = middle - std::sqrt(half2);
        if (!(t > ray.tMin && t < ray.tMax))
            t = middle + std::sqrt(half2);
        if (!(t > ray.tMin && t < ray.tMax))
            return {};

        Vector3f r{o.x + t * ray.d.x, o.y + t * ray.d.y, o.z + t * ray.d.z};
        r = r * (radius / std::sqrt(Dot(r, r)));
        const Float pi = std::numbers::pi_v<Float>, rho = std::sqrt(r.x * r.x + r.y * r.y);
        const Float cosPhi = rho > 0 ? r.x / rho : 1, sinPhi = rho > 0 ? r.y / rho : 0;
        const Vector3f dpdu{-2 * pi * r.y, 2 * pi * r.x, 0}, dpdv{-pi * r.z * cosPhi, -pi * r.z * sinPhi, pi * rho};
        const auto overRadius = [&](Vector3f v) { return Normal3f{v.x / radius, v.y / radius, v.z / radius}; };
        const Float error = 5 * 6e-8f * (std::abs(center.x) + std::abs(center.y) + std::abs(center.z) + radius);
        const Normal3f n = overRadius(r);
        return SurfaceInteraction{t,    center + r,       {error, error, error}, n,   n, dpdu,
                                  dpdv, overRadius(dpdu), overRadius(dpdv),      this};
    }
};

struct Ground : Primitive {
    [[nodiscard]] std::optional<SurfaceInteraction> Intersect(const Ray& ray) const override {
        const Float t = -ray.o.z / ray.d.z;
        if (!(t > ray.tMin && t < ray.tMax))
            return {};
        return SurfaceInteraction{t,         {ray.o.x + t * ray.d.x, ray.o.y + t * ray.d.y, 0},
                                  {},        {0, 0, 1},
                                  {0, 0, 1}, {1, 0, 0},
                                  {0, 1, 0}, {},
                                  {},        this};
    }
};

struct Light {
    enum Kind { Distant, Point } kind;
    Vector3f from; ///< where a point light is, the direction towards a distant one
    RGBSpectrum spectrum;
};

struct Scene {
    std::vector<std::unique_ptr<Primitive>> primitives;
    std::vector<Light> lights;
    Point3f specularCenter; ///< of a sphere about all that is not diffuse
    Float specularRadius = 1;

    [[nodiscard]] std::optional<SurfaceInteraction> Intersect(Ray ray) const {
        std::optional<SurfaceInteraction> nearest;
        for (const auto& primitive : primitives)
            if (const auto isect = primitive->Intersect(ray)) {
                nearest = isect;
                ray.tMax = isect->t;
            }
        return nearest;
    }
};

/// Pixels in tiles of 16 x 16, each value an atomic that any thread may add to.
class Film {
public:
    static constexpr int tileSize = 16;
    explicit Film(int resolution) : resolution_(resolution), values_(std::size_t(resolution * resolution) * 3) {}

    [[nodiscard]] int Resolution() const { return resolution_; }
    void AddSplat(int x, int y, const RGBSpectrum& s) {
        const int tiles = resolution_ / tileSize, tile = (y / tileSize) * tiles + x / tileSize;
        const int inTile = (y % tileSize) * tileSize + x % tileSize;
        for (std::size_t i = 0; i < 3; ++i)
            values_[Offset(tile, inTile) + i].fetch_add(s.c[i], std::memory_order_relaxed);
    }
    [[nodiscard]] std::vector<float> Rows() const {
        std::vector<float> rows;
        for (int y = 0; y < resolution_; ++y)
            for (int x = 0; x < resolution_; ++x)
                for (std::size_t i = 0; i < 3; ++i) {
                    const int tile = (y / tileSize) * (resolution_ / tileSize) + x / tileSize;
                    rows.push_back(values_[Offset(tile, (y % tileSize) * tileSize + x % tileSize) + i].load());
                }
        return rows;
    }

private:
    static std::size_t Offset(int tile, int inTile) {
        return (std::size_t(tile) * tileSize * tileSize + std::size_t(inTile)) * 3;
    }
    int resolution_;
    std::vector<std::atomic<float>> values_;
};

/// Where a pixel's ray has ended; `beta` is the path's throughput times the surface's BRDF, albedo / π, here 1.
struct VisiblePoint {
    Point3f p;
    Normal3f n;
    int x, y;
    RGBSpectrum beta;
};

std::vector<VisiblePoint> TraceCamera(const Film& film) {
    std::vector<VisiblePoint> visible;
    const auto at = [&](int i) { return (Float(i) + 0.5f) / Float(film.Resolution()) - 0.5f; };
    for (int y = 0; y < film.Resolution(); ++y)
        for (int x = 0; x < film.Resolution(); ++x)
            visible.push_back({{at(x), at(y), 0}, {0, 0, 1}, x, y, {{1, 1, 1}}});
    return visible;
}

} // namespace pbrtish

// adapter begins
#include <nephroid/nephroid.hpp>

using namespace pbrtish;

// One of the three types is nephroid's vector; `vec` turns the others into it, and `point` goes back.
template <>
struct nephroid::vector_traits<Vector3f> {
    using scalar = Float;
    static Vector3f make(Float x, Float y, Float z) { return {x, y, z}; }
    static Float x(const Vector3f& v) { return v.x; }
    static Float y(const Vector3f& v) { return v.y; }
    static Float z(const Vector3f& v) { return v.z; }
};
static Vector3f vec(const auto& t) { return {t.x, t.y, t.z}; }
static Point3f point(const Vector3f& v) { return {v.x, v.y, v.z}; }

// The flux of a photon is the renderer's spectrum: what it counts for where one number is wanted, and its zero.
template <>
struct nephroid::flux_traits<RGBSpectrum> {
    static double power(const RGBSpectrum& s) { return double(s.Average()); }
    static RGBSpectrum zero() { return {}; }
};

// The scene as photons see it. An interaction has all that nephroid asks of a hit, under names of its own.
struct CausticScene {
    using Hit = nephroid::SurfaceHit<Vector3f, nephroid::ParametricCurvature<Vector3f>>;
    using Scattering = nephroid::Scattering<RGBSpectrum, Float>;
    struct Found : Hit { // and the primitive, so that `scatter` need not look for it
        const Primitive* primitive;
    };
    const Scene& scene;

    std::optional<Found> intersect(const Vector3f& o, const Vector3f& d, Float tMin, Float tMax) const {
        const std::optional<SurfaceInteraction> isect = scene.Intersect({point(o), d, tMin, tMax});
        if (!isect)
            return {};
        const SurfaceInteraction& s = *isect;
        const Float error =
            std::sqrt(Dot(s.pError, s.pError)); // pError is a box about p: no corner of it is further off
        // dndu and dndv are the shading normal's, which is the one that mirrors and glass turn photons by.
        const nephroid::ParametricCurvature<Vector3f> curvature{s.dpdu, s.dpdv, vec(s.dndu), vec(s.dndv)};
        return Found{{s.t, vec(s.p), vec(s.n), vec(s.ns), curvature, error}, s.primitive};
    }
    Scattering scatter(const Found& hit, const Vector3f& d, auto& /*random numbers*/) const {
        const Float eta = hit.primitive->eta;
        if (eta == 0) // a diffuse surface: the photon is splatted
            return Scattering::deposit();
        const bool entering = Dot(d, hit.geometric_normal) < 0;
        return Scattering::refract({{1, 1, 1}}, entering ? 1 / eta : eta); // the whole flux; n before over n behind
    }
};

// One light that is all of the renderer's, each aimed at what is specular; photons are shared among them by power.
nephroid::StandardLights<Vector3f, RGBSpectrum> PhotonLights(const Scene& scene) {
    using Lights = nephroid::StandardLights<Vector3f, RGBSpectrum>;
    const nephroid::BoundingSphere<Vector3f> target{vec(scene.specularCenter), scene.specularRadius};
    std::vector<Lights::AnyLight> lights;
    for (const Light& l : scene.lights)
        if (l.kind == Light::Distant)
            lights.push_back(nephroid::DirectionalLight<Vector3f, RGBSpectrum>({l.from * -1, l.spectrum, target}));
        else
            lights.push_back(nephroid::PointLight<Vector3f, RGBSpectrum>({l.from, l.spectrum, target}));
    return Lights(std::move(lights));
}

// Adds the caustics of all lights to the film.
void AddCaustics(const Scene& scene, const std::vector<VisiblePoint>& visible, Film& film) {
    // Projections give the points as vectors; the map copies what it needs.
    const auto position = [](const VisiblePoint& v) { return vec(v.p); };
    const auto normal = [](const VisiblePoint& v) { return vec(v.n); };
    const nephroid::EyePathMap map(visible, position, normal);
    auto sums = nephroid::sums<RGBSpectrum>(map);
    nephroid::ThreadExecutor threads; // one per core; the sums are the same for any number
    for (const std::string& sentence : nephroid::diagnose(nephroid::caustics(
             CausticScene{scene}, PhotonLights(scene), sums, {.count = 100'000, .smoothing = 5}, threads)))
        std::cerr << sentence << '\n';
    sums.for_each([&](std::size_t i, const RGBSpectrum& irradiance) {
        film.AddSplat(visible[i].x, visible[i].y, visible[i].beta * irradiance);
    });
}
// adapter ends

int main(int argc, char** argv) {
    Scene scene;
    scene.primitives.push_back(std::make_unique<Ground>());
    auto ball = std::make_unique<Sphere>();
    ball->center = scene.specularCenter = {0, 0, 1.25f};
    ball->eta = 1.5f;
    scene.primitives.push_back(std::move(ball));
    // A red sun and a green lamp, each straight above: the red of the picture is the one's caustic, the green the
    // other's.
    scene.lights = {{Light::Distant, {0, 0, 1}, {{1, 0, 0}}}, {Light::Point, {0, 0, 5.25f}, {{0, 16, 0}}}};

    Film film(256);
    AddCaustics(scene, TraceCamera(film), film);
    return write_pfm(argc > 1 ? argv[1] : "pbrt_like.pfm", 256, 3, film.Rows()) ? 0 : 1;
}
