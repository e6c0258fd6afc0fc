// SPDX-License-Identifier: MIT
/// @file  Generates seeded chains for each group of hard cases.
#pragma once

#include "common/numerics/chain.hpp"
#include "common/numerics/fold.hpp"
#include "common/numerics/groups.hpp"

#include "nephroid/emission/aligned_basis.hpp"
#include "nephroid/vector/glm.hpp"

#include <algorithm>
#include <numbers>
#include <optional>

namespace nephroid::examples::numerics {

/// Makes chains of one group whose numbers all fit into T.
template <class T>
class Generator {
public:
    Generator(Group group, std::uint32_t seed) : group_(group), draws_(seed) {}

    /// The next chain; nothing if the random numbers give no path, because the ray misses a ball or leaves on the wrong
    /// side.
    [[nodiscard]] std::optional<Chain> next() {
        Chain chain;
        const int events = 1 + static_cast<int>(draws_.in(0, 6));
        const int special = static_cast<int>(draws_.in(0, grazes() ? events + 1 : events));
        size_ = group_ == Group::tiny_scene   ? 1e-4
                : group_ == Group::huge_scene ? 1e4
                : group_ == Group::far_away   ? 30
                                              : 1;
        emit(chain);

        Line<Wide> ray = emission(chain, 0, Wide(0));
        for (int i = 0; i <= events; ++i) {
            const bool is_special = i == special, is_receiver = i == events;
            double distance = size_ * draws_.in(0.3, 2);
            if (is_special && group_ == Group::long_transfer) {
                distance = 1e5;
                size_ = 1e3; // the rest of the path is large compared with the rounding of the flight in float
            }
            if (is_receiver && group_ == Group::near_fold) {
                const auto there = distance_to_fold(
                    chain, [this] { return (draws_.in(0, 1) < 0.5 ? -1 : 1) * log_uniform(1e-7, 1e-3); });
                if (!there)
                    return std::nullopt;
                distance = *there;
            }
            Surface<double> s = choose(is_special, is_receiver);
            const double angle = incidence(s, is_special);
            place(s, lift<double>(ray.x) + distance * lift<double>(ray.w), facing(lift<double>(ray.w), angle),
                  is_special);
            Steady steady;
            const Surface<Wide> wide = lift<Wide>(s, steady);
            const Meeting<Wide> m = meet(wide, ray, about_);
            if (!accept(s, wide, ray, m, distance, is_special, is_receiver))
                return std::nullopt;
            chain.surfaces.push_back(s);
            chain.meetings.push_back(lift<double>(m.position));
            ray = {m.position, is_receiver ? ray.w : turned(wide, ray.w, m.shade)};
        }
        return chain;
    }

private:
    [[nodiscard]] bool grazes() const { return group_ == Group::grazing_899 || group_ == Group::grazing_8999; }
    [[nodiscard]] bool is_critical() const {
        return group_ == Group::below_critical || group_ == Group::beyond_critical;
    }

    [[nodiscard]] static double rounded(double x) { return static_cast<double>(static_cast<T>(x)); }
    [[nodiscard]] static Point<double> rounded(const Point<double>& p) {
        return {rounded(p.x), rounded(p.y), rounded(p.z)};
    }
    [[nodiscard]] double log_uniform(double low, double high) {
        return std::exp(draws_.in(std::log(low), std::log(high)));
    }
    [[nodiscard]] Point<double> direction() {
        const Space d = draws_.direction();
        return {as_double(d.x), as_double(d.y), as_double(d.z)};
    }
    /// A unit vector at this angle, radian, from a unit one.
    [[nodiscard]] Point<double> tilted(const Point<double>& n, double angle) {
        const auto [u, v] = two_across(n);
        const double turn = draws_.in(0, 2 * std::numbers::pi);
        const Point<double> side = std::cos(turn) * u + std::sin(turn) * v;
        return std::cos(angle) * n + std::sin(angle) * side;
    }
    /// A normal to which a ray has this angle of incidence.
    [[nodiscard]] Point<double> facing(const Point<double>& w, double angle) { return tilted(-w, angle); }

