// SPDX-License-Identifier: MIT
// expect: the photons are const, and relaxation writes their positions
#include "messages/photons.hpp"

int main() {
    const std::vector<Photon> kept;
    nephroid::relax(kept, access_to_photons, {});
}
