// SPDX-License-Identifier: MIT
// expect: the chart lacks columns(), rows(), place(x) -> optional<RasterPlace> or ray(x, y) -> RasterRay
#include "messages/renderer.hpp"

#include "nephroid/image/caustic_map.hpp"

struct Chart {
    std::size_t columns() const { return 1; }
    std::size_t rows() const { return 1; }
    std::optional<nephroid::RasterPlace> place(const nephroid::ChartVector&) const { return std::nullopt; }
};

int main() { nephroid::CausticMap<V, float, Chart> caustic_map(Chart{}); }
