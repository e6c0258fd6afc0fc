// SPDX-License-Identifier: MIT
#include "common/gltf/nodes.hpp"

#include "common/gltf/report.hpp"
#include "common/gltf/transform.hpp"

#include <limits>

namespace nephroid::examples::gltf {
namespace {

constexpr std::size_t none = std::numeric_limits<std::size_t>::max();

std::string name_of(const tinygltf::Model& model, std::size_t node) {
    return named("node", node, model.nodes[node].name);
}

/// Every node's parent, or `none`. Fails unless the nodes form trees, as glTF demands, so that every walk ends.
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

} // namespace

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

void for_each_node(const tinygltf::Model& model, const std::vector<std::size_t>& roots, const glm::dmat4& start,
                   const VisitNode& visit) {
    struct Step {
        std::size_t node;
        glm::dmat4 parent;
    };
    std::vector<Step> pending; // a stack of its own: a file can nest nodes deeper than the program's stack is
    for (auto root = roots.rbegin(); root != roots.rend(); ++root)
        pending.push_back({*root, start});
    while (!pending.empty()) {
        const Step step = pending.back();
        pending.pop_back();
        const tinygltf::Node& node = model.nodes[step.node];
        const std::string name = name_of(model, step.node);
        const glm::dmat4 to_world = step.parent * local_transform(node, name);
        if (!is_finite_in_float(to_world))
            fail({name, " has a transform that becomes too large"});
        visit(node, name, to_world);
        for (auto child = node.children.rbegin(); child != node.children.rend(); ++child)
            pending.push_back({static_cast<std::size_t>(*child), to_world});
    }
}

} // namespace nephroid::examples::gltf
