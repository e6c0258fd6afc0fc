// SPDX-License-Identifier: MIT
/// @file  A stable counting sort for several threads. Its result does not depend on which thread does what.
#pragma once

#include "nephroid/vector/language.hpp"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

namespace nephroid::detail {

/// Sorts items by a small key. Items with the same key stay in the order of their parts, and within a part in the order
/// of the calls of `put`. Keeps its memory from one sort to the next.
///
/// The caller goes over the items twice, part by part, on as many threads as it likes:
///
/// ```cpp
/// sort.start(parts, keys);
/// executor(parts, [&](std::size_t part) { for (item of part) sort.count(part, key(item)); });
/// sort.make_room();
/// executor(parts, [&](std::size_t part) { for (item of part) sort.put(part, key(item), item); });
/// ```
///
/// @tparam Item  default constructible
template <class Item>
class CountingSort {
public:
    /// @param parts  ranges of the items, each counted and put by one thread at a time
    /// @param keys   every key is below this
    void start(std::size_t parts, std::size_t keys) {
        keys_ = keys;
        next_.assign(parts * keys, 0);
    }

    void count(std::size_t part, std::size_t key) { ++next_[part * keys_ + key]; }

    /// Called after all items are counted, and before the first `put`.
    void make_room() {
        begin_.resize(keys_ + 1);
        std::size_t sum = 0;
        for (std::size_t key = 0; key < keys_; ++key) {
            begin_[key] = sum;
            for (std::size_t next = key; next < next_.size(); next += keys_)
                sum += std::exchange(next_[next], sum);
        }
        begin_[keys_] = sum;
        items_.resize(sum);
    }

    /// Puts an item in its place. There must be as many items of each part and key as were counted, in any order.
    void put(std::size_t part, std::size_t key, const Item& item) { items_[next_[part * keys_ + key]++] = item; }

    /// All items, sorted.
    [[nodiscard]] std::span<Item> items() { return {items_.data(), items_.size()}; }
    [[nodiscard]] std::span<const Item> items() const { return {items_.data(), items_.size()}; }
    /// The items with a key.
    [[nodiscard]] std::span<Item> items_of(std::size_t key) { return {items_.data() + begin_[key], size_of(key)}; }
    [[nodiscard]] std::span<const Item> items_of(std::size_t key) const {
        return {items_.data() + begin_[key], size_of(key)};
    }

private:
    [[nodiscard]] std::size_t size_of(std::size_t key) const { return begin_[key + 1] - begin_[key]; }

    std::size_t keys_ = 0;
    std::vector<std::size_t> next_;  ///< by part, then key: how many items, then where the next one goes
    std::vector<std::size_t> begin_; ///< by key, and the end
    std::vector<Item> items_;
};

} // namespace nephroid::detail
