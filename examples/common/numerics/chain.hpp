// SPDX-License-Identifier: MIT
/// @file  The oracle: a path over a chain of surfaces, its derivatives by differences in wide precision, and their
///        condition numbers: how much they change with the numbers that define the problem.
#pragma once

#include "common/numerics/surface.hpp"

#include <vector>

namespace nephroid::examples::numerics {

/// A photon and the surfaces that it meets, the receiver last. All numbers have the precision of the library's test, so
/// they define the problem without error.
struct Chain {
    Point<double> position, direction;
    std::array<Point<double>, 2> d_position, d_direction; ///< the emission's tangents
    std::vector<Surface<double>> surfaces;
    std::vector<Point<double>> meetings; ///< points where the path meets the surfaces, in double
};

/// Perturbs nothing.
struct Steady {
    template <class... Anything>
    void number(Anything&...) const {}
    template <class... Anything>
    void point(Anything&...) const {}
    template <class... Anything>
    void unit(Anything&...) const {}
    template <class... Anything>
    void tangents(Anything&...) const {}
};

/// Perturbs each number by plus or minus `delta`, relative, as one rounding can.
class Nudge {
public:
    Nudge(double delta, std::uint32_t seed) : delta_(delta), draws_(seed) {}

    void number(Dual& x) { x.value *= 1 + change(); }
    void point(Point<Dual>& p) {
        number(p.x);
        number(p.y);
        number(p.z);
    }
    /// Perturbs the components of a computed unit vector by delta of its length.
    void unit(Point<Dual>& p) {
        p.x.value += change();
        p.y.value += change();
        p.z.value += change();
        tangents(p);
    }
    /// Perturbs the components of the derivatives by delta of their length.
    void tangents(Point<Dual>& p) {
        for (std::size_t j = 0; j < 2; ++j) {
            const double length = derivative_of(p, j).length();
            p.x.d[j] += change() * length;
            p.y.d[j] += change() * length;
            p.z.d[j] += change() * length;
        }
    }

private:
    double change() { return draws_.in(-1, 1) < 0 ? -delta_ : delta_; }

    double delta_;
    Draws draws_;
};

template <class S, class N>
[[nodiscard]] Surface<S> lift(const Surface<double>& from, N& nudge) {
    Surface<S> s{from.kind, from.first, from.refracts, S(from.eta), {}, {}};
    nudge.number(s.eta);
    for (std::size_t i = 0; i < s.point.size(); ++i) {
        s.point[i] = lift<S>(from.point[i]);
        nudge.point(s.point[i]);
    }
    for (std::size_t i = 0; i < s.number.size(); ++i) {
        s.number[i] = S(from.number[i]);
        nudge.number(s.number[i]);
    }
    return s;
}

/// The course of a path: one bit for each surface that it passed through, one for each surface whose two normals
/// disagree about the side of the arriving or leaving ray, and whether the path reached the receiver.
struct Course {
    std::uint32_t passed = 0;
    std::uint32_t torn = 0;
    bool arrived = false;

    friend bool operator==(const Course&, const Course&) = default;
};

/// The path: from the emission to the last surface, whose hit is `x`; `w` is the direction of arrival. The nudge
/// perturbs everything that one step hands to the next.
template <class S, class N>
[[nodiscard]] Line<S> follow(const Chain& chain, Line<S> ray, N& nudge, Course* course = nullptr) {
    for (std::size_t i = 0; i < chain.surfaces.size(); ++i) {
        const Surface<S> s = lift<S>(chain.surfaces[i], nudge);
        Meeting<S> m = meet(s, ray, chain.meetings[i]);
        nudge.point(m.position);
        nudge.tangents(m.position);
        ray.x = m.position;
        if (i + 1 < chain.surfaces.size()) {
            nudge.unit(m.shade);
            const Point<S> outgoing = turned(s, ray.w, m.shade);
            if (course) {
                const double face = as_double(ray.w.dot(m.face)), shade = as_double(ray.w.dot(m.shade));
                const double leaves = as_double(outgoing.dot(m.face));
                const bool passes = s.refracts && as_double(squared_cosine_beyond(s, ray.w, m.shade)) > 0;
                course->passed |= std::uint32_t(passes) << i;
                course->torn |= std::uint32_t(!(face * shade > 0) || !(passes == (leaves * face > 0))) << i;
            }
            ray.w = outgoing;
            nudge.unit(ray.w);
        }
    }
    if (course)
        course->arrived = is_finite(lift<double>(ray.x));
    return ray;
}

/// The emission in wide precision, at the value p of parameter j.
[[nodiscard]] inline Line<Wide> emission(const Chain& chain, std::size_t j, const Wide& p) {
    return {lift<Wide>(chain.position) + p * lift<Wide>(chain.d_position[j]),
            (lift<Wide>(chain.direction) + p * lift<Wide>(chain.d_direction[j])).unit()};
}

/// The four derivatives that a tangent pair has, and the determinant of the footprint.
struct Tangents {
    std::array<Point<double>, 2> d_position, d_direction;

