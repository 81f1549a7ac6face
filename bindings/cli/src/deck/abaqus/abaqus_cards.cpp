// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/abaqus_cards.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "deck/abaqus/abaqus_elements.hpp"
#include "deck/abaqus/generated.hpp"
#include "deck/abaqus/keywords.hpp"
#include "deck/abaqus/orientations.hpp"
#include "text/wording.hpp"

namespace cli::abaqus {

namespace {

// Materials, loads, steps and output requests are for the scene file, which defines them instead.
bool passed_over(const std::string& keyword) {
    const Keyword* known = keyword_of(keyword);
    return known != nullptr && known->use != Use::never;
}

// Rotation of a point by an angle about the axis from a to b (Rodrigues).
std::array<double, 3> rotated(const std::array<double, 3>& point, const std::array<double, 3>& a,
                              const std::array<double, 3>& b, double angle) {
    std::array<double, 3> k{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double length = std::hypot(k[0], k[1], k[2]);
    for (double& x : k) x /= length;
    const std::array<double, 3> v{point[0] - a[0], point[1] - a[1], point[2] - a[2]};
    const double along = k[0] * v[0] + k[1] * v[1] + k[2] * v[2];
    const std::array<double, 3> across{k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2], k[0] * v[1] - k[1] * v[0]};
    std::array<double, 3> out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = a[i] + v[i] * std::cos(angle) + across[i] * std::sin(angle) + k[i] * along * (1 - std::cos(angle));
    return out;
}

// A point from its radius, its angle about z in degrees, and its height or, of spherical ones, the angle above the
// plane.
std::array<double, 3> rectangular(const std::array<double, 3>& at, bool spherical) {
    const double turn = at[1] * std::numbers::pi / 180, rise = spherical ? at[2] * std::numbers::pi / 180 : 0.0;
    const double radius = at[0] * std::cos(rise);
    return {radius * std::cos(turn), radius * std::sin(turn), spherical ? at[0] * std::sin(rise) : at[2]};
}

class CardReader {
public:
    CardReader(const std::vector<InpCard>& cards, Model& model) : model_(model), open_(&model.root), boundary_(cards) {}

    void read(const std::vector<InpCard>& cards) {
        for (const InpCard& card : cards) take(card);
        if (open_ != &model_.root) throw SceneFailure(model_.file, "\"" + open_->name + "\" is not ended");
        if (in_step_) throw SceneFailure(model_.file, "*STEP is not ended");
        if (model_.instances.empty())
            for (const auto& [key, part] : model_.parts)
                throw SceneFailure(model_.file,
                                   fmt::format("part \"{}\" is in no *INSTANCE: give it one, or take *PART and "
                                               "*END PART out",
                                               part->name));
        if (!passed_.empty()) model_.notes.push_back("ignored: " + listing({passed_.begin(), passed_.end()}));
    }

private:
    void take(const InpCard& card) {
        const std::string& word = card.keyword;
        if (in_step_) {
            if (word == "DLOAD") add_pressed(card);
            in_step_ = word != "END STEP";
            return;
        }
        if (word == "STEP") {
            in_step_ = true;
            passed_.insert("*STEP");
        } else if (word == "HEADING" || word == "PARAMETER") {
            return;
        } else if (word == "NODE") {
            take_nodes(card);
        } else if (word == "SYSTEM") {
            system_ = node_system_of(card);
        } else if (word == "ELEMENT") {
            take_elements(card);
        } else if (word == "NGEN") {
            made_ += generate_nodes(card, *open_, most_copies - made_);
        } else if (word == "ELGEN") {
            made_ += generate_elements(card, *open_, most_copies - made_);
        } else if (word == "NFILL") {
            made_ += fill_nodes(card, *open_, most_copies - made_);
        } else if (word == "NCOPY") {
            made_ += copy_nodes(card, *open_, most_copies - made_);
        } else if (word == "ELCOPY") {
            made_ += copy_elements(card, *open_, most_copies - made_);
        } else if (word == "NSET") {
            take_set(card, open_->node_sets, "NSET");
        } else if (word == "ELSET") {
            take_set(card, open_->element_sets, "ELSET");
        } else if (word == "SURFACE") {
            take_surface(card);
        } else if (word == "SOLID SECTION" || word == "SHELL SECTION") {
            open_->sections.push_back({open_, card.required("ELSET"), card.place});
            open_->section_cards.push_back(&card);
        } else if (take_axes(card)) {
            return;
        } else if (word == "COHESIVE SECTION") {
            open_->cohesive_sections.push_back({open_, card.required("ELSET"), card.place});
            open_->cohesive_cards.push_back(&card);
        } else if (word == "TIE") {
            take_tie(card);
        } else if (word == "PART") {
            begin_part(card);
        } else if (word == "INSTANCE") {
            begin_instance(card);
        } else if (word == "ASSEMBLY") {
            require_outside(card);
        } else if (word == "END ASSEMBLY") {
            require_outside(card);
        } else if (word == "END PART" || word == "END INSTANCE") {
            if (open_ == &model_.root) throw SceneFailure(card.place, "nothing of the kind was begun");
            if (placing_ != nullptr) end_instance();
            placing_ = nullptr;
            open_ = &model_.root;
            system_.reset();
        } else if (passed_over(word)) {
            passed_.insert("*" + word);
        } else {
            throw SceneFailure(card.place, instead_of_keyword(word));
        }
    }

