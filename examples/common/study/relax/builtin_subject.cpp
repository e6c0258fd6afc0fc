// SPDX-License-Identifier: MIT
#include "common/study/relax/subject.hpp"

#include "common/builtin_film.hpp"
#include "common/study/relax/stored_photons.hpp"

namespace nephroid::examples::study::relax {

namespace {

/// Repeats what lies within `margin` of the unit square's border on its other side, as a floor of period 1 has it.
void repeat(std::vector<StoredPhoton>& photons, float margin) {
    const std::size_t count = photons.size();
    for (std::size_t i = 0; i < count; ++i)
        for (int dx = -1; dx <= 1; ++dx)
            for (int dy = -1; dy <= 1; ++dy) {
                StoredPhoton photon = photons[i];
                photon.position.x += static_cast<float>(dx);
                photon.position.y += static_cast<float>(dy);
                const auto is_near = [&](float place) { return place > -margin && place < 1 + margin; };
                if ((dx != 0 || dy != 0) && is_near(photon.position.x) && is_near(photon.position.y))
                    photons.push_back(photon);
            }
}

} // namespace

Subject builtin_subject(const Options& options, ThreadExecutor& threads) {
    const BuiltinCase<float, Color> builtin = builtin_case<float, Color>(options.subject, false).value();
    const BuiltinFilm film{.scene = options.subject,
                           .view = builtin.film,
                           .width = options.width,
                           .height = options.height,
                           .samples = options.samples};
    Subject subject;
    subject.photons = stored_photons(builtin.scene, builtin.light, walk_limits(film), options, threads);
    if (builtin.periodic)
        repeat(subject.photons, 0.15f);
    subject.width = options.width;
    subject.height = options.height;
    subject.floor = builtin.film;
    subject.vertices = eye_vertices(film);
    subject.truth = exact_picture(film, options.threads);
    if (!subject.truth)
        subject.notes.push_back("the exact picture of " + options.subject + " is not known, so no errors are given");
    return subject;
}

} // namespace nephroid::examples::study::relax
