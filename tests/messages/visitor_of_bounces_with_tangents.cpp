// SPDX-License-Identifier: MIT
// expect: a visitor that follows bounces walks photons without tangents: emit them from WithoutTangents(light)
#include "messages/renderer.hpp"

struct Wrong {
    static constexpr bool follows_bounces = true;
    void deposit(const nephroid::Deposit<V, float>&, const nephroid::WalkedPath<>&) {}
};

int main() {
    const nephroid::HaltonSequence sequence;
    nephroid::Sampler<nephroid::HaltonSequence> sampler(sequence, 0);
    nephroid::Statistics account;
    Wrong visitor;
    (void)nephroid::walk(Scene{}, sun.emit(sampler, nephroid::Spread<float>{1, 1}), sampler, {}, account, visitor);
}
