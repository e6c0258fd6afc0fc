// SPDX-License-Identifier: MIT
// expect: the photons are no random-access range
#include "messages/photons.hpp"

int main() {
    std::list<Photon> list;
    nephroid::relax(list, access_to_photons, {});
}
