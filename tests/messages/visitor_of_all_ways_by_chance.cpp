// SPDX-License-Identifier: MIT
// expect: the scene lacks scatter_all(hit, direction) const, with a third parameter for the medium if scatter has one
#include "messages/renderer.hpp"

struct Wrong {
    static constexpr bool follows_all_ways = true;
    void deposit(const nephroid::Deposit<V, float>&, const nephroid::WalkedPath<>&) {}
};

int main() {
    const nephroid::HaltonSequence sequence;
    nephroid::Sampler<nephroid::HaltonSequence> sampler(sequence, 0);
    nephroid::Statistics account;
    Wrong visitor;
    (void)nephroid::walk(Scene{}, sun.emit(sampler, nephroid::Spread<float>{1, 1}), sampler, {}, account, visitor);
}