    // The cards are read later, when all of them are known, and only those that a section uses.
    bool take_axes(const InpCard& card) {
        static const std::pair<const char*, CardsByName Part::*> known[] = {
            {"ORIENTATION", &Part::orientations},
            {"DISTRIBUTION", &Part::distributions},
            {"DISTRIBUTION TABLE", &Part::distribution_tables},
        };
        for (const auto& [word, cards] : known) {
            if (card.keyword != word) continue;
            const std::string name = card.required("NAME");
            if (!(open_->*cards).emplace(upper(name), &card).second)
                throw SceneFailure(card.place, "there is another one named \"" + name + "\"");
            return true;
        }
        return false;
    }

    void require_outside(const InpCard& card) const {
        if (open_ != &model_.root) throw SceneFailure(card.place, "\"" + open_->name + "\" is not ended");
    }

    void begin_part(const InpCard& card) {
        require_outside(card);
        card.check();
        auto& part = model_.parts[upper(card.required("NAME"))];
        if (part) throw SceneFailure(card.place, "there is another part \"" + part->name + "\"");
        part = std::make_unique<Part>();
        part->name = card.required("NAME");
        open_ = part.get();
        system_.reset();
    }

    void begin_instance(const InpCard& card) {
        require_outside(card);
        card.check();
        const auto from = model_.parts.find(upper(card.required("PART")));
        if (from == model_.parts.end())
            throw SceneFailure(card.place, "part \"" + card.required("PART") + "\" is not there");
        const std::string name = card.required("NAME");
        if (model_.instance_of.contains(upper(name)))
            throw SceneFailure(card.place, "there is another instance \"" + name + "\"");
        count_copies(*from->second, card.place);
        model_.instances.push_back(std::make_unique<Part>(*from->second));
        Part& instance = *model_.instances.back();
        const Part* part = from->second.get();
        model_.instance_of.emplace(upper(name), &instance);
        instance.name = name;
        instance.order = model_.instances.size();
        // Definitions of the part now belong to the instance.
        const auto renew = [&](Entry& entry) {
            if (entry.scope == part) entry.scope = &instance;
        };
        for (auto* sets : {&instance.node_sets, &instance.element_sets})
            for (auto& [key, set] : *sets) {
                std::for_each(set.entries.begin(), set.entries.end(), renew);
                std::for_each(set.element_sets.begin(), set.element_sets.end(), renew);
            }
        for (auto& [key, surface] : instance.surfaces) {
            for (Side& side : surface.sides) renew(side.elements);
            std::for_each(surface.nodes.begin(), surface.nodes.end(), renew);
        }
        std::for_each(instance.sections.begin(), instance.sections.end(), renew);
        std::for_each(instance.cohesive_sections.begin(), instance.cohesive_sections.end(), renew);
        open_ = &instance;
        placing_ = &card;
        system_.reset();
    }

