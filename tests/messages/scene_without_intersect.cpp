// SPDX-License-Identifier: MIT
// expect: the scene lacks intersect(origin, direction, t_min, t_max) const
#include "messages/renderer.hpp"

struct Wrong {
    Scattering scatter(const Hit&, const V&, auto&) const { return {}; }
};

int main() { render(Wrong{}); }
