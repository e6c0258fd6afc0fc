// SPDX-License-Identifier: MIT
/// @file  A caustic on the floor of the ray tracer that one writes in a weekend: a list of spheres, hit records,
///        materials that scatter rays.
#include "picture.hpp"

#include <cmath>
#include <cstddef>
#include <iostream>
#include <limits>
#include <memory>
#include <random>
#include <string>
#include <vector>

// The renderer as it was before. Its camera, and what is not needed for a caustic, is left out.

inline double random_double() {
    thread_local std::mt19937 generator;
    return std::uniform_real_distribution<double>(0, 1)(generator);
}

class vec3 {
public:
    double e[3];
    vec3() : e{0, 0, 0} {}
    vec3(double e0, double e1, double e2) : e{e0, e1, e2} {}
    double x() const { return e[0]; }
    double y() const { return e[1]; }
    double z() const { return e[2]; }
    vec3 operator-() const { return vec3(-e[0], -e[1], -e[2]); }
    double operator[](std::size_t i) const { return e[i]; }
    vec3& operator+=(const vec3& v) {
        for (std::size_t i = 0; i < 3; ++i)
            e[i] += v.e[i];
        return *this;
    }
    double length_squared() const { return e[0] * e[0] + e[1] * e[1] + e[2] * e[2]; }
    double length() const { return std::sqrt(length_squared()); }
};
using point3 = vec3;
using color = vec3;

inline vec3 operator+(const vec3& u, const vec3& v) { return vec3(u.e[0] + v.e[0], u.e[1] + v.e[1], u.e[2] + v.e[2]); }
inline vec3 operator-(const vec3& u, const vec3& v) { return vec3(u.e[0] - v.e[0], u.e[1] - v.e[1], u.e[2] - v.e[2]); }
inline vec3 operator*(const vec3& u, const vec3& v) { return vec3(u.e[0] * v.e[0], u.e[1] * v.e[1], u.e[2] * v.e[2]); }
inline vec3 operator*(double t, const vec3& v) { return vec3(t * v.e[0], t * v.e[1], t * v.e[2]); }
inline vec3 operator*(const vec3& v, double t) { return t * v; }
inline vec3 operator/(const vec3& v, double t) { return (1 / t) * v; }
inline double dot(const vec3& u, const vec3& v) { return u.e[0] * v.e[0] + u.e[1] * v.e[1] + u.e[2] * v.e[2]; }
inline vec3 cross(const vec3& u, const vec3& v) {
    return vec3(u.e[1] * v.e[2] - u.e[2] * v.e[1], u.e[2] * v.e[0] - u.e[0] * v.e[2],
                u.e[0] * v.e[1] - u.e[1] * v.e[0]);
}
inline vec3 unit_vector(const vec3& v) { return v / v.length(); }
inline vec3 random_in_unit_sphere() {
    for (;;) {
        const vec3 p(2 * random_double() - 1, 2 * random_double() - 1, 2 * random_double() - 1);
        if (p.length_squared() < 1)
            return p;
    }
}
inline vec3 reflect(const vec3& v, const vec3& n) { return v - 2 * dot(v, n) * n; }
inline vec3 refract(const vec3& uv, const vec3& n, double etai_over_etat) {
    const double cos_theta = std::fmin(dot(-uv, n), 1.0);
    const vec3 r_out_perp = etai_over_etat * (uv + cos_theta * n);
    return r_out_perp - std::sqrt(std::fabs(1 - r_out_perp.length_squared())) * n;
}

class ray {
public:
    ray() {}
    ray(const point3& origin, const vec3& direction) : orig(origin), dir(direction) {}
    const point3& origin() const { return orig; }
    const vec3& direction() const { return dir; }
    point3 at(double t) const { return orig + t * dir; }

private:
    point3 orig;
    vec3 dir;
};

class material;

struct hit_record {
    point3 p;
    vec3 normal;
    std::shared_ptr<material> mat_ptr;
    double t = 0;
    bool front_face = true;
    void set_face_normal(const ray& r, const vec3& outward_normal) {
        front_face = dot(r.direction(), outward_normal) < 0;
        normal = front_face ? outward_normal : -outward_normal;
    }
};

class material {
public:
    virtual ~material() = default;
    virtual bool scatter(const ray& r_in, const hit_record& rec, color& attenuation, ray& scattered) const = 0;
};

