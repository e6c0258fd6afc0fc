// SPDX-License-Identifier: MIT
/// @file  One smoothing for all photons of a pass, chosen by comparing estimates from parts of them: where nothing is
///        known of the light but its photons.
///
/// Let W be the picture from all photons at one smoothing, A and B those from either half of them with the same
/// footprints, so that W = (A + B)/2, and A₀ and B₀ the halves at so small a smoothing that they are noisy but
/// hardly biased. Then the sum over the vertices of W² − A B₀ − B A₀ is, but for a constant, the squared error
/// of W on average, less 2 cov(A, B₀). Halves of random photons do not covary. Those of a sequence do, as each fills
/// the other's gaps: with ρ the correlation that is left, the sum of (A − B)(A₀ − B₀) has 2 cov(A, B₀)
/// as its share ρ/(1 − ρ), which is added. And ρ follows from how the noise falls with the number n of
/// photons, as n^−β: ρ = 2^(1−β) − 1. Random ones have β = 1; of a stratified sequence it is measured,
/// from quarters to halves of them: up to 2, with ρ = −1/2, where two numbers make a photon, and less where more do.
///
/// The error is least where its bias, as s⁴/N², and its variance, as s^−2β, balance: a pass of more photons than
/// were compared takes an s that grows with their number as N^(1/(2 + β)).
#pragma once

#include "nephroid/sequence/halton.hpp"
#include "nephroid/sequence/hash.hpp"
#include "nephroid/smoothing/pilot.hpp"
#include "nephroid/splat/photon_splatter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace nephroid {

namespace detail {

/// Leaves of a map's tree from all over it: of neighbours, one in so many.
class LeafSample {
public:
    /// @param vertices  wanted, about
    template <Vector3 V>
    LeafSample(const PointTree<V>& tree, std::size_t vertices) : leaves_(std::uint32_t(tree.leaves().size())) {
        std::size_t all = 0;
        for (const TreeLeaf& leaf : tree.leaves())
            all += leaf.size;
        every_ = std::uint32_t((std::max<std::size_t>)(1, all / vertices));
    }

    [[nodiscard]] bool operator()(std::uint32_t leaf) const { return leaf == chosen(leaf / every_); }

    template <class Visit>
    void for_each(Visit&& visit) const {
        for (std::uint32_t group = 0; group * every_ < leaves_; ++group)
            if (const std::uint32_t leaf = chosen(group); leaf < leaves_)
                visit(leaf);
    }

private:
    [[nodiscard]] std::uint32_t chosen(std::uint32_t group) const {
        return group * every_ + std::uint32_t(mix_bits(group + 1) % every_);
    }

    std::uint32_t leaves_, every_ = 1;
};

/// The picture at some of the vertices, from each quarter of the photons alone.
using QuarterPictures = std::array<std::vector<double>, 4>;

/// Makes such pictures.
///
/// @tparam DepositOf  deposit_of(i) -> optional deposit of photon i, emitted with smoothing 1
template <class Splatter, class DepositOf, class E>
class QuarterSplatter {
public:
    /// @param like     tells map, policies and response
    /// @param count    photons there are
    /// @param photons  that their fluxes and tangents are those of
    QuarterSplatter(const Splatter& like, std::size_t count, double photons, const DepositOf& deposit_of, E& executor)
        : splatter_(like), sample_(like.map().tree(), vertices), per_quarter_(count / 4),
          share_(photons / double(count / 4 * 4)), deposit_of_(deposit_of), executor_(executor) {}

    /// @param s  smoothing of the four quarters together: with footprints of this size each covers a quarter of s²
    [[nodiscard]] QuarterPictures operator()(double s) {
        QuarterPictures pictures;
        for (std::size_t quarter = 0; quarter < pictures.size(); ++quarter) {
            splatter_.clear();
            for (std::size_t done = 0; done < per_quarter_; done += batch)
                splat(quarter * per_quarter_ + done, (std::min)(batch, per_quarter_ - done), s);
            sample_.for_each([&](std::uint32_t leaf) {
                for (const auto& sum : splatter_.sums(leaf))
                    pictures[quarter].push_back(flux_traits<F>::power(sum));
            });
        }
        return pictures;
    }

private:
    using V = typename Splatter::vector;
    using F = typename Splatter::flux_type;
    using T = scalar_t<V>;
    using Chunk = typename Splatter::Chunk;

