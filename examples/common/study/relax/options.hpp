// SPDX-License-Identifier: MIT
/// @file  What `study relax` is asked to do.
#pragma once

#include "common/any_sequence.hpp"
#include "common/command_line.hpp"

#include "nephroid/relaxation/options.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace nephroid::examples::study::relax {

/// How the nearest photons are weighted.
enum class LookKernel { epanechnikov, biweight };

struct Options {
    std::string subject;            ///< a test pattern, a guide image (.png), a built-in case, a .glb or .gltf file
    std::uint64_t photons = 50'000; ///< in the picture of a pattern; caustic photons of a scene
    SequenceKind sequence = SequenceKind::halton;
    std::uint64_t seed = 0;
    RelaxationOptions relaxation;                 ///< with as many iterations as asked for
    std::vector<std::size_t> neighbours;          ///< of the pictures; none: as many as `relax` reports, relaxed alone
    LookKernel kernel = LookKernel::epanechnikov; ///< of all of them
    std::vector<std::size_t> sweep;        ///< of the search for the unrelaxed map's best, where the truth is known
    std::size_t width = 512, height = 512; ///< pixels
    unsigned samples = 1;                  ///< eye paths per pixel
    bool height_given = false;             ///< else a file's camera chooses it
    bool timing = false;                   ///< instead of pictures: what relaxing random photons costs
    unsigned threads = 0;                  ///< 0: as many as the machine has
    std::optional<std::array<double, 4>> spectrum; ///< x_min, x_max, y_min, y_max of evenly lit floor
};

/// The options of the command line.
class Arguments {
public:
    /// The app's options write here, so this must neither move nor end before it.
    explicit Arguments(CLI::App& app);
    Arguments(const Arguments&) = delete;
    Arguments& operator=(const Arguments&) = delete;

    /// What was asked for, subject by subject and for each its sequences; one without a name where costs are asked for.
    /// Throws UsageError.
    [[nodiscard]] std::vector<Options> read() const;

private:
    std::vector<std::string> subjects_;
    std::string photons_ = "50000", seed_ = "0", iterations_ = "20", size_ = "512", sequence_ = "halton";
    std::string constrain_ = "on", diffusion_ = "none", keep_ = "off", kernel_ = "epanechnikov";
    std::string neighbours_ = "10,20,50,250", sweep_ = "10,14,20,28,40,56,80,112,160,224,320,500";
    std::vector<double> over_relaxation_, features_, spectrum_;
    double rho_;
    unsigned samples_ = 1, threads_ = 0;
    bool timing_ = false;
};

} // namespace nephroid::examples::study::relax
