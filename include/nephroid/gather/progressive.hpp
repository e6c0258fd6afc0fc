// SPDX-License-Identifier: MIT
/// @file  Progressive photon mapping: any number of passes of photons, with a radius that shrinks from pass to pass.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/gather/gather.hpp"
#include "nephroid/gather/shrinking_radius.hpp"

#include <type_traits>

namespace nephroid {

struct ProgressiveOptions {
    double radius;          ///< r₀ > 0, world units: of every vertex at first
    double alpha = 2.0 / 3; ///< in (0, 1]: the fraction of a pass's photons that is kept
};

/// Progressive photon mapping with statistics at every eye path vertex. Each vertex has its own radius, which shrinks
/// as photons arrive, r² ← r² (n + αm)/(n + m) for m new ones; the flux within is scaled by the same factor.
/// Source: Hachisuka, Ogaki and Jensen 2008.
///
/// ```cpp
/// nephroid::ProgressivePhotonMapping<Vec, float> progressive(vertices, &Vertex::position, &Vertex::normal,
///                                                            {.radius = 0.05});
/// for (std::uint64_t i = 0; i < passes; ++i) {
///     const auto traced = nephroid::trace_photons(scene, nephroid::WithoutTangents(light),
///                                                 {.first = i * n, .count = n}, sequence, executor);
///     progressive.add(nephroid::PhotonMap(traced.deposits), n, executor);
/// }
/// const float e = progressive.irradiance(vertex);
/// ```
template <Vector3 V, Flux F>
    requires ScalesFlux<F, scalar_t<V>>
class ProgressivePhotonMapping {
public:
    using T = scalar_t<V>;

    /// @param vertices  a random-access range; copied from
    /// @param position  projection to V; finite
    /// @param normal    projection to V; unit, photons on the other side do not count
    /// Throws std::invalid_argument for options out of their ranges, and for a vertex whose position is not finite or
    /// whose normal is not unit, with its index.
    template <std::ranges::random_access_range Vertices, class Position, class Normal>
    ProgressivePhotonMapping(const Vertices& vertices, Position position, Normal normal, ProgressiveOptions options)
        : alpha_(options.alpha) {
        constexpr const char* who = "nephroid::ProgressivePhotonMapping";
        detail::check_radius<T>(who, "radius", options.radius, false);
        detail::check_alpha(who, options.alpha);
        vertices_.reserve(std::size_t(std::ranges::size(vertices)));
        for (const auto& vertex : vertices) {
            const V x = std::invoke(position, vertex), n = std::invoke(normal, vertex);
            if (!all_finite(x) || !(abs(length2(n) - T(1)) < T(0.01)))
                invalid_argument(std::string(who) + ": vertex " + std::to_string(vertices_.size()) + " is at " +
                                 detail::text_of(x) + " with the normal " + detail::text_of(n) +
                                 "; positions must be finite and normals of unit length");
            vertices_.push_back({x, n, options.radius * options.radius, 0, flux_traits<F>::zero()});
        }
    }

    /// Adds a pass of photons.
    ///
    /// @param map      the pass's photons, and no others
    /// @param emitted  the number that their fluxes were divided by at emission: the pass's count, > 0
    /// @param executor who runs the work; the result does not depend on it
    template <class E = SerialExecutor>
        requires ExecutorArgument<E>
    void add(const PhotonMap<V, F>& map, std::uint64_t emitted, E&& executor = E{}) {
        if (emitted == 0)
            invalid_argument("nephroid::ProgressivePhotonMapping::add: emitted is 0; it must be at least 1");
        detail::for_each_index(executor, vertices_.size(), 256,
                               [&](std::size_t i) { add_to(vertices_[i], map, double(emitted)); });
        emitted_ += double(emitted);
    }

    /// The irradiance at a vertex, of all photons so far; zero before the first.
    [[nodiscard]] F irradiance(std::size_t vertex) const {
        const Statistic& v = vertices_[vertex];
        if (emitted_ == 0)
            return flux_traits<F>::zero();
        return v.flux * T(1 / (pi<double> * v.radius2 * emitted_));
    }
    /// The radius at a vertex, world units.
    [[nodiscard]] T radius(std::size_t vertex) const { return T(std::sqrt(vertices_[vertex].radius2)); }
    /// The number of photons that a vertex keeps: n, which grows by αm in a pass with m.
    [[nodiscard]] double photons(std::size_t vertex) const { return vertices_[vertex].photons; }
    [[nodiscard]] std::size_t size() const { return vertices_.size(); }

private:
    struct Statistic {
        V position, normal;
        double radius2; ///< in double: thousands of passes multiply it
        double photons;
        F flux; ///< τ: of the photons within the radius, not yet divided by the number emitted and by the area
    };

    void add_to(Statistic& v, const PhotonMap<V, F>& map, double emitted) const {
        double met = 0;
        F flux = flux_traits<F>::zero();
        detail::for_each_within(map, v.position, v.normal, T(std::sqrt(v.radius2)), [&](std::size_t slot, T) {
            ++met;
            flux = flux + map.flux(slot);
        });
        if (met == 0)
            return;
        const double kept = (v.photons + alpha_ * met) / (v.photons + met);
        v.flux = (v.flux + flux * T(emitted)) * T(kept);
        v.radius2 *= kept;
        v.photons += alpha_ * met;
    }

    std::vector<Statistic> vertices_;
    double alpha_;
    double emitted_ = 0;
};

} // namespace nephroid
