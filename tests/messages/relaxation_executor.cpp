// SPDX-License-Identifier: MIT
// expect: the executor cannot be called as executor(count, task)
#include "messages/photons.hpp"

int main() { nephroid::relax(photons, access_to_photons, {}, 4); }
