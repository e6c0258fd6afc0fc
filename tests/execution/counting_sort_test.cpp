// SPDX-License-Identifier: MIT
#include "nephroid/execution/counting_sort.hpp"
#include "nephroid/execution/executor.hpp"
#include "nephroid/execution/thread_executor.hpp"

#include "support/space.hpp"

#include <doctest/doctest.h>

#include <algorithm>

namespace nephroid::tests::counting_sort_test {

namespace {

struct Item {
    std::size_t key, number;

    friend bool operator==(const Item&, const Item&) = default;
};

std::vector<Item> random_items(std::size_t count, std::size_t keys, std::uint32_t seed) {
    tests::Draws draw(seed);
    std::vector<Item> items;
    for (std::size_t i = 0; i < count; ++i)
        items.push_back({std::min(keys - 1, std::size_t(draw.in(0, double(keys)))), i});
    return items;
}

template <class E>
void sort(detail::CountingSort<Item>& order, const std::vector<Item>& items, std::size_t keys, std::size_t parts,
          E&& executor) {
    const auto for_each = [&](std::size_t part, const auto& use) {
        for (std::size_t i = part * items.size() / parts; i < (part + 1) * items.size() / parts; ++i)
            use(items[i]);
    };
    order.start(parts, keys);
    executor(parts, [&](std::size_t part) { for_each(part, [&](const Item& i) { order.count(part, i.key); }); });
    order.make_room();
    executor(parts, [&](std::size_t part) { for_each(part, [&](const Item& i) { order.put(part, i.key, i); }); });
}

std::vector<Item> sorted_by_std(std::vector<Item> items) {
    std::stable_sort(items.begin(), items.end(), [](const Item& a, const Item& b) { return a.key < b.key; });
    return items;
}

} // namespace

TEST_CASE("counting sort: is a stable sort for any number of parts and threads") {
    const auto items = random_items(5000, 37, 1);
    const auto expected = sorted_by_std(items);
    ThreadExecutor threads(3);
    for (const std::size_t parts : {1u, 2u, 16u, 999u}) {
        detail::CountingSort<Item> order;
        sort(order, items, 37, parts, SerialExecutor{});
        CHECK(std::equal(expected.begin(), expected.end(), order.items().begin(), order.items().end()));
        sort(order, items, 37, parts, threads);
        CHECK(std::equal(expected.begin(), expected.end(), order.items().begin(), order.items().end()));
    }
}

TEST_CASE("counting sort: a key's items are those with the key in their order") {
    const auto items = random_items(300, 50, 2); // of most keys a few, of some none
    detail::CountingSort<Item> order;
    sort(order, items, 60, 4, SerialExecutor{});
    std::size_t together = 0;
    for (std::size_t key = 0; key < 60; ++key) {
        std::vector<Item> expected;
        std::copy_if(items.begin(), items.end(), std::back_inserter(expected),
                     [&](const Item& item) { return item.key == key; });
        const auto found = std::as_const(order).items_of(key);
        CHECK(std::equal(expected.begin(), expected.end(), found.begin(), found.end()));
        together += found.size();
    }
    CHECK(together == 300);
}

TEST_CASE("counting sort: sorts again, larger, smaller and nothing") {
    detail::CountingSort<Item> order;
    for (const std::size_t count : {100u, 1000u, 10u, 0u}) {
        const auto items = random_items(count, 8, std::uint32_t(count));
        sort(order, items, 8, 3, SerialExecutor{});
        const auto expected = sorted_by_std(items);
        CHECK(std::equal(expected.begin(), expected.end(), order.items().begin(), order.items().end()));
    }
    order.start(0, 8);
    order.make_room();
    CHECK(order.items().empty());
    CHECK(order.items_of(7).empty());
}

} // namespace nephroid::tests::counting_sort_test
