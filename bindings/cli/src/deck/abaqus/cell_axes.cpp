// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/cell_axes.hpp"

#include <map>
#include <optional>
#include <set>
#include <string>
#include <utility>

#include <fmt/format.h>

#include "deck/abaqus/inp_cards.hpp"
#include "deck/abaqus/orientations.hpp"
#include "mesh/cell_shape.hpp"
#include "text/say.hpp"

namespace cli::abaqus {

namespace {

using Points = std::vector<double>;

struct Named {
    const Part* scope;
    const InpCard* card;
};

// Returns the card of a name in a part or, if it has none, outside of the parts.
std::optional<Named> find_named(const Model& model, const Part& scope, CardsByName Part::*cards,
                                const std::string& name) {
    for (const Part* part : {&scope, &model.root})
        if (const auto found = (part->*cards).find(upper(name)); found != (part->*cards).end())
            return Named{part, found->second};
    return std::nullopt;
}

// The points of elements that a *DISTRIBUTION gives.
class Distribution {
public:
    Distribution(const Model& model, const Named& of) : name_(of.card->required("NAME")), place_(of.card->place) {
        const InpCard& card = *of.card;
        card.check();
        (void)card.required("LOCATION");
        require_points(model, of);
        for (std::size_t i = 0; i < card.lines.size(); ++i) {
            std::vector<std::string> fields = card.lines[i].fields;
            const Place& place = card.lines[i].place;
            while (card.lines[i].continues && fields.size() < 7 && i + 1 < card.lines.size()) {
                ++i;
                fields.insert(fields.end(), card.lines[i].fields.begin(), card.lines[i].fields.end());
            }
            if (fields.size() != 7)
                throw SceneFailure(place, fmt::format("{} entries: an element or a set of elements and 6 coordinates "
                                                      "are expected",
                                                      fields.size()));
            Points points(9, 0.0);
            for (std::size_t k = 0; k < 6; ++k)
                if (!fields[k + 1].empty()) points[k] = inp_number(fields[k + 1], place);
            add(model, {of.scope, fields[0], place}, std::move(points));
        }
    }

    [[nodiscard]] const Points& of(const ElementAt& at) const {
        if (const auto found = of_.find(at); found != of_.end()) return found->second;
        if (others_) return *others_;
        throw SceneFailure(place_, fmt::format("\"{}\" has no line for element {}, nor one for all others, which has "
                                               "no number",
                                               name_, at.element().id));
    }

private:
    static void require_points(const Model& model, const Named& of) {
        const std::string name = of.card->required("TABLE");
        const auto table = find_named(model, *of.scope, &Part::distribution_tables, name);
        if (!table) throw SceneFailure(of.card->place, "distribution table \"" + name + "\" is not there");
        std::vector<std::string> kinds;
        for (const InpLine& line : table->card->lines)
            for (const std::string& field : line.fields)
                if (!field.empty()) kinds.push_back(upper(field));
        if (kinds != std::vector<std::string>(2, "COORD3D"))
            throw SceneFailure(table->card->place, "the table of an orientation is COORD3D, COORD3D");
    }

    void add(const Model& model, const Entry& where, Points points) {
        if (where.text.empty()) {
            if (others_) throw SceneFailure(where.place, "there is another line for all other elements");
            others_ = std::move(points);
            return;
        }
        std::set<ElementAt> members;
        model.collect_elements(where, members);
        for (const ElementAt& at : members)
            if (!of_.emplace(at, points).second)
                throw SceneFailure(where.place, fmt::format("element {} has another line", at.element().id));
    }

    std::string name_;
    Place place_;
    std::map<ElementAt, Points> of_;
    std::optional<Points> others_;
};

// The section of cells that has an orientation.
struct OrientedSection {
    const Part* scope;
    Entry elements;
    Orientation orientation;
    const Part* home;  // of the orientation
    double angle;      // of the one ply of a composite
};

class AxesMaker {
public:
    explicit AxesMaker(const Model& model) : model_(model) {}

    [[nodiscard]] std::map<ElementAt, std::array<double, 6>> make(std::vector<std::string>& notes) {
        std::map<ElementAt, std::array<double, 6>> out;
        for (const OrientedSection& section : sections()) {
            std::set<ElementAt> members;
            model_.collect_elements(section.elements, members);
            std::int64_t count = 0;
            for (const ElementAt& at : members) {
                if (at.type().cohesive()) continue;
                out[at] = axes_of(section, at);
                ++count;
            }
            const Orientation& from = section.orientation;
            notes.push_back(fmt::format(
                "\"{}\": {} with the axes of *ORIENTATION \"{}\"{}{}", full_name(*section.scope, section.elements.text),
                counted(count, "cell"), from.name,
                from.distribution.empty() ? "" : ", each as *DISTRIBUTION \"" + from.distribution + "\" has it",
                from.cylindrical ? ", radial and tangential at the centre of each" : ""));
        }
        return out;
    }

private:
    // Returns all sections with axes, or none if the axes are the same in each of them.
    [[nodiscard]] std::vector<OrientedSection> sections() const {
        bool differ = false;
        for (const Part* scope : model_.scopes())
            for (std::size_t i = 0; i < scope->sections.size(); ++i)
                if (const auto found = named_by(*scope, i))
                    differ = differ || may_differ(*found->card) || of_several_plies(*scope->section_cards[i]);
        std::vector<OrientedSection> out;
        for (const Part* scope : model_.scopes())
            for (std::size_t i = 0; differ && i < scope->sections.size(); ++i)
                if (const InpCard& card = *scope->section_cards[i]; card.has("ORIENTATION")) {
                    const auto found = named_by(*scope, i);
                    if (!found)
                        throw SceneFailure(card.place,
                                           "orientation \"" + card.parameter("ORIENTATION") + "\" is not there");
                    out.push_back(
                        {scope, scope->sections[i], orientation_of(*found->card), found->scope, angle_of(card)});
                }
        return out;
    }