    // The first data line moves the nodes of the part and those that the instance itself has, which are in the system
    // of the part too. The second rotates them: two points of the axis, degrees.
    void end_instance() {
        Part& instance = *open_;
        const InpCard& card = *placing_;
        if (card.lines.size() > 2) throw SceneFailure(card.lines[2].place, "at most two lines are expected");
        if (!card.lines.empty()) {
            const std::vector<double> by = numbers(card.lines[0], 3);
            for (Node& node : instance.nodes)
                for (std::size_t a = 0; a < 3; ++a) node.at[a] += by[a];
            instance.origin = {by[0], by[1], by[2]};
        }
        if (card.lines.size() == 2) {
            const std::vector<double> turn = numbers(card.lines[1], 7);
            const std::array<double, 3> a{turn[0], turn[1], turn[2]};
            const std::array<double, 3> b{turn[3], turn[4], turn[5]};
            if (a == b) throw SceneFailure(card.lines[1].place, "the two points of the axis of rotation are the same");
            for (std::array<double, 3>& axis : instance.turned)
                axis = rotated(axis, {}, {b[0] - a[0], b[1] - a[1], b[2] - a[2]}, turn[6] * std::numbers::pi / 180);
            instance.origin = rotated(instance.origin, a, b, turn[6] * std::numbers::pi / 180);
            for (Node& node : instance.nodes) node.at = rotated(node.at, a, b, turn[6] * std::numbers::pi / 180);
        }
    }

    // Counts the copies before they are made: one line may copy a part of any size.
    void count_copies(const Part& part, const Place& place) {
        std::size_t count = 1 + part.nodes.size() + part.elements.size() + part.sections.size();
        for (const auto* sets : {&part.node_sets, &part.element_sets})
            for (const auto& [key, set] : *sets) count += 1 + set.entries.size() + set.element_sets.size();
        for (const auto& [key, surface] : part.surfaces) count += 1 + surface.sides.size() + surface.nodes.size();
        copies_ += static_cast<std::int64_t>(count);
        if (copies_ > most_copies)
            throw SceneFailure(place, fmt::format("with it the instances have {} nodes, elements and members of sets: "
                                                  "at most {} are allowed",
                                                  copies_, most_copies));
    }

    static std::vector<double> numbers(const InpLine& line, std::size_t count) {
        if (line.fields.size() > count)
            throw SceneFailure(line.place, fmt::format("{} entries: {} are expected", line.fields.size(), count));
        std::vector<double> out(count, 0.0);
        for (std::size_t i = 0; i < line.fields.size(); ++i)
            if (!line.fields[i].empty()) out[i] = inp_number(line.fields[i], line.place);
        return out;
    }

    void take_nodes(const InpCard& card) {
        card.check();
        const std::string system = card.has("SYSTEM") ? card.required("SYSTEM") : "R";
        for (const InpLine& line : card.lines) {
            if (line.fields.size() > 7)
                throw SceneFailure(line.place, fmt::format("{} entries: a number, up to 3 coordinates and 3 of a "
                                                           "normal are expected",
                                                           line.fields.size()));
            Node node{label(line.fields.at(0), "node", line.place), {}};
            const std::vector<double> values = line.numbers(1);
            std::copy_n(values.begin(), std::min(values.size(), node.at.size()), node.at.begin());
            if (values.size() > node.at.size()) set_note("left out: normals of *NODE, which shells alone have");
            if (system != "R") node.at = rectangular(node.at, system == "S");
            if (system_) node.at = system_->global(node.at);
            if (!open_->node_of.emplace(node.id, open_->nodes.size()).second)
                throw SceneFailure(line.place, fmt::format("node {} occurs twice", node.id));
            open_->nodes.push_back(node);
            if (card.has("NSET"))
                set_named(open_->node_sets, card.required("NSET"), card.place)
                    .entries.push_back({open_, line.fields[0], line.place});
        }
    }

