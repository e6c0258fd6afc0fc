// SPDX-License-Identifier: MIT
#include "common/study/sweep.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace nephroid::examples::study {

const char* name_of(Measure measure) {
    return measure == Measure::relative ? "rel" : measure == Measure::rmse ? "RMSE" : "SSIM";
}

double value_of(const Errors& errors, Measure measure) {
    return measure == Measure::relative ? errors.relative : measure == Measure::rmse ? errors.rmse : errors.ssim;
}

double cost_of(const Errors& errors, Measure measure) {
    const double value = value_of(errors, measure);
    const double cost = measure == Measure::ssim ? 1 - value : value;
    return std::isfinite(cost) ? cost : std::numeric_limits<double>::infinity();
}

BandwidthSweep::BandwidthSweep(Grid grid, Evaluate evaluate) : grid_(grid), evaluate_(std::move(evaluate)) {
    grid_.expected = (std::max)(grid_.least, (std::min)(grid_.expected, grid_.most));
}

bool BandwidthSweep::is_on_grid(int point) const {
    const double wanted = grid_.expected * std::pow(grid_.ratio, point);
    return point == 0 || (wanted >= grid_.least && wanted <= grid_.most);
}

double BandwidthSweep::bandwidth(int point) const {
    const double wanted = grid_.expected * std::pow(grid_.ratio, point);
    return grid_.is_whole ? std::round(wanted) : wanted;
}

double BandwidthSweep::cost(int point, Measure measure) {
    if (!is_on_grid(point))
        return std::numeric_limits<double>::infinity();
    const double h = bandwidth(point);
    points_.emplace(point, h);
    auto found = evaluated_.find(h);
    if (found == evaluated_.end())
        found = evaluated_.emplace(h, evaluate_(h)).first;
    return cost_of(found->second, measure);
}

double BandwidthSweep::best(Measure measure) {
    for (const int look : {-4, 0, 3, 6})
        static_cast<void>(cost(look, measure));
    int point = 0;
    double least = cost(0, measure);
    for (const auto& [known, h] : std::map<int, double>(points_))
        if (const double c = cost(known, measure); c < least)
            least = c, point = known;
    for (const int stride : {4, 2, 1}) {
        for (bool has_moved = true; has_moved;) {
            has_moved = false;
            for (const int next : {point - stride, point + stride})
                if (const double c = cost(next, measure); c < least) {
                    least = c;
                    point = next;
                    has_moved = true;
                    break;
                }
        }
    }
    return bandwidth(point);
}

void BandwidthSweep::cover(int reach) {
    for (int point = -reach; point <= reach; point += 2)
        static_cast<void>(cost(point, Measure::relative));
}

} // namespace nephroid::examples::study
