// SPDX-License-Identifier: MIT
#include "common/gltf/instances.hpp"

#include "common/gltf/accessor.hpp"
#include "common/gltf/transform.hpp"

#include <glm/geometric.hpp>
#include <glm/gtc/quaternion.hpp>

#include <cstddef>
#include <limits>
#include <optional>
#include <string>

namespace nephroid::examples::gltf {
namespace {

/// Views the instancing attributes of one node.
class Attributes {
public:
    Attributes(const tinygltf::Model& model, const tinygltf::Value& attributes, std::string_view owner)
        : model_(model), attributes_(attributes), owner_(owner) {}

    /// @return  nothing if the node has no attribute of that name
    [[nodiscard]] std::optional<AccessorView> view(const char* name, int components) {
        if (!attributes_.Has(name))
            return std::nullopt;
        const tinygltf::Value& index = attributes_.Get(name);
        if (!index.IsInt())
            fail({owner_, " has an instancing attribute ", name, " that is not an index"});
        const AccessorView view = view_vectors(model_, index.GetNumberAsInt(), owner_, components);
        if (count_ != none && view.count != count_)
            fail({owner_, " has instancing attributes of ", std::to_string(count_), " and of ",
                  std::to_string(view.count), " elements"});
        count_ = view.count;
        return view;
    }

    [[nodiscard]] std::size_t count() const { return count_ == none ? 0 : count_; }

private:
    static constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

    const tinygltf::Model& model_;
    const tinygltf::Value& attributes_;
    std::string_view owner_;
    std::size_t count_ = none;
};

glm::dmat3 rotation_from(const glm::dvec4& xyzw, std::string_view owner) {
    const double length = glm::length(xyzw);
    if (!(length > 0))
        fail({owner, " has an instance with a rotation of length zero"});
    return glm::mat3_cast(glm::dquat(xyzw.w / length, xyzw.x / length, xyzw.y / length, xyzw.z / length));
}
} // namespace

std::vector<glm::dmat4> instances_of(const tinygltf::Model& model, const tinygltf::Node& node, std::string_view name,
                                     Budget& budget) {
    const auto extension = node.extensions.find("EXT_mesh_gpu_instancing");
    if (extension == node.extensions.end())
        return {glm::dmat4(1)};
    if (!extension->second.Has("attributes") || !extension->second.Get("attributes").IsObject())
        fail({name, " has EXT_mesh_gpu_instancing without attributes"});

    Attributes attributes(model, extension->second.Get("attributes"), name);
    const auto translation = attributes.view("TRANSLATION", 3);
    const auto rotation = attributes.view("ROTATION", 4);
    const auto scale = attributes.view("SCALE", 3);
    const std::size_t count = attributes.count();
    budget.charge(count, sizeof(glm::dmat4) + 2 * sizeof(glm::vec3) + sizeof(glm::vec4));
    const auto translations = translation ? read_vectors(model, *translation) : std::vector<glm::vec3>(count);
    const auto rotations = rotation ? read_quadruples(model, *rotation) : std::vector<glm::vec4>(count, {0, 0, 0, 1});
    const auto scales = scale ? read_vectors(model, *scale) : std::vector<glm::vec3>(count, glm::vec3(1));

    std::vector<glm::dmat4> instances;
    instances.reserve(count);
    for (std::size_t i = 0; i < count; ++i) {
        glm::dmat4 place(rotation_from(glm::dvec4(rotations[i]), name));
        for (int axis = 0; axis < 3; ++axis)
            place[axis] *= double{scales[i][axis]};
        place[3] = glm::dvec4(glm::dvec3(translations[i]), 1);
        if (!is_finite_in_float(place))
            fail({name, " has an instance that is not finite"});
        instances.push_back(place);
    }
    return instances;
}

} // namespace nephroid::examples::gltf