class lambertian : public material {
public:
    explicit lambertian(const color& a) : albedo(a) {}
    bool scatter(const ray&, const hit_record& rec, color& attenuation, ray& scattered) const override {
        scattered = ray(rec.p, rec.normal + unit_vector(random_in_unit_sphere()));
        attenuation = albedo;
        return true;
    }
    color albedo;
};

class dielectric : public material {
public:
    explicit dielectric(double index_of_refraction) : ir(index_of_refraction) {}
    bool scatter(const ray& r_in, const hit_record& rec, color& attenuation, ray& scattered) const override {
        attenuation = color(1, 1, 1);
        const double refraction_ratio = rec.front_face ? 1 / ir : ir;
        const vec3 unit_direction = unit_vector(r_in.direction());
        const double cos_theta = std::fmin(dot(-unit_direction, rec.normal), 1.0);
        const bool cannot_refract = refraction_ratio * std::sqrt(1 - cos_theta * cos_theta) > 1;
        const bool reflects = cannot_refract || reflectance(cos_theta, refraction_ratio) > random_double();
        scattered = ray(rec.p, reflects ? reflect(unit_direction, rec.normal)
                                        : refract(unit_direction, rec.normal, refraction_ratio));
        return true;
    }
    /// Schlick's approximation.
    static double reflectance(double cosine, double ref_idx) {
        const double r0 = (1 - ref_idx) / (1 + ref_idx) * ((1 - ref_idx) / (1 + ref_idx));
        return r0 + (1 - r0) * std::pow(1 - cosine, 5);
    }
    double ir;
};

class hittable {
public:
    virtual ~hittable() = default;
    virtual bool hit(const ray& r, double t_min, double t_max, hit_record& rec) const = 0;
};

class sphere : public hittable {
public:
    sphere(point3 cen, double r, std::shared_ptr<material> m) : center(cen), radius(r), mat_ptr(m) {}
    bool hit(const ray& r, double t_min, double t_max, hit_record& rec) const override {
        const vec3 oc = r.origin() - center;
        const double a = r.direction().length_squared(), half_b = dot(oc, r.direction());
        const double c = oc.length_squared() - radius * radius, discriminant = half_b * half_b - a * c;
        if (discriminant < 0)
            return false;
        const double sqrtd = std::sqrt(discriminant);
        double root = (-half_b - sqrtd) / a;
        if (root < t_min || t_max < root) {
            root = (-half_b + sqrtd) / a;
            if (root < t_min || t_max < root)
                return false;
        }
        rec.t = root;
        rec.p = r.at(rec.t);
        rec.set_face_normal(r, (rec.p - center) / radius);
        rec.mat_ptr = mat_ptr;
        return true;
    }
    point3 center;
    double radius;
    std::shared_ptr<material> mat_ptr;
};

class hittable_list : public hittable {
public:
    void add(std::shared_ptr<hittable> object) { objects.push_back(object); }
    bool hit(const ray& r, double t_min, double t_max, hit_record& rec) const override {
        hit_record temp_rec;
        bool hit_anything = false;
        double closest_so_far = t_max;
        for (const auto& object : objects)
            if (object->hit(r, t_min, closest_so_far, temp_rec)) {
                hit_anything = true;
                closest_so_far = temp_rec.t;
                rec = temp_rec;
            }
        return hit_anything;
    }
    std::vector<std::shared_ptr<hittable>> objects;
};

// adapter begins
#include <nephroid/nephroid.hpp>

// How nephroid reads and makes the renderer's vector. A color is the same type, and so can be a photon's flux as it is.
template <>
struct nephroid::vector_traits<vec3> {
    using scalar = double;
    static vec3 make(double x, double y, double z) { return vec3(x, y, z); }
    static double x(const vec3& v) { return v.x(); }
    static double y(const vec3& v) { return v.y(); }
    static double z(const vec3& v) { return v.z(); }
};

// The world as a scene that photons walk through.
struct caustic_scene {
    // A hit record knows no curvature: where a photon meets glass, rays are traced beside the hit.
    struct hit : nephroid::SurfaceHit<vec3, nephroid::FiniteDifferenceCurvature<vec3, caustic_scene>> {
        hit_record rec; // for `scatter`
    };
    using scattering = nephroid::Scattering<color, double>;
    const hittable_list& world;

