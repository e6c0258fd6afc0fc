// SPDX-License-Identifier: MIT
/// @file  Reads the files of `gltf_writer.hpp` and checks the reader's error messages.
#pragma once

#include "common/gltf.hpp"
#include "support/gltf_writer.hpp"

#include <doctest/doctest.h>
#include <glm/vec3.hpp>

#include <algorithm>
#include <filesystem>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace nephroid::tests {

using examples::SceneDescription;

inline SceneDescription parse(const std::string& bytes, const std::filesystem::path& path = "test.glb") {
    return examples::parse_gltf({reinterpret_cast<const unsigned char*>(bytes.data()), bytes.size()}, path);
}

inline SceneDescription parse(const GltfFile& file) { return parse(file.glb()); }

/// The reader's error message; empty if it reads the file. Any exception but a std::runtime_error passes through.
inline std::string problem_of(const std::string& bytes) {
    try {
        static_cast<void>(parse(bytes));
    } catch (const std::runtime_error& error) {
        return error.what();
    }
    return "";
}

inline std::string problem_of(const GltfFile& file) { return problem_of(file.glb()); }

inline bool contains(std::string_view text, std::string_view part) { return text.find(part) != std::string_view::npos; }

/// Whether the message is one line that begins with the file's name and contains the part.
inline void check_problem(const std::string& problem, std::string_view part) {
    CAPTURE(problem);
    CAPTURE(part);
    CHECK(problem.rfind("test.glb: ", 0) == 0);
    CHECK(contains(problem, part));
    CHECK_FALSE(contains(problem, "\n"));
}

inline bool warns(const SceneDescription& scene, std::string_view part) {
    return std::any_of(scene.warnings.begin(), scene.warnings.end(),
                       [&](const std::string& line) { return contains(line, part); });
}

/// A file of one mesh, shown by one node with the properties given, each with a comma in front.
inline GltfFile file_with(const TestMesh& mesh, const std::string& node = "") {
    GltfFile file;
    file.add_node(R"({"mesh":)" + std::to_string(add_mesh(file, mesh, "shape")) + node + "}");
    return file;
}

/// A file of one primitive, as JSON without the braces, over positions that are accessor 0.
inline GltfFile file_with_primitive(const std::vector<glm::vec3>& positions, const std::string& more = "") {
    GltfFile file;
    file.add_vectors(positions);
    file.add_mesh(R"({"attributes":{"POSITION":0})" + more + "}");
    file.add_node(R"({"mesh":0})");
    return file;
}

/// Four vertices: a strip of two triangles, but no list of triangles.
inline const std::vector<glm::vec3> four_points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}};

} // namespace nephroid::tests
