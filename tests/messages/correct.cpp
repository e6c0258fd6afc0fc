// SPDX-License-Identifier: MIT
#include "messages/renderer.hpp"

// Nothing is wrong with this one: what the others show is their own mistake.
int main() { render(); }