    /// Emits from a point, from an area in one direction, or both: tangents of up to a third of the scene, or of a
    /// radian.
    void emit(Chain& chain) {
        using V = glm::vec<3, T>;
        Point<double> middle{};
        if (group_ == Group::far_away) {
            const double distance = log_uniform(1e4, 1e6);
            middle = distance * direction();
        }
        chain.position = rounded(middle + size_ * Point<double>{draws_.in(-1, 1), draws_.in(-1, 1), draws_.in(-1, 1)});
        chain.direction = rounded(direction());
        const Point<double> n = rounded(tilted(chain.direction, draws_.in(0, 1)));
        const auto narrow = [](const Point<double>& p) { return V(T(p.x), T(p.y), T(p.z)); };
        const AlignedBasis<V> basis = aligned_basis(narrow(n), narrow(chain.direction));
        const int light = static_cast<int>(draws_.in(0, 3));
        const T along = light == 0 ? T(0) : T(size_ * draws_.in(0.1, 0.3)),
                turning = light == 1 ? T(0) : T(draws_.in(0.1, 0.3));
        const auto widen = [](const V& v) { return Point<double>{double(v.x), double(v.y), double(v.z)}; };
        chain.d_position = {widen(along * basis.u), widen(along * basis.v)};
        chain.d_direction = {widen(turning * basis.theta), widen(turning * basis.phi)};
    }

    [[nodiscard]] Surface<double> choose(bool is_special, bool is_receiver) {
        Surface<double> s;
        s.kind = is_receiver ? Kind::plane : static_cast<Kind>(draws_.in(0, kind_count));
        if (is_special && group_ == Group::small_radius && !is_receiver)
            s.kind = draws_.in(0, 1) < 0.5 ? Kind::sphere : Kind::cylinder;
        s.first = draws_.in(0, 1) < 0.5;
        s.refracts = draws_.in(0, 1) < 0.6 || group_ == Group::faint_index || (is_special && is_critical());
        const double index = group_ == Group::faint_index ? 1.0001 : draws_.in(1.2, 1.8);
        s.eta = rounded(draws_.in(0, 1) < 0.5 ? index : 1 / index);
        if (is_special && is_critical())
            s.eta = rounded(index);
        else if (is_special && grazes())
            s.eta = rounded(1 / index);
        return s;
    }

    [[nodiscard]] double incidence(const Surface<double>& s, bool is_special) {
        constexpr double degree = std::numbers::pi / 180;
        if (group_ == Group::normal_incidence)
            return draws_.in(0, 1) < 0.5 ? 0 : log_uniform(1e-9, 1e-3);
        if (is_special && grazes())
            return (group_ == Group::grazing_899 ? 89.9 : 89.99) * degree;
        const double critical = s.eta > 1 ? std::asin(1 / s.eta) : 90 * degree;
        if (is_special && is_critical())
            return critical + (group_ == Group::below_critical ? -1 : 1) * log_uniform(1e-6, 1e-3);
        const double most = s.refracts ? (std::min)(75 * degree, critical - 0.1) : 75 * degree;
        return draws_.in(0, most);
    }

