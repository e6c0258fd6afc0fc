// SPDX-License-Identifier: MIT
/// @file  Photon differential mapping: photons stored with their footprints and gathered at every eye path vertex.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/gather/footprint_map.hpp"
#include "nephroid/gather/gather.hpp"
#include "nephroid/splat/splat.hpp"

#include <type_traits>

namespace nephroid {

/// Estimates irradiance as the sum of the stored photons' footprints over a point: the same sum as splatting's,
/// photon by photon for each vertex instead of vertex by vertex for each photon.
/// Source: Schjøth, Frisvad, Erleben and Sporring 2007, "Photon Differentials".
///
/// ```cpp
/// const nephroid::DifferentialMap estimate(traced.deposits, eye_path_map, nephroid::Published{});
/// const float e = estimate(position, normal);
/// ```
template <Vector3 V, Flux F, class K = BiweightKernel>
    requires Kernel<K, scalar_t<V>> && ScalesFlux<F, scalar_t<V>>
class DifferentialMap {
public:
    using T = scalar_t<V>;

    /// @param deposits  photons with their tangents, as `trace_photons` returns them
    /// @param eyes      the vertices to be estimated at: bound the footprints and give the pixel filter its width, as
    ///                  in splatting; not needed after the call
    /// @param policies  `Published{}` or others: how a photon becomes a footprint. First order: neighbouring photons do
    ///                  not shape the footprints, as they may in `caustics`
    /// @param executor  who runs the work; the result does not depend on it
    template <std::size_t N, class Policies, class E = SerialExecutor>
    DifferentialMap(const std::vector<Deposit<V, F, N>>& deposits, const EyePathMap<V>& eyes, const Policies& policies,
                    E&& executor = E{}) requires ExecutorArgument<E>
        : DifferentialMap(make_splats(deposits, eyes, policies, executor), eyes.tree().origin(), policies.kernel) {}

    /// With the default policies.
    template <std::size_t N, std::same_as<BiweightKernel> = K>
    DifferentialMap(const std::vector<Deposit<V, F, N>>& deposits, const EyePathMap<V>& eyes)
        : DifferentialMap(deposits, eyes, Published{}) {}

    /// The irradiance at a point of a surface, flux per area; a position that is not finite receives nothing.
    /// @param normal  unit; photons on the other side do not count
    [[nodiscard]] F operator()(const V& position, const V& normal) const {
        return (*this)(position, normal, detail::NoResponse{});
    }

    /// The same with each photon's irradiance times response(direction of flight): the BRDF; the sum is radiance.
    template <class Response>
    [[nodiscard]] F operator()(const V& position, const V& normal, const Response& response) const {
        F sum = flux_traits<F>::zero();
        const V relative = position - origin_;
        map_.visit_leaves(relative, [&](const TreeLeaf& leaf) {
            std::array<T, detail::FootprintMap<V>::leaf_size> weight;
            weigh(leaf, relative, normal, weight);
            for (std::size_t i = 0; i < leaf.size; ++i)
                if (weight[i] > T(0))
                    add(sum, leaf.first + i, weight[i], response);
        });
        return sum;
    }

    /// What became of the photons: Fate::splatted are those stored.
    [[nodiscard]] const Statistics& statistics() const { return statistics_; }

private:
    struct Splats {
        std::vector<Splat<V, F>> splats;
        Statistics statistics;
    };

    template <std::size_t N, class Policies, class E>
    [[nodiscard]] static Splats make_splats(const std::vector<Deposit<V, F, N>>& deposits, const EyePathMap<V>& eyes,
                                            const Policies& policies, E& executor) {
        constexpr std::size_t per_task = 1024;
        std::vector<Splats> parts((deposits.size() + per_task - 1) / per_task);
        executor(parts.size(), [&](std::size_t part) {
            const std::size_t end = (std::min)(deposits.size(), (part + 1) * per_task);
            for (std::size_t i = part * per_task; i < end; ++i) {
                const auto outcome = make_splat(deposits[i], eyes, policies);
                parts[part].statistics.bounded_footprints += outcome.bounded;
                parts[part].statistics.end(outcome.fate, double(flux_traits<F>::power(deposits[i].flux)));
                if (outcome.splat)
                    parts[part].splats.push_back(*outcome.splat);
            }
        });
        Splats all;
        for (const Splats& part : parts) {
            for (const Splat<V, F>& splat : part.splats) // insert() draws a false warning from g++ 12
                all.splats.push_back(splat);
            all.statistics += part.statistics;
        }
        return all;
    }

