// SPDX-License-Identifier: MIT
#include "common/gltf.hpp"

#include "common/gltf/light.hpp"
#include "common/gltf/material.hpp"
#include "common/gltf/model.hpp"
#include "common/gltf/primitive.hpp"
#include "common/gltf/report.hpp"
#include "common/gltf/tinygltf.hpp"
#include "common/gltf/transform.hpp"

#include <glm/mat4x4.hpp>

#include <cerrno>
#include <exception>
#include <fstream>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

namespace nephroid::examples {
namespace gltf {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

std::string name_of(const tinygltf::Model& model, std::size_t node) {
    return named("node", node, model.nodes[node].name);
}

/// Every node's parent, or `none`. Fails unless the nodes form trees, as glTF demands: then no walk is endless.
std::vector<std::size_t> parents_of(const tinygltf::Model& model) {
    const std::size_t count = model.nodes.size();
    std::vector<std::size_t> parents(count, none);
    for (std::size_t i = 0; i < count; ++i) {
        for (const int child : model.nodes[i].children) {
            std::size_t& parent = parents[checked_index(child, count, name_of(model, i), "node")];
            if (parent != none)
                fail({name_of(model, static_cast<std::size_t>(child)), " has two parents, nodes ",
                      std::to_string(parent), " and ", std::to_string(i), "; or one parent lists it twice"});
            parent = i;
        }
    }

    // With one parent each, a node is in a tree exactly if it can be reached from a root.
    std::vector<std::size_t> pending;
    for (std::size_t i = 0; i < count; ++i)
        if (parents[i] == none)
            pending.push_back(i);
    std::vector<bool> reached(count, false);
    while (!pending.empty()) {
        const std::size_t i = pending.back();
        pending.pop_back();
        reached[i] = true;
        for (const int child : model.nodes[i].children)
            pending.push_back(static_cast<std::size_t>(child));
    }
    for (std::size_t i = 0; i < count; ++i)
        if (!reached[i])
            fail({name_of(model, i), " is its own ancestor or the child of one that is: the nodes form a cycle"});
    return parents;
}

/// The nodes that the scene starts from, each once.
std::vector<std::size_t> roots_of(const tinygltf::Model& model) {
    const std::vector<std::size_t> parents = parents_of(model);
    std::vector<std::size_t> roots;
    if (model.scenes.empty()) {
        for (std::size_t i = 0; i < parents.size(); ++i)
            if (parents[i] == none)
                roots.push_back(i);
        return roots;
    }

    const int preset = model.defaultScene == -1 ? 0 : model.defaultScene;
    const std::size_t scene = checked_index(preset, model.scenes.size(), "the file", "scene");
    const std::string owner = named("scene", scene, model.scenes[scene].name);
    std::vector<bool> listed(parents.size(), false);
    for (const int node : model.scenes[scene].nodes) {
        const std::size_t i = checked_index(node, parents.size(), owner, "node");
        if (parents[i] != none)
            fail(
                {owner, " starts from ", name_of(model, i), ", which is a child of node ", std::to_string(parents[i])});
        if (listed[i])
            fail({owner, " lists ", name_of(model, i), " twice"});
        listed[i] = true;
        roots.push_back(i);
    }
    return roots;
}

/// Builds the description node by node.
class Reader {
public:
    Reader(const tinygltf::Model& model, std::size_t file_bytes, Warnings& warnings)
        : model_(model), budget_(file_bytes), warnings_(warnings) {}

    SceneDescription read() {
        for (std::size_t i = 0; i < model_.materials.size(); ++i)
            scene_.materials.push_back(read_material(model_.materials[i], i, warnings_));

        struct Step {
            std::size_t node;
            glm::dmat4 parent;
        };
        std::vector<Step> pending; // a stack of its own: a file can nest nodes deeper than the program's stack is
        const std::vector<std::size_t> roots = roots_of(model_);
        for (auto root = roots.rbegin(); root != roots.rend(); ++root)
            pending.push_back({*root, glm::dmat4(1)});
        while (!pending.empty()) {
            const Step step = pending.back();
            pending.pop_back();
            const tinygltf::Node& node = model_.nodes[step.node];
            const std::string name = name_of(model_, step.node);
            const glm::dmat4 to_world = step.parent * local_transform(node, name);
            if (!is_finite_in_float(to_world))
                fail({name, " has a transform that becomes too large"});
            visit(node, name, to_world);
            for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
                pending.push_back({static_cast<std::size_t>(*child), to_world});
        }
        return std::move(scene_);
    }

private:
    void visit(const tinygltf::Node& node, const std::string& name, const glm::dmat4& to_world) {
        if (node.mesh != -1)
            add_mesh(node, checked_index(node.mesh, model_.meshes.size(), name, "mesh"), to_world);
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
            auto result = read_primitive(model_, primitive, to_world, part, budget_, warnings_);
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
    Budget budget_;
    Warnings& warnings_;
    SceneDescription scene_;
};

SceneDescription parse(std::span<const unsigned char> file, const std::filesystem::path& folder) {
    Warnings warnings;
    const tinygltf::Model model = load_model(file, folder, warnings);
    std::size_t bytes = file.size();
    for (const tinygltf::Buffer& buffer : model.buffers)
        bytes += buffer.data.size();
    SceneDescription scene = Reader(model, bytes, warnings).read();
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

/// Runs a part of the reader, and puts the file's name before what it complains of.
template <class Part>
auto naming(const std::filesystem::path& path, const Part& part) {
    std::string problem;
    try {
        return part();
    } catch (const std::bad_alloc&) {
        problem = "not enough memory to read it";
    } catch (const std::exception& error) {
        problem = error.what();
    }
    throw std::runtime_error(one_line(path.string()) + ": " + one_line(problem));
}
} // namespace
} // namespace gltf

SceneDescription parse_gltf(std::span<const unsigned char> file, const std::filesystem::path& path) {
    return gltf::naming(path, [&] { return gltf::parse(file, path.parent_path()); });
}

SceneDescription read_gltf(const std::filesystem::path& path) {
    const std::vector<unsigned char> content = gltf::naming(path, [&] { return gltf::file_content(path); });
    return parse_gltf(content, path);
}

} // namespace nephroid::examples
