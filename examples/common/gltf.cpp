// SPDX-License-Identifier: MIT
#include "common/gltf.hpp"

#include "common/gltf/instances.hpp"
#include "common/gltf/light.hpp"
#include "common/gltf/material.hpp"
#include "common/gltf/model.hpp"
#include "common/gltf/nodes.hpp"
#include "common/gltf/primitive.hpp"
#include "common/gltf/recentring.hpp"
#include "common/gltf/report.hpp"
#include "common/gltf/texture.hpp"
#include "common/gltf/tinygltf.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <glm/mat4x4.hpp>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace nephroid::examples {
namespace gltf {
namespace {

std::string text_of(const glm::dvec3& v) {
    char text[96];
    std::snprintf(text, sizeof text, "(%g, %g, %g)", v.x, v.y, v.z);
    return text;
}

/// Builds the description node by node.
class Reader {
public:
    /// @param folder  of the file
    Reader(const tinygltf::Model& model, std::size_t file_bytes, const std::filesystem::path& folder,
           Warnings& warnings)
        : model_(model), file_bytes_(file_bytes), budget_(file_bytes), warnings_(warnings),
          textures_(model, folder, budget_, warnings_) {}

    SceneDescription read() {
        for (std::size_t i = 0; i < model_.materials.size(); ++i)
            scene_.materials.push_back(read_material(model_.materials[i], i, textures_, warnings_));

        const std::vector<std::size_t> roots = roots_of(model_);
        scene_.origin = origin_for(model_, roots, scene_.materials, file_bytes_);
        if (scene_.origin != glm::dvec3(0))
            warnings_.add("the scene lies far from the origin and is moved there, by " + text_of(-scene_.origin));
        for_each_node(model_, roots, glm::translate(glm::dmat4(1), -scene_.origin),
                      [this](const tinygltf::Node& node, const std::string& name, const glm::dmat4& to_world) {
                          visit(node, name, to_world);
                      });
        scene_.textures = textures_.take();
        return std::move(scene_);
    }

private:
    void visit(const tinygltf::Node& node, const std::string& name, const glm::dmat4& to_world) {
        if (node.mesh != -1) {
            const std::size_t mesh = checked_index(node.mesh, model_.meshes.size(), name, "mesh");
            for (const glm::dmat4& instance : instances_of(model_, node, name, budget_))
                add_mesh(node, mesh, to_world * instance);
        }
        if (node.skin != -1)
            warnings_.add(name + " has a skin, which is not read");
        if (auto light = light_of(model_, node, to_world, name)) {
            budget_.charge(1, sizeof(LightDescription) + light->name.size());
            scene_.lights.push_back(std::move(*light));
        }
        if (auto camera = camera_of(model_, node, to_world, name)) {
            budget_.charge(1, sizeof(CameraDescription) + camera->name.size());
            scene_.cameras.push_back(std::move(*camera));
        }
    }

    void add_mesh(const tinygltf::Node& node, std::size_t index, const glm::dmat4& to_world) {
        const tinygltf::Mesh& mesh = model_.meshes[index];
        const std::string owner = named("mesh", index, mesh.name);
        if (mesh.primitives.empty())
            fail({owner, " has no primitives"});
        const std::string& node_or_mesh = node.name.empty() ? mesh.name : node.name;
        const std::string name = node_or_mesh.empty() ? owner : node_or_mesh;

        for (std::size_t i = 0; i < mesh.primitives.size(); ++i) {
            const tinygltf::Primitive& primitive = mesh.primitives[i];
            budget_.charge(1, 2 * sizeof(MeshDescription) + name.size());
            const std::string part = mesh.primitives.size() == 1 ? owner : owner + ", primitive " + std::to_string(i);
            static const MaterialDescription plain;
            const MaterialDescription& material =
                primitive.material == -1 ? plain : scene_.materials[material_of(primitive, part)];
            auto result = read_primitive(model_, primitive, to_world, part, material, budget_, warnings_);
            if (!result)
                continue;
            result->name = name;
            result->material = material_of(primitive, part);
            scene_.meshes.push_back(std::move(*result));
        }
    }

    std::size_t material_of(const tinygltf::Primitive& primitive, std::string_view owner) {
        const std::size_t count = model_.materials.size();
        if (primitive.material != -1)
            return checked_index(primitive.material, count, owner, "material");
        if (scene_.materials.size() == count) {
            scene_.materials.emplace_back();
            scene_.materials.back().name = "default";
        }
        return count;
    }

    const tinygltf::Model& model_;
    std::size_t file_bytes_;
    Budget budget_;
    Warnings& warnings_;
    TextureReader textures_;
    SceneDescription scene_;
};

SceneDescription parse(std::span<const unsigned char> file, const std::filesystem::path& folder, Warnings& warnings) {
    const tinygltf::Model model = load_model(file, folder, warnings);
    std::size_t bytes = file.size();
    for (const tinygltf::Buffer& buffer : model.buffers)
        bytes += buffer.data.size();
    SceneDescription scene = Reader(model, bytes, folder, warnings).read();
    scene.warnings = warnings.take();
    return scene;
}

std::vector<unsigned char> file_content(const std::filesystem::path& path) {
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (status.type() == std::filesystem::file_type::not_found)
        fail({"no such file"});
    if (status.type() == std::filesystem::file_type::none)
        fail({error.message()});
    if (!std::filesystem::is_regular_file(status))
        fail({"not a file"});
    const std::uintmax_t size = std::filesystem::file_size(path, error);
    if (error)
        fail({error.message()});
    if (size > std::numeric_limits<std::uint32_t>::max())
        fail({"more than 4 GiB, which tinygltf does not read"});

    errno = 0;
    std::ifstream file(path, std::ios::binary);
    std::vector<unsigned char> content(static_cast<std::size_t>(size));
    if (!file || !file.read(reinterpret_cast<char*>(content.data()), static_cast<std::streamsize>(size)))
        fail({"it cannot be read: ", errno != 0 ? std::generic_category().message(errno) : "it has become shorter"});
    return content;
}

/// Runs a part of the reader, and adds the file's name to its error messages.
template <class Part>
auto naming(const std::filesystem::path& path, const Part& part) {
    Warnings warnings;
    std::string problem;
    try {
        return part(warnings);
    } catch (const std::bad_alloc&) {
        problem = "not enough memory to read it";
    } catch (const std::exception& error) {
        problem = error.what();
    }
    throw UnreadableGltf(one_line(path.string()) + ": " + one_line(problem), warnings.take());
}
} // namespace
} // namespace gltf

SceneDescription parse_gltf(std::span<const unsigned char> file, const std::filesystem::path& path) {
    return gltf::naming(path,
                        [&](gltf::Warnings& warnings) { return gltf::parse(file, path.parent_path(), warnings); });
}

SceneDescription read_gltf(const std::filesystem::path& path) {
    const std::vector<unsigned char> content =
        gltf::naming(path, [&](gltf::Warnings&) { return gltf::file_content(path); });
    return parse_gltf(content, path);
}

} // namespace nephroid::examples