    DifferentialMap(const Splats& all, const V& origin, K kernel)
        : map_(
              all.splats.size(), [&](std::size_t i) { return all.splats[i].centre; },
              [&](std::size_t i) { return all.splats[i].box; }, "nephroid::DifferentialMap"),
          origin_(origin), kernel_(kernel), statistics_(all.statistics) {
        using t = vector_traits<V>;
        for (auto& column : columns_)
            column.reserve(map_.slots());
        peaks_.reserve(map_.slots());
        directions_.reserve(map_.slots());
        for (std::size_t slot = 0; slot < map_.slots(); ++slot) {
            const Splat<V, F>& splat = all.splats[map_.index(slot)];
            const std::array<V, columns / 3> vectors{splat.centre, splat.row_a, splat.row_b, splat.row_n, splat.normal};
            for (std::size_t i = 0; i < vectors.size(); ++i) {
                columns_[3 * i].push_back(t::x(vectors[i]));
                columns_[3 * i + 1].push_back(t::y(vectors[i]));
                columns_[3 * i + 2].push_back(t::z(vectors[i]));
            }
            peaks_.push_back(splat.peak);
            directions_.push_back(splat.direction);
        }
    }

    /// The kernels of a leaf's photons at a position relative to the origin: the splatter's inner loop, for one vertex
    /// and many photons.
    void weigh(const TreeLeaf& leaf, const V& relative, const V& normal,
               std::array<T, detail::FootprintMap<V>::leaf_size>& weight) const {
        using t = vector_traits<V>;
        constexpr std::size_t lanes = detail::FootprintMap<V>::lanes;
        std::array<const T*, columns> c;
        for (std::size_t column = 0; column < columns; ++column)
            c[column] = columns_[column].data() + leaf.first;
        const T px = t::x(relative), py = t::y(relative), pz = t::z(relative);
        const T mx = t::x(normal), my = t::y(normal), mz = t::z(normal);
        const std::size_t size = (leaf.size + lanes - 1) / lanes * lanes;
        for (std::size_t i = 0; i < size; ++i) {
            const T dx = px - c[0][i], dy = py - c[1][i], dz = pz - c[2][i];
            const T a = c[3][i] * dx + c[4][i] * dy + c[5][i] * dz;
            const T b = c[6][i] * dx + c[7][i] * dy + c[8][i] * dz;
            const T off = c[9][i] * dx + c[10][i] * dy + c[11][i] * dz;
            const T facing = mx * c[12][i] + my * c[13][i] + mz * c[14][i];
            weight[i] = keep_if(bool(int(off * off < T(1)) & int(facing > T(0))), kernel_(a * a + b * b));
        }
    }

    template <class Response>
    void add(F& sum, std::size_t slot, T weight, const Response& response) const {
        if constexpr (std::same_as<Response, detail::NoResponse>)
            sum = sum + peaks_[slot] * weight;
        else
            sum = sum + peaks_[slot] * weight * response(directions_[slot]);
    }

    static constexpr std::size_t columns = 15; // the coordinates of a splat's five vectors, each an array by slot

    detail::FootprintMap<V> map_;
    V origin_;
    K kernel_;
    Statistics statistics_;
    std::array<std::vector<T>, columns> columns_;
    std::vector<F> peaks_;
    std::vector<V> directions_;
};

template <Vector3 V, Flux F, std::size_t N, class Policies>
DifferentialMap(const std::vector<Deposit<V, F, N>>&, const EyePathMap<V>&, const Policies&)
    -> DifferentialMap<V, F, decltype(Policies::kernel)>;
template <Vector3 V, Flux F, std::size_t N, class Policies, class E>
DifferentialMap(const std::vector<Deposit<V, F, N>>&, const EyePathMap<V>&, const Policies&, E&&)
    -> DifferentialMap<V, F, decltype(Policies::kernel)>;
template <Vector3 V, Flux F, std::size_t N>
DifferentialMap(const std::vector<Deposit<V, F, N>>&, const EyePathMap<V>&) -> DifferentialMap<V, F>;

} // namespace nephroid
