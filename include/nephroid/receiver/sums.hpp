// SPDX-License-Identifier: MIT
/// @file  The sums: light of any kind, added up at each eye path vertex.
#pragma once

#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/receiver/sink.hpp"

#include <concepts>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

/// The response of diffuse surfaces, which does not depend on where light comes from. The sums are irradiance; the
/// caller multiplies them by throughput · albedo / π.
struct Irradiance {};

/// Any other response: response(vertex index, direction of the photon's flight) returns a factor for the photon's
/// irradiance, which is the BRDF f_r(x, −ω_p, ω) times the path's throughput. The sums are then radiance. Called
/// from several threads at once.
///
/// ```cpp
/// auto sums = nephroid::sums<Colour>(map, [&](std::size_t vertex, const Vec3& direction) {
///     return vertices[vertex].throughput * brdf(vertices[vertex], -direction);
/// });
/// ```
template <class R, class V, class F>
concept Response = std::same_as<R, Irradiance> ||
    requires(const R response, std::size_t vertex, const V& direction, const F& flux) {
    { (flux * response(vertex, direction)) } -> std::convertible_to<F>;
};

namespace detail {
template <class R, class V, class F>
consteval bool explain_response() {
    static_assert(Response<R, V, F>,
                  "nephroid: the response cannot be called as response(std::size_t vertex, const V& direction) const "
                  "-> a factor that the flux can be multiplied by (receiver/sums.hpp)");
    return false;
}

template <class R, class V, class F>
concept MustRespond = Response<R, V, F> || explain_response<R, V, F>();
} // namespace detail

/// The sums of light at the vertices of an eye path map. Every kind of light can be added to the same sums, any number
/// of times. Made by `nephroid::sums`. Memory: one F for each slot of the map's tree.
///
/// @tparam V  vector
/// @tparam F  flux; the sums are F per world unit squared (times the response)
/// @tparam R  Irradiance, or another Response
template <class V, class F, class R = Irradiance>
    requires(detail::MustBeFluxFor<F, V>&& detail::MustRespond<R, V, F>)
class Sums {
public:
    using vector = V;
    using flux_type = F;

    /// @param map  kept by reference; must outlive the sums
    explicit Sums(const EyePathMap<V>& map, R response = {}) : map_(&map), response_(std::move(response)) { clear(); }
    explicit Sums(const EyePathMap<V>&&, R = {}) = delete; // would refer to a temporary

    [[nodiscard]] const EyePathMap<V>& map() const { return *map_; }
    [[nodiscard]] const R& response() const { return response_; }

    /// Sets all sums to zero.
    void clear() { by_slot_.assign(map_->tree().slots(), flux_traits<F>::zero()); }

    /// Calls sink(vertex index, sum) once for every vertex, in the map's order, with the irradiance (or radiance) of
    /// all light since the last `clear`.
    template <class S>
        requires detail::MustBeSink<std::remove_reference_t<S>, F>
    void for_each(S&& sink) const {
        for (const TreeLeaf& leaf : map_->tree().leaves())
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                sink(std::size_t(map_->tree().index(slot)), by_slot_[slot]);
    }

    /// The sums at the vertices of one leaf of the map's tree, to add light to. Slot i of the tree is at i −
    /// leaf.first. After the last vertex the leaf is padded to whole lanes (`PointTree::lanes`); what is added there is
    /// never read. Different threads may add to different leaves.
    [[nodiscard]] std::span<F> of_leaf(std::uint32_t leaf) { return {by_slot_.data() + first(leaf), size(leaf)}; }
    [[nodiscard]] std::span<const F> of_leaf(std::uint32_t leaf) const {
        return {by_slot_.data() + first(leaf), size(leaf)};
    }

private:
    [[nodiscard]] std::size_t first(std::uint32_t leaf) const { return map_->tree().leaves()[leaf].first; }
    [[nodiscard]] std::size_t size(std::uint32_t leaf) const { return map_->tree().leaves()[leaf].size; }

    const EyePathMap<V>* map_;
    [[no_unique_address]] R response_;
    std::vector<F> by_slot_;
};

/// Sums of irradiance (or, with a response, of radiance) at the vertices of a map, all zero.
///
/// ```cpp
/// auto sums = nephroid::sums<float>(map);
/// nephroid::caustics(scene, light, sums, {.count = 100'000});
/// sums.for_each([&](std::size_t vertex, float irradiance) { film[vertices[vertex].pixel] += irradiance; });
/// ```
///
/// @tparam F   the light's flux type
/// @param map  kept by reference; must outlive the sums
template <class F, class V, class R = Irradiance>
[[nodiscard]] Sums<V, F, R> sums(const EyePathMap<V>& map, R response = {}) {
    return Sums<V, F, R>(map, std::move(response));
}
template <class F, class V, class R = Irradiance>
Sums<V, F, R> sums(const EyePathMap<V>&& map, R response = {}) = delete; // would refer to a temporary

} // namespace nephroid
