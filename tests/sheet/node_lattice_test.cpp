// SPDX-License-Identifier: MIT
#include "nephroid/sheet/node_lattice.hpp"

#include "nephroid/vector/glm.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

namespace nephroid::tests::node_lattice_test {

TEST_CASE("node grid: it announces its tasks and traces each node once") {
    using V = glm::vec3;
    for (const std::int64_t cells_u : {1, 13, 510, 512})
        for (const std::int64_t cells_v : {1, 11, 496}) {
            CAPTURE(cells_u);
            CAPTURE(cells_v);
            detail::Lattice lattice;
            lattice.cells_u = cells_u;
            lattice.cells_v = cells_v;
            const detail::CellRange all{0, cells_u, 0, cells_v};
            detail::NodeGrid<V, float> grid;
            std::vector<int> traced(std::size_t((cells_u + 1) * (cells_v + 1)));
            const auto trace = [&](const detail::LatticePlace& place, std::vector<detail::NodeEnd<V, float>>&,
                                   std::size_t task) {
                REQUIRE(task < grid.tasks_of(lattice, all));
                const std::int64_t step = lattice.step();
                ++traced[std::size_t(place.j / step * (cells_u + 1) + place.i / step)];
            };
            std::size_t tasks = 0;
            const auto executor = [&](std::size_t count, const auto& run) {
                tasks = count;
                for (std::size_t task = 0; task < count; ++task)
                    run(task);
            };
            grid.fill(lattice, all, trace, executor);
            CHECK(tasks == grid.tasks_of(lattice, all));
            CHECK(traced == std::vector<int>(traced.size(), 1));
        }
}

} // namespace nephroid::tests::node_lattice_test
