// SPDX-License-Identifier: BSD-3-Clause
#include "deck/cards/deck_cards.hpp"

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "deck/abaqus/keywords.hpp"
#include "deck/cards/deck_constraint_cards.hpp"
#include "deck/cards/deck_step_cards.hpp"
#include "text/wording.hpp"

namespace cli::abaqus {

namespace {

constexpr const char* contact_at_start =
    "*CONTACT INITIALIZATION DATA: no faces are moved; those that lie on each other are in contact";
// Keywords whose effect the scene has in another way; each is reported once.
const std::pair<const char*, const char*> otherwise[] = {
    {"DAMAGE STABILIZATION", "*DAMAGE STABILIZATION: no viscosity; jumps of the crack are found by energy"},
    {"CONTACT DAMPING", "*CONTACT DAMPING: no viscosity; jumps of the crack are found by energy"},
    {"CONTACT INITIALIZATION ASSIGNMENT", contact_at_start},
    {"CONTACT INITIALIZATION DATA", contact_at_start},
    {"CONTACT STABILIZATION", "*CONTACT STABILIZATION: no viscosity; jumps of the crack are found by energy"},
    {"FRICTION", "*FRICTION: contact without friction"},
    {"SURFACE BEHAVIOR", "*SURFACE BEHAVIOR: contact is exact, without a penalty"},
    {"TRANSVERSE SHEAR STIFFNESS",
     "*TRANSVERSE SHEAR STIFFNESS: solid cells shear by the moduli of their material, whatever it says"},
    {"SURFACE PROPERTY ASSIGNMENT", "*SURFACE PROPERTY ASSIGNMENT: surfaces are the sides of cells as they are meshed"},
};

class DeckReader {
public:
    DeckReader(const std::string& path, const Part& root)
        : path_(path), root_(root), steps_(deck_, root), constraints_(deck_, root) {}

    Deck read(const std::vector<InpCard>& cards) {
        RefusalList refused;
        for (const InpCard& card : cards)
            if (!refused.attempt([&] { take(card); }) && others_follow(card.keyword)) refused.require_none();
        refused.attempt([&] { constraints_.finish(); });
        refused.require_none();
        if (deck_.steps.empty())
            throw SceneFailure({path_, "", 0},
                               "there is no *STEP in it: a deck with loads is expected; a "
                               "mesh is for a scene, as its mesh.file (SCENE.md, [mesh])");
        for (const std::string& name : left_) deck_.left_out.push_back("*" + name);
        list_refused();
        return std::move(deck_);
    }

private:
    void take(const InpCard& card) {
        const std::string& word = card.keyword;
        if (word == "PART") part_ = card.required("NAME");
        if (word == "INSTANCE") part_ = "instance " + card.required("NAME");
        if (word == "END PART" || word == "END INSTANCE") part_.clear();
        const Keyword* keyword = keyword_of(word);
        if (keyword == nullptr) throw SceneFailure(card.place, instead_of_keyword(word));
        if (keyword->use == Use::mesh) return;
        if (keyword->use == Use::unneeded) {
            left_.insert(word);
            return;
        }
        try {
            take_known(card);
        } catch (const SceneFailure& failure) {
            if (!keep_for_use(card, keyword->use, failure)) throw;
        }
    }

    // True if later cards belong to this one, so that they would be refused for its fault.
    static bool others_follow(const std::string& keyword) {
        static const std::set<std::string, std::less<>> known{
            "CONTACT PAIR", "COUPLING", "DISTRIBUTING", "DYNAMIC", "END STEP", "INSTANCE",
            "KINEMATIC",    "MATERIAL", "PART",         "STATIC",  "STEP",     "SURFACE INTERACTION"};
        return known.contains(keyword);
    }

