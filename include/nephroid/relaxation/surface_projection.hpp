// SPDX-License-Identifier: MIT
/// @file  Puts moved photons back on their surface: the caller's `project` of `relax`.
#pragma once

#include "nephroid/relaxation/photon_cloud.hpp"

#include <concepts>
#include <string>
#include <type_traits>
#include <vector>

namespace nephroid {

/// Leaves a moved photon in its tangent plane: for flat surfaces, and where the surface is not known.
struct StayInPlane {
    template <class V>
    [[nodiscard]] const V& operator()(std::size_t, const V& position) const {
        return position;
    }
};

/// A position on a surface with its normal, unit: what a `project` returns that turns normals as well.
template <Vector3 V>
struct SurfacePoint {
    V position;
    V normal;
};

namespace detail {

template <class Project, class V>
using projected_point_t = std::remove_cvref_t<std::invoke_result_t<const Project&, std::size_t, const V&>>;

/// Calls `project` for the photons of a cloud.
template <class Cloud, class Project>
class SurfaceProjection {
public:
    using V = typename Cloud::vector;
    static constexpr bool turns_normals = std::same_as<projected_point_t<Project, V>, SurfacePoint<V>>;

    SurfaceProjection(Cloud& cloud, const Project& project) : cloud_(&cloud), project_(&project) {
        if constexpr (turns_normals)
            for (std::size_t slot = 0; slot < cloud.tree().slots(); ++slot)
                points_.push_back({cloud.position(slot), cloud.normal(slot)});
    }

    /// @param position  relative to the tree's origin, as what is returned
    /// Throws std::invalid_argument for what cannot be a position or a normal.
    [[nodiscard]] V operator()(std::size_t slot, const V& position) {
        if constexpr (std::is_same_v<Project, StayInPlane>) {
            return position;
        } else if constexpr (turns_normals) {
            const SurfacePoint<V> point =
                (*project_)(cloud_->tree().index(slot), V(cloud_->tree().origin() + position));
            if (!(abs(length2(point.normal) - scalar_t<V>(1)) < scalar_t<V>(0.01)))
                invalid_argument(photon(slot) + " a normal of " + text_of(point.normal) +
                                 "; every normal must be of unit length");
            points_[slot] = {checked(slot, point.position), point.normal};
            return points_[slot].position;
        } else {
            return checked(slot, (*project_)(cloud_->tree().index(slot), V(cloud_->tree().origin() + position)));
        }
    }

    /// Turns the normals of the photons that were put elsewhere, when an iteration is over: during it their neighbours
    /// read them.
    template <class E>
    void turn_normals(E& executor) {
        if constexpr (turns_normals)
            for_each_slot(cloud_->tree(), executor, [&](std::size_t slot) {
                if (length2(V(points_[slot].position - cloud_->position(slot))) == scalar_t<V>(0))
                    cloud_->set_normal(slot, points_[slot].normal);
            });
    }

private:
    [[nodiscard]] std::string photon(std::size_t slot) const {
        return "nephroid::relax: project put photon " + std::to_string(cloud_->tree().index(slot)) + " at";
    }

    [[nodiscard]] V checked(std::size_t slot, const V& there) const {
        if (!all_finite(there))
            invalid_argument(photon(slot) + " " + text_of(there) + "; every position must be finite");
        return cloud_->tree().relative(there);
    }

    Cloud* cloud_;
    const Project* project_;
    std::vector<SurfacePoint<V>> points_; ///< by slot, where photons were put last; empty unless normals turn
};

} // namespace detail

} // namespace nephroid
