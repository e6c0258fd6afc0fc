// SPDX-License-Identifier: MIT
// expect: the light lacks emit(samples, spread) const -> Photon<vector, flux_type>
#include "messages/renderer.hpp"

struct Wrong {
    using vector = V;
    using flux_type = float;
    double power() const { return 1; }
};

int main() { render(Scene{}, Wrong{}); }