    // Returns the number of a node or an element.
    static std::int64_t label(const std::string& field, const char* of, const Place& place) {
        const std::int64_t number = inp_whole(field, place);
        if (number < 1) throw SceneFailure(place, fmt::format("{} {}: its number must be > 0", of, number));
        return number;
    }

    void take_elements(const InpCard& card) {
        card.check();
        if (boundary_.contains(card))
            return set_note(fmt::format("left out: elements {} of \"{}\", edges or faces that no section names",
                                        card.parameter("TYPE"), card.parameter("ELSET")));
        const ElementType& type = type_named(card);
        const std::size_t per_element = type.nodes();
        if (!type.note.empty()) set_note(fmt::format("{}: {}", type.name, type.note));
        for (std::size_t i = 0; i < card.lines.size(); ++i) {
            // A line that ends with a comma continues on the next.
            std::vector<std::string> fields = card.lines[i].fields;
            const Place place = card.lines[i].place;
            while (card.lines[i].continues && fields.size() < per_element + 1 && i + 1 < card.lines.size()) {
                ++i;
                fields.insert(fields.end(), card.lines[i].fields.begin(), card.lines[i].fields.end());
            }
            if (fields.size() != per_element + 1)
                throw SceneFailure(place, fmt::format("{} nodes: {} has {}", fields.empty() ? 0 : fields.size() - 1,
                                                      type.name, per_element));
            Element element{label(fields[0], "element", place), &type, {}, card.parameter("ELSET"), place};
            for (std::size_t k = 1; k < fields.size(); ++k) element.nodes.push_back(inp_whole(fields[k], place));
            for (std::size_t k = 0; k < type.order.size(); ++k)
                element.nodes[k] = inp_whole(fields[1 + type.order[k]], place);
            if (!open_->element_of.emplace(element.id, open_->elements.size()).second)
                throw SceneFailure(place, fmt::format("element {} occurs twice", element.id));
            open_->elements.push_back(std::move(element));
            if (card.has("ELSET"))
                set_named(open_->element_sets, card.required("ELSET"), card.place)
                    .entries.push_back({open_, fields[0], place});
        }
    }

    static Set& set_named(std::map<std::string, Set>& sets, const std::string& name, const Place& place) {
        Set& set = sets[upper(name)];
        if (set.name.empty()) {
            set.name = name;
            set.place = place;
        }
        return set;
    }

    void take_set(const InpCard& card, std::map<std::string, Set>& sets, const std::string& key) {
        card.check();
        Set& set = set_named(sets, card.required(key), card.place);
        set.unsorted = set.unsorted || card.has("UNSORTED");
        const Part* scope = card.has("INSTANCE") ? model_.instance_named(card.required("INSTANCE"), card.place) : open_;
        if (key == "NSET" && card.has("ELSET")) set.element_sets.push_back({scope, card.required("ELSET"), card.place});
        for (const InpLine& line : card.lines) {
            if (card.has("GENERATE")) {
                generate(line, scope, set);
                continue;
            }
            for (const std::string& field : line.fields)
                if (!field.empty()) set.entries.push_back({scope, field, line.place});
        }
    }

    static void generate(const InpLine& line, const Part* scope, Set& set) {
        if (line.fields.size() < 2 || line.fields.size() > 3)
            throw SceneFailure(
                line.place, fmt::format("{} entries: first, last and (1) increment are expected", line.fields.size()));
        const std::int64_t first = inp_whole(line.fields[0], line.place);
        const std::int64_t last = inp_whole(line.fields[1], line.place);
        const std::int64_t by = line.fields.size() == 3 ? inp_whole(line.fields[2], line.place) : 1;
        // Unsigned, because the difference of two numbers may exceed the largest signed one.
        const auto step = static_cast<std::uint64_t>(by);
        const std::uint64_t span = static_cast<std::uint64_t>(last) - static_cast<std::uint64_t>(first);
        if (by <= 0 || last < first || span % step != 0)
            throw SceneFailure(
                line.place, fmt::format("{}, {}, {}: from first up to last in whole increments > 0", first, last, by));
        set.entries.push_back({scope, std::to_string(first), line.place, last, by});
    }