    /// Moves the surface through a point so that its normal there is n.
    void place(Surface<double>& s, const Point<double>& p, const Point<double>& n, bool is_special) {
        about_ = p;
        const bool small = is_special && group_ == Group::small_radius;
        const double radius = small ? 1e-4 : size_ * log_uniform(0.7, 7);
        const auto [u, v] = two_across(n);
        const double turn = draws_.in(0, 2 * std::numbers::pi);
        const Point<double> g = std::cos(turn) * u + std::sin(turn) * v;
        const Point<double> outward = s.first ? n : -n; // the ray meets a ball from outside or from inside
        switch (s.kind) {
        case Kind::plane:
            s.point[0] = p + size_ * draws_.in(-1, 1) * g;
            s.point[1] = n;
            break;
        case Kind::sphere:
            s.point[0] = p - radius * outward;
            s.number[0] = radius;
            break;
        case Kind::cylinder:
            s.point[0] = p - radius * outward + (small ? radius : size_) * draws_.in(-1, 1) * g;
            s.point[1] = g;
            s.number[0] = radius;
            break;
        case Kind::torus: {
            const double psi = draws_.in(-1.2, 1.2), ring = radius * draws_.in(1.5, 3);
            const Point<double> radial = std::cos(psi) * outward + std::sin(psi) * g;
            s.point[1] = std::sin(psi) * outward - std::cos(psi) * g;
            s.point[0] = p - radius * outward - ring * radial;
            s.number = {ring, radius};
            break;
        }
        case Kind::wave: {
            const double slope = draws_.in(-0.3, 0.3), phase = draws_.in(-1.2, 1.2);
            const double number = 1 / (size_ * draws_.in(0.5, 2)), scale = 1 / std::sqrt(1 + slope * slope);
            const Point<double> along = scale * (g - slope * n);
            s.point[1] = scale * (n + slope * g);
            s.point[2] = number * along;
            s.number[0] = slope / (number * std::cos(phase));
            s.point[0] = p - s.number[0] * std::sin(phase) * s.point[1] - (phase / number) * along;
            break;
        }
        case Kind::triangle: {
            // The face is tilted against the interpolated normal, unless the group needs the exact angle at the face.
            const bool exact = is_special && (grazes() || is_critical());
            const Point<double> face = exact ? n : tilted(n, draws_.in(0, 0.1));
            const auto [e, f] = two_across(face);
            const double bend = 1 / radius * (s.first ? 1 : -1);
            Point<double> sum{};
            for (std::size_t i = 0; i < 3; ++i) {
                const double at = turn + 2 * std::numbers::pi / 3 * double(i), reach = size_ * draws_.in(0.2, 1);
                const Point<double> offset = reach * (std::cos(at) * e + std::sin(at) * f);
                s.point[i] = p + offset;
                s.point[i + 3] = n + bend * offset;
            }
            // The vertices' normals are changed so that n is interpolated at p.
            const auto [b1, b2] = coordinates_in(s, p);
            sum = s.point[3] + b1 * (s.point[4] - s.point[3]) + b2 * (s.point[5] - s.point[3]);
            for (std::size_t i = 3; i < 6; ++i)
                s.point[i] = s.point[i] - sum + n;
            if ((s.point[1] - s.point[0]).cross(s.point[2] - s.point[0]).dot(n) < 0) {
                std::swap(s.point[1], s.point[2]);
                std::swap(s.point[4], s.point[5]);
            }
            break;
        }
        }
        for (Point<double>& q : s.point)
            q = rounded(q);
        for (double& x : s.number)
            x = rounded(x);
    }

    /// Whether the path belongs to the group.
    [[nodiscard]] bool accept(const Surface<double>& s, const Surface<Wide>& wide, const Line<Wide>& ray,
                              const Meeting<Wide>& m, double distance, bool is_special, bool is_receiver) const {
        const Point<double> off = lift<double>(Point<Wide>(m.position - ray.x)) - distance * lift<double>(ray.w);
        if (!(off.length() < 0.1 * distance))
            return false;
        const double with_face = as_double(ray.w.dot(m.face)), with_shade = as_double(ray.w.dot(m.shade));
        if (!(with_face * with_shade > 0))
            return false;
        if (is_receiver)
            return true;
        const bool passes = s.refracts && as_double(squared_cosine_beyond(wide, ray.w, m.shade)) > 0;
        const bool must_pass = s.refracts && !(is_special && group_ == Group::beyond_critical);
        if (passes != must_pass)
            return false;
        const double leaves = as_double(turned(wide, ray.w, m.shade).dot(m.face));
        return passes == (leaves * with_face > 0);
    }

    Group group_;
    Draws draws_;
    double size_ = 1;
    Point<double> about_{};
};

} // namespace nephroid::examples::numerics
