// SPDX-License-Identifier: MIT
/// @file  The point of its light's domain from which a photon starts. Photons with near points are neighbours.
#pragma once

#include "nephroid/emission/light.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid::detail {

/// A point of a light's emission domain.
struct EmissionSample {
    std::array<double, 2> at{};    ///< the first two coordinates, in [0, 1)
    std::uint32_t light = 0;       ///< the light's index in its `LightSet`; a hash for sets inside of sets
    std::uint32_t coordinates = 0; ///< of the light's domain: 2 or 4, or 0 if the light declares no domain
    std::array<double, 2> then{};  ///< the third and fourth coordinates, in [0, 1)
};

/// A source of samples that records the point of its domain from which a light emits. A set of lights calls
/// `chose(light, coordinates)`, if the source has that member, before the chosen light draws.
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
        constexpr std::uint32_t of_a_set = 0x9e3779b1u; // odd: a hash far beyond the indices of lights
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
    unsigned choices_ = 0; // more than one if a set contains sets
};

/// Draws a light's coordinates, without emitting a photon.
template <class L, class Source>
void draw_coordinates(const L& light, RecordingSource<Source>& samples) {
    if constexpr (requires { light.draw_coordinates(samples); }) {
        light.draw_coordinates(samples);
    } else {
        for (std::uint32_t i = 0; i < coordinates_of<L>; ++i)
            (void)samples.template next<scalar_t<typename L::vector>>();
    }
}
/// The point from which a light would emit a photon with these samples.
template <class L, class Source>
[[nodiscard]] EmissionSample draw_point(const L& light, Source& samples) {
    RecordingSource<Source> recorder(samples, coordinates_of<L>);
    draw_coordinates(light, recorder);
    return recorder.sample();
}

} // namespace nephroid::detail
