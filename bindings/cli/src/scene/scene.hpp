// SPDX-License-Identifier: BSD-3-Clause
// A scene as written in the file (schema 1, see SCENE.md), checked as far as possible without a mesh. Every part keeps
// its place in the file, so that later errors can name it.
#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include "deck/deck_scene.hpp"
#include "mesh/mesh_data.hpp"
#include "text/error.hpp"
#include "text/unit.hpp"

namespace cli {

// A layer of the block, or a body of a mesh, which has no thickness and divisions.
struct Layer {
    std::string name;
    double thickness = 0;
    std::int64_t divisions = 1;
    std::size_t material = 0;
    std::optional<std::array<double, 6>> axes;  // of the material, 1 and 2, in space
    std::vector<std::array<double, 6>> plies;   // the same for each of its plies, from the bottom up; empty: one axes
    std::string formulation;                    // of its material, or that of its cells by default
    Place place;
};

// The block of layers; a mesh has only `dimension`, `plane` and `smallest_edge`.
struct Geometry {
    std::int32_t dimension = 2;
    std::int32_t cell_type = 0;
    std::vector<double> lengths;  // [dimension-1]
    std::vector<std::int64_t> divisions;
    std::string plane;
    double smallest_edge = 0;
    double height = 0;  // of all layers
    Place place;
};

struct Isotropic {
    double young = 0;
    double poisson = 0;
};

struct Material {
    std::string name;
    std::variant<Isotropic, std::array<double, 9>> elastic;  // or E1 E2 E3 nu12 nu13 nu23 G12 G13 G23
    std::string formulation;                                 // empty: by default
    std::optional<std::array<double, 3>> expansion;          // thermal, along the material's axes, per degree
    Place place;
};

struct LawData {
    std::string name;
    std::string kind;
    std::vector<std::pair<std::string, std::string>> texts;  // set first: they decide which parameters exist
    std::vector<std::pair<std::string, double>> parameters;
    std::vector<double> table_xi, table_s;  // softening of a tabulated law
    std::map<std::string, Place> places;    // of each given key
    Place place;
};

// Returns a number of a law by its key; 0: the law does not give it.
double law_number(const LawData& law, std::string_view key);
// True if the law gives numbers of its own for the second shear, so that the tangents of a pair are its axes.
bool has_axes(const LawData& law);
// Returns the law whose first shear is the second one of this law.
LawData with_second_shear(const LawData& law);
// Returns the peak of the traction in a mode, "normal", "tangential" or "second_tangential"; 0: the law has none, or
// does not give it.
double law_peak(const LawData& law, const std::string& mode);

// Adhesion of the pairs of an interface inside a box (in-plane between layers, in space in a mesh) or of a set of nodes
// of the mesh. Ends inside the interface are open: the pair there stays bonded.
struct Region {
    std::array<double, 3> lower{};
    std::array<double, 3> upper{};
    std::string set;
    bool outside = false;  // of a set: the faces that are not in it
    double adhesion = 0;
    Place place;
};

struct InterfaceData {
    std::size_t lower = 0;  // layers, or bodies of a mesh (a, b)
    std::size_t upper = 0;
    std::string a, b;  // in a mesh: names of bodies, with * for any characters; empty: all that touch
    bool projected = false;
    bool points = false;  // projected onto points of a's faces, not means
    double gap = 0;
    bool open = false;  // distances of the faces count
    double adjust = 0;  // smaller ones do not
    double tolerance = 0;
    std::string cut;  // of a body with itself: the set of faces along which its nodes are doubled; empty: none
    bool shared_bonded = false;  // pairs of nodes that both bodies have in the file are bonded, whatever the law
    std::string name;
    bool bonded = false;
    bool contact = false;  // alone, no adhesion
    std::size_t law = 0;
    std::optional<std::array<double, 3>> shear_axis;  // direction of the first tangent of its pairs
    std::vector<Region> parts;  // the faces for which it stands, all that lie in one of them; empty: those of no other
    std::vector<Region> regions;
    Place place;

