// SPDX-License-Identifier: MIT
// expect: the scene lacks scatter(hit, direction, sampler) const -> event, weight, eta
#include "messages/renderer.hpp"

struct Wrong {
    std::optional<Hit> intersect(const V&, const V&, float, float) const { return std::nullopt; }
};

int main() { render(Wrong{}); }
