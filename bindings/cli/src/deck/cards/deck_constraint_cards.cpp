// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/deck_constraint_cards.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>

#include <fmt/format.h>

namespace cli::abaqus {

bool ConstraintReader::take(const InpCard& card) {
    using Take = void (ConstraintReader::*)(const InpCard&);
    static const std::pair<const char*, Take> known[] = {
        {"COUPLING", &ConstraintReader::take_coupling},  {"DISTRIBUTING", &ConstraintReader::take_distributing},
        {"EQUATION", &ConstraintReader::take_equation},  {"KINEMATIC", &ConstraintReader::take_kinematic},
        {"MPC", &ConstraintReader::take_pins},           {"RIGID BODY", &ConstraintReader::take_rigid_body},
        {"TRANSFORM", &ConstraintReader::take_transform}};
    if (card.keyword != "KINEMATIC" && card.keyword != "DISTRIBUTING") finish();
    for (const auto& [keyword, function] : known)
        if (card.keyword == keyword) {
            (this->*function)(card);
            return true;
        }
    return false;
}

void ConstraintReader::finish() const {
    if (open_) throw SceneFailure(open_->place, "*KINEMATIC or *DISTRIBUTING is expected next");
}

void ConstraintReader::take_coupling(const InpCard& card) {
    open_ = Coupling{{&root_, card.required("REF NODE"), card.place},
                     {&root_, card.required("SURFACE"), card.place},
                     {},
                     {},
                     card.place,
                     false,
                     true};
}

// Its lines name rotations that the reference node has; it always has all displacements.
void ConstraintReader::take_distributing(const InpCard& card) {
    if (!open_) throw SceneFailure(card.place, "a *COUPLING is expected first");
    open_->in_mean = true;
    open_->turns = card.lines.empty();
    for (const InpLine& line : card.lines) {
        const int first = degree_of_freedom(line.fields.at(0), 6, line.place);
        const bool one = line.fields.size() < 2 || line.fields[1].empty();
        if ((one ? first : degree_of_freedom(line.fields[1], 6, line.place)) > 3) open_->turns = true;
    }
    deck_.couplings.push_back(std::move(*open_));
    open_.reset();
}

void ConstraintReader::take_kinematic(const InpCard& card) {
    if (!open_) throw SceneFailure(card.place, "a *COUPLING is expected first");
    for (const InpLine& line : card.lines) {
        const int first = degree_of_freedom(line.fields[0], 6, line.place);
        const bool one = line.fields.size() < 2 || line.fields[1].empty();
        const int last = one ? first : degree_of_freedom(line.fields[1], 6, line.place);
        if (last < first) throw SceneFailure(line.place, fmt::format("degrees of freedom {} to {}: none", first, last));
        // Higher degrees of freedom are rotations, which nodes of solids do not have.
        for (int dof = first; dof <= std::min(last, 3); ++dof)
            if (std::find(open_->dofs.begin(), open_->dofs.end(), dof) == open_->dofs.end()) open_->dofs.push_back(dof);
    }
    if (!card.lines.empty() && open_->dofs.empty())
        throw SceneFailure(card.place, "no degree of freedom from 1 to 3: nodes of solids do not rotate");
    deck_.couplings.push_back(std::move(*open_));
    open_.reset();
}

void ConstraintReader::take_rigid_body(const InpCard& card) {
    Coupling coupling{
        {&root_, card.required("REF NODE"), card.place}, {&root_, "", card.place}, {}, {}, card.place, false, true};
    std::size_t given = 0;
    for (const char* name : {"NSET", "PIN NSET", "TIE NSET"})
        if (card.has(name)) {
            coupling.where.text = card.required(name);
            ++given;
        }
    if (given != 1) throw SceneFailure(card.place, "one of NSET=, PIN NSET= and TIE NSET= is expected");
    if (card.has("ROT NODE")) coupling.rotation_node = Entry{&root_, card.required("ROT NODE"), card.place};
    deck_.couplings.push_back(std::move(coupling));
}

// Lines with the number of terms, each followed by that many triples of node or set, degree of freedom, coefficient.
void ConstraintReader::take_equation(const InpCard& card) {
    std::vector<EquationEntry> terms;
    std::int64_t wanted = 0;
    for (const InpLine& line : card.lines) {
        if (wanted == 0) {
            wanted = inp_whole(line.fields.at(0), line.place);
            if (wanted < 1) throw SceneFailure(line.place, fmt::format("{} terms: at least 1 is expected", wanted));
            if (line.fields.size() > 1 && !line.fields[1].empty())
                throw SceneFailure(line.place, "the number of terms alone is expected");
            continue;
        }
        std::size_t last = line.fields.size();
        while (last > 0 && line.fields[last - 1].empty()) --last;
        if (last % 3 != 0)
            throw SceneFailure(line.place,
                               "triples of a node or set, a degree of freedom and a coefficient are expected");
        for (std::size_t i = 0; i < last; i += 3) {
            EquationEntry term;
            term.where = {&root_, line.fields[i], line.place};
            term.dof = degree_of_freedom(line.fields[i + 1], 6, line.place);
            term.coefficient = inp_number(line.fields[i + 2], line.place);
            terms.push_back(std::move(term));
        }
        if (static_cast<std::int64_t>(terms.size()) > wanted)
            throw SceneFailure(line.place, fmt::format("{} terms: {} are expected", terms.size(), wanted));
        if (static_cast<std::int64_t>(terms.size()) == wanted) {
            deck_.equations.push_back(std::move(terms));
            terms.clear();
            wanted = 0;
        }
    }
    if (wanted != 0) throw SceneFailure(card.place, fmt::format("{} terms: {} are expected", terms.size(), wanted));
    if (card.lines.empty()) throw SceneFailure(card.place, "the number of terms is expected");
}

void ConstraintReader::take_pins(const InpCard& card) {
    (void)card.first_line();
    for (const InpLine& line : card.lines) {
        const std::string type = line.fields.empty() ? "" : upper(line.fields[0]);
        if (type != "TIE" && type != "PIN")
            throw SceneFailure(line.place, "type " + type +
                                               " is not imported: TIE and PIN are; give *COUPLING with *KINEMATIC for "
                                               "BEAM, *EQUATION for others, *TIE for meshes that do not match");
        if (line.fields.size() != 3) throw SceneFailure(line.place, "a type and two nodes or sets are expected");
        deck_.pins.push_back({{&root_, line.fields[1], line.place}, {&root_, line.fields[2], line.place}});
    }
}

// The first point lies on axis 1, the second in the plane of axes 1 and 2.
void ConstraintReader::take_transform(const InpCard& card) {
    const Numbers points = card.first_line().numbers();
    if (points.size() != 6) throw SceneFailure(card.lines[0].place, "6 coordinates are expected");
    Transform transform{{&root_, card.required("NSET"), card.place}, {}, card.place};
    const auto unit = [&](std::array<double, 3> v) {
        const double length = std::hypot(v[0], v[1], v[2]);
        if (!(length > 0)) throw SceneFailure(card.lines[0].place, "the points lie on one line: they give no axes");
        for (double& x : v) x /= length;
        return v;
    };
    const auto cross = [](const std::array<double, 3>& a, const std::array<double, 3>& b) {
        return std::array{a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
    };
    transform.axes[0] = unit({points[0], points[1], points[2]});
    transform.axes[2] = unit(cross(transform.axes[0], {points[3], points[4], points[5]}));
    transform.axes[1] = cross(transform.axes[2], transform.axes[0]);
    deck_.transforms.push_back(std::move(transform));
}

}  // namespace cli::abaqus
