// SPDX-License-Identifier: MIT
/// @file  Splatting onto an eye path map: batches of photons, binned by groups of leaves, each summed by one thread.
///
/// A group adds up its photons in the order of their indices whoever runs it, so that the sums are the same bit for bit
/// for any number of threads, without atomics or locks.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/receiver/sink.hpp"
#include "nephroid/splat/splat_reach.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace nephroid {

/// The vertices' response does not depend on where light comes from (diffuse surfaces): what is summed up is
/// irradiance, which the caller multiplies with throughput · albedo / π.
struct Irradiance {};

/// All leaves of the map's tree take photons.
struct EveryLeaf {
    [[nodiscard]] constexpr bool operator()(std::uint32_t) const { return true; }
};

/// Sums up photons at the vertices of an eye path map [Frisvad et al. 2014, eq. 10].
///
/// @tparam V         vector
/// @tparam F         flux; the sums are F per world unit squared
/// @tparam Policies  `SplatPolicies<…>`
/// @tparam Response  Irradiance, or a callable (vertex index, photon direction) -> a factor for the photon's
///                   irradiance there: the BRDF f_r(x, −ω_p, ω) times the path's throughput; what is summed is then
///                   radiance. Called from several threads at once.
template <class V, class F, class Policies = SplatPolicies<>, class Response = Irradiance>
    requires detail::MustBeFluxFor<F, V>
class PhotonSplatter {
public:
    using T = scalar_t<V>;
    using vector = V;
    using flux_type = F;

    /// @param map  is referred to, and must outlive the splatter
    explicit PhotonSplatter(const EyePathMap<V>& map, Policies policies = {}, Response response = {})
        : map_(&map), policies_(std::move(policies)), response_(std::move(response)) {
        clear();
    }
    explicit PhotonSplatter(const EyePathMap<V>&&, Policies = {}, Response = {}) = delete; // would refer to a temporary

    [[nodiscard]] const EyePathMap<V>& map() const { return *map_; }
    [[nodiscard]] const Policies& policies() const { return policies_; }

    /// Forgets all photons.
    void clear() { sums_.assign(map_->tree().slots(), flux_traits<F>::zero()); }

    /// Photons of one chunk, in the order of their indices, on their way into the map. Aligned, as threads fill
    /// neighbouring ones at the same time.
    class alignas(64) Chunk {
    public:
        /// Splats a deposit; its flux is booked in the account under what became of it.
        ///
        /// @param takes  takes(leaf) -> whether that leaf of the map's tree is to get its part: all do unless told
        template <std::size_t N, class Takes = EveryLeaf>
        void add(const PhotonSplatter& splatter, const Deposit<V, F, N>& deposit, Statistics& account,
                 const Takes& takes = {}) {
            account.end(place(splatter, deposit, account, takes), power(deposit));
        }

        /// Splats a photon that was taken to pieces: it is splatted if one of them is, and the flux of each is booked
        /// under what became of it. At least one.
        template <std::size_t N>
        void add(const PhotonSplatter& splatter, std::span<const Deposit<V, F, N>> pieces, Statistics& account) {
            std::array<double, fate_count> flux{};
            Fate fate = Fate::splatted;
            bool is_splatted = false;
            for (const Deposit<V, F, N>& piece : pieces) {
                const Fate its = place(splatter, piece, account, EveryLeaf{});
                flux[std::size_t(its)] += power(piece);
                is_splatted = is_splatted || its == Fate::splatted;
                fate = is_splatted ? Fate::splatted : its;
            }
            account.end(fate, 0);
            for (std::size_t i = 0; i < fate_count; ++i)
                account.lose(Fate(i), flux[i]);
        }

        /// Splats what has been made ready.
        /// @return  whether it meets a leaf with vertices that may lie in it and face it
        template <class Takes = EveryLeaf>
        bool add(const PhotonSplatter& splatter, const Splat<V, F>& splat, const Takes& takes = {}) {
            const std::size_t before = visits_.size();
            const auto number = std::uint32_t(splats_.size());
            const detail::SplatReach<V, F> reach(splat);
            splatter.map_->tree().visit_leaves(splat.box, [&](std::uint32_t leaf) {
                if (!takes(leaf))
                    return;
                if (const detail::LeafMeeting meeting = reach(splatter.map_->leaf(leaf)); meeting.meets)
                    visits_.push_back({leaf, number, meeting});
            });
            if (visits_.size() == before)
                return false;
            splats_.push_back(splat);
            return true;
        }

