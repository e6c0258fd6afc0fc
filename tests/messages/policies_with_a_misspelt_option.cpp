// SPDX-License-Identifier: MIT
// expect any: fitler
#include "messages/renderer.hpp"

const nephroid::Published policies{.fitler = {1.244}};
