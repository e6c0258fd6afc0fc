// SPDX-License-Identifier: MIT
// expect: the scene's hit lacks `geometric_normal`
#include "messages/renderer.hpp"

struct WrongHit {
    float distance, position_error;
    V normal; // by another name
    nephroid::Flat curvature;
};
struct Wrong {
    std::optional<WrongHit> intersect(const V&, const V&, float, float) const { return std::nullopt; }
    Scattering scatter(const WrongHit&, const V&, auto&) const { return {}; }
};

int main() { render(Wrong{}); }
