// SPDX-License-Identifier: MIT
// expect: the photons of all lights of one set need the same number of tangents
#include "messages/renderer.hpp"

#include "nephroid/emission/light_set.hpp"

struct Spectral {
    using vector = V;
    using flux_type = float;
    nephroid::Photon<V, float, 3> emit(auto&, const nephroid::Spread<float>&) const {
        return {V(0), V(0, 0, -1), 1, {}};
    }
    double power() const { return 1; }
};

int main() { (void)sizeof(nephroid::LightSet<nephroid::DirectionalLight<V, float>, Spectral>); }
