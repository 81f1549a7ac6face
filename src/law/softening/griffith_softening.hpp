// SPDX-License-Identifier: BSD-3-Clause
// Griffith's law: onset and end are one, the law has a toughness only. The shape is the straight line of no length.
#pragma once

#include "law/softening/linear_softening.hpp"

namespace delam {

struct GriffithSoftening : LinearSoftening {
    static constexpr LawKind kind{"griffith", "no softening: a pair debonds at once where Y reaches Gc",
                                  Toughnesses::total};
};

}  // namespace delam
