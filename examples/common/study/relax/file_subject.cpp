// SPDX-License-Identifier: MIT
#include "common/study/relax/subject.hpp"

#include "common/photon_lights.hpp"
#include "common/scene_from_gltf.hpp"
#include "common/study/relax/stored_photons.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>

namespace nephroid::examples::study::relax {

namespace {

[[noreturn]] void fail(const Options& options, const std::string& what) {
    throw std::runtime_error("'" + options.subject + "' " + what);
}

/// Puts a photon that has left its curved surface along the tangent plane back onto it: the diffuse surface
/// that the scene has along the normal, no further away than the photon has moved.
[[nodiscard]] glm::vec3 back_onto_surface(const Scene<float, Color>& scene, const StoredPhoton& photon,
                                          const glm::vec3& moved) {
    const float reach = length(moved - photon.position);
    const glm::vec3 above = moved + reach * photon.normal;
    const auto hit = scene.intersect(above, -photon.normal, 0, 2 * reach);
    return hit && scene.material(*hit).surface == Surface::diffuse ? hit->position : moved;
}

} // namespace

Subject file_subject(const Options& options, ThreadExecutor& threads) {
    const SceneDescription description = read_gltf(options.subject);
    const auto gltf = std::make_shared<GltfScene<float, Color>>(scene_from<float, Color>(description));
    if (gltf->scene.empty())
        fail(options, "has no triangles; add a mesh");
    if (gltf->lamps.empty())
        fail(options, "has no light; add one by KHR_lights_punctual, or a mesh with an emissive material");
    if (!gltf->scene.has_specular())
        fail(options, "has no specular surface, so it has no caustic; add glass (KHR_materials_transmission) or a "
                      "smooth metal");

    const CameraDescription view =
        description.cameras.empty() ? camera_for(gltf->scene.bounds()) : description.cameras.front();
    Subject subject;
    subject.notes = gltf->warnings;
    subject.width = options.width;
    subject.height = options.height;
    if (!options.height_given)
        subject.height =
            static_cast<std::size_t>((std::max)(1.0, std::round(static_cast<double>(options.width) / aspect_of(view))));
    const auto camera = camera_from<float>(view, subject.width, subject.height);
    subject.vertices =
        trace_eye_paths(gltf->scene, camera, {.samples = options.samples, .seed = options.seed}, threads).vertices;
    subject.photons =
        stored_photons(gltf->scene, photon_lights(gltf->lamps, gltf->scene), WalkLimits{}, options, threads);
    subject.project = [gltf, photons = subject.photons](std::size_t i, const glm::vec3& moved) {
        return back_onto_surface(gltf->scene, photons[i], moved);
    };
    return subject;
}

} // namespace nephroid::examples::study::relax
