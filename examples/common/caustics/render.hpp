// SPDX-License-Identifier: MIT
/// @file  From a scene, a light and an eye path map to sums at the vertices: the pilot pass and the real one, timed.
#pragma once

#include "common/caustic_photons.hpp"
#include "common/caustics/passes.hpp"
#include "common/caustics/report.hpp"
#include "common/stopwatch.hpp"

#include "nephroid/caustics.hpp"
#include "nephroid/smoothing/cross_validated_smoothing.hpp"

#include <stdexcept>
#include <type_traits>
#include <utility>
#include <variant>

namespace nephroid::examples {

using AnyKernel = std::variant<BiweightKernel, EpanechnikovKernel, ConeKernel, UniformKernel, TruncatedGaussianKernel>;

[[nodiscard]] inline AnyKernel make_kernel(const Options& options) {
    switch (options.kernel) {
    case KernelKind::epanechnikov:
        return EpanechnikovKernel{};
    case KernelKind::cone:
        return ConeKernel{};
    case KernelKind::uniform:
        return UniformKernel{};
    case KernelKind::gaussian:
        return TruncatedGaussianKernel{};
    default:
        return BiweightKernel{};
    }
}

/// Calls use(policies) with the splat policies that the options ask for.
///
/// @param repeats  whether the scene repeats over the light's patch
/// @tparam curves  whether footprints may be in pieces
template <bool curves = true, class K, class Use>
void with_policies(const Options& options, const K& kernel, bool repeats, Use&& use) {
    const PixelFilter filter{options.pixel_filter ? 1.0 : 0.0};
    if (options.first_order)
        use(Published{.filter = filter}.with_kernel(kernel));
    else if constexpr (std::same_as<K, BiweightKernel>) { // for the others the options insist on first order
        const SecondOrder order{.domain_repeats = repeats};
        if constexpr (curves)
            if (options.curved)
                return use(Default{.filter = filter}.with_order(CurvedFootprints{order}));
        use(Default{.filter = filter, .order = order});
    }
}

/// Traces and splats the photons that the options ask for.
///
/// @param repeats    whether the scene repeats over the light's patch
/// @param pixels_of  pixels_of(sums) -> the layer's pixels
/// @return  a PassedLayer
template <Flux F, class S, Light L, Vector3 V, class PixelsOf>
auto splat_caustics_timed(const S& scene, const L& light, const EyePathMap<V>& map, const WalkLimits& limits,
                          const Options& options, bool repeats, ThreadExecutor& threads, Report& report,
                          const PixelsOf& pixels_of) {
    using Pixel = typename std::invoke_result_t<const PixelsOf&, const Sums<V, F>&>::value_type;
    PassedLayer<Pixel> layer;
    std::visit(
        [&](const auto& kernel, const auto& sequence) {
            if (!(light.power() > 0))
                throw std::runtime_error("the lights emit nothing: their intensity or emission is zero");
            Stopwatch stopwatch;
            std::uint64_t emit = options.emit.value_or(0);
            if (emit == 0)
                emit = emit_for(scene, light, options.photons, limits, sequence, threads);
            report.seconds.pilot += stopwatch.lap();

            PhotonPass pass{.count = emit, .smoothing = options.smoothing, .limits = limits};
            with_policies<!nephroid::detail::has_wavelength<nephroid::detail::parameters_t<L>>>(
                options, kernel, repeats, [&](const auto& policies) {
                    TimingExecutor timing(threads);
                    auto sums = nephroid::sums<F>(map);
                    if constexpr (std::is_same_v<nephroid::detail::parameters_t<L>, NoParameters>)
                        if (options.cross_validated)
                            pass.smoothing =
                                cross_validated_smoothing(scene, light, sums, pass, policies, sequence, timing);
                    report.smoothing =
                        options.first_order ? pass.smoothing.value_or(default_smoothing) : pass.smoothing;
                    layer = trace_passes(
                        options.error, emit,
                        [&](std::uint64_t first, const auto& progress) {
                            sums.clear();
                            pass.first = first;
                            pass.progress = progress;
                            const Statistics of_pass =
                                nephroid::caustics(scene, light, sums, pass, policies, sequence, timing);
                            report.statistics += of_pass;
                            return of_pass.emitted.photons;
                        },
                        [&] { return pixels_of(std::as_const(sums)); });
                    report.seconds.trace += timing.trace_seconds();
                    report.seconds.fit += timing.fit_seconds();
                    report.seconds.splat += timing.splat_seconds();
                    report.caustic_passes = layer.report;
                    divide_flux(report.statistics, layer.report.passes);
                    report.interrupted = report.interrupted || layer.report.is_interrupted;
                });
        },
        make_kernel(options), make_sequence(options.sequence, options.seed));
    return layer;
}

} // namespace nephroid::examples
