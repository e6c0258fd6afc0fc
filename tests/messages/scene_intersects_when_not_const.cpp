// SPDX-License-Identifier: MIT
// expect: the scene lacks intersect(origin, direction, t_min, t_max) const
#include "messages/renderer.hpp"

struct Wrong : Scene {
    std::optional<Hit> intersect(const V&, const V&, float, float) { return std::nullopt; }
};

int main() { render(Wrong{}); }
