// SPDX-License-Identifier: MIT
/// @file  How far the photons' tangents are from the truth on hard cases, with your compiler and your flags: paths of
///        one to six reflections and refractions against differences in quadruple precision, in float and in double.
#include "numerics/group_table.hpp"

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <vector>

namespace {

using namespace nephroid::tests::numerics;

constexpr double bar = 100, limit = 1000; // units: 99.9% of cases within the first, none above the second

struct Worst {
    Measured measured;
    Group group;
    const char* precision;
};

template <class T>
bool print_table(const char* precision, std::size_t count, std::vector<Worst>& worst) {
    std::printf("%-28s%7s%11s%11s%11s%10s%10s%8s%10s\n", precision, "cases", "error", "largest", "condition", "units",
                "largest", "lost", "ill-posed");
    bool good = true;
    for (std::size_t g = 0; g < group_names.size(); ++g) {
        const Row row = measure<T>(Group(g), count);
        std::size_t above = 0;
        for (const Measured& m : row.cases) {
            above += !(m.units <= bar);
            worst.push_back({m, row.group, precision});
        }
        good = good && row.lost == 0 && row.not_finite == 0 && 1000 * above <= row.cases.size() &&
               row.largest(&Measured::units) <= limit;
        std::printf("%-28s%7zu%11.1e%11.1e%11.1e%10.2f%10.1f%8zu%10zu%s\n", group_names[g], row.cases.size(),
                    row.median(&Measured::relative_error), row.largest(&Measured::relative_error),
                    row.median(&Measured::condition), row.median(&Measured::units), row.largest(&Measured::units),
                    row.lost, row.ill_posed, row.not_finite > 0 ? "  NOT FINITE" : "");
        std::fflush(stdout);
    }
    std::printf("\n");
    return good;
}

void print_worst(std::vector<Worst>& all) {
    constexpr std::size_t shown = 10;
    const std::size_t count = (std::min)(shown, all.size());
    std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(count), all.end(),
                      [](const Worst& a, const Worst& b) { return !(a.measured.units <= b.measured.units); });
    std::printf("the worst\n");
    for (std::size_t i = 0; i < count; ++i) {
        const Measured& m = all[i].measured;
        std::printf("%8.1f  %-7s%-28s%-12s error %.1e, condition %.1e:", m.units, all[i].precision,
                    group_names[std::size_t(all[i].group)], m.what, m.relative_error, m.condition);
        for (const auto& s : m.chain.surfaces)
            std::printf(" %s%s", kind_names[std::size_t(s.kind)],
                        &s == &m.chain.surfaces.back() ? ""
                        : s.refracts                   ? " >"
                                                       : " <");
        std::printf("\n");
    }
}

} // namespace

int main(int argc, char** argv) {
    std::size_t count = 250;
    if (argc == 2 && std::strcmp(argv[1], "--help") != 0)
        count = std::size_t(std::strtoull(argv[1], nullptr, 10));
    if (argc > 2 || count == 0 || (argc == 2 && std::strcmp(argv[1], "--help") == 0)) {
        std::printf(
            "usage: numerics [cases in each group]\n"
            "Prints by group: the median and the largest relative error of the tangents at the end of a path, the\n"
            "median condition number of the problem, and the median and the largest error in units of condition\n"
            "times machine epsilon. Returns 1 if more than 0.1%% of a group are above 100 units, one above 1000, or\n"
            "a photon is lost. Ill-posed: rounding the input alone moves the result by a hundredth of it or more, or\n"
            "decides whether a ball is hit or light totally reflected; such cases need only stay finite.\n");
        return argc > 2 || count == 0 ? 2 : 0;
    }
#if defined(__FAST_MATH__)
    std::printf(
        "compiled with -ffast-math: the oracle's quadruple precision is untouched, its condition numbers nearly\n\n");
#endif
    if (nephroid::tests::Wide::digits < 113)
        std::printf("no quadruple precision here: in double the errors are those of the reference\n\n");

    std::vector<Worst> worst;
    const bool float_is_good = print_table<float>("float", count, worst);
    const bool double_is_good = print_table<double>("double", count, worst);
    print_worst(worst);
    return float_is_good && double_is_good ? 0 : 1;
}