    std::optional<hit> intersect(const vec3& origin, const vec3& direction, double t_min, double t_max) const {
        hit h;
        if (!world.hit(ray(origin, direction), t_min, t_max, h.rec))
            return std::nullopt;
        h.distance = h.rec.t;
        h.position = h.rec.p;
        h.geometric_normal = h.shading_normal = h.rec.normal; // turned to the ray, which nephroid does not mind
        h.position_error = 1e-9; // generous: how far rec.p may be off, so that the next ray does not start inside
        h.curvature = nephroid::finite_difference_curvature(*this, h, 1); // the glass ball's radius is 1
        return h;
    }
    scattering scatter(const hit& h, const vec3& direction, auto& random) const {
        const auto* const glass = dynamic_cast<const dielectric*>(h.rec.mat_ptr.get());
        if (!glass)
            return scattering::deposit(); // lambertian: the photon is splatted
        // As in dielectric::scatter. Not by the direction's side of the normal: that one is turned to the ray.
        const double ratio = h.rec.front_face ? 1 / glass->ir : glass->ir;
        const bool reflects =
            random.template next<double>() < dielectric::reflectance(-dot(direction, h.rec.normal), ratio);
        // Beyond the critical angle nephroid reflects what is to be refracted.
        return reflects ? scattering::reflect(color(1, 1, 1)) : scattering::refract(color(1, 1, 1), ratio);
    }
};

// A diffuse point that a pixel sees, and what of the light there reaches the pixel.
struct seen_point {
    point3 p;
    vec3 normal;
    std::size_t pixel;
    color weight;
};

// Follows a camera's ray as ray_color does, to the first diffuse surface: sunlight there is what ray_color never finds.
void see(const hittable_list& world, ray r, std::size_t pixel, std::vector<seen_point>& seen) {
    hit_record rec;
    color throughput(1, 1, 1), attenuation;
    for (int depth = 0; depth < 50 && world.hit(r, 0.001, std::numeric_limits<double>::infinity(), rec); ++depth) {
        if (!rec.mat_ptr->scatter(r, rec, attenuation, r))
            return;
        throughput = throughput * attenuation;
        if (dynamic_cast<const lambertian*>(rec.mat_ptr.get())) // a BRDF of albedo / π
            return seen.push_back({rec.p, rec.normal, pixel, throughput / nephroid::pi<double>});
    }
}

// Adds the sun's caustics to the image; `glass` is about all that refracts.
void add_caustics(const hittable_list& world, const vec3& sun_direction, const color& sun_color, const sphere& glass,
                  const std::vector<seen_point>& seen, std::vector<color>& image) {
    const nephroid::EyePathMap map(seen, &seen_point::p, &seen_point::normal);
    auto sums = nephroid::sums<color>(map);
    const nephroid::BoundingSphere<vec3> target{glass.center, glass.radius};
    const nephroid::DirectionalLight<vec3, color> sun({sun_direction, sun_color, target});
    nephroid::ThreadExecutor threads;
    for (const std::string& sentence : nephroid::diagnose(
             nephroid::caustics(caustic_scene{world}, sun, sums, {.count = 50'000, .smoothing = 5}, threads)))
        std::cerr << sentence << '\n';
    sums.for_each([&](std::size_t i, const color& e) { image[seen[i].pixel] += seen[i].weight * e; });
}
// adapter ends

/// Straight down on [-1/2, 1/2]² of the floor, from below the ball.
int main(int argc, char** argv) {
    hittable_list world;
    const auto glass = std::make_shared<sphere>(point3(0, 1.25, 0), 1, std::make_shared<dielectric>(1.5));
    world.add(std::make_shared<sphere>(point3(0, -1000, 0), 1000, std::make_shared<lambertian>(color(0.5, 0.5, 0.5))));
    world.add(glass);

    constexpr std::size_t size = 256;
    std::vector<seen_point> seen;
    const auto at = [](std::size_t i) { return (double(i) + 0.5) / size - 0.5; };
    for (std::size_t pixel = 0; pixel < size * size; ++pixel)
        see(world, ray(point3(at(pixel % size), 0.2, at(pixel / size)), vec3(0, -1, 0)), pixel, seen);
    std::vector<color> image(size * size);
    add_caustics(world, vec3(0, -1, 0), color(1, 1, 1), *glass, seen, image);

    std::vector<float> samples;
    for (const color& pixel : image)
        for (std::size_t i = 0; i < 3; ++i)
            samples.push_back(float(pixel[i]));
    return write_pfm(argc > 1 ? argv[1] : "weekend.pfm", size, 3, samples) ? 0 : 1;
}
