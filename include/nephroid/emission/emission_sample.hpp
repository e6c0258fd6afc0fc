// SPDX-License-Identifier: MIT
/// @file  Where in its light's domain a photon was drawn: what makes photons neighbours at emission.
#pragma once

#include "nephroid/vector/scalar.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// The numbers that a light drew for a photon.
struct EmissionSample {
    std::array<double, 2> at{};   ///< the first two, in [0, 1)
    std::uint32_t light = 0;      ///< which of a `LightSet`'s; of sets within sets a number of its own, out of order
    std::uint32_t dimensions = 0; ///< how many were drawn: two say all about a photon of a point or directional light,
                                  ///< four about one of an area light
    std::array<double, 2> then{}; ///< the third and fourth, in [0, 1)
};

/// A source of samples that keeps what was drawn from another one. A light of several calls `chose(light)`, if its
/// source has that, before the chosen light draws.
template <class Source>
class RecordingSource {
public:
    explicit RecordingSource(Source& source) : source_(&source) {}

    template <Scalar T>
    [[nodiscard]] T next() {
        const T value = source_->template next<T>();
        if (sample_.dimensions < 2)
            sample_.at[sample_.dimensions] = double(value);
        else if (sample_.dimensions < 4)
            sample_.then[sample_.dimensions - 2] = double(value);
        ++sample_.dimensions;
        return value;
    }

    void chose(std::size_t light) {
        constexpr std::uint32_t of_a_set = 0x9e3779b1u; // odd: keeps sets apart, far beyond the numbers of lights
        const std::uint32_t set = choices_++ == 0 ? 0 : (sample_.light + 1) * of_a_set;
        sample_ = {{}, set + static_cast<std::uint32_t>(light), 0, {}};
    }

    [[nodiscard]] const EmissionSample& sample() const { return sample_; }

private:
    Source* source_;
    EmissionSample sample_;
    unsigned choices_ = 0; // a set's own light may be a set
};

} // namespace nephroid
