// SPDX-License-Identifier: MIT
#include "common/errors.hpp"

#include "nephroid/quality/error.hpp"
#include "nephroid/quality/exposure.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>
#include <string>

namespace nephroid::examples {

namespace {
template <class T>
[[nodiscard]] std::vector<T> mean_of_channels(const Samples& image) {
    std::vector<T> result(image.width * image.height);
    for (std::size_t i = 0; i < result.size(); ++i) {
        double sum = 0;
        for (std::size_t c = 0; c < image.channels; ++c)
            sum += double(image.samples[i * image.channels + c]);
        result[i] = T(sum / double(image.channels));
    }
    return result;
}
} // namespace

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

std::optional<Errors> errors_against(const Samples& reference, const Samples& picture) {
    const auto size = [](const Samples& s) { return std::to_string(s.width) + " x " + std::to_string(s.height); };
    if (reference.width != picture.width || reference.height != picture.height)
        throw std::runtime_error("the reference has " + size(reference) + " pixels and the picture " + size(picture) +
                                 "; they must be of one size");
    const auto truth = mean_of_channels<double>(reference);
    if (!std::all_of(truth.begin(), truth.end(), [](double e) { return std::isfinite(e); }))
        throw std::runtime_error("the reference has pixels that are not finite");
    return errors_against(truth, mean_of_channels<float>(picture), picture.width, picture.height);
}

} // namespace nephroid::examples
