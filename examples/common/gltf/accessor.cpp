// SPDX-License-Identifier: MIT
#include "common/gltf/accessor.hpp"

#include "common/gltf/report.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <string>

namespace nephroid::examples::gltf {
namespace {

/// Bytes of a component; 0 for a type that glTF does not have.
std::size_t component_size(int type) {
    switch (type) {
    case TINYGLTF_COMPONENT_TYPE_BYTE:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE:
        return 1;
    case TINYGLTF_COMPONENT_TYPE_SHORT:
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT:
        return 2;
    case TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT:
    case TINYGLTF_COMPONENT_TYPE_FLOAT:
        return 4;
    default:
        return 0;
    }
}

bool is_index_type(int type) {
    return type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT ||
           type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT;
}

/// Little-endian, as glTF is, on any machine and at any alignment.
std::uint32_t unsigned_at(const unsigned char* bytes, std::size_t size) {
    std::uint32_t value = 0;
    for (std::size_t i = size; i-- > 0;)
        value = value << 8 | bytes[i];
    return value;
}

/// Source: glTF 2.0, section 3.11 for normalized integers.
float component_at(const unsigned char* bytes, int type, bool normalized) {
    const std::size_t size = component_size(type);
    const std::uint32_t bits = unsigned_at(bytes, size);
    if (type == TINYGLTF_COMPONENT_TYPE_FLOAT)
        return std::bit_cast<float>(bits);

    const auto bit_count = static_cast<unsigned>(8 * size);
    if (type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_BYTE || type == TINYGLTF_COMPONENT_TYPE_UNSIGNED_SHORT) {
        const auto value = static_cast<float>(bits);
        return normalized ? value / static_cast<float>((1u << bit_count) - 1) : value;
    }
    const std::int32_t whole =
        size == 1 ? std::int32_t{static_cast<std::int8_t>(bits)} : std::int32_t{static_cast<std::int16_t>(bits)};
    const auto value = static_cast<float>(whole);
    return normalized ? (std::max)(value / static_cast<float>((1u << (bit_count - 1)) - 1), -1.f) : value;
}

struct Bytes {
    const unsigned char* data;
    std::size_t size;
};

Bytes buffer_view(const tinygltf::Model& model, int index, std::string_view owner) {
    const std::size_t i = checked_index(index, model.bufferViews.size(), owner, "buffer view");
    const tinygltf::BufferView& view = model.bufferViews[i];
    const std::string name = named("buffer view", i, view.name);
    const auto& data = model.buffers[checked_index(view.buffer, model.buffers.size(), name, "buffer")].data;
    if (view.byteOffset > data.size() || view.byteLength > data.size() - view.byteOffset)
        fail({name, " goes beyond its buffer: ", std::to_string(view.byteLength), " bytes from byte ",
              std::to_string(view.byteOffset), ", of ", std::to_string(data.size())});
    return {data.data() + view.byteOffset, view.byteLength};
}

/// The elements' first byte, once they are known to lie within the buffer view.
///
/// @param count  >= 1; @param offset  as the file has it, perhaps negative
const unsigned char* elements(const tinygltf::Model& model, int view, long long offset, std::size_t count,
                              std::size_t stride, std::size_t size, const std::string& name) {
    const Bytes bytes = buffer_view(model, view, name);
    const auto start = static_cast<std::size_t>(offset);
    const bool fits = offset >= 0 && start <= bytes.size && size <= bytes.size - start &&
                      count - 1 <= (bytes.size - start - size) / stride;
    if (!fits)
        fail({name, " goes beyond its buffer view: ", std::to_string(count), " elements, ", std::to_string(stride),
              " bytes apart, from byte ", std::to_string(offset), ", of ", std::to_string(bytes.size)});
    return bytes.data + start;
}

struct Sparse {
    std::size_t count;
    std::size_t index_size;
    const unsigned char* indices;
    const unsigned char* values; ///< tightly packed

