// SPDX-License-Identifier: MIT
// expect: the access's position must return a reference to the photon's position
#include "messages/photons.hpp"

int main() {
    const auto copies = nephroid::photon_access([](Photon& p) { return p.position; }, &Photon::normal, &Photon::flux);
    nephroid::relax(photons, copies, {});
}