        void clear() {
            splats_.clear();
            visits_.clear();
        }

        /// How many times a leaf is met by a splat.
        [[nodiscard]] std::size_t visits() const { return visits_.size(); }

    private:
        friend PhotonSplatter;

        template <std::size_t N>
        [[nodiscard]] static double power(const Deposit<V, F, N>& deposit) {
            return double(flux_traits<F>::power(deposit.flux));
        }

        template <std::size_t N, class Takes>
        [[nodiscard]] Fate place(const PhotonSplatter& splatter, const Deposit<V, F, N>& deposit, Statistics& account,
                                 const Takes& takes) {
            const auto outcome = make_splat(deposit, *splatter.map_, splatter.policies_);
            account.bounded_footprints += outcome.bounded;
            return outcome.splat && !add(splatter, *outcome.splat, takes) ? Fate::unseen : outcome.fate;
        }

        /// This leaf is met by the splat with this number.
        struct Visit {
            std::uint32_t leaf, number;
            detail::LeafMeeting meeting;
        };

        std::vector<Splat<V, F>> splats_;
        std::vector<Visit> visits_;
    };

    /// Adds the photons of consecutive chunks, in order.
    template <class E>
        requires Executor<E&>
    void add(std::span<const Chunk> chunks, E& executor) {
        bin(chunks, executor);
        // Neighbouring groups have lines of cache in common, which two threads take from each other again and again: a
        // task is several where that leaves enough of them for many threads.
        const std::size_t groups_per_task = std::clamp<std::size_t>(groups() / 256, 1, 4);
        detail::for_each_index(executor, groups(), groups_per_task, [&](std::size_t group) {
            for (std::size_t i = bin_begin_[group]; i < bin_begin_[group + 1]; ++i)
                splat_leaf(bins_[i], map_->tree().leaves()[bins_[i].leaf]);
        });
    }

    /// Calls sink(vertex index, sum) once for every vertex, in the map's order, with the irradiance (or radiance)
    /// of all photons since the last `clear`.
    template <class S>
        requires detail::MustBeSink<std::remove_reference_t<S>, F>
    void for_each(S&& sink) const {
        for (const TreeLeaf& leaf : map_->tree().leaves())
            for (std::size_t slot = leaf.first; slot < leaf.first + leaf.size; ++slot)
                sink(std::size_t(map_->tree().index(slot)), sums_[slot]);
    }

    /// The sums at the vertices of one leaf of the map's tree, by slot.
    [[nodiscard]] std::span<const F> sums(std::uint32_t leaf) const {
        const TreeLeaf& range = map_->tree().leaves()[leaf];
        return {sums_.data() + range.first, range.size};
    }

private:
    /// A splat, and a leaf that it meets.
    struct Binned {
        const Splat<V, F>* splat;
        std::uint32_t leaf;
        detail::LeafMeeting meeting;
    };

    /// How many neighbouring leaves one thread sums up together, as a power of two: four, which stay in the nearest
    /// cache, or what makes 8192 groups at most, as sixteen parts of a batch count their visits to each.
    [[nodiscard]] unsigned group_bits() const {
        return (std::max)(2u, unsigned(std::bit_width(map_->tree().leaves().size() >> 13)));
    }

    [[nodiscard]] std::size_t groups() const { return (map_->tree().leaves().size() >> group_bits()) + 1; }

