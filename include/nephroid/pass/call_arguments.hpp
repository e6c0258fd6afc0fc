// SPDX-License-Identifier: MIT
/// @file  The optional last arguments of calls that trace photons: a sequence, an executor and others. Each is
///        recognised by its interface, so that any may be left out and they may stand in any order.
#pragma once

#include "nephroid/execution/executor.hpp"
#include "nephroid/sequence/sequence.hpp"

#include <type_traits>

namespace nephroid::detail {

struct SequenceKind {
    template <class A>
    static constexpr bool is = SampleSequence<std::remove_cvref_t<A>>;
};

struct ExecutorKind {
    template <class A>
    static constexpr bool is = ExecutorArgument<A>;
};

/// The first argument of a kind, or the fallback.
template <class Kind, class Fallback>
[[nodiscard]] constexpr auto& argument_of(Fallback& fallback) {
    return fallback;
}
template <class Kind, class Fallback, class First, class... Rest>
[[nodiscard]] constexpr auto& argument_of(Fallback& fallback, First& first, Rest&... rest) {
    if constexpr (Kind::template is<First>)
        return first;
    else
        return argument_of<Kind>(fallback, rest...);
}

/// A type that is probably meant to be a sequence, so that the error can say what it lacks.
template <class A>
concept NearlySequence = SamplesAs < std::remove_cvref_t<A>,
float > || SamplesAs<std::remove_cvref_t<A>, double> || HasStratifiedFlag<std::remove_cvref_t<A>>;

template <class A>
consteval bool explain_argument() {
    if constexpr (NearlySequence<A>)
        return explain_sequence<std::remove_cvref_t<A>>();
    else
        static_assert(NearlySequence<A>,
                      "nephroid: an argument after the pass is none of those that may stand there: splat policies "
                      "(splat/splat_policies.hpp), a sequence (sequence/sequence.hpp), an executor that can be called "
                      "as executor(count, task) (execution/executor.hpp)");
    return false;
}

template <class... Arguments>
consteval bool explain_repetition() {
    static_assert(sizeof...(Arguments) == 0, "nephroid: of splat policies, sequences and executors there may be one "
                                             "each after the pass");
    return false;
}

/// An argument of one of the kinds; otherwise an error says what is wrong.
template <class A, class... Kinds>
concept MustBeOneOf = (Kinds::template is<A> || ...) || explain_argument<A>();

/// At most one argument of a kind.
template <class Kind, class... Arguments>
concept NotRepeated = (0 + ... + int(Kind::template is<Arguments>)) <= 1 || explain_repetition<Arguments...>();

} // namespace nephroid::detail