    [[nodiscard]] const Point<double>& operator[](std::size_t i) const {
        return i < 2 ? d_position[i] : d_direction[i - 2];
    }
    static constexpr std::size_t size = 4;
};

struct Truth {
    Tangents tangents;
    std::array<double, 4> error; ///< estimated, of each
    Point<double> normal;        ///< of the receiver, unit
};

/// Central differences of the whole path, extrapolated twice; the last extrapolation's change estimates the error.
[[nodiscard]] inline Truth differentiate(const Chain& chain) {
    // The truncation error (h/ρ)^6 is negligible down to ρ = 1e-8, the rounding error is 2^-75 of the condition.
    const Wide h = power_of_two(-38);
    Truth truth{};
    Steady steady;
    for (std::size_t j = 0; j < 2; ++j) {
        std::array<Line<Wide>, 3> central;
        Wide step = h;
        for (Line<Wide>& c : central) {
            const Line<Wide> up = follow(chain, emission(chain, j, step), steady);
            const Line<Wide> down = follow(chain, emission(chain, j, -step), steady);
            const Wide inverse = Wide(0.5) / step;
            c = {inverse * (up.x - down.x), inverse * (up.w - down.w)};
            step = Wide(0.5) * step;
        }
        const auto extrapolate = [&](const Point<Wide>& a, const Point<Wide>& b, const Point<Wide>& c, std::size_t i) {
            const Wide third = Wide(1) / Wide(3), fifteenth = Wide(1) / Wide(15);
            const Point<Wide> ab = b + third * (b - a), bc = c + third * (c - b);
            const Point<Wide> best = bc + fifteenth * (bc - ab);
            truth.error[i] = as_double((best - bc).length());
            return lift<double>(best);
        };
        truth.tangents.d_position[j] = extrapolate(central[0].x, central[1].x, central[2].x, j);
        truth.tangents.d_direction[j] = extrapolate(central[0].w, central[1].w, central[2].w, j + 2);
    }
    const Surface<Wide> receiver = lift<Wide>(chain.surfaces.back(), steady);
    const Line<Wide> arriving = follow(chain, emission(chain, 0, Wide(0)), steady);
    truth.normal = lift<double>(meet(receiver, arriving, chain.meetings.back()).face);
    return truth;
}

/// The emission with its derivatives.
template <class N>
[[nodiscard]] Line<Dual> dual_emission(const Chain& chain, N& nudge) {
    const auto with = [](const Point<double>& p, const std::array<Point<double>, 2>& d) {
        return Point<Dual>{{p.x, d[0].x, d[1].x}, {p.y, d[0].y, d[1].y}, {p.z, d[0].z, d[1].z}};
    };
    Line<Dual> ray{with(chain.position, chain.d_position), with(chain.direction, chain.d_direction).unit()};
    nudge.point(ray.x);
    nudge.tangents(ray.x);
    nudge.unit(ray.w);
    return ray;
}

[[nodiscard]] inline Tangents tangents_of(const Line<Dual>& ray) {
    return {{derivative_of(ray.x, 0), derivative_of(ray.x, 1)}, {derivative_of(ray.w, 0), derivative_of(ray.w, 1)}};
}

/// The footprint's signed determinant.
[[nodiscard]] inline double determinant(const Tangents& t, const Point<double>& normal) {
    return normal.dot(t.d_position[0].cross(t.d_position[1]));
}

/// The change of each result, per unit of relative change, if every number of the problem and every number that one
/// step of the path hands to the next is changed by the same relative amount with a random sign: the root mean square,
/// which is the root of the sum of the squared effects of all numbers.
struct Sensitivity {
    std::array<double, 4> of;
    double determinant;
};

[[nodiscard]] inline Sensitivity sensitivity(const Chain& chain, const Point<double>& normal) {
    // Small against 1e-8, where a ray at 89.99 degrees just grazes a ball, and large against the rounding of double.
    constexpr double delta = 0x1p-35;
    constexpr int samples = 16;
    Steady steady;
    const Tangents base = tangents_of(follow(chain, dual_emission(chain, steady), steady));
    const double base_determinant = determinant(base, normal);
    Sensitivity sum{};
    for (std::uint32_t k = 1; k <= samples; ++k) {
        Nudge nudge(delta, 0x9e3779b9u * k | 1u);
        const Tangents moved = tangents_of(follow(chain, dual_emission(chain, nudge), nudge));
        for (std::size_t i = 0; i < Tangents::size; ++i) {
            const Point<double> change = moved[i] - base[i];
            sum.of[i] += change.dot(change);
        }
        sum.determinant += square(determinant(moved, normal) - base_determinant);
    }
    for (double& s : sum.of)
        s = std::sqrt(s / samples) / delta;
    sum.determinant = std::sqrt(sum.determinant / samples) / delta;
    return sum;
}

/// Whether perturbations of this size do not change the path's course: no missed ball, no other total reflection.
[[nodiscard]] inline bool keeps_course(const Chain& chain, double delta) {
    const auto course = [&](double change, std::uint32_t seed) {
        Nudge nudge(change, seed);
        Course result;
        (void)follow(chain, dual_emission(chain, nudge), nudge, &result);
        return result;
    };
    const Course steady = course(0, 1);
    for (std::uint32_t k = 1; k <= 16; ++k)
        if (course(delta, 0x85ebca6bu * k | 1u) != steady)
            return false;
    return steady.arrived;
}

} // namespace nephroid::examples::numerics
