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

/// Which photons of one kind of light have been added.
struct IlluminationPart {
    std::uint64_t passes = 0; ///< that added such light
    std::uint64_t next = 0;   ///< index of the first photon of the next one
};

/// The light at the vertices of a map, as `illuminate` adds to it pass by pass: the mean over the passes is the
/// picture, for caustics over those passes that had caustic photons and for indirect light over those that had global
/// ones. The disks of indirect light shrink from one pass to the next, so that its mean converges to the truth. The
/// mean of caustics loses its noise and keeps the bias of the footprints of one pass.
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
    /// What has been added so far of light by mirrors and glass alone, and of light by diffuse surfaces.
    [[nodiscard]] const IlluminationPart& caustic_part() const { return caustic_part_; }
    [[nodiscard]] const IlluminationPart& indirect_part() const { return indirect_part_; }
    /// The sums over all passes, of irradiance.
    [[nodiscard]] const Sums<V, F>& caustic() const { return caustic_; }
    [[nodiscard]] const Sums<V, F>& indirect() const { return indirect_; }

    /// Calls sink(vertex index, caustic, indirect) once for each vertex, with the irradiance by mirrors and glass alone
    /// and by diffuse surfaces; both are zero before the first pass. The rest, direct light, is the renderer's.
    template <class S>
        requires detail::MustTakeIllumination<std::remove_reference_t<S>, F>
    void for_each(S&& sink) const {
        const auto share_of = [](const IlluminationPart& part) {
            return part.passes > 0 ? T(1) / T(part.passes) : T(0);
        };
        const T of_caustics = share_of(caustic_part_), of_indirect = share_of(indirect_part_);
        const auto leaves = map().tree().leaves();
        for (std::uint32_t leaf = 0; leaf < leaves.size(); ++leaf)
            for (std::size_t i = 0; i < leaves[leaf].size; ++i) {
                const F caustic = caustic_.of_leaf(leaf)[i] * of_caustics;
                const F indirect = indirect_.of_leaf(leaf)[i] * of_indirect;
                sink(std::size_t(map().tree().index(leaves[leaf].first + i)), caustic, indirect);
            }
    }

    /// Begins again; free distances stay.
    void clear() {
        caustic_.clear();
        indirect_.clear();
        radius_.reset();
        caustic_part_ = indirect_part_ = {};
    }

    // For whoever adds a pass, as `illuminate` does.

    [[nodiscard]] Sums<V, F>& caustic() { return caustic_; }
    [[nodiscard]] Sums<V, F>& indirect() { return indirect_; }
    /// The radius of the next pass's disks; nothing before one was chosen or given.
    [[nodiscard]] std::optional<double> radius() const {
        return radius_ ? std::optional<double>(radius_->radius()) : std::nullopt;
    }
    /// Counts a pass that added caustics, of so many photons.
    void end_caustic_pass(std::uint64_t photons) {
        ++caustic_part_.passes;
        caustic_part_.next += photons;
    }
    /// Counts a pass that added indirect light, of so many photons.
    ///
    /// @param radius  from which disks shrink, if the pass is the first that has one; world units
    /// @param alpha   in (0, 1]: the share of a pass's photons within a disk that the next one keeps
    void end_indirect_pass(std::uint64_t photons, std::optional<double> radius, double alpha) {
        ++indirect_part_.passes;
        indirect_part_.next += photons;
        if (!radius_ && radius)
            radius_.emplace(ShrinkingRadiusOptions{.radius = *radius, .alpha = alpha});
        if (radius_)
            radius_->advance();
    }

private:
    FreeDistances<V> distances_;
    Sums<V, F> caustic_, indirect_;
    std::optional<ShrinkingRadius> radius_;
    IlluminationPart caustic_part_, indirect_part_;
};

} // namespace nephroid
