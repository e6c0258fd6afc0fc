// SPDX-License-Identifier: MIT
#include "common/study/relax/blue_noise.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace nephroid::examples::study::relax {

namespace {

using Points = std::vector<std::array<double, 2>>;

/// The photons by window of a grid of `side` × `side` windows, each from 0 to 1; the last ones of the grid are left
/// out.
[[nodiscard]] std::vector<Points> windows_of(const std::vector<StoredPhoton>& photons,
                                             const std::array<double, 4>& floor) {
    constexpr std::size_t side = 4;
    static_assert(side * side >= spectral_windows);
    const auto& [x_min, x_max, y_min, y_max] = floor;
    const double window = (std::min)(x_max - x_min, y_max - y_min) / side;
    const double left = 0.5 * (x_min + x_max) - 0.5 * side * window, low = 0.5 * (y_min + y_max) - 0.5 * side * window;
    std::vector<Points> windows(spectral_windows);
    for (const StoredPhoton& photon : photons) {
        const double x = (static_cast<double>(photon.position.x) - left) / window;
        const double y = (static_cast<double>(photon.position.y) - low) / window;
        if (!(x >= 0 && x < side && y >= 0 && y < side))
            continue;
        const std::size_t number = static_cast<std::size_t>(y) * side + static_cast<std::size_t>(x);
        if (number < windows.size())
            windows[number].push_back({x - std::floor(x), y - std::floor(y)});
    }
    return windows;
}

} // namespace

BlueNoise blue_noise(const std::vector<StoredPhoton>& photons, const std::array<double, 4>& floor,
                     ThreadExecutor& threads) {
    const std::vector<Points> windows = windows_of(photons, floor);
    std::size_t points = 0;
    for (const Points& window : windows) {
        if (window.size() < 16)
            throw std::runtime_error("--spectrum: there are too few photons on that floor for a spectrum");
        points += window.size();
    }
    const double principal = principal_frequency(static_cast<double>(points) / spectral_windows);
    PowerSpectrum spectrum((std::min)(std::size_t(4096), static_cast<std::size_t>(2 * principal) + 2),
                           SpectralWindow::hann);
    for (const Points& window : windows)
        spectrum.add(window, threads);

    BlueNoise result{std::move(spectrum), {}, principal, 0, 0, 0};
    result.annuli = result.spectrum.radial();
    result.low_power = result.spectrum.band_power(BlueNoise::least_frequency(), 0.5 * principal);
    double sum = 0, frequencies = 0;
    for (const Annulus& annulus : result.annuli) {
        if (annulus.frequency < BlueNoise::least_frequency() || annulus.frequency > 2 * principal)
            continue;
        const double count = static_cast<double>(annulus.frequencies);
        sum += count * annulus.anisotropy;
        frequencies += count;
        if (annulus.frequencies >= 64)
            result.worst_anisotropy = (std::max)(result.worst_anisotropy, annulus.anisotropy);
    }
    result.anisotropy = sum / frequencies;
    return result;
}

} // namespace nephroid::examples::study::relax
