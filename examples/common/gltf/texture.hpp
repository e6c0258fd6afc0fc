// SPDX-License-Identifier: MIT
/// @file  The textures of a glTF file, decoded when a material uses them.
#pragma once

#include "common/gltf/report.hpp"
#include "common/gltf/tinygltf.hpp"
#include "common/texture.hpp"

#include <cstddef>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace nephroid::examples::gltf {

/// Reads each texture once. If an image cannot be read, a warning says why, and the material does without it.
class TextureReader {
public:
    /// The model, the budget and the warnings are kept by reference.
    ///
    /// @param folder  of the file, where images are looked for
    TextureReader(const tinygltf::Model& model, std::filesystem::path folder, Budget& budget, Warnings& warnings)
        : model_(model), folder_(std::move(folder)), budget_(budget), warnings_(warnings) {}

    /// Fails for an index out of bounds, and for a KHR_texture_transform that is not made of numbers.
    ///
    /// @param texture     its index as the file has it, or -1 for none
    /// @param set         of texture coordinates, as the file has it
    /// @param extensions  of the reference
    /// @param owner       of the reference, for messages
    [[nodiscard]] std::optional<TextureReference>
    reference(int texture, int set, const tinygltf::ExtensionMap& extensions, const std::string& owner);

    [[nodiscard]] std::vector<std::shared_ptr<const Texture>> take() { return std::move(textures_); }

private:
    [[nodiscard]] std::optional<std::size_t> number_of(int texture, const std::string& owner);
    [[nodiscard]] std::shared_ptr<const Texture> read(const tinygltf::Texture& texture, const std::string& name);
    void read_sampler(Texture& texture, int sampler, const std::string& name);

    const tinygltf::Model& model_;
    std::filesystem::path folder_;
    Budget& budget_;
    Warnings& warnings_;
    std::map<int, std::optional<std::size_t>> numbers_; ///< into `textures_`, by the file's index
    std::vector<std::shared_ptr<const Texture>> textures_;
    std::set<std::filesystem::path> image_files_; ///< that the budget has grown by
};

} // namespace nephroid::examples::gltf