    void take_known(const InpCard& card) {
        const std::string& word = card.keyword;
        const Use use = keyword_of(word)->use;
        if (use == Use::no_law || use == Use::passed || use == Use::never)
            throw SceneFailure(card.place, instead_of_keyword(word));
        card.check();
        for (const auto& [name, text] : otherwise)
            if (word == name) return say_once(deck_.changed, text);
        if (steps_.take(card)) return;
        if (constraints_.take(card)) {
            if (!part_.empty())
                throw SceneFailure(card.place, "within a *PART or *INSTANCE it is not imported: give it outside");
            return;
        }
        using Take = void (DeckReader::*)(const InpCard&);
        static const std::pair<const char*, Take> known[] = {
            {"COHESIVE BEHAVIOR", &DeckReader::take_behavior},
            {"COHESIVE SECTION", &DeckReader::take_cohesive_section},
            {"CONTACT", &DeckReader::take_general_contact},
            {"CONTACT INCLUSIONS", &DeckReader::take_inclusions},
            {"CONTACT PAIR", &DeckReader::take_pair},
            {"CONTACT PROPERTY ASSIGNMENT", &DeckReader::take_assignment},
            {"DAMAGE EVOLUTION", &DeckReader::take_evolution},
            {"DAMAGE INITIATION", &DeckReader::take_initiation},
            {"ELASTIC", &DeckReader::take_elastic},
            {"EXPANSION", &DeckReader::take_expansion},
            {"HEADING", &DeckReader::take_heading},
            {"INITIAL CONDITIONS", &DeckReader::take_initial},
            {"MATERIAL", &DeckReader::take_material},
            {"ORIENTATION", &DeckReader::take_orientation},
            {"SECTION CONTROLS", &DeckReader::take_controls},
            {"SHELL SECTION", &DeckReader::take_section},
            {"SOLID SECTION", &DeckReader::take_section},
            {"SURFACE INTERACTION", &DeckReader::take_interaction},
        };
        for (const auto& [name, function] : known)
            if (word == name) return (this->*function)(card);
        if (word != "PARAMETER") throw SceneFailure(card.place, instead_of_keyword(word));
    }

    // Keeps what is wrong with a material, an interaction, an amplitude or an orientation until one asks for it: many
    // decks have some that nothing uses. False: it is wrong at once.
    bool keep_for_use(const InpCard& card, Use use, const SceneFailure& failure) {
        std::optional<Refusals>* kept = nullptr;
        if (use == Use::law || use == Use::no_law) {
            if (damage_of_ == &DeckReader::damage_of_material) kept = &deck_.materials.back().refusal;
            if (damage_of_ == &DeckReader::damage_of_interaction) kept = &deck_.interactions.back().refusal;
        } else if (card.parameter("NAME").empty()) {
            return false;
        } else if (card.keyword == "SURFACE INTERACTION") {
            add_interaction(card);
            kept = &deck_.interactions.back().refusal;
        } else if (card.keyword == "AMPLITUDE") {
            Amplitude amplitude;
            amplitude.name = card.parameter("NAME");
            deck_.amplitudes.push_back(std::move(amplitude));
            kept = &deck_.amplitudes.back().refusal;
        } else if (card.keyword == "ORIENTATION") {
            const std::pair key(part_, upper(card.parameter("NAME")));
            kept = &deck_.orientations.try_emplace(key).first->second.refusal;
        }
        if (kept == nullptr) return false;
        std::vector<SceneFailure> all = *kept ? (*kept)->all() : std::vector<SceneFailure>{};
        all.push_back(failure);
        kept->emplace(std::move(all));
        return true;
    }

    // Lists what would be refused if something used it.
    void list_refused() {
        const auto list = [&](const char* what, const std::string& name, const std::optional<Refusals>& refusal) {
            if (!refusal) return;
            const Place& place = refusal->place();
            deck_.left_out.push_back(fmt::format("{} \"{}\", which nothing uses ({})", what, name, place.text()));
        };
        for (const MaterialCards& each : deck_.materials) list("material", each.name, each.refusal);
        for (const InteractionCards& each : deck_.interactions) list("surface interaction", each.name, each.refusal);
        for (const Amplitude& each : deck_.amplitudes) list("amplitude", each.name, each.refusal);
        for (const auto& [key, each] : deck_.orientations) list("orientation", key.second, each.refusal);
    }

    void take_heading(const InpCard& card) {
        if (!card.lines.empty() && !card.lines[0].fields.empty()) deck_.title = listing(card.lines[0].fields);
    }

    void take_material(const InpCard& card) {
        deck_.materials.push_back({card.required("NAME"), "", {}, {}, {}, {}, card.place, {}});
        damage_of_ = &DeckReader::damage_of_material;
    }

    void take_interaction(const InpCard& card) { add_interaction(card); }
    void add_interaction(const InpCard& card) {
        InteractionCards interaction;
        interaction.name = card.required("NAME");
        interaction.place = card.place;
        deck_.interactions.push_back(std::move(interaction));
        damage_of_ = &DeckReader::damage_of_interaction;
    }

