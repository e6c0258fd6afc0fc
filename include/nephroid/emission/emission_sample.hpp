// SPDX-License-Identifier: MIT
/// @file  Where in its light's domain a photon starts: what makes photons neighbours at emission.
#pragma once

#include "nephroid/emission/light.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid::detail {

/// A point of a light's emission domain.
struct EmissionSample {
    std::array<double, 2> at{};    ///< the first two coordinates, in [0, 1)
    std::uint32_t light = 0;       ///< which of a `LightSet`'s; of sets within sets a number of its own, out of order
    std::uint32_t coordinates = 0; ///< of its light's domain: 2 or 4, or 0 where the light declares none
    std::array<double, 2> then{};  ///< the third and fourth, in [0, 1)
};

/// A source of samples that keeps where in its domain a light emits. A light of several calls `chose(light,
/// coordinates)`, if its source has that, before the chosen light draws.
template <class Source>
class RecordingSource {
public:
    /// @param coordinates  of the light's domain: `coordinates_of<L>`
    RecordingSource(Source& source, std::uint32_t coordinates) : source_(&source) { sample_.coordinates = coordinates; }

    template <Scalar T>
    [[nodiscard]] T next() {
        const T value = source_->template next<T>();
        if (known_ < sample_.coordinates) {
            (known_ < 2 ? sample_.at[known_] : sample_.then[known_ - 2]) = double(value);
            ++known_;
        }
        return value;
    }

    void chose(std::size_t light, std::uint32_t coordinates) {
        constexpr std::uint32_t of_a_set = 0x9e3779b1u; // odd: keeps sets apart, far beyond the numbers of lights
        const std::uint32_t set = choices_++ == 0 ? 0 : (sample_.light + 1) * of_a_set;
        sample_ = {{}, set + static_cast<std::uint32_t>(light), coordinates, {}};
        known_ = 0;
    }

    [[nodiscard]] const EmissionSample& sample() const { return sample_; }
    /// Whether the light has drawn as many numbers as its domain has coordinates.
    [[nodiscard]] bool is_complete() const { return known_ == sample_.coordinates; }

private:
    Source* source_;
    EmissionSample sample_;
    std::uint32_t known_ = 0;
    unsigned choices_ = 0; // a set's own light may be a set
};

/// Draws the coordinates alone.
template <class L, class Source>
void draw_coordinates(const L& light, RecordingSource<Source>& samples) {
    if constexpr (requires { light.draw_coordinates(samples); }) {
        light.draw_coordinates(samples);
    } else {
        for (std::uint32_t i = 0; i < coordinates_of<L>; ++i)
            (void)samples.template next<scalar_t<typename L::vector>>();
    }
}
/// Where a light would emit a photon with these samples; without emitting it.
template <class L, class Source>
[[nodiscard]] EmissionSample draw_point(const L& light, Source& samples) {
    RecordingSource<Source> recorder(samples, coordinates_of<L>);
    draw_coordinates(light, recorder);
    return recorder.sample();
}

} // namespace nephroid::detail
