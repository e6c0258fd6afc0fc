// SPDX-License-Identifier: MIT
/// @file  The optional arguments after the pass in calls that splat: policies, a sequence, an executor, in any order.
#pragma once

#include "nephroid/execution/checked_executor.hpp"
#include "nephroid/execution/task_runner.hpp"
#include "nephroid/footprint/check_kernel.hpp"
#include "nephroid/pass/call_arguments.hpp"
#include "nephroid/sequence/halton.hpp"
#include "nephroid/splat/splat_policies.hpp"

#include <type_traits>
#include <utility>

namespace nephroid::detail {

struct PoliciesKind {
    template <class A>
    static constexpr bool is = is_splat_policies<std::remove_cvref_t<A>>;
};

/// Splat policies, a sequence or an executor; otherwise an error says what is wrong.
template <class A>
concept MustBeSplatArgument = MustBeOneOf<A, PoliciesKind, SequenceKind, ExecutorKind>;

/// At most one of each.
template <class... Arguments>
concept MustNotRepeat = NotRepeated<PoliciesKind, Arguments...> && NotRepeated<SequenceKind, Arguments...> &&
    NotRepeated<ExecutorKind, Arguments...>;

/// The type of the policies among the arguments.
template <class DefaultPolicies, class... Arguments>
using policies_among = std::remove_cvref_t<decltype(argument_of<PoliciesKind>(std::declval<const DefaultPolicies&>(),
                                                                              std::declval<Arguments&>()...))>;

/// The type of the sequence among the arguments.
template <class... Arguments>
using sequence_among = std::remove_cvref_t<decltype(argument_of<SequenceKind>(std::declval<const HaltonSequence&>(),
                                                                              std::declval<Arguments&>()...))>;

/// Calls use(policies, sequence, executor): each is the one among the arguments, or the default. The executor is held
/// to running each task once, and the kernel to its integral: std::invalid_argument. It is passed behind one type, so
/// that what it runs is compiled once for all executors.
///
/// @tparam Kind  of policies
template <class DefaultPolicies, class Kind = PoliciesKind, class Use, class... Arguments>
decltype(auto) with_splat_arguments(const Use& use, Arguments&... arguments) {
    const DefaultPolicies policies{};
    const HaltonSequence sequence{};
    const SerialExecutor executor{};
    CheckedExecutor checked(argument_of<ExecutorKind>(executor, arguments...));
    const TaskRunner runner(checked);
    const auto& chosen = argument_of<Kind>(policies, arguments...);
    check_kernel(chosen.kernel);
    return use(chosen, argument_of<SequenceKind>(sequence, arguments...), runner);
}

} // namespace nephroid::detail
