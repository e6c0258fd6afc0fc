// SPDX-License-Identifier: MIT
/// @file  A scene as a photon with parameters sees it: they are the last argument of the scene's functions.
#pragma once

#include "nephroid/emission/parameters.hpp"
#include "nephroid/transport/parametric_scattering.hpp"
#include "nephroid/transport/scene.hpp"
#include "nephroid/transport/ways.hpp"

#include <concepts>
#include <type_traits>

namespace nephroid::detail {

template <class S, class... Arguments>
concept IntersectsWith = requires(const S& scene, const Arguments&... arguments) {
    scene.intersect(arguments...);
};
template <class S, class Sampler, class H, class V, class... Others>
concept ScattersWith = requires(const S& scene, const H& hit, const V& v, Sampler& sampler, const Others&... others) {
    scene.scatter(hit, v, sampler, others...);
};
template <class S, class... Arguments>
concept ScattersAllWith = requires(const S& scene, const Arguments&... arguments) {
    scene.scatter_all(arguments...);
};
template <class S, class... Arguments>
concept TransmitsWith = requires(const S& scene, const Arguments&... arguments) {
    scene.transmittance(arguments...);
};

/// The members of a scene that are not functions.
template <class S>
struct SceneMedium {};
template <class S>
    requires requires { typename S::medium; }
struct SceneMedium<S> {
    using medium = typename S::medium;
};
template <class S>
struct SceneChoice {};
template <class S>
    requires requires { S::scatters_by_chance; }
struct SceneChoice<S> {
    static constexpr bool scatters_by_chance = S::scatters_by_chance;
};
template <class S>
struct SceneEpsilon {
    explicit SceneEpsilon(const S&) {}
};
template <class S>
    requires requires(const S& scene) { scene.tracer_epsilon; }
struct SceneEpsilon<S> {
    std::remove_cvref_t<decltype(std::declval<const S&>().tracer_epsilon)> tracer_epsilon;

    explicit SceneEpsilon(const S& scene) : tracer_epsilon(scene.tracer_epsilon) {}
};

/// A scene for one photon. `intersect`, `scatter`, `scatter_all` and `transmittance` get its parameters after their
/// other arguments where they take them; else they are called as for any photon.
///
/// @tparam P              the parameters
/// @tparam notes_glass    whether the parameters are told of refractions: not if the photon follows several ways
template <class S, class P, bool notes_glass = true>
class ParametricScene : public SceneMedium<S>, public SceneChoice<S>, public SceneEpsilon<S> {
public:
    /// Both are kept by reference.
    ParametricScene(const S& scene, P& parameters) : SceneEpsilon<S>(scene), scene_(&scene), parameters_(&parameters) {}

    template <class... Arguments>
        requires(IntersectsWith<S, Arguments..., P> || IntersectsWith<S, Arguments...>)
    [[nodiscard]] auto intersect(const Arguments&... arguments) const {
        if constexpr (IntersectsWith<S, Arguments..., P>)
            return scene_->intersect(arguments..., *parameters_);
        else
            return scene_->intersect(arguments...);
    }

    template <class H, class V, class Sampler>
        requires(ScattersWith<S, Sampler, H, V, P> || ScattersWith<S, Sampler, H, V>)
    [[nodiscard]] auto scatter(const H& hit, const V& direction, Sampler& sampler) const {
        if constexpr (ScattersWith<S, Sampler, H, V, P>)
            return noting(scene_->scatter(hit, direction, sampler, *parameters_));
        else
            return noting(scene_->scatter(hit, direction, sampler));
    }
    template <class H, class V, class Sampler, class Medium>
        requires(!std::same_as<Medium, NoMedium> &&
                 (ScattersWith<S, Sampler, H, V, Medium, P> || ScattersWith<S, Sampler, H, V, Medium>))
    [[nodiscard]] auto scatter(const H& hit, const V& direction, Sampler& sampler, const Medium& through) const {
        if constexpr (ScattersWith<S, Sampler, H, V, Medium, P>)
            return noting(scene_->scatter(hit, direction, sampler, through, *parameters_));
        else
            return noting(scene_->scatter(hit, direction, sampler, through));
    }

    template <class H, class V, class... Medium>
        requires(!(std::same_as<Medium, NoMedium> || ...) &&
                 (ScattersAllWith<S, H, V, Medium..., P> || ScattersAllWith<S, H, V, Medium...>))
    [[nodiscard]] auto scatter_all(const H& hit, const V& direction, const Medium&... through) const {
        if constexpr (ScattersAllWith<S, H, V, Medium..., P>)
            return all_of(scene_->scatter_all(hit, direction, through..., *parameters_));
        else
            return all_of(scene_->scatter_all(hit, direction, through...));
    }

    template <class Medium, class T>
        requires(TransmitsWith<S, Medium, T, P> || TransmitsWith<S, Medium, T>)
    [[nodiscard]] auto transmittance(const Medium& through, const T& distance) const {
        if constexpr (TransmitsWith<S, Medium, T, P>)
            return scene_->transmittance(through, distance, *parameters_);
        else
            return scene_->transmittance(through, distance);
    }

    template <class H, class V>
        requires requires(const S& scene, const H& hit, const V& v) { scene.spawn(hit, v); }
    [[nodiscard]] auto spawn(const H& hit, const V& direction) const { return scene_->spawn(hit, direction); }

    template <class V>
        requires requires(const S& scene, const V& v) { scene.medium_at(v); }
    [[nodiscard]] auto medium_at(const V& position) const { return scene_->medium_at(position); }

private:
    template <class Scattering>
    [[nodiscard]] auto noting(const Scattering& scattering) const {
        return ParametricScattering<Scattering, P>(scattering, notes_glass ? parameters_ : nullptr);
    }
    template <class List>
    [[nodiscard]] static ParametricWays<List, P> all_of(const List& list) {
        return {list};
    }

    const S* scene_;
    P* parameters_;
};

} // namespace nephroid::detail
