// SPDX-License-Identifier: MIT
/// @file  What light diffuse surfaces get besides direct light: caustics and indirect light, over any number of passes.
#pragma once

#include "nephroid/gather/shrinking_radius.hpp"
#include "nephroid/receiver/free_distances.hpp"
#include "nephroid/receiver/sums.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <type_traits>

namespace nephroid {

namespace detail {
template <class S, class F>
concept TakesIllumination = std::invocable<S&, std::size_t, const F&, const F&>;

template <class S, class F>
consteval bool explain_illumination_sink() {
    static_assert(TakesIllumination<S, F>,
                  "nephroid: the sink of Illumination::for_each cannot be called as sink(std::size_t vertex, const F& "
                  "caustic, const F& indirect) (bounce/illumination.hpp)");
    return false;
}
template <class S, class F>
concept MustTakeIllumination = TakesIllumination<S, F> || explain_illumination_sink<S, F>();
} // namespace detail

/// The light at the vertices of a map, as `illuminate` adds to it pass by pass: the mean over the passes is the
/// picture. The disks of indirect light shrink from one pass to the next, so that the mean converges to the truth.
///
/// ```cpp
/// nephroid::Illumination<Vec3, Colour> light(map, scene);
/// for (int pass = 0; pass < 16; ++pass)
///     nephroid::illuminate(scene, lamp, light, {.global = {.count = 50'000}});
/// light.for_each([&](std::size_t vertex, const Colour& caustic, const Colour& indirect) { … });
/// ```
///
/// Memory: the free distances and two sums, whatever the number of passes.
template <detail::MustBeVector V, class F>
    requires detail::MustBeFluxFor<F, V>
class Illumination {
public:
    using T = scalar_t<V>;

    /// @param map       kept by reference; must outlive the illumination
    /// @param scene     as for FreeDistances: short rays are traced about each vertex, once
    /// @param executor  who traces them
    template <RayTracer<V> S, ExecutorArgument E = SerialExecutor>
    Illumination(const EyePathMap<V>& map, const S& scene, const FreeDistanceOptions& options = {}, E&& executor = E{})
        : distances_(map, scene, options, executor), caustic_(map), indirect_(map) {}
    template <class S, class... Others>
    Illumination(const EyePathMap<V>&&, const S&, Others&&...) = delete; // would refer to a temporary

    [[nodiscard]] const EyePathMap<V>& map() const { return distances_.map(); }
    [[nodiscard]] const FreeDistances<V>& distances() const { return distances_; }
    /// Passes added so far.
    [[nodiscard]] std::uint64_t passes() const { return passes_; }
    /// The sums over all passes, of irradiance.
    [[nodiscard]] const Sums<V, F>& caustic() const { return caustic_; }
    [[nodiscard]] const Sums<V, F>& indirect() const { return indirect_; }

    /// Calls sink(vertex index, caustic, indirect) once for each vertex, with the irradiance by mirrors and glass alone
    /// and by diffuse surfaces; both are zero before the first pass. The rest, direct light, is the renderer's.
    template <class S>
        requires detail::MustTakeIllumination<std::remove_reference_t<S>, F>
    void for_each(S&& sink) const {
        const T share = passes_ > 0 ? T(1) / T(passes_) : T(0);
        const auto leaves = map().tree().leaves();
        for (std::uint32_t leaf = 0; leaf < leaves.size(); ++leaf)
            for (std::size_t i = 0; i < leaves[leaf].size; ++i) {
                const F caustic = caustic_.of_leaf(leaf)[i] * share, indirect = indirect_.of_leaf(leaf)[i] * share;
                sink(std::size_t(map().tree().index(leaves[leaf].first + i)), caustic, indirect);
            }
    }

    /// Begins again; free distances stay.
    void clear() {
        caustic_.clear();
        indirect_.clear();
        radius_.reset();
        passes_ = 0;
    }

    // For whoever adds a pass, as `illuminate` does.

    [[nodiscard]] Sums<V, F>& caustic() { return caustic_; }
    [[nodiscard]] Sums<V, F>& indirect() { return indirect_; }
    /// The radius of the next pass's disks; nothing before the first pass.
    [[nodiscard]] std::optional<double> radius() const {
        return radius_ ? std::optional<double>(radius_->radius()) : std::nullopt;
    }
    /// Counts a pass.
    ///
    /// @param radius  from which disks shrink, world units; 0 if the pass had none
    /// @param alpha   in (0, 1]: the share of a pass's photons within a disk that the next one keeps
    void end_pass(double radius, double alpha) {
        ++passes_;
        if (!(radius > 0))
            return;
        if (!radius_)
            radius_.emplace(ShrinkingRadiusOptions{.radius = radius, .alpha = alpha});
        radius_->advance();
    }

private:
    FreeDistances<V> distances_;
    Sums<V, F> caustic_, indirect_;
    std::optional<ShrinkingRadius> radius_;
    std::uint64_t passes_ = 0;
};

} // namespace nephroid
