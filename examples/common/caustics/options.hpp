// SPDX-License-Identifier: MIT
/// @file  The command line options of the program `caustics`.
#pragma once

#include "common/any_sequence.hpp"
#include "common/command_line.hpp"
#include "common/layer.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>

namespace nephroid::examples {

/// How light on its way from mirrors and glass is drawn.
enum class Method {
    splats,    ///< to second order
    sheets,    ///< patches of light between neighbouring photons, and splats where light lies on none
    published, ///< splats where photons land
};

enum class KernelKind { biweight, epanechnikov, cone, uniform, gaussian };

/// A sun that is added to a file's scene.
struct Sun {
    std::array<double, 3> direction{}; ///< in which its light travels, any length but zero
    double degrees = 0;                ///< its angular diameter; 0: parallel light
};

struct Options {
    std::string scene;                 ///< the name of a built-in case or a room, or a .glb or .gltf file
    std::uint64_t photons = 20'000;    ///< caustic photons wanted
    std::optional<std::uint64_t> emit; ///< photons to emit, instead
    std::optional<double> error;       ///< of the mean of passes, as a share of it; nothing: one pass
    std::optional<double> smoothing;   ///< s; nothing: chosen for each photon
    bool cross_validated = false;      ///< s is chosen for all photons together, to first order
    static constexpr unsigned most_bands = 16;
    std::optional<unsigned> bands;         ///< of a file's caustics; nothing: red, green and blue
    Method method = Method::splats;        ///< that draws the caustics
    bool first_order = false;              ///< photon differential splatting as published
    bool curved = false;                   ///< footprints in pieces that bend as the light does
    std::size_t width = 512, height = 512; ///< pixels
    bool height_given = false;             ///< otherwise a file's camera gives it
    unsigned samples = 1;                  ///< eye paths per pixel
    KernelKind kernel = KernelKind::biweight;
    SequenceKind sequence = SequenceKind::halton;
    std::uint64_t seed = 0;
    unsigned threads = 0; ///< 0: as many as the machine has
    bool pixel_filter = true;
    bool fresnel = false;                           ///< of the built-in cases; materials of a file always have it
    bool one_reflection = false;                    ///< of the ring: discard light that is reflected twice
    std::optional<std::array<double, 4>> view;      ///< x_min, x_max, y_min, y_max of a built-in case's film
    Layer layer = Layer::all;                       ///< of a file's or a room's picture
    std::optional<unsigned> bounces;                ///< of it, off diffuse surfaces; otherwise the scene's default
    std::optional<Sun> sun;                         ///< added to a file's scene
    std::optional<double> ground;                   ///< the albedo of one that is added to a file's scene
    std::optional<std::string> environment;         ///< around a file's scene: "constant" or a picture's path
    std::filesystem::path output;                   ///< the picture: .exr, .pfm or .png
    std::optional<std::filesystem::path> layers;    ///< all of them in one .exr
    std::optional<std::filesystem::path> json;      ///< the statistics
    std::optional<std::filesystem::path> reference; ///< a .pfm to compare the picture with
};

/// Reads the command line.
/// @return  nothing if it asked for help, which has then been printed
/// Throws UsageError.
[[nodiscard]] std::optional<Options> read_options(int argc, const char* const* argv);

[[nodiscard]] const char* name_of(Method method);
[[nodiscard]] const char* name_of(KernelKind kernel);

} // namespace nephroid::examples
