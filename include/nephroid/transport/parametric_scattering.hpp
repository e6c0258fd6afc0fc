// SPDX-License-Identifier: MIT
/// @file  What a surface does with a photon that has parameters: what the scene says, which tangents change the index
///        of refraction, and what the parameters are told of it.
#pragma once

#include "nephroid/emission/parameters.hpp"
#include "nephroid/transport/scattering.hpp"
#include "nephroid/vector/algebra.hpp"

#include <cstddef>
#include <type_traits>
#include <utility>

namespace nephroid::detail {

/// What a scene's `scatter` returned, for a photon with parameters.
template <class Scattering, class P>
struct ParametricScattering : Scattering {
    P* parameters; ///< to be told of glass; null if the photon follows several ways, which have nothing in common

    ParametricScattering(const Scattering& scattering, P* of_photon) : Scattering(scattering), parameters(of_photon) {}

    /// Whether a photon's tangent i of N is by a parameter that changes the index.
    template <std::size_t N>
    [[nodiscard]] static constexpr bool changes_index(std::size_t i) {
        return tangent_kinds<N, P>[i] == TangentKind::wavelength;
    }

    /// Tells the parameters how far the refracted ray is from the critical angle, and how this changes with the
    /// wavelength.
    ///
    /// @param photon  before the refraction or the total reflection
    /// @param normal  about which it turns; faces the photon
    /// @param d_normal_by  d_normal_by(tangent) is the normal's change
    template <class Photon, class V, class NormalChange>
    void note_glass(const Photon& photon, const V& normal, const NormalChange& d_normal_by) const {
        constexpr std::size_t n = Photon::tangent_count;
        if constexpr (requires { parameters->meet_glass(0.0, 0.0); } && has_wavelength<P> && refracts<Scattering>) {
            if (parameters == nullptr)
                return;
            std::size_t at = 0;
            while (!changes_index<n>(at))
                ++at;
            const Tangent<V>& tangent = photon.differential[at];
            const V d_normal = d_normal_by(tangent);
            const double ratio = double(this->eta), c = -double(dot(photon.direction, normal));
            const double dc = -double(dot(tangent.d_direction, normal) + dot(photon.direction, d_normal));
            const double sin2 = (1 - c) * (1 + c);
            parameters->meet_glass(1 - ratio * ratio * sin2, 2 * ratio * (ratio * c * dc - index_slope() * sin2));
        }
    }

private:
    [[nodiscard]] double index_slope() const {
        if constexpr (requires { double(this->d_eta); })
            return double(this->d_eta);
        else
            return 0;
    }
};

/// The list that a scene's `scatter_all` returned, for such a photon.
template <class List, class P>
struct ParametricWays {
    using Way = ParametricScattering<std::remove_cvref_t<decltype(std::declval<const List&>()[std::size_t(0)])>, P>;

    List list;

    [[nodiscard]] std::size_t size() const { return std::size_t(list.size()); }
    [[nodiscard]] Way operator[](std::size_t i) const { return Way(list[i], nullptr); }
};

} // namespace nephroid::detail