    DamageCards& damage_of_material() { return deck_.materials.back().damage; }
    DamageCards& damage_of_interaction() { return deck_.interactions.back().damage; }
    DamageCards& damage(const InpCard& card) {
        if (damage_of_ == nullptr)
            throw SceneFailure(card.place, "a *MATERIAL or *SURFACE INTERACTION is expected first");
        return (this->*damage_of_)();
    }
    MaterialCards& material(const InpCard& card) {
        if (deck_.materials.empty() || damage_of_ != &DeckReader::damage_of_material)
            throw SceneFailure(card.place, "a *MATERIAL is expected first");
        return deck_.materials.back();
    }

    static void require_constant(const InpCard& card) {
        if (card.has("DEPENDENCIES")) throw SceneFailure(card.place, "DEPENDENCIES: constants alone are imported");
    }

    // Further lines are for other temperatures.
    static void require_one_line(const InpCard& card) {
        if (card.lines.size() > 1)
            throw SceneFailure(card.lines[1].place, "one line is expected: values at one temperature are imported");
    }

    void take_elastic(const InpCard& card) {
        require_constant(card);
        MaterialCards& m = material(card);
        if (!m.elastic.empty()) throw SceneFailure(card.place, "is given twice for one material");
        static const std::map<std::string, std::size_t> types{
            {"ISOTROPIC", 2}, {"TRACTION", 3}, {"LAMINA", 6}, {"ENGINEERING CONSTANTS", 9}, {"ORTHOTROPIC", 9}};
        const std::string type = card.has("TYPE") ? card.required("TYPE") : "ISOTROPIC";
        const std::size_t count = types.at(type);
        Numbers constants = card.row();
        // A temperature may follow, and another row would be for another temperature.
        if (constants.size() < count || constants.size() > count + 1)
            throw SceneFailure(card.place, fmt::format("{} numbers: {} constants, at one temperature, are expected",
                                                       constants.size(), count));
        constants.resize(count);
        m.elastic = type;
        m.constants = std::move(constants);
        m.elastic_place = card.place;
    }

    // The strain from the initial temperature on does not depend on ZERO.
    void take_expansion(const InpCard& card) {
        require_constant(card);
        require_one_line(card);
        MaterialCards& m = material(card);
        if (!m.expansion.empty()) throw SceneFailure(card.place, "is given twice for one material");
        const std::size_t count = card.parameter("TYPE") == "ORTHO" ? 3 : 1;
        Numbers values = card.first_line().numbers();
        // A temperature may follow.
        if (values.size() != count && values.size() != count + 1)
            throw SceneFailure(card.place,
                               fmt::format("{} numbers: {} expected", values.size(), count == 1 ? "1 is" : "3 are"));
        values.resize(count);
        m.expansion = std::move(values);
    }

    void take_initiation(const InpCard& card) {
        require_constant(card);
        DamageCards& d = damage(card);
        if (!d.initiation.empty()) throw SceneFailure(card.place, "is given twice for one law");
        d.initiation = card.required("CRITERION");
        require_one_line(card);
        d.strengths = card.first_line().numbers();
        d.initiation_place = card.place;
        if (d.strengths.size() < 2) throw SceneFailure(card.place, "two or three values are expected");
        d.strengths.resize(3, d.strengths[1]);
    }

    void take_evolution(const InpCard& card) {
        require_constant(card);
        DamageCards& d = damage(card);
        if (!d.evolution.empty()) throw SceneFailure(card.place, "is given twice for one law");
        d.evolution = card.required("TYPE");
        if (card.has("SOFTENING")) d.softening = card.required("SOFTENING");
        d.mixed_mode = card.parameter("MIXED MODE BEHAVIOR");
        if (d.mixed_mode == "MODE INDEPENDENT") d.mixed_mode.clear();
        const bool table = d.mixed_mode == "TABULAR";
        if (card.has("MODE MIX RATIO")) d.mix_ratio = card.required("MODE MIX RATIO");
        if (d.mix_ratio == "TRACTION" && !table)
            throw SceneFailure(card.place,
                               "MODE MIX RATIO=TRACTION belongs to MIXED MODE BEHAVIOR=TABULAR: BK and POWER LAW mix "
                               "energies; write MODE MIX RATIO=ENERGY, or leave it out");
        if (table && (d.softening == "TABULAR" || (d.softening != "LINEAR" && d.evolution == "DISPLACEMENT")))
            throw SceneFailure(card.place,
                               "MIXED MODE BEHAVIOR=TABULAR is imported with SOFTENING=LINEAR or, with TYPE=ENERGY, "
                               "EXPONENTIAL");
        if (!d.mixed_mode.empty() && !table) {
            d.power = inp_number(card.required("POWER"), card.place);
            if (!(d.power > 0)) throw SceneFailure(card.place, fmt::format("POWER={}: must be > 0", d.power));
        }
        if (d.evolution == "DISPLACEMENT" && !d.mixed_mode.empty() && !table)
            throw SceneFailure(card.place, "MIXED MODE BEHAVIOR=" + d.mixed_mode + " needs TYPE=ENERGY");
        if (d.softening != "TABULAR" && !table) require_one_line(card);
        (void)card.first_line();
        for (const InpLine& line : card.lines) d.values.push_back(line.numbers());
        d.evolution_place = card.place;
    }

