// SPDX-License-Identifier: MIT
#include "common/gltf/recentring.hpp"

#include "common/gltf/accessor.hpp"
#include "common/gltf/instances.hpp"
#include "common/gltf/nodes.hpp"
#include "common/gltf/report.hpp"
#include "common/gltf/transform.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>

#include <cmath>
#include <limits>
#include <map>
#include <stdexcept>

namespace nephroid::examples::gltf {
namespace {

/// An axis-aligned box; empty by default.
struct Bounds {
    glm::dvec3 low{std::numeric_limits<double>::infinity()}, high{-std::numeric_limits<double>::infinity()};

    [[nodiscard]] bool is_empty() const { return !(low.x <= high.x); }
    void add(const glm::dvec3& p) {
        low = glm::min(low, p);
        high = glm::max(high, p);
    }
    /// Adds the corners of a transformed box.
    void add(const Bounds& box, const glm::dmat4& to_world) {
        for (int i = 0; i < 8; ++i)
            add(glm::dvec3(to_world * glm::dvec4(i & 1 ? box.high.x : box.low.x, i & 2 ? box.high.y : box.low.y,
                                                 i & 4 ? box.high.z : box.low.z, 1)));
    }
};

/// The bounds of an accessor's positions in the mesh's own space. The mesh's reader reports errors of the accessor.
Bounds bounds_of(const tinygltf::Model& model, int accessor) {
    Bounds bounds;
    try {
        const AccessorView view = view_vectors(model, accessor, "a mesh");
        if (view.data == nullptr) // all zero, perhaps very many
            bounds.add(glm::dvec3(0));
        else
            for (const glm::vec3& position : read_vectors(model, view))
                if (is_finite(glm::dvec3(position)))
                    bounds.add(glm::dvec3(position));
    } catch (const std::runtime_error&) {
        return {};
    }
    return bounds;
}

/// Collects the bounds of the scene's primitives.
class Survey {
public:
    Survey(const tinygltf::Model& model, const std::vector<MaterialDescription>& materials)
        : model_(model), materials_(materials) {}

    void add(const tinygltf::Mesh& mesh, const glm::dmat4& to_world) {
        for (const tinygltf::Primitive& primitive : mesh.primitives) {
            const auto position = primitive.attributes.find("POSITION");
            if (position == primitive.attributes.end())
                continue;
            const auto [known, is_new] = known_.try_emplace(position->second);
            if (is_new)
                known->second = bounds_of(model_, position->second);
            if (known->second.is_empty())
                continue;
            const auto material = static_cast<std::size_t>(primitive.material);
            all_.add(known->second, to_world);
            if (primitive.material >= 0 && material < materials_.size() && materials_[material].is_specular())
                specular_.add(known->second, to_world);
        }
    }

    [[nodiscard]] const Bounds& subject() const { return specular_.is_empty() ? all_ : specular_; }

private:
    const tinygltf::Model& model_;
    const std::vector<MaterialDescription>& materials_;
    std::map<int, Bounds> known_; ///< by accessor
    Bounds all_, specular_;
};
} // namespace

glm::dvec3 origin_for(const tinygltf::Model& model, const std::vector<std::size_t>& roots,
                      const std::vector<MaterialDescription>& materials, std::size_t file_bytes) {
    constexpr double close_by = 16; // radii
    Survey survey(model, materials);
    Budget budget(file_bytes);
    for_each_node(model, roots, glm::dmat4(1),
                  [&](const tinygltf::Node& node, const std::string& name, const glm::dmat4& to_world) {
                      if (node.mesh < 0 || static_cast<std::size_t>(node.mesh) >= model.meshes.size())
                          return;
                      for (const glm::dmat4& instance : instances_of(model, node, name, budget))
                          survey.add(model.meshes[static_cast<std::size_t>(node.mesh)], to_world * instance);
                  });
    const Bounds& subject = survey.subject();
    if (subject.is_empty() || !is_finite(subject.low) || !is_finite(subject.high))
        return glm::dvec3(0);
    const glm::dvec3 middle = 0.5 * (subject.low + subject.high);
    const double radius = 0.5 * glm::length(subject.high - subject.low);
    if (!(glm::length(middle) > close_by * radius) || !(radius > 0))
        return glm::dvec3(0);
    // On a grid of powers of two: a scene built around such a point gets back its own coordinates, to the last bit.
    const double step = std::exp2(std::floor(std::log2(radius)));
    return step * glm::round(middle / step);
}

} // namespace nephroid::examples::gltf
