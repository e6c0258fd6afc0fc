// SPDX-License-Identifier: MIT
/// @file  Checks of the lights' parameters, with error messages.
#pragma once

#include "nephroid/emission/flux.hpp"
#include "nephroid/emission/target.hpp"
#include "nephroid/vector/text.hpp"

#include <optional>
#include <string>

namespace nephroid::detail {

/// Checks parameters of one light; throws messages such as "nephroid::PointLight: radius -1 is not positive; pass ...".
class Validator {
public:
    explicit constexpr Validator(const char* light) : light_(light) {}

    template <Vector3 V>
    NEPHROID_NOINLINE void finite(const char* name, const V& v) const {
        if (!all_finite(v))
            complain(name, text_of(v), "is not finite; pass world coordinates");
    }

    /// Normalises a vector, which may be as short or long as the scalar type allows.
    template <Vector3 V>
    [[nodiscard]] NEPHROID_NOINLINE V direction(const char* name, const V& v) const {
        using T = scalar_t<V>;
        using t = vector_traits<V>;
        finite(name, v);
        if (!(abs(T(t::x(v))) + abs(T(t::y(v))) + abs(T(t::z(v))) > T(0)))
            complain(name, text_of(v), "has no length; pass a direction, normalised or not");
        return direction_of(v);
    }

    template <Scalar T>
    NEPHROID_NOINLINE void positive(const char* name, const T& x) const {
        if (!(x > T(0)) || !isfinite(x))
            complain(name, text_of(x), "is not positive and finite; pass world units");
    }

    template <Vector3 V>
    void target(const std::optional<BoundingSphere<V>>& bounds) const {
        sphere("target's", bounds);
    }

    /// @param whose  such as "target's"
    template <Vector3 V>
    NEPHROID_NOINLINE void sphere(const char* whose, const std::optional<BoundingSphere<V>>& bounds) const {
        if (!bounds)
            return;
        finite((std::string(whose) + " centre").c_str(), bounds->centre);
        positive((std::string(whose) + " radius").c_str(), bounds->radius);
    }

    template <Flux F>
    NEPHROID_NOINLINE void flux(const char* name, const F& f) const {
        const double power = flux_traits<F>::power(f);
        bool negative = !(power >= 0) || !std::isfinite(power);
        if constexpr (Vector3<F>) {
            using t = vector_traits<F>;
            negative = negative || t::x(f) < 0 || t::y(f) < 0 || t::z(f) < 0;
        }
        if (negative)
            complain(name, "of power " + text_of(power), "is negative or not finite; pass what the light emits");
    }

    [[noreturn]] NEPHROID_NOINLINE void complain(const char* name, const std::string& value, const char* reason) const {
        invalid_argument(std::string("nephroid::") + light_ + ": " + name + " " + value + " " + reason);
    }

private:
    const char* light_;
};

} // namespace nephroid::detail
