// SPDX-License-Identifier: MIT
/// @file  The library's side of the page: draws the irradiance of a scene's floor. Compiled to WebAssembly it is what
///        the page calls; compiled for this machine it is the program that the page's light is compared with:
///        `web_caustic_map <scene> <method> <photons> <size> <lamp's x> <y> <z> <seconds> [picture.raw] [repeats]`
#include "raster.hpp"

#include <nephroid/quality/error.hpp>
#include <nephroid/receiver/sums.hpp>
#include <nephroid/sheet/light_sheets.hpp>
#include <nephroid/splat/splat_caustics.hpp>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <memory>
#include <vector>

namespace nephroid::examples::web {
namespace {

enum class Method { sheets, splats, thin_lens, dots };

/// A floor that light can be drawn onto again and again.
class Studio {
public:
    Studio(const Scene& scene, std::size_t size) : raster_(size, scene.half_map()), map_(make_map(raster_)) {}

    const Raster& draw(const Scene& scene, Method method, std::uint64_t photons, const Vec& position) {
        const PointThroughOpenings lamp{position, 1, scene.openings(position)};
        const PhotonPass pass{.count = photons, .smoothing = smoothing, .limits = limits};
        std::fill(raster_.pixels.begin(), raster_.pixels.end(), 0.f);
        Statistics account;
        if (method == Method::sheets || method == Method::splats) {
            sums_.clear();
            if (method == Method::sheets)
                light_sheets(scene, lamp, sums_, receiver_, pass, photons > many ? SheetOptions{} : quick);
            else
                splat_caustics(scene, lamp, sums_, pass, R2Sequence());
            sums_.for_each([&](std::size_t i, float irradiance) { raster_.pixels[i] = irradiance; });
        } else if (method == Method::dots) {
            trace_rivals(scene, lamp, photons, 1, limits, account,
                         [&](const auto& deposit, const auto&, float) { raster_.dot(deposit.position, deposit.flux); });
        } else {
            const float filter = 0.816f * raster_.pixel(), widest = 0.25f * raster_.half;
            trace_rivals(scene, lamp, photons, smoothing, limits, account,
                         [&](const auto& deposit, const ThinLens& lens, float half_angle) {
                             const float radius = (std::min)(half_angle * lens.front * lens.widening(), widest);
                             raster_.disk(deposit.position, std::sqrt(radius * radius + filter * filter), deposit.flux);
                         });
        }
        return raster_;
    }

private:
    /// A picture that is gone in a fifteenth of a second may be wrong by some per cent at its folds. Beyond so many
    /// photons it is the converged one.
    static constexpr SheetOptions quick{.tessellation = {.bend = 0.3, .density = 1, .max_quads = 3},
                                        .refinement = {.levels = 3, .tolerance = 0.4, .relative = 0.1}};
    static constexpr std::uint64_t many = 100'000;
    static constexpr float smoothing = 3; ///< about the best of splats on a lattice
    /// No roulette: what is left of a photon after many total reflections is worth no dice.
    static constexpr WalkLimits limits{.specular_events = 24, .roulette_after = 24};

    [[nodiscard]] static EyePathMap<Vec> make_map(const Raster& raster) {
        std::vector<Vec> floor;
        for (std::size_t j = 0; j < raster.size; ++j)
            for (std::size_t i = 0; i < raster.size; ++i)
                floor.push_back(raster.middle(i, j));
        const float side = raster.pixel();
        return EyePathMap<Vec>(
            floor, [](const Vec& p) { return p; }, [](const Vec&) { return Vec(0, 0, 1); },
            [side](const Vec&) {
                return PixelFootprint<Vec>{{side, 0, 0}, {0, side, 0}};
            });
    }

    Raster raster_;
    EyePathMap<Vec> map_;
    SheetReceiver<Vec> receiver_{map_};
    Sums<Vec, float> sums_ = sums<float>(map_);
};

[[nodiscard]] Scene make_scene(int number, float seconds) {
    if (number == 0)
        return {Ring()};
    if (number == 1)
        return {Tumbler()};
    return {Pool{{seconds}}};
}

std::unique_ptr<Studio> studio;
int open_number = -1;
std::size_t open_size = 0;
std::vector<float> converged;
const Raster* picture = nullptr;

} // namespace
} // namespace nephroid::examples::web

using namespace nephroid::examples::web;

extern "C" {
/// Draws the floor's irradiance in the light of a lamp of one unit of flux per steradian.
///
/// @param scene    0: ring, 1: tumbler, 2: pool
/// @param method   0: sheets, 1: splats, 2: thin lens, 3: dots
/// @param photons  above 0
/// @param size     pixels along each side
/// @return  size × size floats, from low x and y on; overwritten by the next call
const float* nephroid_draw(int scene, int method, int photons, int size, float lamp_x, float lamp_y, float lamp_z,
                           float seconds) {
    const Scene shown = make_scene(scene, seconds);
    if (scene != open_number || std::size_t(size) != open_size) {
        studio = std::make_unique<Studio>(shown, std::size_t(size));
        open_number = scene, open_size = std::size_t(size);
    }
    picture = &studio->draw(shown, Method(method), std::uint64_t(photons), {lamp_x, lamp_y, lamp_z});
    return picture->pixels.data();
}

/// Half of the side of a scene's floor, world units.
float nephroid_half_map(int scene) { return make_scene(scene, 0).half_map(); }

/// A number of one of the pool's four waves: amplitude, turns along x, along y, turns per second.
float nephroid_wave(int wave, int number) {
    const Waves::Wave& chosen = Waves::list[std::size_t(wave)];
    return std::array{chosen.amplitude, chosen.x, chosen.y, chosen.speed}[std::size_t(number)];
}

/// Keeps the last picture as the converged one.
void nephroid_keep() { converged = picture->pixels; }

/// The last picture's error against the one that was kept: its RMSE over the other's mean.
double nephroid_error() {
    const bool comparable = picture && converged.size() == picture->pixels.size();
    return comparable ? nephroid::relative_error(picture->pixels, converged) : -1;
}
}

#ifndef __EMSCRIPTEN__
int main(int argc, char** argv) {
    if (argc < 9) {
        std::fprintf(stderr, "%s <scene 0..2> <method 0..3> <photons> <size> <x> <y> <z> <seconds> [file] [repeats]\n",
                     argv[0]);
        return 2;
    }
    const auto whole = [&](int i) { return std::atoi(argv[i]); };
    const auto real = [&](int i) { return float(std::atof(argv[i])); };
    const int repeats = argc > 10 ? whole(10) : 1;
    const float* pixels = nullptr;
    for (int i = 0; i < repeats; ++i) {
        const auto start = std::chrono::steady_clock::now();
        pixels = nephroid_draw(whole(1), whole(2), whole(3), whole(4), real(5), real(6), real(7), real(8));
        const std::chrono::duration<double, std::milli> time = std::chrono::steady_clock::now() - start;
        std::printf("%.2f ms\n", time.count());
    }
    if (argc > 9) {
        std::ofstream file(argv[9], std::ios::binary);
        const auto size = std::streamsize(whole(4));
        file.write(reinterpret_cast<const char*>(pixels), std::streamsize(sizeof(float)) * size * size);
        return file ? 0 : 1;
    }
    return 0;
}
#endif
