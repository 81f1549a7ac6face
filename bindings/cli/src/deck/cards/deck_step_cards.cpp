// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/deck_step_cards.hpp"

#include <algorithm>
#include <array>

#include <fmt/format.h>

#include "deck/abaqus/abaqus_cards.hpp"

namespace cli::abaqus {

namespace {

const std::pair<const char*, std::vector<int>> named_supports[] = {{"ENCASTRE", {1, 2, 3, 4, 5, 6}},
                                                                   {"PINNED", {1, 2, 3}},
                                                                   {"XSYMM", {1, 5, 6}},
                                                                   {"YSYMM", {2, 4, 6}},
                                                                   {"ZSYMM", {3, 4, 5}},
                                                                   {"XASYMM", {2, 3, 4}},
                                                                   {"YASYMM", {1, 3, 5}},
                                                                   {"ZASYMM", {1, 2, 6}}};

// Load steps of a step whose increments have no upper limit below the whole step: enough points for a curve, at a
// fiftieth of its load; 25 halves the time and the points, 100 doubles both (ctest -R cli_decks).
constexpr double free_steps = 50;
// Least number of load steps where the deck limits its increments to a larger part of the step; half as many draw
// corners into a curve, twice as many take more time than the deck asks for (ctest -R cli_decks).
constexpr double fewest_steps = 10;

}  // namespace

bool StepReader::take(const InpCard& card) {
    using Take = void (StepReader::*)(const InpCard&);
    static const std::pair<const char*, Take> known[] = {
        {"AMPLITUDE", &StepReader::take_amplitude}, {"BOUNDARY", &StepReader::take_boundary},
        {"CLOAD", &StepReader::take_forces},        {"DSLOAD", &StepReader::take_distributed},
        {"DLOAD", &StepReader::take_pressures},     {"DYNAMIC", &StepReader::take_procedure},
        {"END STEP", &StepReader::end_step},        {"STATIC", &StepReader::take_procedure},
        {"STEP", &StepReader::take_step},           {"TEMPERATURE", &StepReader::take_temperature},
    };
    for (const auto& [keyword, function] : known)
        if (card.keyword == keyword) {
            (this->*function)(card);
            return true;
        }
    return false;
}

void StepReader::take_amplitude(const InpCard& card) {
    Amplitude amplitude;
    amplitude.name = card.required("NAME");
    amplitude.place = card.place;
    amplitude.total_time = card.parameter("TIME") == "TOTAL TIME";
    amplitude.absolute = card.parameter("VALUE") == "ABSOLUTE";
    amplitude.smooth = card.parameter("DEFINITION") == "SMOOTH STEP";
    if (card.has("SMOOTH")) say_once(deck_.changed, "*AMPLITUDE, SMOOTH: straight lines between its points");
    if (card.parameter("DEFINITION") == "EQUALLY SPACED") return take_equally_spaced(card, std::move(amplitude));
    const Numbers values = card.row();
    if (values.size() < 2 || values.size() % 2 != 0)
        throw SceneFailure(card.place, "pairs of time and value are expected");
    for (std::size_t i = 0; i < values.size(); i += 2) {
        if (i > 0 && !(values[i] > values[i - 2]))
            throw SceneFailure(card.place, fmt::format("time {} after {}: times must grow", values[i], values[i - 2]));
        amplitude.points.emplace_back(values[i], values[i + 1]);
    }
    deck_.amplitudes.push_back(std::move(amplitude));
}

void StepReader::take_equally_spaced(const InpCard& card, Amplitude amplitude) {
    const double interval = inp_number(card.required("FIXED INTERVAL"), card.place);
    const double begin = card.has("BEGIN") ? inp_number(card.required("BEGIN"), card.place) : 0.0;
    if (!(interval > 0)) throw SceneFailure(card.place, fmt::format("FIXED INTERVAL={}: must be > 0", interval));
    for (const double value : card.row())
        amplitude.points.emplace_back(begin + interval * static_cast<double>(amplitude.points.size()), value);
    if (amplitude.points.empty()) throw SceneFailure(card.place, "values are expected");
    deck_.amplitudes.push_back(std::move(amplitude));
}

void StepReader::take_step(const InpCard& card) {
    Step step;
    step.name = card.parameter("NAME");
    step.place = card.place;
    if (card.has("AMPLITUDE")) step.ramp = card.required("AMPLITUDE") == "RAMP";
    if (card.has("NLGEOM")) step.large = upper(card.parameter("NLGEOM")) != "NO";
    deck_.steps.push_back(std::move(step));
    in_step_ = true;
}

Step& StepReader::step(const InpCard& card) {
    if (!in_step_) throw SceneFailure(card.place, "a *STEP is expected first");
    return deck_.steps.back();
}
void StepReader::end_step(const InpCard& card) {
    const Step& ended = step(card);
    if (!ended.procedure)
        throw SceneFailure(ended.place, "the step has no procedure: *STATIC, or *DYNAMIC, APPLICATION=QUASI-STATIC");
    in_step_ = false;
}

void StepReader::take_procedure(const InpCard& card) {
    Step& s = step(card);
    s.procedure = true;
    if (card.has("RIKS")) {
        s.riks = true;
        s.increment = s.period / free_steps;
        say_once(deck_.changed,
                 "RIKS: load steps to the displacements of the step (load proportionality factor 1), over a time of 1; "
                 "jumps are found by energy");
        return;
    }
    if (card.keyword == "DYNAMIC") {
        if (card.parameter("APPLICATION") != "QUASI-STATIC")
            throw SceneFailure(card.place, "dynamic steps are not imported, but for APPLICATION=QUASI-STATIC");
        say_once(deck_.changed, "*DYNAMIC: without inertia");
    }
    if (card.has("STABILIZE"))
        say_once(deck_.changed, "STABILIZE: no viscosity; jumps of the crack are found by energy");
    if (card.lines.size() > 1) throw SceneFailure(card.lines[1].place, "one line is expected");
    Numbers values = card.lines.empty() ? Numbers{} : card.lines[0].numbers();
    values.resize(std::max<std::size_t>(values.size(), 4), 0.0);
    for (std::size_t i = 0; i < 4; ++i)
        if (values[i] < 0)
            throw SceneFailure(card.lines[0].place, fmt::format("{} in a line of increments: must be >= 0", values[i]));
    const auto [first, period, least, largest] = std::array{values[0], values[1], values[2], values[3]};
    if (period > 0) s.period = period;
    if (card.has("DIRECT")) {
        s.increment = first > 0 ? std::min(first, s.period) : s.period;
        return;
    }
    if (least > 0 && largest > 0 && least > largest)
        throw SceneFailure(card.lines[0].place,
                           fmt::format("the least increment, {}, is larger than the largest, {}", least, largest));
    // Abaqus begins with the first increment and chooses those behind it up to the largest; here the library takes
    // shorter substeps where it needs them.
    const bool limited = largest > 0 && largest < s.period;
    s.increment = std::max(limited ? std::min(largest, s.period / fewest_steps) : s.period / free_steps, least);
    s.increment = std::min(s.increment, s.period);
    s.least_increment = std::min(least, s.increment);
}

std::vector<LoadLine>& StepReader::boundaries() { return in_step_ ? deck_.steps.back().boundaries : deck_.held; }

// OP=NEW: what earlier steps have prescribed ends, unless this step gives it again.
bool StepReader::renews(const InpCard& card) { return card.parameter("OP") == "NEW"; }

void StepReader::take_boundary(const InpCard& card) {
    if (renews(card)) {
        step(card).new_boundaries = true;
        step(card).renewed = card.place;
    }
    const bool rate = card.parameter("TYPE") == "VELOCITY";
    if (rate && card.has("AMPLITUDE"))
        throw SceneFailure(card.place, "VELOCITY with AMPLITUDE is not imported: give displacements, its integral");
    if (rate)
        say_once(deck_.changed, "VELOCITY: displacements that grow evenly, by the velocity times the time of the step");
    const bool fixed = card.has("FIXED");
    if (fixed && !in_step_) throw SceneFailure(card.place, "FIXED is expected within a *STEP");
    for (const InpLine& line : card.lines) {
        if (line.fields.size() < 2)
            throw SceneFailure(line.place, "a node or set and a degree of freedom are expected");
        LoadLine load;
        load.where = {&root_, line.fields[0], line.place};
        load.amplitude = card.parameter("AMPLITUDE");
        load.rate = rate;
        load.fixed = fixed;
        for (const auto& [name, dofs] : named_supports)
            if (upper(line.fields[1]) == name) {
                load.named = true;
                for (const int dof : dofs) {
                    load.first = load.last = dof;
                    boundaries().push_back(load);
                }
                load.first = -1;
            }
        if (load.first < 0) continue;
        load.first = load.last = degree_of_freedom(line.fields[1], 6, line.place);
        if (line.fields.size() > 2 && !line.fields[2].empty())
            load.last = degree_of_freedom(line.fields[2], 6, line.place);
        if (load.last < load.first)
            throw SceneFailure(line.place, fmt::format("degrees of freedom {} to {}: none", load.first, load.last));
        if (line.fields.size() > 3) load.magnitude = inp_number(line.fields[3], line.place);
        if (!in_step_ && load.magnitude != 0)
            throw SceneFailure(line.place, "a displacement other than 0 is expected within a *STEP");
        boundaries().push_back(std::move(load));
    }
}

// With forces alone the factor to which RIKS goes is not known.
void StepReader::require_displacements(const InpCard& card) {
    if (step(card).riks && !card.lines.empty())
        throw SceneFailure(card.place,
                           "forces in a step with RIKS are not imported: prescribe displacements, with which jumps are "
                           "found by energy");
}

void StepReader::take_forces(const InpCard& card) {
    if (renews(card)) step(card).new_forces = true;
    require_displacements(card);
    for (const InpLine& line : card.lines) {
        if (line.fields.size() < 3)
            throw SceneFailure(line.place, "a node or set, a degree of freedom and a force are expected");
        if (std::any_of(line.fields.begin() + 3, line.fields.end(), [](const std::string& f) { return !f.empty(); }))
            throw SceneFailure(line.place, "3 values are expected: a line for each degree of freedom");
        LoadLine load;
        load.where = {&root_, line.fields[0], line.place};
        load.amplitude = card.parameter("AMPLITUDE");
        load.first = load.last = degree_of_freedom(line.fields[1], 6, line.place);
        load.magnitude = inp_number(line.fields[2], line.place);
        step(card).forces.push_back(std::move(load));
    }
}

void StepReader::take_distributed(const InpCard& card) {
    if (renews(card)) step(card).new_distributed = true;
    require_displacements(card);
    for (const InpLine& line : card.lines) {
        if (line.fields.size() < 3)
            throw SceneFailure(line.place, "a surface, P or TRVEC, and a magnitude are expected");
        LoadLine load;
        load.where = {&root_, line.fields[0], line.place};
        load.amplitude = card.parameter("AMPLITUDE");
        load.distributed = upper(line.fields[1]);
        if (load.distributed != "P" && load.distributed != "TRVEC")
            throw SceneFailure(line.place, "\"" + line.fields[1] + "\" is not imported: P and TRVEC are");
        load.magnitude = inp_number(line.fields[2], line.place);
        if (load.distributed == "TRVEC") load.direction = line.numbers(3);
        step(card).forces.push_back(std::move(load));
    }
}

void StepReader::take_pressures(const InpCard& card) {
    if (renews(card)) step(card).new_distributed = true;
    require_displacements(card);
    for (const InpLine& line : card.lines) {
        const std::string kind = line.fields.size() > 1 ? upper(line.fields[1]) : "";
        if (kind == "GRAV" || kind == "CENTRIF" || kind == "CENT" || kind.starts_with("B"))
            throw SceneFailure(line.place, "\"" + line.fields[1] +
                                               "\" is not imported: pressures on sides, P1 .. P6, are; forces on the "
                                               "volume stay out, give their sum to a surface (*DSLOAD, TRVEC)");
        if (line.fields.size() != 3)
            throw SceneFailure(line.place,
                               "an element or a set of them, a side (P1 .. P6) and a pressure are expected");
        LoadLine load;
        const std::string surface = pressed_surface(line.fields[0], line.fields[1]);
        if (surface.empty())
            throw SceneFailure(line.place,
                               "\"" + line.fields[1] + "\" is not imported: pressures on sides, P1 .. P6, are");
        load.where = {&root_, surface, line.place};
        load.amplitude = card.parameter("AMPLITUDE");
        load.distributed = "P";
        load.magnitude = inp_number(line.fields[2], line.place);
        step(card).forces.push_back(std::move(load));
    }
}

void StepReader::take_temperatures(const InpCard& card, const Part& root, std::vector<LoadLine>& lines) {
    for (const InpLine& line : card.lines) {
        if (line.fields.size() != 2)
            throw SceneFailure(line.place,
                               "a node or set and one temperature are expected: temperatures through the "
                               "thickness are not imported");
        LoadLine load;
        load.where = {&root, line.fields[0], line.place};
        load.amplitude = card.parameter("AMPLITUDE");
        load.magnitude = inp_number(line.fields[1], line.place);
        lines.push_back(std::move(load));
    }
}

void StepReader::take_temperature(const InpCard& card) {
    const bool earlier = std::any_of(deck_.steps.begin(), deck_.steps.end(),
                                     [](const Step& each) { return !each.temperatures.empty(); });
    if (renews(card) && earlier)
        throw SceneFailure(card.place, "OP=NEW of temperatures is not imported: give all temperatures of this step");
    take_temperatures(card, root_, step(card).temperatures);
}

}  // namespace cli::abaqus
