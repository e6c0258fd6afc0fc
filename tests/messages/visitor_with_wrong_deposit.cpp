// SPDX-License-Identifier: MIT
// expect: the visitor's `deposit` must take (const Deposit<V, F, N>&, const WalkedPath<trail>&)
#include "messages/renderer.hpp"

struct Wrong {
    void deposit(const nephroid::Deposit<V, float>&) {}
};

int main() {
    const nephroid::HaltonSequence sequence;
    nephroid::Sampler<nephroid::HaltonSequence> sampler(sequence, 0);
    nephroid::Statistics account;
    Wrong visitor;
    (void)nephroid::walk(Scene{}, sun.emit(sampler, nephroid::Spread<float>{1, 1}), sampler, {}, account, visitor);
}
