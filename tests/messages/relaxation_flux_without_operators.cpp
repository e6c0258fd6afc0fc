// SPDX-License-Identifier: MIT
// expect: the flux type lacks a + b or a * b of two fluxes
#include "messages/photons.hpp"

int main() {
    struct Spectrum {};
    struct Coloured {
        glm::vec3 position, normal;
        Spectrum flux;
    };
    std::vector<Coloured> coloured;
    nephroid::relax(coloured, nephroid::photon_access(&Coloured::position, &Coloured::normal, &Coloured::flux), {});
}