    static constexpr std::size_t vertices = std::size_t(1) << 15;
    static constexpr std::size_t chunks = 64, batch = 128 * chunks;

    void splat(std::size_t first, std::size_t count, double s) {
        const T stretch = T(s * std::sqrt(share_)), boost = T(4 * share_);
        const std::size_t per_chunk = (count + chunks - 1) / chunks;
        executor_(chunks, [&](std::size_t c) {
            chunks_[c].clear();
            Statistics unused;
            for (std::size_t i = c * per_chunk; i < (std::min)(count, (c + 1) * per_chunk); ++i)
                if (auto deposit = deposit_of_(first + i)) {
                    for (V& d : deposit->d_position)
                        d = stretch * d;
                    deposit->flux = deposit->flux * boost;
                    chunks_[c].add(splatter_, *deposit, unused, sample_);
                }
        });
        splatter_.add(std::span<const Chunk>(chunks_), executor_);
    }

    Splatter splatter_;
    LeafSample sample_;
    std::size_t per_quarter_;
    double share_; ///< of the pass's photons over those at hand
    const DepositOf& deposit_of_;
    E& executor_;
    std::vector<Chunk> chunks_ = std::vector<Chunk>(chunks);
};

/// How the noise of an estimate falls with the number n of its photons, as n^−β: 1 for random ones, 2 for those that
/// avoid each other in the plane of their footprints.
[[nodiscard]] inline double noise_order(const QuarterPictures& q) {
    double quarters = 0, halves = 0;
    for (std::size_t i = 0; i < q[0].size(); ++i) {
        quarters += 0.5 * (square(q[0][i] - q[1][i]) + square(q[2][i] - q[3][i]));
        halves += 0.25 * square((q[0][i] + q[1][i]) - (q[2][i] + q[3][i]));
    }
    return halves > 0 ? std::clamp(std::log2(quarters / halves), 1.0, 2.0) : 1;
}

/// The squared error of the picture from all quarters together, summed over the vertices, but for a constant.
///
/// @param sharp  the same at a small smoothing
/// @param order  noise_order
[[nodiscard]] inline double validated_error(const QuarterPictures& q, const QuarterPictures& sharp, double order) {
    const double correlation = std::exp2(1 - order) - 1;
    double error = 0, difference = 0;
    for (std::size_t i = 0; i < q[0].size(); ++i) {
        const double a = 0.5 * (q[0][i] + q[1][i]), b = 0.5 * (q[2][i] + q[3][i]);
        const double a0 = 0.5 * (sharp[0][i] + sharp[1][i]), b0 = 0.5 * (sharp[2][i] + sharp[3][i]);
        error += square(0.5 * (a + b)) - a * b0 - b * a0 + a0 * b0; // the last does not depend on s: smaller numbers
        difference += (a - b) * (a0 - b0);
    }
    return error + correlation / (1 - correlation) * difference;
}

/// @param count       photons at hand
/// @param photons     of the pass, N_e: what the deposits were emitted as parts of
/// @param stratified  whether they are from a sequence that is
/// @return  s for the pass; `default_smoothing` where too few photons are seen to tell
template <class Splatter, class DepositOf, class E>
[[nodiscard]] double cross_validated(const Splatter& splatter, std::size_t count, double photons, bool stratified,
                                     const DepositOf& deposit_of, E& executor) {
    constexpr double sharpest = 2.5; // below, footprints hardly overlap, and a sequence's photons are as random ones
    constexpr std::size_t measured = 2, most = 9; // s = 5 for the noise, and up to 40
    constexpr std::size_t fewest = 64;            // that landed
    const auto s_of = [](double step) { return sharpest * std::exp2(0.5 * step); };
    std::size_t landed = 0;
    for (std::size_t i = 0; i < count && landed < fewest; ++i)
        landed += deposit_of(i).has_value();
    if (landed < fewest)
        return default_smoothing;

    announce(executor, Phase::fit);
    QuarterSplatter splat(splatter, count, photons, deposit_of, executor);
    std::vector<QuarterPictures> first; // those up to where the noise is measured
    for (std::size_t step = 0; step <= measured; ++step)
        first.push_back(splat(s_of(double(step))));
    const double order = stratified ? noise_order(first[measured]) : 1;

    std::vector<double> error;
    std::size_t best = 0;
    for (std::size_t step = 0; step < most && step <= best + 2; ++step) { // twice in a row worse: it is the minimum
        error.push_back(validated_error(step <= measured ? first[step] : splat(s_of(double(step))), first[0], order));
        if (error[step] < error[best])
            best = step;
    }
    if (!isfinite(order) || !isfinite(error[best]) || error[0] == error[1]) // nothing is seen, or it is no number
        return default_smoothing;
    double place = double(best);
    if (best > 0 && best + 1 < error.size()) { // the parabola through it and its neighbours
        const double below = error[best - 1] - error[best], above = error[best + 1] - error[best];
        place += below + above > 0 ? 0.5 * (below - above) / (below + above) : 0;
    }
    return s_of(place) * std::pow(photons / double(count), 1 / (2 + order));
}

/// For the photons that have no neighbours to choose their footprints by (Footprints::has_cells).
template <class Footprints, class Splatter, class Photon, class E>
[[nodiscard]] double smoothing_without_cells(const Splatter& splatter, const Pilot<Photon>& pilot,
                                             const PhotonPass& pass, bool stratified, E& executor) {
    const auto deposit_of = [&pilot](std::size_t i) {
        const Photon& photon = pilot.photons[i];
        return Footprints::has_cells(photon.sample) ? std::nullopt : photon.deposit;
    };
    return cross_validated(splatter, pilot.photons.size(), double(pass.total == 0 ? pass.count : pass.total),
                           stratified, deposit_of, executor);
}

} // namespace detail

