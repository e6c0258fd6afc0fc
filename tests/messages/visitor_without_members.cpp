// SPDX-License-Identifier: MIT
// expect: the visitor has neither flight, nor meet, nor deposit
#include "messages/renderer.hpp"

struct Wrong {
    void deposits(const nephroid::Deposit<V, float>&) {}
};

int main() {
    const nephroid::HaltonSequence sequence;
    nephroid::Sampler<nephroid::HaltonSequence> sampler(sequence, 0);
    nephroid::Statistics account;
    Wrong visitor;
    (void)nephroid::walk(Scene{}, sun.emit(sampler, nephroid::Spread<float>{1, 1}), sampler, {}, account, visitor);
}
