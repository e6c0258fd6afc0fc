// SPDX-License-Identifier: MIT
// expect: the sequence lacks `static constexpr bool stratified`
#include "messages/renderer.hpp"

struct Wrong {
    template <class T>
    T sample(std::uint64_t, std::uint32_t) const {
        return T(0);
    }
};

int main() { render(Scene{}, sun, Wrong{}); }