    void take_surface(const InpCard& card) {
        const std::string name = card.required("NAME");
        Surface& surface = open_->surfaces[upper(name)];
        if (!surface.name.empty()) throw SceneFailure(card.place, "there is another surface \"" + name + "\"");
        surface.name = name;
        surface.place = card.place;
        surface.of_nodes = card.parameter("TYPE") == "NODE";
        // Many decks have surfaces that nothing uses.
        try {
            take_sides(card, surface);
        } catch (const SceneFailure& failure) {
            surface.sides.clear();
            surface.nodes.clear();
            surface.refusal = failure;
            set_note(fmt::format("ignored: surface \"{}\", unless something uses it ({})", name, failure.what()));
        }
    }

    void take_sides(const InpCard& card, Surface& surface) const {
        card.check();
        for (const InpLine& line : card.lines) {
            if (surface.of_nodes) {
                surface.nodes.push_back({open_, line.fields.at(0), line.place});
                continue;
            }
            if (line.fields.size() > 2 || line.fields.at(0).empty())
                throw SceneFailure(line.place,
                                   "an element or an element set and a side, S1 .. S6, are expected; without a side, "
                                   "those of its sides that no other element has");
            const std::string side = line.fields.size() < 2 ? "" : upper(line.fields[1]);
            if (side.empty()) {
                surface.sides.push_back({{open_, line.fields[0], line.place}, free_sides});
                continue;
            }
            if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6')
                throw SceneFailure(line.place, "\"" + line.fields[1] + "\": a side, S1 .. S6, is expected");
            surface.sides.push_back({{open_, line.fields[0], line.place}, static_cast<std::size_t>(side[1] - '1')});
        }
    }

    void take_tie(const InpCard& card) {
        card.check();
        Tie tie;
        if (card.has("POSITION TOLERANCE")) tie.tolerance = inp_number(card.required("POSITION TOLERANCE"), card.place);
        if (!(tie.tolerance >= 0))
            throw SceneFailure(card.place, fmt::format("POSITION TOLERANCE={}: must be >= 0", tie.tolerance));
        (void)card.first_line();
        for (const InpLine& line : card.lines) {
            if (line.fields.size() < 2) throw SceneFailure(line.place, "a slave and a master surface are expected");
            tie.slave = {open_, line.fields[0], line.place};
            tie.master = {open_, line.fields[1], line.place};
            tie.place = line.place;
            model_.ties.push_back(tie);
        }
    }

    // The sides of elements on which a pressure acts are a surface.
    void add_pressed(const InpCard& card) {
        for (const InpLine& line : card.lines) {
            const std::string name = line.fields.size() < 2 ? "" : pressed_surface(line.fields[0], line.fields[1]);
            if (name.empty()) continue;
            Surface& surface = model_.root.surfaces[upper(name)];
            if (!surface.name.empty()) continue;
            surface.name = name;
            surface.place = line.place;
            surface.sides.push_back(
                {{&model_.root, line.fields[0], line.place}, static_cast<std::size_t>(line.fields[1][1] - '1')});
        }
    }

    void set_note(const std::string& text) {
        auto& notes = model_.notes;
        if (std::find(notes.begin(), notes.end(), text) == notes.end()) notes.push_back(text);
    }

    Model& model_;
    Part* open_;
    BoundaryElements boundary_;
    const InpCard* placing_ = nullptr;  // the *INSTANCE that is open
    std::optional<NodeSystem> system_;  // of the nodes that follow; none: x, y, z
    bool in_step_ = false;
    std::int64_t copies_ = 0;
    std::int64_t made_ = 0;  // nodes and elements of *NGEN and *ELGEN
    std::set<std::string> passed_;
};

}  // namespace

std::string pressed_surface(const std::string& elements, const std::string& side) {
    if (side.size() != 2 || (side[0] != 'P' && side[0] != 'p') || side[1] < '1' || side[1] > '6') return "";
    return elements + "-P" + side[1];
}

void take_cards(const std::vector<InpCard>& cards, const std::string& path, Model& model) {
    model.file = {path, "", 0};
    CardReader(cards, model).read(cards);
}

}  // namespace cli::abaqus