    void take_behavior(const InpCard& card) {
        require_constant(card);
        if (deck_.interactions.empty()) throw SceneFailure(card.place, "a *SURFACE INTERACTION is expected first");
        InteractionCards& interaction = deck_.interactions.back();
        if (interaction.cohesive) throw SceneFailure(card.place, "is given twice for one interaction");
        interaction.cohesive = true;
        interaction.eligibility = card.parameter("ELIGIBILITY");
        interaction.stiffness = card.row();
        interaction.stiffness_place = card.place;
        if (interaction.stiffness.empty()) return;  // that of contact
        if (interaction.stiffness.size() < 2) throw SceneFailure(card.place, "Knn, Kss, Ktt are expected, or no line");
        interaction.stiffness.resize(3, interaction.stiffness[1]);
    }

    void take_section(const InpCard& card) {
        require_one_section(card);
        Section section;
        section.place = card.place;
        section.orientation = card.parameter("ORIENTATION");
        section.part = part_;
        section.shell = card.keyword == "SHELL SECTION";
        if (!card.has("COMPOSITE")) {
            section.material = card.required("MATERIAL");
            if (!section.shell && !card.lines.empty() && !card.lines[0].fields.empty() &&
                !card.lines[0].fields[0].empty())
                section.width = positive_number(card.lines[0].fields[0], card.lines[0].place);
        } else {
            const Laminate laminate = laminate_of(card);
            section.material = laminate.material;
            section.plies = laminate.plies.angles.size() > 1;
            section.turned_plies = section.plies && laminate.turns();
            if (!section.plies) section.angle = laminate.plies.angles[0];
        }
        deck_.sections.push_back(std::move(section));
    }

    void require_one_section(const InpCard& card) {
        const std::string set = card.required("ELSET");
        const bool cohesive = card.keyword == "COHESIVE SECTION";
        const auto [other, first] = section_of_.emplace(std::tuple(part_, upper(set), cohesive), card.place);
        if (!first)
            throw SceneFailure(card.place, fmt::format("the elements \"{}\" have the section of {} already", set,
                                                       other->second.text()));
    }

    static double positive_number(const std::string& field, const Place& place) {
        const double value = inp_number(field, place);
        if (!(value > 0)) throw SceneFailure(place, fmt::format("thickness {}: must be > 0", value));
        return value;
    }

    void take_cohesive_section(const InpCard& card) {
        require_one_section(card);
        (void)card.required("RESPONSE");
        if (card.has("CONTROLS"))
            say_once(deck_.changed,
                     "CONTROLS of cohesive elements: no viscosity; jumps of the crack are found by energy");
        Section section;
        section.orientation = card.has("ORIENTATION") ? card.required("ORIENTATION") : "";
        section.part = part_;
        section.material = card.required("MATERIAL");
        section.thickness = card.has("THICKNESS") ? card.required("THICKNESS") : "SPECIFIED";
        if (card.has("STACK DIRECTION") && card.required("STACK DIRECTION") != "3")
            throw SceneFailure(
                card.place, "STACK DIRECTION=" + card.required("STACK DIRECTION") +
                                " is not imported: 3 is, with which the first half of the nodes of a cohesive element "
                                "is one face, the second half the other; number the nodes so");
        if (!card.lines.empty()) {
            const InpLine& line = card.lines[0];
            if (!line.fields.empty() && !line.fields[0].empty())
                section.value = positive_number(line.fields[0], line.place);
            if (line.fields.size() > 1 && !line.fields[1].empty())
                section.width = positive_number(line.fields[1], line.place);
        }
        section.place = card.place;
        deck_.sections.push_back(std::move(section));
    }

