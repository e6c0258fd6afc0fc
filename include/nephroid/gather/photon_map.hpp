// SPDX-License-Identifier: MIT
/// @file  The photon map: stored photons, looked up by place [Jensen 1996].
#pragma once

#include "nephroid/transport/account.hpp"
#include "nephroid/transport/deposit.hpp"
#include "nephroid/tree/element_at.hpp"
#include "nephroid/tree/point_tree.hpp"

#include <concepts>
#include <functional>
#include <ranges>

namespace nephroid {

/// Stored photons in a kd-tree, copied from the user's own array. Photons of a leaf have contiguous slots, as vertices
/// have in the eye path map.
///
/// ```cpp
/// const nephroid::PhotonMap map(traced.deposits);
/// const nephroid::PhotonMap mine(photons, &P::position, &P::normal, &P::direction, &P::flux);
/// ```
template <Vector3 V, Flux F>
    requires ScalesFlux<F, scalar_t<V>>
class PhotonMap {
public:
    using T = scalar_t<V>;
    using vector = V;
    using flux_type = F;

    /// @param photons    a random-access range; may be empty, and is not needed after the call
    /// @param position   projection to V: a member pointer or a callable; finite
    /// @param normal     projection to V: of the surface, unit, on the side that the photon came from
    /// @param direction  projection to V: of flight
    /// @param flux       projection to F, finite: the photon's share, divided by the number emitted
    /// Throws std::invalid_argument, with the photon's index, for a value that is not finite and a normal that is not
    /// unit.
    template <std::ranges::random_access_range Photons, class Position, class Normal, class Direction, class Power>
    PhotonMap(const Photons& photons, Position position, Normal normal, Direction direction, Power flux)
        : tree_(
              std::size_t(std::ranges::size(photons)),
              [&](std::size_t i) -> V { return std::invoke(position, detail::element_at(photons, i)); },
              "nephroid::PhotonMap") {
        for (auto& component : normals_)
            component.reserve(tree_.slots());
        directions_.reserve(tree_.slots());
        fluxes_.reserve(tree_.slots());
        for (std::size_t slot = 0; slot < tree_.slots(); ++slot) {
            const std::uint32_t i = tree_.index(slot);
            auto&& photon = detail::element_at(photons, i);
            append(i, std::invoke(normal, photon), std::invoke(direction, photon), std::invoke(flux, photon));
        }
    }

    /// @param deposits  as `trace_photons` returns them
    template <std::size_t N>
    explicit PhotonMap(const std::vector<Deposit<V, F, N>>& deposits)
        : PhotonMap(deposits, &Deposit<V, F, N>::position, &Deposit<V, F, N>::normal, &Deposit<V, F, N>::direction,
                    &Deposit<V, F, N>::flux) {}

    [[nodiscard]] const PointTree<V>& tree() const { return tree_; }
    /// The diagonal of the bounds of all photons, world units; 0 when there are none.
    [[nodiscard]] T diagonal() const {
        const Box<T>& box = tree_.bounds();
        T diagonal2(0);
        for (std::size_t axis = 0; !tree_.empty() && axis < 3; ++axis)
            diagonal2 = diagonal2 + square(box.high[axis] - box.low[axis]);
        return sqrt(diagonal2);
    }
    /// By slot of the tree's leaf order, as the direction and the flux.
    [[nodiscard]] V normal(std::size_t slot) const {
        return make_vector<V>(normals_[0][slot], normals_[1][slot], normals_[2][slot]);
    }
    [[nodiscard]] const V& direction(std::size_t slot) const { return directions_[slot]; }
    [[nodiscard]] const F& flux(std::size_t slot) const { return fluxes_[slot]; }

    /// Whether the photon came from the side that a normal points to: only such photons light a surface there.
    [[nodiscard]] bool faces(std::size_t slot, const V& n) const {
        using t = vector_traits<V>;
        return normals_[0][slot] * t::x(n) + normals_[1][slot] * t::y(n) + normals_[2][slot] * t::z(n) > T(0);
    }

private:
    void append(std::uint32_t i, const V& n, const V& d, const F& flux) {
        using t = vector_traits<V>;
        const auto named = [i] { return "nephroid::PhotonMap: photon " + std::to_string(i); };
        if (!(abs(length2(n) - T(1)) < T(0.01)))
            invalid_argument(named() + " has the normal " + detail::text_of(n) + "; normals must be of unit length");
        if (!all_finite(d))
            invalid_argument(named() + " flies along " + detail::text_of(d) + "; directions must be finite");
        if (!isfinite(double(flux_traits<F>::power(flux))))
            invalid_argument(named() + " has a flux of " + detail::text_of(double(flux_traits<F>::power(flux))) +
                             "; fluxes must be finite");
        normals_[0].push_back(t::x(n));
        normals_[1].push_back(t::y(n));
        normals_[2].push_back(t::z(n));
        directions_.push_back(d);
        fluxes_.push_back(flux);
    }

    PointTree<V> tree_;
    std::array<std::vector<T>, 3> normals_;
    std::vector<V> directions_;
    std::vector<F> fluxes_;
};

template <std::ranges::random_access_range Photons, class Position, class Normal, class Direction, class Power>
PhotonMap(const Photons&, Position, Normal, Direction, Power)
    -> PhotonMap<std::remove_cvref_t<std::invoke_result_t<Position&, std::ranges::range_reference_t<const Photons>>>,
                 std::remove_cvref_t<std::invoke_result_t<Power&, std::ranges::range_reference_t<const Photons>>>>;

template <Vector3 V, Flux F, std::size_t N>
PhotonMap(const std::vector<Deposit<V, F, N>>&) -> PhotonMap<V, F>;

} // namespace nephroid
