// SPDX-License-Identifier: MIT
/// @file  The camera of a glTF file, or one that shows its scene.
#pragma once

#include "common/camera.hpp"
#include "common/gltf.hpp"
#include "common/scene.hpp"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace nephroid::examples {

/// The camera that a file describes, with a film of the given size: the vertical extent is the file's, the horizontal
/// one follows from the film.
template <class T>
[[nodiscard]] Camera<T> camera_from(const CameraDescription& c, std::size_t width, std::size_t height) {
    const typename Camera<T>::Pose pose{Vec3<T>(c.position), Vec3<T>(c.right), Vec3<T>(c.up), Vec3<T>(c.forward)};
    return c.kind == CameraDescription::Kind::perspective ? Camera<T>::perspective(pose, T(c.yfov), width, height)
                                                          : Camera<T>::orthographic(pose, T(c.ymag), width, height);
}

/// The width over the height of a file's camera; 1 if it has none.
[[nodiscard]] inline double aspect_of(const CameraDescription& c) {
    if (c.kind == CameraDescription::Kind::orthographic)
        return double(c.xmag) / double(c.ymag);
    return double(c.aspect.value_or(1.0f));
}

/// A camera for files without one: it shows a whole box from the front and above, with y upwards as in glTF.
///
/// @param aspect  of the film, width over height
template <class T>
[[nodiscard]] CameraDescription camera_for(const Box<T>& bounds, double aspect = 1) {
    CameraDescription c;
    c.name = "default";
    const glm::vec3 low(bounds.min), high(bounds.max), middle = 0.5f * (low + high);
    const float radius = 0.5f * length(high - low), tilt = 0.5f;
    const float half_angle = std::atan(std::tan(0.5f * c.yfov) * static_cast<float>((std::min)(1.0, aspect)));
    c.forward = {0, -std::sin(tilt), -std::cos(tilt)};
    c.up = {0, std::cos(tilt), -std::sin(tilt)};
    c.position = middle - radius / std::sin(half_angle) * c.forward;
    return c;
}

/// Moves a camera in front of objects between it and its subject, and widens its view to show the same.
///
/// @param middle  of the subject; specular surfaces block the view
template <class T, Flux F>
void step_inside(CameraDescription& camera, const Scene<T, F>& scene, const glm::vec3& middle) {
    const Vec3<T> back(-camera.forward);
    const T wanted = length(Vec3<T>(camera.position - middle));
    T free = T(0);
    for (int surfaces = 0; surfaces < 64 && free < wanted; ++surfaces) {
        const auto hit = scene.intersect(Vec3<T>(middle) + free * back, back, T(0), wanted - free);
        if (!hit)
            return;
        free += hit->distance * T(1.0001);
        if (scene.material(*hit).is_specular())
            continue;
        const T distance = T(0.95) * free;
        constexpr float widest = 2; // radians
        const float half = std::atan(std::tan(0.5f * camera.yfov) * static_cast<float>(wanted / distance));
        camera.position = middle + static_cast<float>(distance) * glm::vec3(back);
        camera.yfov = (std::min)(widest, 2 * half);
        return;
    }
}

} // namespace nephroid::examples
