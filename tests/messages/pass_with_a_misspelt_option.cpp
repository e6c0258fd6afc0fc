// SPDX-License-Identifier: MIT
// expect any: cuont
#include "messages/renderer.hpp"

const nephroid::PhotonPass pass{.cuont = 1}; // in the call itself, compilers say no more than that it does not fit
