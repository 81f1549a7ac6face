// SPDX-License-Identifier: BSD-3-Clause
// Data of an input file of Abaqus beside its mesh: materials, sections, interactions and the steps of the analysis, as
// written there. deck_cards.hpp reads them, deck_scene.hpp makes a scene of them.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <utility>
#include <vector>

#include "deck/abaqus/abaqus_model.hpp"
#include "deck/abaqus/inp_cards.hpp"
#include "deck/abaqus/orientations.hpp"
#include "text/error.hpp"
#include "text/refusals.hpp"
#include "text/wording.hpp"

namespace cli::abaqus {

using Numbers = std::vector<double>;

// Objects with names, in the order of the deck; found whatever the case of their name is, the first of several.
template <class T>
class Catalogue {
public:
    void push_back(T object) {
        at_.emplace(upper(object.name), all_.size());
        all_.push_back(std::move(object));
    }
    [[nodiscard]] const T* find(const std::string& name) const {
        const auto found = at_.find(upper(name));
        return found == at_.end() ? nullptr : &all_[found->second];
    }
    [[nodiscard]] bool empty() const { return all_.empty(); }
    [[nodiscard]] T& back() { return all_.back(); }
    [[nodiscard]] auto begin() const { return all_.begin(); }
    [[nodiscard]] auto end() const { return all_.end(); }

private:
    std::vector<T> all_;
    std::unordered_map<std::string, std::size_t> at_;
};

// Begins a line of origin_line(); no other line of a scene begins so.
inline constexpr std::string_view begin_of_origin_line = "#@";

inline constexpr const char* axis_names[] = {"x", "y", "z"};

// *DAMAGE INITIATION and *DAMAGE EVOLUTION, of a material or of a surface interaction.
struct DamageCards {
    std::string initiation;  // MAXS, QUADS, ..; empty: none
    Numbers strengths;
    Place initiation_place;
    std::string evolution;  // ENERGY or DISPLACEMENT; empty: none
    std::string softening = "LINEAR";
    std::string mixed_mode;            // BK, POWER LAW, TABULAR; empty: none
    std::string mix_ratio = "ENERGY";  // of a TABULAR mixed_mode, or TRACTION
    double power = 0;
    std::vector<Numbers> values;
    Place evolution_place;
};

struct MaterialCards {
    std::string name;
    std::string elastic;  // TYPE of *ELASTIC; empty: none
    Numbers constants;
    Place elastic_place{};
    Numbers expansion{};  // one value, or one for each axis; empty: none
    DamageCards damage{};
    Place place;
    std::optional<Refusals> refusal{};  // why it cannot be used
};

struct Section {
    std::string material;
    std::string orientation;
    double angle = 0;    // of the one ply of a composite, degrees about its normal
    bool plies = false;  // a composite of several, whose cells the mesh splits
    bool turned_plies = false;
    std::string thickness{};  // of cohesive elements: SPECIFIED or GEOMETRY
    double value = 1;         // the specified thickness
    double width = 1;         // out of the plane
    bool shell = false;
    std::string part{};  // the part or instance in which it and its orientation stand
    Place place;         // of the card, by which the mesh knows it
};

struct InteractionCards {
    std::string name;
    bool cohesive = false;
    Numbers stiffness;
    Place stiffness_place{};
    std::string eligibility;
    DamageCards damage;
    Place place;
    std::optional<Refusals> refusal{};
};

struct ContactPair {
    std::string interaction;
    Entry slave, master;   // surfaces
    std::string bonded{};  // of *INITIAL CONDITIONS, TYPE=CONTACT: the set of nodes that adhere; empty: all
    double adjust = 0;     // faces up to so far apart are moved together
    Place place;
};

struct Amplitude {
    std::string name;
    bool total_time = false;
    bool absolute = false;
    bool smooth = false;
    std::vector<std::pair<double, double>> points;
    Place place;
    std::optional<Refusals> refusal{};
};

// A term of *EQUATION.
struct EquationEntry {
    Entry where;
    int dof = 0;
    double coefficient = 0;
};

// Nodes that move with a reference node as one rigid body: *COUPLING with *KINEMATIC, *RIGID BODY. Or that do so in the
// mean: *DISTRIBUTING.
struct Coupling {
    Entry reference;
    Entry where;
    std::vector<int> dofs;               // 1 to 3; empty: all
    std::optional<Entry> rotation_node;  // of CalculiX: its degrees of freedom 1 to 3 are the rotation
    Place place;
    bool in_mean = false;
    bool turns = true;  // in the mean: the reference node turns, too
};

// Nodes that *MPC, of type TIE or PIN, lets move alike: one, or two sets node by node.
struct Pin {
    Entry first, second;
};

// *TRANSFORM: the degrees of freedom 1 to 3 of nodes are along these axes.
struct Transform {
    Entry where;
    std::array<std::array<double, 3>, 3> axes{};
    Place place;
};

// A line of *BOUNDARY, *CLOAD or *DSLOAD.
struct LoadLine {
    Entry where;
    int first = 0, last = 0;  // degrees of freedom, 1 to 6; of a distributed load 0
    std::string distributed;  // P, TRVEC
    double magnitude = 0;
    Numbers direction{};  // of TRVEC
    std::string amplitude{};
    bool fixed = false;  // at the displacement at which the step begins
    bool rate = false;   // of TYPE=VELOCITY: what it adds in a unit of time
    bool named = false;  // ENCASTRE, ..: of its degrees of freedom, those that the node has
};

struct Step {
    std::string name;
    double increment = 1;        // that its load steps have here at most, and over which what jumps at its begin moves
    double least_increment = 0;  // 0: not said
    double period = 1;
    bool ramp = true;  // loads without an amplitude grow over the step
    bool new_boundaries = false, new_forces = false, new_distributed = false;  // those before end
    Place renewed{};                                                           // *BOUNDARY, OP=NEW
    std::optional<bool> large;  // NLGEOM: large displacements and rotations; nothing: not said
    bool riks = false;
    bool procedure = false;  // *STATIC or *DYNAMIC has come
    std::vector<LoadLine> boundaries, forces, temperatures;
    Place place;
};

struct Deck {
    std::string title;
    Catalogue<MaterialCards> materials;
    std::vector<Section> sections;
    std::map<std::pair<std::string, std::string>, Orientation> orientations;  // by part and name in upper case
    Catalogue<InteractionCards> interactions;
    std::vector<ContactPair> pairs;
    Catalogue<Amplitude> amplitudes;
    std::vector<std::vector<EquationEntry>> equations;
    std::vector<Transform> transforms;
    std::vector<Pin> pins;
    std::vector<Coupling> couplings;
    std::vector<LoadLine> held;  // *BOUNDARY before the first step
    std::vector<LoadLine> initial_temperatures;
    std::vector<Step> steps;
    bool general_contact = false;
    std::string adhering{};  // the interaction of all bodies that touch and have no other; empty: contact
    Place adhering_place{};
    double width = 0;                  // of a plane mesh; 0: not known yet
    std::string solver_keys{};         // lines of [solver]
    std::vector<std::string> changed;  // for people: what the scene does otherwise
    std::vector<std::string> left_out;
};

// The section of a set of elements, and the part or instance in which the set is. Null: it has none.
struct SectionOf {
    const Section* section = nullptr;
    const Part* scope = nullptr;
};
// The sections of all sets, found by the names that the sets have in the scene.
class SectionIndex {
public:
    // sections: Part::sections or Part::cohesive_sections.
    SectionIndex(const Deck& deck, const Model& model, std::vector<Entry> Part::*sections);
    [[nodiscard]] SectionOf of(const std::string& name) const;

private:
    std::unordered_map<std::string, SectionOf> of_;
};

// The orientation that a section names: of its part, else of the whole deck. Throws SceneFailure where there is none.
const Orientation& orientation_of(const Deck& deck, const Section& section);

// The names that sets of nodes and surfaces have in the scene; "": there is none.
std::string node_set_name(const Model& model, const Entry& raw);
std::string surface_name(const Model& model, const Entry& raw);

// An element of the deck. Null: there is none.
struct FoundElement {
    const Part* scope = nullptr;
    const Element* element = nullptr;
};
// A cohesive element by the nodes of its lower face in the mesh.
FoundElement cohesive_element(const Model& model, const std::vector<std::int64_t>& lower);
// The first element that is a cell and has these nodes of the mesh.
FoundElement cell_with(const Model& model, const std::vector<std::int64_t>& nodes);

// The line before a table of the scene that says which card it comes from; import_deck makes a comment of it.
std::string origin_line(const Place& place);

// 1 to `most`. Throws SceneFailure at `place`.
int degree_of_freedom(const std::string& field, int most, const Place& place);

// Adds a line for people, once.
inline void say_once(std::vector<std::string>& texts, const std::string& text) {
    if (std::find(texts.begin(), texts.end(), text) == texts.end()) texts.push_back(text);
}

// The object of this name, whatever its case. Throws SceneFailure at `place`, or where the object is refused.
template <class T>
const T& named(const Catalogue<T>& all, const std::string& name, const char* what, const Place& place) {
    if (const T* found = all.find(name)) {
        if (found->refusal) throw Refusals(*found->refusal);
        return *found;
    }
    std::vector<std::string> known;
    for (const T& each : all) known.push_back(each.name);
    throw SceneFailure(place, std::string(what) + " \"" + name + "\" is not there" + suggestion(name, known));
}

}  // namespace cli::abaqus
