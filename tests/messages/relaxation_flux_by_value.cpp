// SPDX-License-Identifier: MIT
// expect: the access's flux must return a reference to the photon's flux
#include "messages/photons.hpp"

int main() {
    const auto copies = nephroid::photon_access(&Photon::position, &Photon::normal, [](Photon& p) { return p.flux; });
    nephroid::relax(photons, copies, {});
}