    /// Sorts the chunks' visits by group, keeping the photons' order: a counting sort, of which 16 parts count and move
    /// their visits at the same time. More would take longer to add up than they save.
    template <class E>
    void bin(std::span<const Chunk> chunks, E& executor) {
        constexpr std::size_t parts = 16;
        const std::size_t count = groups(), chunks_per_part = (chunks.size() + parts - 1) / parts;
        const unsigned bits = group_bits();
        const auto for_each_visit = [&](std::size_t part, const auto& work) {
            const std::size_t end = (std::min)(chunks.size(), (part + 1) * chunks_per_part);
            for (std::size_t chunk = part * chunks_per_part; chunk < end; ++chunk)
                for (const auto& visit : chunks[chunk].visits_)
                    work(next_[part * count + (visit.leaf >> bits)], visit, chunks[chunk]);
        };
        next_.assign(parts * count, 0);
        executor(parts, [&](std::size_t part) {
            for_each_visit(part, [](std::size_t& visits, const auto&, const Chunk&) { ++visits; });
        });
        bin_begin_.resize(count + 1);
        std::size_t sum = 0;
        for (std::size_t group = 0; group < count; ++group) {
            bin_begin_[group] = sum;
            for (std::size_t part = 0; part < parts; ++part)
                sum += std::exchange(next_[part * count + group], sum);
        }
        bin_begin_[count] = sum;
        bins_.resize(sum);
        executor(parts, [&](std::size_t part) {
            for_each_visit(part, [this](std::size_t& next, const auto& visit, const Chunk& chunk) {
                bins_[next++] = {&chunk.splats_[visit.number], visit.leaf, visit.meeting};
            });
        });
    }

    /// Adds one photon to the vertices of one leaf.
    void splat_leaf(const Binned& binned, const TreeLeaf& range) {
        using t = vector_traits<V>;
        constexpr std::size_t most = PointTree<V>::leaf_size;
        const Splat<V, F>& splat = *binned.splat;
        const std::size_t lanes = PointTree<V>::lanes;
        const std::size_t size = (range.size + lanes - 1) / lanes * lanes;
        std::array<T, most> weight;
        const T* const x = map_->tree().x() + range.first;
        const T* const y = map_->tree().y() + range.first;
        const T* const z = map_->tree().z() + range.first;
        const T cx = t::x(splat.centre), cy = t::y(splat.centre), cz = t::z(splat.centre);
        const T ax = t::x(splat.row_a), ay = t::y(splat.row_a), az = t::z(splat.row_a);
        const T bx = t::x(splat.row_b), by = t::y(splat.row_b), bz = t::z(splat.row_b);
        const auto kernel = policies_.kernel;
        for (std::size_t i = 0; i < size; ++i) {
            const T dx = x[i] - cx, dy = y[i] - cy, dz = z[i] - cz;
            const T a = ax * dx + ay * dy + az * dz;
            const T b = bx * dx + by * dy + bz * dz;
            weight[i] = kernel(a * a + b * b);
        }
        if (binned.meeting.checks_height) {
            const T nx = t::x(splat.row_n), ny = t::y(splat.row_n), nz = t::z(splat.row_n);
            for (std::size_t i = 0; i < size; ++i) {
                const T off = nx * (x[i] - cx) + ny * (y[i] - cy) + nz * (z[i] - cz);
                weight[i] = keep_if(off * off < T(1), weight[i]);
            }
        }
        if (binned.meeting.checks_normals) {
            const T px = t::x(splat.normal), py = t::y(splat.normal), pz = t::z(splat.normal);
            const T* const mx = map_->normal_x() + range.first;
            const T* const my = map_->normal_y() + range.first;
            const T* const mz = map_->normal_z() + range.first;
            for (std::size_t i = 0; i < size; ++i)
                weight[i] = keep_if(mx[i] * px + my[i] * py + mz[i] * pz > T(0), weight[i]);
        }

        F* const sum = sums_.data() + range.first;
        if constexpr (std::is_same_v<Response, Irradiance>) {
            const F peak = splat.peak;
            for (std::size_t i = 0; i < size; ++i)
                sum[i] = sum[i] + peak * weight[i];
        } else {
            for (std::size_t i = 0; i < range.size; ++i)
                if (weight[i] > T(0))
                    sum[i] = sum[i] + splat.peak * weight[i] *
                                          response_(std::size_t(map_->tree().index(range.first + i)), splat.direction);
        }
    }

    const EyePathMap<V>* map_;
    Policies policies_;
    Response response_;
    std::vector<F> sums_; // by slot
    std::vector<Binned> bins_;
    std::vector<std::size_t> bin_begin_; // of each group in the bins, and their end
    std::vector<std::size_t> next_;      // by part of the batch, then group: where its next visit goes
};

} // namespace nephroid
