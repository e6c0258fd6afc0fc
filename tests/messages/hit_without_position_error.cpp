// SPDX-License-Identifier: MIT
// expect: the scene's hit lacks `position_error`, or the scene spawn(hit, direction) const
#include "messages/renderer.hpp"

struct WrongHit {
    float distance;
    V geometric_normal;
    nephroid::Flat curvature;
};
struct Wrong {
    std::optional<WrongHit> intersect(const V&, const V&, float, float) const { return std::nullopt; }
    Scattering scatter(const WrongHit&, const V&, auto&) const { return {}; }
};

int main() { render(Wrong{}); }
