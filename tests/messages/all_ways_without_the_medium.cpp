// SPDX-License-Identifier: MIT
// expect: the scene's scatter takes the medium, but its scatter_all does not
#include "messages/renderer.hpp"

#include "nephroid/transport/media.hpp"

struct Wrong : Scene {
    using medium = nephroid::Media;
    Scattering scatter(const Hit&, const V&, auto&, const medium&) const { return {}; }
    nephroid::Ways<Scattering> scatter_all(const Hit&, const V&) const { return {}; }
    float transmittance(const medium&, float) const { return 1; }
};

struct AllWays {
    static constexpr bool follows_all_ways = true;
    void deposit(const nephroid::Deposit<V, float>&, const nephroid::WalkedPath<>&) {}
};

int main() {
    const nephroid::HaltonSequence sequence;
    nephroid::Sampler<nephroid::HaltonSequence> sampler(sequence, 0);
    nephroid::Statistics account;
    AllWays visitor;
    (void)nephroid::walk(Wrong{}, sun.emit(sampler, nephroid::Spread<float>{1, 1}), sampler, {}, account, visitor);
}
