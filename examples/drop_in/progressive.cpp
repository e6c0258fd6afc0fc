// SPDX-License-Identifier: MIT
/// @file  Caustics in an interactive renderer: photons pass by pass on the renderer's own threads, a stop button, a
///        progress bar, and a picture at any time. The scene is a mirror half ring on a floor in the sun.
///        `progressive picture.pfm [stop]`: with `stop` the rendering is stopped on the way, and resumed.
#include "picture.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <limits>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

/// The renderer as it was before.
namespace renderer {

struct float3 {
    float x, y, z;
};
inline float3 operator+(float3 a, float3 b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline float3 operator*(float s, float3 a) { return {s * a.x, s * a.y, s * a.z}; }

struct Hit {
    float t;
    float3 position, normal;
    bool is_mirror;
};

/// The half cylinder x² + y² = 1, x > 0, 0 < z < 1/2, a mirror, on the floor z = 0.
struct Scene {
    [[nodiscard]] std::optional<Hit> trace(float3 o, float3 d, float t_min, float t_max) const {
        std::optional<Hit> nearest;
        if (const float t = -o.z / d.z; t > t_min && t < t_max) {
            nearest = Hit{t, {o.x + t * d.x, o.y + t * d.y, 0}, {0, 0, 1}, false};
            t_max = t;
        }
        const float dd = d.x * d.x + d.y * d.y, middle = -(o.x * d.x + o.y * d.y) / dd;
        const float x = o.x + middle * d.x, y = o.y + middle * d.y, half_chord2 = (1 - x * x - y * y) / dd;
        if (half_chord2 > 0)
            for (const float t : {middle - std::sqrt(half_chord2), middle + std::sqrt(half_chord2)}) {
                const float3 p = o + t * d;
                if (t > t_min && t < t_max && p.x > 0 && p.z > 0 && p.z < 0.5f) {
                    const float r = std::sqrt(p.x * p.x + p.y * p.y);
                    return Hit{t, {p.x / r, p.y / r, p.z}, {p.x / r, p.y / r, 0}, true};
                }
            }
        return nearest;
    }
};

/// Where a pixel's ray has ended on a diffuse surface.
struct Seen {
    float3 position, normal;
    std::size_t pixel;
};

/// An orthographic camera that looks down at the part of the floor with the cusp.
std::vector<Seen> trace_camera(std::size_t size) {
    std::vector<Seen> seen;
    const auto at = [size](std::size_t i) { return 0.8f * (float(i) + 0.5f) / float(size); };
    for (std::size_t pixel = 0; pixel < size * size; ++pixel)
        seen.push_back({{at(pixel % size) + 0.1f, at(pixel / size) - 0.4f, 0}, {0, 0, 1}, pixel});
    return seen;
}

/// The renderer's threads, and its way to keep them busy.
class ThreadPool {
public:
    explicit ThreadPool(unsigned count) {
        for (unsigned i = 0; i < count; ++i)
            threads_.emplace_back([this] { work(); });
    }
    ~ThreadPool() {
        {
            const std::lock_guard lock(mutex_);
            ends_ = true;
        }
        wake_.notify_all();
        for (std::thread& thread : threads_)
            thread.join();
    }

    /// Returns when all jobs are done.
    void run_and_wait(std::vector<std::function<void()>> jobs) {
        std::unique_lock lock(mutex_);
        open_ = jobs.size();
        jobs_ = std::move(jobs);
        wake_.notify_all();
        done_.wait(lock, [this] { return open_ == 0; });
    }

private:
    void work() {
        std::unique_lock lock(mutex_);
        for (;;) {
            wake_.wait(lock, [this] { return ends_ || !jobs_.empty(); });
            if (ends_)
                return;
            const std::function<void()> job = std::move(jobs_.back());
            jobs_.pop_back();
            lock.unlock();
            job();
            lock.lock();
            if (--open_ == 0)
                done_.notify_one();
        }
    }

    std::mutex mutex_;
    std::condition_variable wake_, done_;
    std::vector<std::function<void()>> jobs_;
    std::size_t open_ = 0;
    bool ends_ = false;
    std::vector<std::thread> threads_;
};

} // namespace renderer

// adapter begins
#include <nephroid/nephroid.hpp>

using renderer::float3;

// How nephroid reads and makes the renderer's vector.
template <>
struct nephroid::vector_traits<float3> {
    using scalar = float;
    static float3 make(float x, float y, float z) { return {x, y, z}; }
    static float x(const float3& v) { return v.x; }
    static float y(const float3& v) { return v.y; }
    static float z(const float3& v) { return v.z; }
};

// The renderer's scene as one that photons walk through.
struct CausticScene {
    using Hit = nephroid::SurfaceHit<float3, nephroid::ShapeOperator<float3>>;
    using Scattering = nephroid::Scattering<float, float>;
    const renderer::Scene& scene;

