// SPDX-License-Identifier: MIT
#include "common/gltf/light.hpp"

#include "common/gltf/report.hpp"
#include "common/gltf/transform.hpp"

#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include <cmath>
#include <cstddef>
#include <numbers>
#include <string>

namespace nephroid::examples::gltf {
namespace {

/// A unit vector; fails where the node's scale has made it zero.
glm::dvec3 direction_of(const glm::dvec3& v, std::string_view node_name) {
    const double length = glm::length(v);
    if (!(length > 0))
        fail({node_name, " has a scale of zero, which leaves its light or camera without a direction"});
    return v / length;
}

std::string first_name(const std::string& own, const std::string& node, std::string_view kind, std::size_t index) {
    if (!own.empty())
        return own;
    return node.empty() ? named(kind, index, "") : node;
}

void read_cones(LightDescription& light, const tinygltf::SpotLight& spot, std::string_view owner) {
    const double inner = spot.innerConeAngle, outer = spot.outerConeAngle;
    if (!(inner >= 0 && inner <= outer && outer > 0 && outer <= std::numbers::pi / 2 + 1e-6))
        fail({owner, " has an inner cone angle of ", std::to_string(inner), " and an outer one of ",
              std::to_string(outer), "; these are needed: 0 <= inner < outer <= pi / 2"});
    light.cos_inner = static_cast<float>(std::cos(inner));
    light.cos_outer = static_cast<float>(std::cos(outer));
    if (!(light.cos_outer < light.cos_inner)) // a hard edge: exporters write two equal angles
        light.cos_outer = std::nextafter(light.cos_inner, -1.f);
}

LightDescription read_light(const tinygltf::Light& light, std::string_view owner) {
    LightDescription result;
    if (light.type == "directional")
        result.kind = LightDescription::Kind::directional;
    else if (light.type == "point")
        result.kind = LightDescription::Kind::point;
    else if (light.type == "spot")
        result.kind = LightDescription::Kind::spot;
    else
        fail({owner, " is of the type \"", light.type, "\"; directional, point and spot are read"});

    if (!light.color.empty() && light.color.size() != 3)
        fail({owner, " has a color of ", std::to_string(light.color.size()), " numbers"});
    const float intensity = to_float(light.intensity, owner, "intensity");
    for (std::size_t i = 0; i < 3; ++i) {
        const double color = light.color.empty() ? 1 : double{to_float(light.color[i], owner, "color")};
        const double value = color * double{intensity};
        if (!(value >= 0))
            fail({owner, " has a negative intensity"});
        result.intensity[static_cast<int>(i)] = to_float(value, owner, "intensity");
    }
    if (light.range > 0) // 0: not given
        result.range = to_float(light.range, owner, "range");
    if (result.kind == LightDescription::Kind::spot)
        read_cones(result, light.spot, owner);
    return result;
}
} // namespace

std::optional<LightDescription> light_of(const tinygltf::Model& model, const tinygltf::Node& node,
                                         const glm::dmat4& to_world, std::string_view node_name) {
    const auto extension = node.extensions.find("KHR_lights_punctual");
    if (extension == node.extensions.end() || !extension->second.Has("light"))
        return std::nullopt;
    const tinygltf::Value& number = extension->second.Get("light");
    if (!number.IsInt())
        fail({node_name, " refers to a light by something else than an index"});
    const std::size_t index = checked_index(number.GetNumberAsInt(), model.lights.size(), node_name, "light");

    const tinygltf::Light& light = model.lights[index];
    LightDescription result = read_light(light, named("light", index, light.name));
    result.name = first_name(light.name, node.name, "light", index);
    result.position = glm::vec3(to_world[3]);
    result.direction = glm::vec3(-direction_of(glm::dvec3(to_world[2]), node_name));
    return result;
}

std::optional<CameraDescription> camera_of(const tinygltf::Model& model, const tinygltf::Node& node,
                                           const glm::dmat4& to_world, std::string_view node_name) {
    if (node.camera == -1)
        return std::nullopt;
    const std::size_t index = checked_index(node.camera, model.cameras.size(), node_name, "camera");
    const tinygltf::Camera& camera = model.cameras[index];
    const std::string owner = named("camera", index, camera.name);

    CameraDescription result;
    result.name = first_name(camera.name, node.name, "camera", index);
    if (camera.type == "orthographic") {
        result.kind = CameraDescription::Kind::orthographic;
        result.xmag = std::abs(to_float(camera.orthographic.xmag, owner, "xmag"));
        result.ymag = std::abs(to_float(camera.orthographic.ymag, owner, "ymag"));
        if (!(result.xmag > 0 && result.ymag > 0))
            fail({owner, " has a size of zero"});
    } else {
        result.kind = CameraDescription::Kind::perspective;
        result.yfov = to_float(camera.perspective.yfov, owner, "yfov");
        if (!(result.yfov > 0 && double{result.yfov} < std::numbers::pi))
            fail({owner, " has a yfov of ", std::to_string(result.yfov), "; it must be an angle between 0 and pi"});
        const float aspect = to_float(camera.perspective.aspectRatio, owner, "aspectRatio");
        if (aspect < 0)
            fail({owner, " has a negative aspectRatio"});
        if (aspect > 0) // 0: not given
            result.aspect = aspect;
    }

    const glm::dvec3 forward = -direction_of(glm::dvec3(to_world[2]), node_name);
    const glm::dvec3 right =
        direction_of(glm::cross(forward, direction_of(glm::dvec3(to_world[1]), node_name)), node_name);
    result.position = glm::vec3(to_world[3]);
    result.forward = glm::vec3(forward);
    result.right = glm::vec3(right);
    result.up = glm::vec3(glm::cross(right, forward));
    return result;
}

} // namespace nephroid::examples::gltf
