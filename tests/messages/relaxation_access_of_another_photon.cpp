// SPDX-License-Identifier: MIT
// expect: the access's position, normal or flux cannot be called with one of these photons
#include "messages/photons.hpp"

int main() {
    struct Other {
        glm::vec3 position;
    };
    std::vector<Other> others;
    nephroid::relax(others, access_to_photons, {});
}
