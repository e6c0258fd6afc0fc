// SPDX-License-Identifier: MIT
// expect: the visitor's `flight` must take a const Flight<V, F, N>&
#include "messages/renderer.hpp"

struct Wrong {
    void flight(nephroid::Flight<V, float>&) {}
};

int main() {
    const nephroid::HaltonSequence sequence;
    nephroid::Sampler<nephroid::HaltonSequence> sampler(sequence, 0);
    nephroid::Statistics account;
    Wrong visitor;
    (void)nephroid::walk(Scene{}, sun.emit(sampler, nephroid::Spread<float>{1, 1}), sampler, {}, account, visitor);
}
