// SPDX-License-Identifier: MIT
/// @file  How far the photons' tangents are from the truth on hard cases, with your compiler and your flags: paths of
///        one to six reflections and refractions against differences in quadruple precision, in float and in double.
#include "common/numerics/group_table.hpp"
#include "common/table.hpp"
#include "common/text.hpp"

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <string>
#include <vector>

namespace {

using namespace nephroid::examples;
using namespace nephroid::examples::numerics;

constexpr double bar = 100, limit = 1000; // units: 99.9% of cases within the first, none above the second

struct Worst {
    Measured measured;
    Group group;
    const char* precision;
};

/// Measures all groups in one precision and prints their table.
/// @return  whether all are within the bar
template <class T>
bool print_table(const char* precision, std::size_t count, TableFormat format, std::vector<Worst>& worst) {
    Table table{
        precision,
        std::string("Tangents in ") + precision,
        "Relative errors, by group; condition is how much the problem magnifies rounding, and a unit is condition "
        "times epsilon",
        {"group", "cases", "median error", "largest", "condition", "median units", "largest", "lost", "ill-posed"},
        {}};
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
        table.rows.push_back(
            {group_names[g], text("%zu", row.cases.size()), text("%.1e", row.median(&Measured::relative_error)),
             text("%.1e", row.largest(&Measured::relative_error)), text("%.1e", row.median(&Measured::condition)),
             text("%.2f", row.median(&Measured::units)), text("%.1f", row.largest(&Measured::units)),
             text("%zu", row.lost), text("%zu%s", row.ill_posed, row.not_finite > 0 ? ", not finite" : "")});
    }
    print(std::cout, table, format);
    std::cout << std::endl;
    return good;
}

void print_worst(std::vector<Worst>& all) {
    constexpr std::size_t shown = 10;
    const std::size_t count = (std::min)(shown, all.size());
    std::partial_sort(all.begin(), all.begin() + std::ptrdiff_t(count), all.end(),
                      [](const Worst& a, const Worst& b) { return !(a.measured.units <= b.measured.units); });
    std::cout << "the worst\n";
    for (std::size_t i = 0; i < count; ++i) {
        const Measured& m = all[i].measured;
        std::cout << text("%8.1f  %-7s%-28s%-12s error %.1e, condition %.1e:", m.units, all[i].precision,
                          group_names[std::size_t(all[i].group)], m.what, m.relative_error, m.condition);
        for (const auto& s : m.chain.surfaces)
            std::cout << ' ' << kind_names[std::size_t(s.kind)]
                      << (&s == &m.chain.surfaces.back() ? ""
                          : s.refracts                   ? " >"
                                                         : " <");
        std::cout << '\n';
    }
}

} // namespace

int main(int argc, char** argv) {
    std::size_t count = 250;
    TableFormat format = TableFormat::text;
    bool is_understood = true;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--markdown") == 0) {
            format = TableFormat::markdown;
        } else {
            count = std::size_t(std::strtoull(argv[i], nullptr, 10));
            is_understood = is_understood && count > 0;
        }
    }
    if (!is_understood) {
        const bool asked = std::strcmp(argv[1], "--help") == 0;
        (asked ? std::cout : std::cerr)
            << "usage: numerics [--markdown] [cases in each group]\n"
               "Prints by group: the median and the largest relative error of the tangents at the end of a path, the\n"
               "median condition number of the problem, and the median and the largest error in units of condition\n"
               "times machine epsilon. Returns 1 if more than 0.1% of a group are above 100 units, one above 1000, or\n"
               "a photon is lost. Ill-posed: rounding the input alone moves the result by a hundredth of it or more, "
               "or\n"
               "decides whether a ball is hit or light totally reflected; such cases need only stay finite.\n";
        return asked ? 0 : 2;
    }
#if defined(__FAST_MATH__)
    std::cerr << "compiled with -ffast-math: the oracle's quadruple precision is untouched, its condition numbers "
                 "nearly\n";
#endif
    if (Wide::digits < 113)
        std::cerr << "no quadruple precision here: in double the errors are those of the reference\n";

    std::vector<Worst> worst;
    const bool float_is_good = print_table<float>("float", count, format, worst);
    const bool double_is_good = print_table<double>("double", count, format, worst);
    if (format == TableFormat::text)
        print_worst(worst);
    return float_is_good && double_is_good ? 0 : 1;
}