    // Other orientations may be of kinds that nobody reads: a scene gives axes of its own.
    static bool may_differ(const InpCard& card) {
        if (card.has("SYSTEM") && card.parameter("SYSTEM") == "CYLINDRICAL") return true;
        const bool here = !card.has("DEFINITION") || card.parameter("DEFINITION") == "COORDINATES";
        const bool rectangular = !card.has("SYSTEM") || card.parameter("SYSTEM") == "RECTANGULAR";
        return here && rectangular && !card.lines.empty() && orientation_of(card).of_each_element();
    }

    static bool of_several_plies(const InpCard& section) {
        return section.has("COMPOSITE") && laminate_of(section).plies.angles.size() > 1;
    }

    [[nodiscard]] std::optional<Named> named_by(const Part& scope, std::size_t section) const {
        const InpCard& card = *scope.section_cards[section];
        const std::string name = card.parameter("ORIENTATION");
        return name.empty() ? std::nullopt : find_named(model_, scope, &Part::orientations, name);
    }

    // Returns the angle of the one ply; several turn the axes of their own cells (ply_cells.hpp).
    static double angle_of(const InpCard& section) {
        if (!section.has("COMPOSITE")) return 0;
        const Laminate laminate = laminate_of(section);
        return laminate.plies.angles.size() == 1 ? laminate.plies.angles[0] : 0;
    }

    [[nodiscard]] std::array<double, 6> axes_of(const OrientedSection& section, const ElementAt& at) {
        const Orientation& from = section.orientation;
        // The section of a part moves with its instance, and the one outside of the parts has the axes of the mesh.
        const Part& scope = *section.scope;
        const Points& points = from.distribution.empty() ? from.points : distribution(section).of(at);
        Axes axes{};
        try {
            axes = from.axes(points, centre_in(scope, at), from.place);
        } catch (const SceneFailure& failure) {
            throw SceneFailure(from.place, fmt::format("element {}: {}", at.element().id, failure.text()));
        }
        turn(axes, 3, section.angle);
        for (Vector& axis : axes) axis = turned_by(scope, axis);
        return first_two(axes);
    }

    [[nodiscard]] static Vector centre_in(const Part& scope, const ElementAt& at) {
        const std::size_t corners = shape_of(at.type().cell).corners;
        Vector centre{};
        for (std::size_t k = 0; k < corners; ++k) {
            const std::int64_t id = at.element().nodes[k];
            const auto index = at.scope->node_of.find(id);
            if (index == at.scope->node_of.end())
                throw SceneFailure(at.element().place, fmt::format("node {} is not there", id));
            for (std::size_t a = 0; a < 3; ++a)
                centre[a] += at.scope->nodes[index->second].at[a] / static_cast<double>(corners);
        }
        Vector out{};
        for (std::size_t i = 0; i < 3; ++i)
            for (std::size_t a = 0; a < 3; ++a) out[i] += (centre[a] - scope.origin[a]) * scope.turned[i][a];
        return out;
    }

    const Distribution& distribution(const OrientedSection& section) {
        const std::string& name = section.orientation.distribution;
        const auto found = find_named(model_, *section.home, &Part::distributions, name);
        if (!found)
            throw SceneFailure(section.orientation.place,
                               "distribution \"" + name + "\" is not there (*DISTRIBUTION, LOCATION=ELEMENT)");
        const std::pair key(found->scope, found->card);
        const auto known = distributions_.find(key);
        return known != distributions_.end() ? known->second
                                             : distributions_.emplace(key, Distribution(model_, *found)).first->second;
    }

    const Model& model_;
    std::map<std::pair<const Part*, const InpCard*>, Distribution> distributions_;
};

}  // namespace

void set_cell_axes(const Model& model, const std::vector<std::vector<ElementAt>>& elements, MeshData& mesh) {
    const auto axes = AxesMaker(model).make(mesh.notes);
    if (axes.empty()) return;
    for (const auto& block : elements)
        for (const ElementAt& at : block) {
            const auto found = axes.find(at);
            mesh.orientation.push_back(found == axes.end() ? std::array<double, 6>{1, 0, 0, 0, 1, 0} : found->second);
        }
}

}  // namespace cli::abaqus