    // Viscosity is spoken of where cohesive elements have controls.
    void take_controls(const InpCard& card) {
        left_.insert(card.keyword);
        if (card.has("MAX DEGRADATION") && inp_number(card.required("MAX DEGRADATION"), card.place) < 1)
            say_once(deck_.changed,
                     fmt::format("*SECTION CONTROLS, MAX DEGRADATION={}: damage goes to 1 here, and leaves "
                                 "no stiffness",
                                 card.required("MAX DEGRADATION")));
    }

    void take_orientation(const InpCard& card) {
        Orientation orientation = orientation_of(card);
        orientation.part = part_;
        const std::pair key(part_, upper(orientation.name));
        deck_.orientations.emplace(key, std::move(orientation));
    }

    void take_pair(const InpCard& card) {
        if (!card.has("INTERACTION")) throw SceneFailure(card.place, "INTERACTION= is missing");
        const std::string interaction = card.required("INTERACTION");
        double adjust = 0;
        if (card.has("ADJUST")) {
            const std::string given = card.required("ADJUST");
            if (given.find_first_not_of("0123456789.+-eEdD") != std::string::npos)
                throw SceneFailure(card.place, "ADJUST=" + given + " is not imported: a distance is");
            adjust = inp_number(given, card.place);
            if (!(adjust >= 0)) throw SceneFailure(card.place, "ADJUST=" + given + ": a distance >= 0 is expected");
        }
        for (const InpLine& line : card.lines) {
            if (line.fields.size() < 2) throw SceneFailure(line.place, "a slave and a master surface are expected");
            pair_of_.emplace(std::pair(upper(line.fields[0]), upper(line.fields[1])), deck_.pairs.size());
            deck_.pairs.push_back({interaction,
                                   {&root_, line.fields[0], line.place},
                                   {&root_, line.fields[1], line.place},
                                   "",
                                   adjust,
                                   card.place});
        }
    }

    void take_general_contact(const InpCard&) { deck_.general_contact = true; }

    void take_inclusions(const InpCard& card) {
        if (!card.has("ALL EXTERIOR"))
            throw SceneFailure(card.place, "ALL EXTERIOR alone is imported: give the others as *CONTACT PAIR");
    }

    // The properties of contact that is no pair have no meaning here unless surfaces adhere.
    void take_assignment(const InpCard& card) {
        for (const InpLine& line : card.lines) {
            if (line.fields.size() != 3)
                throw SceneFailure(line.place, "two surfaces, or none, and an interaction are expected");
            const std::string &first = line.fields[0], &second = line.fields[1], &name = line.fields[2];
            if (!named(deck_.interactions, name, "surface interaction", line.place).cohesive) continue;
            if (first.empty() && second.empty()) {
                deck_.adhering = name;
                deck_.adhering_place = line.place;
                continue;
            }
            if (first.empty() || second.empty() || upper(first) == upper(second))
                throw SceneFailure(line.place,
                                   "two surfaces of different bodies are expected where they adhere, or none of both");
            deck_.pairs.push_back(
                {name, {&root_, first, line.place}, {&root_, second, line.place}, "", 0.0, line.place});
        }
    }

    void take_initial(const InpCard& card) {
        if (card.required("TYPE") == "TEMPERATURE")
            return StepReader::take_temperatures(card, root_, deck_.initial_temperatures);
        if (card.has("NORMAL"))
            throw SceneFailure(card.place,
                               "NORMAL is not imported: nodes that adhere do so in all directions; take it out where "
                               "this is meant");
        for (const InpLine& line : card.lines) {
            if (line.fields.size() != 3)
                throw SceneFailure(line.place, "slave, master and a set of nodes are expected");
            const auto pair = pair_of_.find({upper(line.fields[0]), upper(line.fields[1])});
            if (pair == pair_of_.end()) throw SceneFailure(line.place, "there is no *CONTACT PAIR of these surfaces");
            deck_.pairs[pair->second].bonded = line.fields[2];
        }
    }

    std::string path_;
    const Part& root_;
    Deck deck_;
    DamageCards& (DeckReader::*damage_of_)() = nullptr;
    StepReader steps_;
    ConstraintReader constraints_;
    std::string part_;                                                        // the part or instance that is open
    std::map<std::pair<std::string, std::string>, std::size_t> pair_of_;      // by slave and master in upper case
    std::map<std::tuple<std::string, std::string, bool>, Place> section_of_;  // by part, set and if it is cohesive
    std::set<std::string> left_;
};

}  // namespace

Deck read_deck(const std::vector<InpCard>& cards, const std::string& path, const Part& root) {
    return DeckReader(path, root).read(cards);
}

}  // namespace cli::abaqus