/// The smoothing that suits a pass best as a whole, for plain splats: what `PhotonPass::smoothing` takes.
///
/// Second-order splatting chooses a footprint for each photon and asks for none of this, but for photons of lights
/// whose samples say nothing of which ones are neighbours: for those `splat_caustics` does it by itself.
///
/// ```cpp
/// pass.smoothing = nephroid::cross_validated_smoothing(scene, light, splatter, pass);
/// nephroid::splat_caustics(scene, light, splatter, pass);
/// ```
///
/// @param splatter  tells the map, the policies and the response; is left as it is
/// @param pass      of which up to 65536 photons are traced, the first; its own smoothing does not matter
/// @return  2.5 to 40 for as many photons as were compared, more for a longer pass; 8 where fewer than 64 of them land.
///          The same for any number of threads, bit for bit
/// Throws std::invalid_argument for zero photons.
///
/// A vertex is taken to show what is estimated there. Where a renderer adds several up to one pixel, each with a part
/// of the light (ghosts around a floor that repeats), the borders between the parts are taken for edges, and s is too
/// small.
///
/// Cost: tracing those photons, and splatting them onto some 32,000 of the vertices with smoothings of 2.5 up to twice
/// the one chosen: measured as one to four passes of 20,000 photons onto 512 x 512 vertices, and less than one of
/// 160,000. Memory: the photons traced, and the splatter's sums once more.
template <class S, class L, Vector3 V, Flux F, class Policies, class Response,
          detail::MustBeSequence Sequence = HaltonSequence, class E = SerialExecutor>
    requires detail::MustBeScene<S, V, Sampler<Sequence>> && Light<L> && detail::EmitsFor<L, V, F> &&
        ExecutorArgument<E>
[[nodiscard]] double cross_validated_smoothing(const S& scene, const L& light,
                                               const PhotonSplatter<V, F, Policies, Response>& splatter,
                                               const PhotonPass& pass, const Sequence& sequence = Sequence{},
                                               E&& executor = E{}) {
    detail::check(pass, "nephroid::cross_validated_smoothing");
    const auto pilot = detail::trace_pilot(scene, light, pass, SecondOrder{}, sequence, executor);
    const auto deposit_of = [&pilot](std::size_t i) { return pilot.photons[i].deposit; };
    return detail::cross_validated(splatter, pilot.photons.size(), double(pass.total == 0 ? pass.count : pass.total),
                                   Sequence::stratified, deposit_of, executor);
}

} // namespace nephroid
