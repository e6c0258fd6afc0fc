// SPDX-License-Identifier: MIT
// expect: photons of Spectral and Extended lights are not the same without tangents
#include "messages/spectral.hpp"

#include "nephroid/emission/without_tangents.hpp"

int main() { (void)nephroid::WithoutTangents(spectral_light); }
