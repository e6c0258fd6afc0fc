// SPDX-License-Identifier: MIT
// expect: nephroid: a volume must have a member overlaps(const Box<T>& box) const -> bool
#include "messages/renderer.hpp"

struct Ball {
    V centre;
    float radius;
};

int main() {
    map.visit_leaves(Ball{}, [](std::uint32_t) {});
}
