// SPDX-License-Identifier: BSD-3-Clause
// The zones that a jump operator offers: systems about rows that change, with everything else minimised out.
#pragma once

#include <cstdint>
#include <span>

#include "reduction/operator/response.hpp"

namespace delam {

struct ZoneTraits {
    bool whole = false;     // every zone has all rows, and its cost does not depend on those that are wanted
    double rounding = 0.0;  // the largest change of an adhesion that may be the rounding of a zone, whose minimiser is
                            // then not quite that of JumpOperator::solve(); 0: they are one
};

class Zones {
public:
    virtual ~Zones() = default;
    virtual ZoneTraits zone_traits() const = 0;
    // Returns a system about the wanted rows [rows], with everything else minimised out at these springs, for
    // minimisers that change springs and contact there; null: none this time. It is valid until the next call of
    // zone(), part(), or of solve() or recall() of the operator. tight: takes no existing zone that is much larger
    // than necessary, and chooses no larger one.
    virtual Zone* zone(const Springs& springs, std::span<const std::uint8_t> wanted, bool tight) = 0;
    // Sets the response of all bodies to a solution of the last zone(). springs: those of the solution, and outside
    // the zone those of its choice. False: not set, because zones are whole, or it would take another solve.
    virtual bool complete(const Springs& /*springs*/, std::span<const double> /*theta*/,
                          const Zone::Solution& /*solution*/, Response& /*response*/) const {
        return false;
    }
    // Returns a zone in which only the bodies about the wanted rows are free, and all else is where the response has
    // it: what lowers the energy there lowers that of the whole. Null: that is not much cheaper, or not offered.
    virtual Zone* part(std::span<const double> /*theta*/, const Response& /*response*/,
                       std::span<const std::uint8_t> /*wanted*/) {
        return nullptr;
    }
};

}  // namespace delam