    // True if it stands for the seams within one body, where faces of it lie on each other with nodes of their own.
    [[nodiscard]] bool within() const { return !a.empty() && a == b && a.find('*') == std::string::npos; }
};

struct GeneralContact {
    double gap = 0;  // faces of two bodies up to so far apart
    Place place;
};

struct Point {
    std::vector<double> at;
};
struct Box {
    std::vector<double> lower;
    std::vector<double> upper;
};
struct Patch {
    std::vector<double> lower;
    std::vector<double> upper;
    std::vector<double> normal;
};
// A set of nodes or faces of a mesh; without a name: all of the body's nodes.
struct NamedSet {
    std::string name;
};

// A node without cells, by its index in [[controls]].
struct ControlNode {
    std::size_t index = 0;
};

struct Selection {
    std::variant<Point, Box, Patch, NamedSet, ControlNode> shape;
    std::int32_t body = -1;
    double tolerance = 0;
    Place place;
    std::string name{};  // free text, for people
};

struct Term {
    std::size_t pattern = 0;
    double coefficient = 1;
};

// A time at which something begins or ends, an instant of the scene, and one by which what it changes is over.
struct Change {
    double at = 0;
    std::optional<double> over;
};

// A support has no terms.
struct Prescription {
    Selection where;
    std::vector<std::vector<double>> directions;
    std::vector<Term> terms;
    bool mean = false;  // of a set of faces: only the mean over them
    Place place;
    std::optional<Change> begin{}, end{};  // nothing: it holds from the first instant, to the last
};

// A node without cells to which the displacements or forces of others refer.
struct ControlData {
    std::string name;
    std::vector<double> at;
    bool placed = false;  // the scene says where
    Place place;
};

// One side of an equation: coefficient * direction . u of a node, or of the weighted mean over a patch.
struct EquationTerm {
    Selection where;
    std::vector<double> direction;
    double coefficient = 1;
};
struct EquationData {
    std::vector<EquationTerm> left;
    std::vector<Term> right;  // empty: 0
    std::string name;         // of the scene, or empty
    Place place;
};

// Nodes that move with a control node along some directions, as points of a rigid body where it has a rotation.
struct CouplingData {
    Selection where;
    std::vector<std::vector<double>> directions;
    std::size_t control = 0;
    std::optional<std::size_t> rotation;  // a control node too
    Place place;
};

// A rigid plane carried by a control node; nodes on it can separate from it.
struct ObstacleData {
    Selection where;  // patch or set
    std::string name;
    std::size_t control = 0;
    Place place;
};

// A periodic cell: the components of average strain (shears doubled) or stress that follow patterns.
struct CellComponent {
    std::size_t i = 0, j = 0;
    bool stress = false;
    std::vector<Term> terms;
    Place place;
};
struct CellData {
    std::vector<std::vector<double>> periods;
    std::vector<std::size_t> axes;      // along which the periods lie; one per period
    std::vector<std::size_t> controls;  // of each period
    std::vector<CellComponent> components;
    double tolerance = 0;
    Place place;
};

enum class ForceKind { total, traction, pressure };

struct DeadForce {
    Selection where;
    ForceKind kind = ForceKind::total;
    std::vector<double> force;  // a pressure has one value
    std::size_t pattern = 0;
    Place place;
};

// [[thermal]] and [[eigenstrains]]: the strain per unit factor of the pattern in a body, in its material's axes.
struct EigenstrainData {
    std::int32_t body = -1;
    std::array<double, 6> strain{};
    std::size_t pattern = 0;
    Place place;
};

struct PatternData {
    std::string name;
    std::vector<double> times;
    std::vector<double> values;
    Place place;
};

struct SolverOption {
    std::string key;
    std::variant<double, std::string> value;
    Place place;
};

struct Output {
    std::vector<std::string> fields;
    std::optional<std::int64_t> every;  // nothing: where something happens (result/fields/instants.hpp)
    std::vector<double> snapshots;
    bool own_snapshots = false;  // the scene names them
    double displacement_scale = 5;
    bool brief = false;                // the end is not examined
    std::vector<std::string> columns;  // values of the solver beyond the standard columns of history.csv
    Place columns_place;
    std::vector<std::string>
        sensitivities;  // numbers of laws by which the reactions are derived: laws[0].normal_toughness
    Place sensitivities_place;
    Place place;
};

// Labels only: the program does not convert units.
struct Units {
    UnitNames names;
    std::string time;
    bool given = false;  // the scene has the table, which may leave names empty on purpose
};

struct Scene {
    std::string file;
    std::optional<ImportedScene> imported;  // the file is no scene but a deck of Abaqus
    std::string title;
    std::string file_hash;              // of the bytes
    std::string content_hash;           // of the content with the settings; comments, order and layout do not matter
    std::vector<std::string> settings;  // KEY=VALUE of the command line
    Geometry geometry;
    std::shared_ptr<const MeshData> mesh;  // null: a block of layers
    std::vector<Layer> layers;             // by label of the body
    std::vector<Material> materials;
    std::vector<LawData> laws;
    std::vector<InterfaceData> interfaces;
    std::optional<GeneralContact> general_contact;  // wherever outer faces have no interface
    std::vector<PatternData> patterns;
    std::vector<Prescription> prescriptions;  // supports, then loads
    std::vector<DeadForce> forces;
    std::vector<EigenstrainData> eigenstrains;
    std::vector<ControlData> controls;
    std::vector<EquationData> equations;
    std::vector<CouplingData> couplings;
    std::vector<ObstacleData> obstacles;
    std::optional<CellData> cell;
    std::vector<double> times;  // instants, the first is that of the initial state
    std::vector<SolverOption> options;
    Output output;
    Units units;

    [[nodiscard]] std::size_t step_count() const { return times.size() - 1; }
};

// The factor of a pattern multiplies prescribed displacements or average strains of a cell, forces or average stresses
// of a cell, or strains within the bodies.
enum class Drives { displacement, force, strain };
std::vector<Drives> drives_of(const Scene& scene);  // for each pattern

}  // namespace cli
