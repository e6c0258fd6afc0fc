// SPDX-License-Identifier: MIT
#include "common/errors.hpp"

#include "nephroid/quality/error.hpp"
#include "nephroid/quality/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace nephroid::examples {

std::optional<Errors> errors_against(const std::vector<double>& reference, const std::vector<float>& irradiance,
                                     std::size_t width, std::size_t height) {
    if (!(std::accumulate(reference.begin(), reference.end(), 0.0) > 0))
        return std::nullopt;
    Errors errors;
    errors.relative = relative_error(irradiance, reference);
    errors.energy = energy_error(irradiance, reference);
    if ((std::min)(width, height) >= SsimOptions{}.window) {
        const PictureError error = picture_error(irradiance, reference, width, height);
        errors.rmse = error.rmse;
        errors.ssim = error.ssim;
    } else {
        const double exposure = picture_exposure(reference);
        errors.rmse = rmse(exposed(irradiance, exposure), exposed(reference, exposure));
        errors.ssim = std::nan("");
    }
    return errors;
}

} // namespace nephroid::examples
