// SPDX-License-Identifier: MIT
/// @file  What the program `relaxation` is asked to do.
#pragma once

#include "common/any_sequence.hpp"
#include "common/command_line.hpp"

#include "nephroid/relaxation/options.hpp"

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples::relaxation {

/// How the nearest photons are weighted.
enum class LookKernel { epanechnikov, biweight };

struct Options {
    std::string subject;            ///< a test pattern, a guide image (.png), a built-in case, a .glb or .gltf file
    std::uint64_t photons = 50'000; ///< in the picture of a pattern; caustic photons of a scene
    SequenceKind sequence = SequenceKind::halton;
    std::uint64_t seed = 0;
    RelaxationOptions relaxation;                 ///< with as many iterations as asked for
    std::vector<std::size_t> neighbours;          ///< of the pictures
    LookKernel kernel = LookKernel::epanechnikov; ///< of all of them
    std::vector<std::size_t> sweep;        ///< of the search for the unrelaxed map's best, where the truth is known
    std::size_t width = 512, height = 512; ///< pixels
    unsigned samples = 1;                  ///< eye paths per pixel
    bool height_given = false;             ///< else a file's camera chooses it
    bool timing = false;                   ///< instead of pictures: what relaxing random photons costs
    unsigned threads = 0;                  ///< 0: as many as the machine has
    std::optional<std::array<double, 4>> spectrum; ///< x_min, x_max, y_min, y_max of evenly lit floor
    std::filesystem::path output;                  ///< a folder
};

/// Reads the command line.
/// @return  nothing if it asked for help, which has then been printed
/// Throws UsageError.
[[nodiscard]] std::optional<Options> read_options(int argc, const char* const* argv);

} // namespace nephroid::examples::relaxation
