// SPDX-License-Identifier: MIT
/// @file  The account of a pass: every unit of emitted flux under one fate.
#pragma once

#include "nephroid/vector/language.hpp"

#include <array>
#include <cstddef>
#include <cstdint>

namespace nephroid {

/// How a photon's flux ends.
enum class Fate : unsigned char {
    splatted,   ///< onto leaves of the eye path map that the footprint may reach and that may face the photon
    unseen,     ///< on a diffuse surface, but nowhere near eye path vertices on the photon's side
    direct,     ///< on a diffuse surface without having met a specular one: direct light, not a caustic
    absorbed,   ///< by surfaces and media, or not followed by the scene's `scatter`
    escaped,    ///< out of the scene
    terminated, ///< at the bound on a path's length, or by Russian roulette (minus what survivors gain)
    collapsed,  ///< discarded by the collapse policy
    excessive,  ///< discarded by the excess policy
    invalid,    ///< a number on the path was not finite, or the last ray ran parallel to its surface
};

inline constexpr std::size_t fate_count = 9;
inline constexpr std::array<const char*, fate_count> fate_names = {
    "splatted", "unseen", "direct", "absorbed", "escaped", "terminated", "collapsed", "excessive", "invalid"};

/// Which way light came to a diffuse surface.
enum class Arrival : unsigned char {
    direct,   ///< straight from the lamp
    caustic,  ///< through mirrors and glass only
    indirect, ///< from another diffuse surface, with or without mirrors and glass before and after it
};

inline constexpr std::size_t arrival_count = 3;

/// A number of photons and their flux, in the unit of flux_traits<F>::power. The flux is a compensated sum [Kahan
/// 1965], as exact after 10⁹ photons as after one (except with -ffast-math, which drops the compensation).
struct Tally {
    std::uint64_t photons = 0;
    double flux = 0;
    double excess = 0; ///< by how much rounding has made `flux` too large

    void add(double more) {
        const double exact = more - excess, sum = flux + exact;
        excess = (sum - flux) - exact;
        flux = sum;
    }

    Tally& operator+=(const Tally& other) {
        photons += other.photons;
        add(other.flux);
        excess += other.excess;
        return *this;
    }
};

/// The result of every pass. No flux is lost silently: `emitted.flux` is the sum of `[fate].flux` over all fates, to
/// the rounding of double.
struct Statistics {
    Tally emitted;
    std::array<Tally, fate_count> fates{};
    /// What diffuse surfaces received, if photons go on from them (`follows_bounces` of a visitor). That is no fate: a
    /// photon may arrive many times. On average the sum of received · (1 − albedo) is what these surfaces absorbed.
    std::array<Tally, arrival_count> received{};
    std::uint64_t rays = 0;            ///< traced
    std::uint64_t specular_events = 0; ///< reflections and refractions
    std::uint64_t diffuse_events = 0;  ///< arrivals at surfaces that may send light on (Event::diffuse)
    std::uint64_t diffuse_bounces = 0; ///< photons that these surfaces sent on
    std::uint64_t branches = 0;        ///< additional ways, if all ways are followed: the fates count this many photons
                                       ///< more than were emitted
    std::uint64_t corrected_normals = 0; ///< events that used the geometric normal, because the shading normal sent the
                                         ///< ray to the wrong side of the surface
    std::uint64_t hits_at_start = 0;  ///< surfaces met at the ray's origin: a surface that touches the one left, or the
                                      ///< same surface again; not counted in scenes with Contacts
    std::uint64_t opaque_first = 0;   ///< photons whose first surface was neither a mirror nor glass
    std::uint64_t escaped_first = 0;  ///< photons that escaped before any reflection, refraction or deposit
    std::uint64_t bounded_shifts = 0; ///< shifts of second-order splats that were shortened
    std::uint64_t splatted_as_published = 0; ///< photons that second order left unshifted, with `default_smoothing`:
                                             ///< neighbours contradicted the fit, an area light had too few, or
                                             ///< its photons predict each other better so
    std::uint64_t bounded_footprints = 0;    ///< footprints that the excess or the collapse policy changed
    std::uint64_t invalid_albedos = 0; ///< photons that met an albedo that is negative, above 1 in a band, or no number
    double invalid_albedo = 0; ///< the first of these albedos, as the power of the flux it left over that before
    std::uint64_t invalid_albedo_surface = 0; ///< `surface` of the hit there, if hits have it

    [[nodiscard]] const Tally& operator[](Fate fate) const { return fates[std::size_t(fate)]; }
    [[nodiscard]] const Tally& operator[](Arrival arrival) const { return received[std::size_t(arrival)]; }

    /// Photons that reached a diffuse surface by way of a specular one: the papers' n.
    [[nodiscard]] std::uint64_t caustic_photons() const {
        return (*this)[Fate::splatted].photons + (*this)[Fate::unseen].photons + (*this)[Fate::collapsed].photons +
               (*this)[Fate::excessive].photons;
    }

    [[nodiscard]] double accounted_flux() const {
        double sum = 0;
        for (const Tally& tally : fates)
            sum += tally.flux;
        return sum;
    }

    /// Books the end of a photon that carries this flux.
    void end(Fate fate, double flux) {
        Tally& tally = fates[std::size_t(fate)];
        ++tally.photons;
        tally.add(flux);
    }

    /// Books the arrival of a photon at a diffuse surface.
    void arrive(Arrival arrival, double flux) {
        Tally& tally = received[std::size_t(arrival)];
        ++tally.photons;
        tally.add(flux);
    }

    /// Books flux that a photon loses while it goes on.
    void lose(Fate fate, double flux) { fates[std::size_t(fate)].add(flux); }

    Statistics& operator+=(const Statistics& other) {
        emitted += other.emitted;
        for (std::size_t i = 0; i < fate_count; ++i)
            fates[i] += other.fates[i];
        for (std::size_t i = 0; i < arrival_count; ++i)
            received[i] += other.received[i];
        rays += other.rays;
        specular_events += other.specular_events;
        diffuse_events += other.diffuse_events;
        diffuse_bounces += other.diffuse_bounces;
        branches += other.branches;
        corrected_normals += other.corrected_normals;
        hits_at_start += other.hits_at_start;
        opaque_first += other.opaque_first;
        escaped_first += other.escaped_first;
        bounded_shifts += other.bounded_shifts;
        splatted_as_published += other.splatted_as_published;
        bounded_footprints += other.bounded_footprints;
        if (invalid_albedos == 0) {
            invalid_albedo = other.invalid_albedo;
            invalid_albedo_surface = other.invalid_albedo_surface;
        }
        invalid_albedos += other.invalid_albedos;
        return *this;
    }
};

} // namespace nephroid