    std::optional<Hit> intersect(const float3& o, const float3& d, float t_min, float t_max) const {
        const auto hit = scene.trace(o, d, t_min, t_max);
        if (!hit)
            return std::nullopt;
        const float3 n = hit->normal, around{-n.y, n.x, 0}, up{0, 0, 1};
        // The mirror's normal turns by 1/radius around the axis, and not along it; on the floor it never does.
        const auto curvature = nephroid::principal_curvatures(around, hit->is_mirror ? 1.f : 0.f, up, 0);
        const float error = nephroid::rounding_error(o, hit->t, hit->position);
        return Hit{hit->t, hit->position, n, n, curvature, error, hit->is_mirror ? 1u : 0u};
    }
    Scattering scatter(const Hit& hit, const float3&, auto& /*random numbers*/) const {
        return hit.surface == 1 ? Scattering::reflect(1) : Scattering::deposit(); // all is reflected, or splatted
    }
};

// The caustics layer of the viewer. One thread renders; any other may ask for the progress and for a picture.
struct CausticsLayer {
    static constexpr std::uint64_t photons = 400'000;
    const CausticScene scene;
    renderer::ThreadPool& pool;
    const nephroid::EyePathMap<float3> map;                          // of what the camera sees
    nephroid::Sums<float3, float> sums = nephroid::sums<float>(map); // the irradiance there, kept from pass to pass
    // Through an upright window before the mirror, as wide as it and as high as its shadow there.
    const nephroid::Parallelogram<float3> window{{-0.0625f, -1, 0}, {0, 2, 0}, {0, 0, 1.25f}};
    const nephroid::DirectionalLight<float3, float> sun{{{0.819152f, 0, -0.573576f}, 1 / 0.573576f, window}};
    std::atomic<std::uint64_t> done{0};
    std::mutex mutex;           // of the picture
    std::vector<float> picture; // irradiance by the index of what is seen

    // Returns when all photons are done, or soon after somebody has pressed stop; called again, it goes on from there.
    void render(const std::atomic<bool>& stop) {
        // An executor: does task(0) … task(n − 1), here as jobs of the renderer's pool, and returns when all are
        // done.
        const auto on_pool = [this](std::size_t n, const auto& task) {
            std::vector<std::function<void()>> jobs;
            for (std::size_t i = 0; i < n; ++i)
                jobs.push_back([&task, i] { task(i); });
            pool.run_and_wait(std::move(jobs));
        };
        const std::uint64_t first = done;
        const auto progress = [&](std::uint64_t in_this_pass) { // between batches of up to 65,536 photons
            done = first + in_this_pass;
            const float missing = float(photons) / float(done); // a photon's flux is its share of all of them
            const std::lock_guard lock(mutex);
            sums.for_each([&](std::size_t i, float irradiance) { picture[i] = missing * irradiance; });
            return !stop; // false ends the pass
        };
        const nephroid::PhotonPass rest{
            .first = first, .count = photons - first, .total = photons, .smoothing = 6, .progress = progress};
        // To first order, as published: a photon's footprint depends on no other photon, and so on no pass.
        nephroid::splat_caustics(scene, sun, sums, rest, on_pool);
    }
    std::vector<float> snapshot() {
        const std::lock_guard lock(mutex);
        return picture;
    }
};
// adapter ends

int main(int argc, char** argv) {
    const std::string output = argc > 1 ? argv[1] : "progressive.pfm";
    const bool stops = argc > 2 && argv[2] == std::string("stop");
    constexpr std::size_t size = 256;
    const renderer::Scene scene;
    const auto seen = renderer::trace_camera(size);
    renderer::ThreadPool pool(2);
    CausticsLayer layer{.scene = {scene},
                        .pool = pool,
                        .map = {seen, &renderer::Seen::position, &renderer::Seen::normal},
                        .mutex = {},
                        .picture = std::vector<float>(seen.size())};

    bool written = true;
    for (std::atomic<bool> stop = false; layer.done < layer.photons; stop = false) {
        const bool presses = stops && layer.done == 0;
        std::thread rendering([&] { layer.render(stop); });
        if (presses) { // a user who watches the progress, and presses the button at a quarter
            while (layer.done < layer.photons / 4)
                std::this_thread::sleep_for(std::chrono::milliseconds(1));
            stop = true;
        }
        rendering.join();
        std::printf("%.0f%%\n", 100 * double(layer.done) / double(layer.photons));
        if (layer.done < layer.photons)
            written = write_pfm(output + ".stopped", size, 1, layer.snapshot());
    }
    return write_pfm(output, size, 1, layer.snapshot()) && written ? 0 : 1;
}
