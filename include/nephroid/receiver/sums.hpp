// SPDX-License-Identifier: MIT
/// @file  The sums: light of any kind, added up at each eye path vertex.
#pragma once

#include "nephroid/receiver/accumulator.hpp"
#include "nephroid/receiver/eye_path_map.hpp"
#include "nephroid/receiver/response.hpp"
#include "nephroid/receiver/sink.hpp"
#include "nephroid/vector/error.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

/// The sums of light at the vertices of an eye path map. Every kind of light can be added to the same sums, any number
/// of times. Made by `nephroid::sums`. Memory: one F for each slot of the map's tree, or what the accumulator takes.
///
/// @tparam V  vector
/// @tparam F  flux; the sums are F per world unit squared (times the response)
/// @tparam R  Irradiance, or another Response, or one of them InDouble or InWholeNumbers
template <class V, class F, class R = Irradiance>
    requires(detail::MustBeFluxFor<F, V>&& detail::MustRespond<detail::response_within<R>, V, F>)
class Sums {
    using Accumulator = detail::Accumulator<F, R>;

public:
    using vector = V;
    using flux_type = F;
    using response_type = detail::response_within<R>;
    using number = typename Accumulator::number; ///< that a sum is made of: F, double or std::int64_t
    static constexpr std::size_t numbers_per_slot = Accumulator::numbers;
    static constexpr bool is_in_flux = Accumulator::is_flux; ///< whether a sum is an F

    /// @param map  kept by reference; must outlive the sums
    explicit Sums(const EyePathMap<V>& map, R response = {})
        : map_(&map), accumulator_(std::move(response), map.tree().slots(), double(map.diagonal())) {
        clear();
    }
    explicit Sums(const EyePathMap<V>&&, R = {}) = delete; // would refer to a temporary

    [[nodiscard]] const EyePathMap<V>& map() const { return *map_; }
    [[nodiscard]] const response_type& response() const { return accumulator_.response(); }

    /// Sets all sums to zero.
    void clear() { numbers_.assign(map_->tree().slots() * numbers_per_slot, Accumulator::zero()); }

    /// Calls sink(vertex index, sum) once for every vertex, in the map's order, with the irradiance (or radiance) of
    /// all light since the last `clear`.
    template <class S>
        requires detail::MustBeSink<std::remove_reference_t<S>, F>
    void for_each(S&& sink) const {
        for (const TreeLeaf& leaf : map_->tree().leaves())
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                sink(std::size_t(map_->tree().index(slot)), at(slot));
    }

    /// The sum at the vertex of a slot of the map's tree.
    [[nodiscard]] decltype(auto) at(std::size_t slot) const { return accumulator_.value(of_slot(slot)); }

    /// What the vertex of a slot makes of light from a direction.
    [[nodiscard]] F responded(std::size_t slot, const F& light, const V& direction) const {
        if constexpr (std::is_same_v<response_type, Irradiance>)
            return light;
        else
            return light * response()(std::size_t(map_->tree().index(slot)), direction);
    }

    /// Adds light at the vertex of a slot. Different threads may add to different leaves.
    void add(std::size_t slot, const F& more) { accumulator_.add(numbers_.data() + slot * numbers_per_slot, more); }

    /// All sums, in the order of slots, to be written to a file or sent to another rank. Maps of the same vertices have
    /// the same order. The padding after a leaf's last vertex is among them.
    [[nodiscard]] std::span<number> values() { return {numbers_.data(), numbers_.size()}; }
    [[nodiscard]] std::span<const number> values() const { return {numbers_.data(), numbers_.size()}; }

    /// Adds the `values` of other sums, which another rank or a file brought. The receiver must have been made of the
    /// same vertices and the accumulator of the same options. Throws std::invalid_argument for another number of them.
    void add(std::span<const number> others) {
        if (others.size() != numbers_.size())
            invalid_argument("nephroid::Sums::add: " + std::to_string(others.size()) + " values for " +
                             std::to_string(numbers_.size()) + "; both receivers must have the same vertices");
        for (std::size_t i = 0; i < numbers_.size(); ++i)
            Accumulator::merge(numbers_[i], others[i]);
    }

    /// What one of `values` is worth: 1, or the unit of whole numbers. Sums of different units cannot be added.
    [[nodiscard]] double unit() const {
        if constexpr (requires { accumulator_.unit(); })
            return accumulator_.unit();
        else
            return 1;
    }

    /// The number of vertices whose sum has left the range of whole numbers, and reads as the largest of them. Give
    /// InWholeNumbers more power then. Other accumulators have none.
    [[nodiscard]] std::uint64_t overflows() const {
        std::uint64_t count = 0;
        if constexpr (requires { accumulator_.has_overflowed(numbers_.data()); })
            for (const TreeLeaf& leaf : map_->tree().leaves())
                for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                    count += accumulator_.has_overflowed(of_slot(slot));
        return count;
    }

    /// The sums at the vertices of one leaf of the map's tree, to add light to. Slot i of the tree is at i −
    /// leaf.first. After the last vertex the leaf is padded to whole lanes (`PointTree::lanes`); what is added there is
    /// never read. Different threads may add to different leaves.
    [[nodiscard]] std::span<F> of_leaf(std::uint32_t leaf) requires(is_in_flux) {
        return {numbers_.data() + first(leaf), size(leaf)};
    }
    [[nodiscard]] std::span<const F> of_leaf(std::uint32_t leaf) const requires(is_in_flux) {
        return {numbers_.data() + first(leaf), size(leaf)};
    }

private:
    [[nodiscard]] const number* of_slot(std::size_t slot) const { return numbers_.data() + slot * numbers_per_slot; }
    [[nodiscard]] std::size_t first(std::uint32_t leaf) const { return map_->tree().leaves()[leaf].first; }
    [[nodiscard]] std::size_t size(std::uint32_t leaf) const { return map_->tree().leaves()[leaf].size; }

    const EyePathMap<V>* map_;
    [[no_unique_address]] Accumulator accumulator_;
    std::vector<number> numbers_;
};

/// Sums of irradiance (or, with a response, of radiance) at the vertices of a map, all zero.
///
/// ```cpp
/// auto sums = nephroid::sums<float>(map);
/// nephroid::caustics(scene, light, sums, {.count = 100'000});
/// sums.for_each([&](std::size_t vertex, float irradiance) { film[vertices[vertex].pixel] += irradiance; });
/// ```
///
/// @tparam F   the light's flux type. What the sums are made of is F as well, so that their last bits depend on the
///             order of photons; `sums<F>(map, InWholeNumbers(watts))` does not (receiver/accumulator.hpp)
/// @param map  kept by reference; must outlive the sums
template <class F, class V, class R = Irradiance>
[[nodiscard]] Sums<V, F, R> sums(const EyePathMap<V>& map, R response = {}) {
    return Sums<V, F, R>(map, std::move(response));
}
template <class F, class V, class R = Irradiance>
Sums<V, F, R> sums(const EyePathMap<V>&& map, R response = {}) = delete; // would refer to a temporary

} // namespace nephroid
