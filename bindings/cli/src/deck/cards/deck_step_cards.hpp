// SPDX-License-Identifier: BSD-3-Clause
// The cards of steps, and of amplitudes, which steps use.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "deck/abaqus/inp_cards.hpp"
#include "deck/cards/deck.hpp"

namespace cli::abaqus {

class StepReader {
public:
    // root: the scope of the sets that steps name.
    StepReader(Deck& deck, const Part& root) : deck_(deck), root_(root) {}

    // The lines of a card of temperatures: a node or set, and one temperature.
    static void take_temperatures(const InpCard& card, const Part& root, std::vector<LoadLine>& lines);

    // False: the card does not belong to a step.
    bool take(const InpCard& card);

private:
    void take_amplitude(const InpCard& card);
    // amplitude: all but its points.
    void take_equally_spaced(const InpCard& card, Amplitude amplitude);
    void take_step(const InpCard& card);
    void end_step(const InpCard& card);
    void take_temperature(const InpCard& card);
    void take_procedure(const InpCard& card);
    void take_boundary(const InpCard& card);
    void take_forces(const InpCard& card);
    void take_distributed(const InpCard& card);
    void take_pressures(const InpCard& card);
    void require_displacements(const InpCard& card);
    Step& step(const InpCard& card);
    std::vector<LoadLine>& boundaries();
    // OP=NEW: what earlier steps have prescribed ends, unless this step gives it again.
    static bool renews(const InpCard& card);

    Deck& deck_;
    const Part& root_;
    bool in_step_ = false;
};

}  // namespace cli::abaqus
