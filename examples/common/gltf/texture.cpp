// SPDX-License-Identifier: MIT
#include "common/gltf/texture.hpp"

#include "common/gltf/image_bytes.hpp"
#include "common/gltf/transform.hpp"
#include "common/image/decode.hpp"

#include <array>
#include <cmath>
#include <stdexcept>

namespace nephroid::examples::gltf {
namespace {

/// The numbers of a KHR_texture_transform's property; those given if it is missing.
template <std::size_t N>
std::array<double, N> numbers_in(const tinygltf::Value& transform, const char* name, std::array<double, N> numbers,
                                 const std::string& owner) {
    if (!transform.Has(name))
        return numbers;
    const tinygltf::Value& value = transform.Get(name);
    tinygltf::Value::Array array;
    if (value.IsArray())
        array = value.Get<tinygltf::Value::Array>();
    else if (N == 1)
        array = {value};
    for (std::size_t i = 0; i < N; ++i) {
        if (array.size() != N || !array[i].IsNumber())
            fail({owner, " has a KHR_texture_transform whose ", name, " is not ", std::to_string(N),
                  N == 1 ? " number" : " numbers"});
        numbers[i] = double{to_float(array[i].GetNumberAsDouble(), owner, name)};
    }
    return numbers;
}

/// Source: KHR_texture_transform. The image turns clockwise on the surface, the coordinates counter-clockwise.
void apply_transform(TextureReference& reference, int& set, const tinygltf::Value& transform,
                     const std::string& owner) {
    const auto [offset_u, offset_v] = numbers_in<2>(transform, "offset", {0, 0}, owner);
    const auto [scale_u, scale_v] = numbers_in<2>(transform, "scale", {1, 1}, owner);
    const auto [angle] = numbers_in<1>(transform, "rotation", {0}, owner);
    reference.offset = {offset_u, offset_v};
    reference.column_u = scale_u * glm::dvec2(std::cos(angle), -std::sin(angle));
    reference.column_v = scale_v * glm::dvec2(std::sin(angle), std::cos(angle));
    if (transform.Has("texCoord") && transform.Get("texCoord").IsInt())
        set = transform.Get("texCoord").GetNumberAsInt();
}

/// Charges what decoding an image takes, and at the end gives back all but what the image keeps.
class DecodingMemory {
public:
    DecodingMemory(Budget& budget, std::size_t texels, std::size_t file_bytes)
        : budget_(budget), working_(20 * texels + 3 * file_bytes) {
        constexpr std::size_t each = 24, mebibyte = std::size_t{1} << 20;
        if (!budget.try_to_charge(3 * file_bytes, 1))
            fail({"its image has ", std::to_string(file_bytes / mebibyte), " MiB, ", too_much});
        if (budget.try_to_charge(texels, each))
            return;
        budget.give_back(3 * file_bytes);
        fail({"its image has ", std::to_string(texels), " pixels in ", std::to_string(file_bytes),
              " bytes, and decoding them takes ", std::to_string(texels / (mebibyte / each)), " MiB, ", too_much});
    }
    ~DecodingMemory() { budget_.give_back(working_); }
    DecodingMemory(const DecodingMemory&) = delete;
    DecodingMemory& operator=(const DecodingMemory&) = delete;

private:
    static constexpr const char* too_much = "more than is left of 256 MiB and 256 times the scene's files; make it "
                                            "smaller";
    Budget& budget_;
    std::size_t working_;
};
} // namespace

std::optional<TextureReference> TextureReader::reference(int texture, int set, const tinygltf::ExtensionMap& extensions,
                                                         const std::string& owner) {
    if (texture < 0)
        return std::nullopt;
    TextureReference result;
    if (const auto transform = extensions.find("KHR_texture_transform");
        transform != extensions.end() && transform->second.IsObject())
        apply_transform(result, set, transform->second, owner);
    if (set < 0 || set > 1) {
        warnings_.add(owner + " has a texture with the coordinates TEXCOORD_" + std::to_string(set) +
                      ", which is left out; TEXCOORD_0 and TEXCOORD_1 are read");
        return std::nullopt;
    }
    const std::optional<std::size_t> number = number_of(texture, owner);
    if (!number)
        return std::nullopt;
    result.texture = *number;
    result.set = static_cast<std::size_t>(set);
    return result;
}

std::optional<std::size_t> TextureReader::number_of(int texture, const std::string& owner) {
    const auto [known, is_new] = numbers_.try_emplace(texture);
    if (!is_new)
        return known->second;
    const std::size_t index = checked_index(texture, model_.textures.size(), owner, "texture");
    const std::string name = named("texture", index, model_.textures[index].name);
    try {
        textures_.push_back(read(model_.textures[index], name));
        known->second = textures_.size() - 1;
    } catch (const std::runtime_error& error) {
        warnings_.add(name + " is left out: " + error.what());
    }
    return known->second;
}

std::shared_ptr<const Texture> TextureReader::read(const tinygltf::Texture& texture, const std::string& name) {
    if (texture.source < 0)
        for (const char* extension : {"KHR_texture_basisu", "EXT_texture_webp", "EXT_texture_avif", "MSFT_texture_dds"})
            if (texture.extensions.count(extension) != 0)
                fail({"its image is stored by ", extension, ", which is not read; export PNG or JPEG"});
    if (texture.source < 0)
        fail({"it has no image"});
    const ImageBytes image =
        bytes_of_image(model_, checked_index(texture.source, image_count(model_), "it", "image"), folder_);
    const std::size_t texels = pixels_of_image(image.bytes);
    if (texels == 0)
        fail({"its image", image.name.empty() ? "" : " (" + image.name + ")",
              " is neither PNG nor JPEG, and other images are not read"});
    if (!image.file.empty() && image_files_.insert(image.file).second)
        budget_.grow(image.bytes.size());
    // While it is decoded there are copies of it; after that, four bytes a texel.
    const DecodingMemory memory(budget_, texels, image.bytes.size());
    auto result = std::make_shared<Texture>();
    result->image = decode_image(image.bytes);
    if (texture.sampler >= 0)
        read_sampler(*result, texture.sampler, name);
    return result;
}

void TextureReader::read_sampler(Texture& texture, int index, const std::string& name) {
    const tinygltf::Sampler& sampler = model_.samplers[checked_index(index, model_.samplers.size(), "it", "sampler")];
    const auto wrap_of = [&](int mode, const char* property) {
        switch (mode) {
        case TINYGLTF_TEXTURE_WRAP_REPEAT:
            return Texture::Wrap::repeat;
        case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
            return Texture::Wrap::mirror;
        case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
            return Texture::Wrap::clamp;
        default:
            warnings_.add(name + " has a " + property + " of " + std::to_string(mode) + ", taken for 10497 (repeat)");
            return Texture::Wrap::repeat;
        }
    };
    texture.wrap_u = wrap_of(sampler.wrapS, "wrapS");
    texture.wrap_v = wrap_of(sampler.wrapT, "wrapT");
    texture.takes_nearest = sampler.magFilter == TINYGLTF_TEXTURE_FILTER_NEAREST;
    if (sampler.magFilter != -1 && sampler.magFilter != TINYGLTF_TEXTURE_FILTER_NEAREST &&
        sampler.magFilter != TINYGLTF_TEXTURE_FILTER_LINEAR)
        warnings_.add(name + " has a magFilter of " + std::to_string(sampler.magFilter) + ", taken for 9729 (linear)");
}

} // namespace nephroid::examples::gltf
