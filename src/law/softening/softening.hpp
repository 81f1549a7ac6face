// SPDX-License-Identifier: BSD-3-Clause
// The table of law kinds: one shape of softening between onset and end for each kind, one row for each shape. The file
// of a shape says what its kind is called and which parameters it has (law_kind.hpp).
#pragma once

#include <array>
#include <string>
#include <type_traits>
#include <variant>

#include "law/softening/exponential_softening.hpp"
#include "law/softening/griffith_softening.hpp"
#include "law/softening/host_softening.hpp"
#include "law/softening/law_kind.hpp"
#include "law/softening/linear_softening.hpp"
#include "law/softening/polyline_softening.hpp"

namespace delam {

using Softening = std::variant<  //
    LinearSoftening,             //
    ExponentialSoftening,        //
    TrapezoidalSoftening,        //
    TabulatedSoftening,          //
    GriffithSoftening,           //
    HostSoftening>;

namespace detail {
template <class... Shapes>
constexpr std::array<LawKind, sizeof...(Shapes)> kinds_of(std::type_identity<std::variant<Shapes...>>) {
    return {Shapes::kind...};
}
}  // namespace detail

// The kinds in the order of Softening.
inline constexpr auto law_kinds = detail::kinds_of(std::type_identity<Softening>{});

// The shape of a kind before its parameters are set; false: no kind has this name.
bool softening_of(const std::string& name, Softening& softening);

}  // namespace delam