    [[nodiscard]] std::size_t index(std::size_t i) const { return unsigned_at(indices + i * index_size, index_size); }
};

Sparse sparse_part(const tinygltf::Model& model, const tinygltf::Accessor& accessor, std::size_t element_size,
                   const std::string& name) {
    const auto& sparse = accessor.sparse;
    if (sparse.count < 1 || static_cast<std::size_t>(sparse.count) > accessor.count)
        fail({name, " of ", std::to_string(accessor.count), " elements replaces ", std::to_string(sparse.count)});
    if (!is_index_type(sparse.indices.componentType))
        fail({name, " has sparse indices of the type ", std::to_string(sparse.indices.componentType)});

    const auto count = static_cast<std::size_t>(sparse.count);
    const std::size_t size = component_size(sparse.indices.componentType);
    const auto indices_offset = static_cast<long long>(sparse.indices.byteOffset);
    const auto values_offset = static_cast<long long>(sparse.values.byteOffset);
    return {count, size, elements(model, sparse.indices.bufferView, indices_offset, count, size, size, name),
            elements(model, sparse.values.bufferView, values_offset, count, element_size, element_size, name)};
}

/// @param components  of an element, 1 to 4
AccessorView view_accessor(const tinygltf::Model& model, int index, int components, std::string_view owner) {
    AccessorView view;
    view.index = checked_index(index, model.accessors.size(), owner, "accessor");
    view.accessor = &model.accessors[view.index];
    const tinygltf::Accessor& accessor = *view.accessor;
    const std::string name = named("accessor", view.index, accessor.name);
    const int type = components == 1 ? TINYGLTF_TYPE_SCALAR : components; // VEC2 to VEC4 are 2 to 4
    const std::size_t size = static_cast<std::size_t>(components) * component_size(accessor.componentType);
    if (accessor.type != type || size == 0)
        fail({owner, " wants ", components == 1 ? "SCALAR" : "VEC" + std::to_string(components), " elements, which ",
              name, " does not have"});
    view.count = accessor.count;
    if (view.count == 0)
        fail({name, " has no elements"});

    if (accessor.bufferView >= 0) {
        const std::size_t i = checked_index(accessor.bufferView, model.bufferViews.size(), name, "buffer view");
        const std::size_t stride = model.bufferViews[i].byteStride;
        view.stride = stride == 0 ? size : stride;
        if (view.stride < size)
            fail({name, " has elements of ", std::to_string(size), " bytes, ", std::to_string(stride), " apart"});
        const long long offset = accessor.byteOffset > static_cast<std::size_t>(std::numeric_limits<long long>::max())
                                     ? -1
                                     : static_cast<long long>(accessor.byteOffset);
        view.data = elements(model, accessor.bufferView, offset, view.count, view.stride, size, name);
    }
    if (accessor.sparse.isSparse) {
        const Sparse sparse = sparse_part(model, accessor, size, name);
        for (std::size_t i = 0; i < sparse.count; ++i)
            if (sparse.index(i) >= view.count)
                fail({name, " of ", std::to_string(view.count), " elements replaces number ",
                      std::to_string(sparse.index(i))});
    }
    return view;
}

/// Every element, decoded by `decode(first byte)`; zero where there is no buffer view.
template <class Element, class Decode>
std::vector<Element> read(const tinygltf::Model& model, const AccessorView& view, std::size_t size,
                          const Decode& decode) {
    std::vector<Element> result(view.count, Element{0});
    if (view.data != nullptr)
        for (std::size_t i = 0; i < view.count; ++i)
            result[i] = decode(view.data + i * view.stride);
    if (view.accessor->sparse.isSparse) {
        const Sparse sparse = sparse_part(model, *view.accessor, size, named("accessor", view.index, ""));
        for (std::size_t i = 0; i < sparse.count; ++i)
            result[sparse.index(i)] = decode(sparse.values + i * size);
    }
    return result;
}

template <int Components>
std::vector<glm::vec<Components, float>> read_floats(const tinygltf::Model& model, const AccessorView& view) {
    using Vector = glm::vec<Components, float>;
    const int type = view.accessor->componentType;
    const bool normalized = view.accessor->normalized;
    const std::size_t step = component_size(type);
    return read<Vector>(model, view, Components * step, [=](const unsigned char* at) {
        Vector result(0);
        for (int i = 0; i < Components; ++i)
            result[i] = component_at(at + static_cast<std::size_t>(i) * step, type, normalized);
        return result;
    });
}
} // namespace

std::vector<unsigned char> bytes_of_view(const tinygltf::Model& model, int index, std::string_view owner) {
    const Bytes bytes = buffer_view(model, index, owner);
    return {bytes.data, bytes.data + bytes.size};
}

AccessorView view_vectors(const tinygltf::Model& model, int index, std::string_view owner, int components) {
    const AccessorView view = view_accessor(model, index, components, owner);
    if (view.accessor->componentType == TINYGLTF_COMPONENT_TYPE_UNSIGNED_INT)
        fail(
            {named("accessor", view.index, view.accessor->name), " has vectors of 32-bit integers, not legal in glTF"});
    return view;
}

AccessorView view_indices(const tinygltf::Model& model, int index, std::string_view owner) {
    const AccessorView view = view_accessor(model, index, 1, owner);
    if (!is_index_type(view.accessor->componentType))
        fail({named("accessor", view.index, view.accessor->name), " has indices that are not unsigned integers"});
    return view;
}

std::vector<glm::vec3> read_vectors(const tinygltf::Model& model, const AccessorView& view) {
    return read_floats<3>(model, view);
}

std::vector<glm::vec2> read_pairs(const tinygltf::Model& model, const AccessorView& view) {
    return read_floats<2>(model, view);
}

std::vector<glm::vec4> read_quadruples(const tinygltf::Model& model, const AccessorView& view) {
    return read_floats<4>(model, view);
}

std::vector<std::uint32_t> read_indices(const tinygltf::Model& model, const AccessorView& view) {
    const std::size_t size = component_size(view.accessor->componentType);
    return read<std::uint32_t>(model, view, size, [=](const unsigned char* at) { return unsigned_at(at, size); });
}

} // namespace nephroid::examples::gltf
