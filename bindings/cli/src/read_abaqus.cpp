// SPDX-License-Identifier: BSD-3-Clause
#include "read_abaqus.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <optional>
#include <set>
#include <unordered_map>

#include <fmt/format.h>

#include "cell_shape.hpp"
#include "delam/delam.h"
#include "hash.hpp"
#include "inp_cards.hpp"
#include "reader.hpp"

namespace cli {

namespace {

struct ElementType {
    std::string_view name;
    std::int32_t cell;
    std::string_view formulation;
    std::string_view plane;
    std::string_view note;
};

constexpr std::string_view full = "integrated fully here";
constexpr std::string_view plain = "a plain quadratic cell here";

// The node orders are the library's: corners, then the nodes midway, C3D20 the bottom's, the top's, the vertical ones.
constexpr ElementType element_types[] = {
    {"CPE3", DELAM_TRI3, "", "plane-strain", ""},
    {"CPE4", DELAM_QUAD4, "", "plane-strain", ""},
    {"CPE4R", DELAM_QUAD4, "", "plane-strain", full},
    {"CPE4I", DELAM_QUAD4, "incompatible", "plane-strain", ""},
    {"CPE6", DELAM_TRI6, "", "plane-strain", ""},
    {"CPE6M", DELAM_TRI6, "", "plane-strain", plain},
    {"CPE8", DELAM_QUAD8, "", "plane-strain", ""},
    {"CPE8R", DELAM_QUAD8, "", "plane-strain", full},
    {"CPS3", DELAM_TRI3, "", "plane-stress", ""},
    {"CPS4", DELAM_QUAD4, "", "plane-stress", ""},
    {"CPS4R", DELAM_QUAD4, "", "plane-stress", full},
    {"CPS4I", DELAM_QUAD4, "incompatible", "plane-stress", ""},
    {"CPS6", DELAM_TRI6, "", "plane-stress", ""},
    {"CPS6M", DELAM_TRI6, "", "plane-stress", plain},
    {"CPS8", DELAM_QUAD8, "", "plane-stress", ""},
    {"CPS8R", DELAM_QUAD8, "", "plane-stress", full},
    {"C3D4", DELAM_TET4, "", "", ""},
    {"C3D8", DELAM_HEX8, "", "", ""},
    {"C3D8R", DELAM_HEX8, "", "", full},
    {"C3D8I", DELAM_HEX8, "incompatible", "", ""},
    {"C3D10", DELAM_TET10, "", "", ""},
    {"C3D10M", DELAM_TET10, "", "", plain},
    {"C3D20", DELAM_HEX20, "", "", ""},
    {"C3D20R", DELAM_HEX20, "", "", full},
};

// Materials, loads, steps and requests for output: the scene says these. A *STEP is passed over to its end.
const std::set<std::string> passed_over{"AMPLITUDE",
                                        "BOUNDARY",
                                        "CLOAD",
                                        "COHESIVE BEHAVIOR",
                                        "CONTACT",
                                        "CONTACT PAIR",
                                        "CONTACT PROPERTY ASSIGNMENT",
                                        "CONTACT INCLUSIONS",
                                        "CONTACT EXCLUSIONS",
                                        "CONDUCTIVITY",
                                        "DAMAGE EVOLUTION",
                                        "DAMAGE INITIATION",
                                        "DAMAGE STABILIZATION",
                                        "DAMPING",
                                        "DENSITY",
                                        "DEPVAR",
                                        "DISTRIBUTION",
                                        "DISTRIBUTION TABLE",
                                        "DLOAD",
                                        "DSLOAD",
                                        "ELASTIC",
                                        "ELEMENT OUTPUT",
                                        "EXPANSION",
                                        "FIELD",
                                        "FRICTION",
                                        "HOURGLASS STIFFNESS",
                                        "INITIAL CONDITIONS",
                                        "MATERIAL",
                                        "NODE OUTPUT",
                                        "ORIENTATION",
                                        "OUTPUT",
                                        "PHYSICAL CONSTANTS",
                                        "PLASTIC",
                                        "PREPRINT",
                                        "RESTART",
                                        "SECTION CONTROLS",
                                        "SPECIFIC HEAT",
                                        "SURFACE BEHAVIOR",
                                        "SURFACE INTERACTION",
                                        "TIME POINTS",
                                        "USER DEFINED FIELD",
                                        "USER MATERIAL"};

struct Node {
    std::int64_t id;
    std::array<double, 3> at;
};

struct Element {
    std::int64_t id;
    const ElementType* type;
    std::vector<std::int64_t> nodes;  // ids
    std::string set;                  // of the *ELEMENT line
    Place place;
};

struct Part;

// An entry of a set as it is written: a number, the name of a set, or either with the instance before it.
struct Entry {
    const Part* scope;
    std::string text;
    Place place;
};

struct Set {
    std::string name;  // as spelt first
    std::vector<Entry> entries;
    std::vector<Entry> element_sets;  // of node sets: all nodes of their elements
    Place place;
};

struct Side {
    Entry elements;
    std::size_t side;
};

struct Surface {
    std::string name;
    std::vector<Side> sides;
    std::vector<Entry> nodes;  // of TYPE=NODE
    bool of_nodes = false;
    Place place;
};

// A part, an instance of one, or what stands outside of both.
struct Part {
    std::string name;
    std::vector<Node> nodes;
    std::vector<Element> elements;
    std::unordered_map<std::int64_t, std::size_t> node_of;     // by id
    std::unordered_map<std::int64_t, std::size_t> element_of;  // by id
    std::map<std::string, Set> node_sets;                      // by upper case
    std::map<std::string, Set> element_sets;
    std::map<std::string, Surface> surfaces;
    std::vector<Entry> sections;  // their element sets
    std::size_t order = 0;        // among what the mesh is made of
    std::int64_t first_node = 0;  // of the mesh
};

struct ElementAt {
    const Part* scope;
    std::size_t index;
    bool operator<(const ElementAt& other) const {
        return std::pair(scope->order, index) < std::pair(other.scope->order, other.index);
    }
};

// Rotation of a point by an angle about the axis from a to b (Rodrigues).
std::array<double, 3> rotated(const std::array<double, 3>& point, const std::array<double, 3>& a,
                              const std::array<double, 3>& b, double angle) {
    std::array<double, 3> k{b[0] - a[0], b[1] - a[1], b[2] - a[2]};
    const double length = std::hypot(k[0], k[1], k[2]);
    for (double& x : k) x /= length;
    const std::array<double, 3> v{point[0] - a[0], point[1] - a[1], point[2] - a[2]};
    const double along = k[0] * v[0] + k[1] * v[1] + k[2] * v[2];
    const std::array<double, 3> across{k[1] * v[2] - k[2] * v[1], k[2] * v[0] - k[0] * v[2],
                                       k[0] * v[1] - k[1] * v[0]};
    std::array<double, 3> out{};
    for (std::size_t i = 0; i < 3; ++i)
        out[i] = a[i] + v[i] * std::cos(angle) + across[i] * std::sin(angle) + k[i] * along * (1 - std::cos(angle));
    return out;
}

class AbaqusReader {
public:
    MeshData read(const std::vector<InpCard>& cards, const std::string& path, const std::vector<std::string>& bodies,
                  const Place& place) {
        file_ = {path, "", 0};
        for (const InpCard& card : cards) take(card);
        if (open_ != &root_) throw SceneFailure(file_, "\"" + open_->name + "\" is not ended");
        if (in_step_) throw SceneFailure(file_, "*STEP is not ended");
        if (instances_.empty())
            for (const auto& [key, part] : parts_)
                throw SceneFailure(file_, fmt::format("part \"{}\" is in no *INSTANCE", part->name));
        if (!passed_.empty()) mesh_.notes.push_back("passed over: " + listing({passed_.begin(), passed_.end()}));
        number_nodes();
        assign_bodies(bodies, place);
        add_cells();
        add_sets();
        return std::move(mesh_);
    }

private:
    // ---- cards ----

    void take(const InpCard& card) {
        const std::string& word = card.keyword;
        if (in_step_) {
            in_step_ = word != "END STEP";
            return;
        }
        if (word == "STEP") {
            in_step_ = true;
            passed_.insert("*STEP");
        } else if (word == "HEADING") {
            return;
        } else if (word == "NODE") {
            take_nodes(card);
        } else if (word == "ELEMENT") {
            take_elements(card);
        } else if (word == "NSET") {
            take_set(card, open_->node_sets, "NSET");
        } else if (word == "ELSET") {
            take_set(card, open_->element_sets, "ELSET");
        } else if (word == "SURFACE") {
            take_surface(card);
        } else if (word == "SOLID SECTION") {
            open_->sections.push_back({open_, card.required("ELSET"), card.place});
        } else if (word == "PART") {
            begin_part(card);
        } else if (word == "INSTANCE") {
            begin_instance(card);
        } else if (word == "ASSEMBLY") {
            require_outside(card);
        } else if (word == "END ASSEMBLY") {
            require_outside(card);
        } else if (word == "END PART" || word == "END INSTANCE") {
            if (open_ == &root_) throw SceneFailure(card.place, "nothing of the kind was begun");
            open_ = &root_;
        } else if (passed_over.contains(word)) {
            passed_.insert("*" + word);
        } else {
            throw SceneFailure(card.place, "this keyword is not read; SCENE.md lists those that are, and those that "
                                           "are passed over");
        }
    }

    void require_outside(const InpCard& card) const {
        if (open_ != &root_) throw SceneFailure(card.place, "\"" + open_->name + "\" is not ended");
    }

    void begin_part(const InpCard& card) {
        require_outside(card);
        card.only({"NAME"});
        auto& part = parts_[upper(card.required("NAME"))];
        if (part) throw SceneFailure(card.place, "there is another part \"" + part->name + "\"");
        part = std::make_unique<Part>();
        part->name = card.required("NAME");
        open_ = part.get();
    }

    // The part's nodes are moved by the first data line and turned by the second: two points of the axis, degrees.
    void begin_instance(const InpCard& card) {
        require_outside(card);
        card.only({"NAME", "PART"});
        const auto from = parts_.find(upper(card.required("PART")));
        if (from == parts_.end())
            throw SceneFailure(card.place, "part \"" + card.required("PART") + "\" is not there");
        const std::string name = card.required("NAME");
        for (const auto& other : instances_)
            if (upper(other->name) == upper(name))
                throw SceneFailure(card.place, "there is another instance \"" + name + "\"");
        instances_.push_back(std::make_unique<Part>(*from->second));
        Part& instance = *instances_.back();
        const Part* part = from->second.get();
        instance.name = name;
        instance.order = instances_.size();
        // What the part says of itself is said of the instance now.
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
        if (card.lines.size() > 2) throw SceneFailure(card.lines[2].place, "at most two lines are expected");
        if (!card.lines.empty()) {
            const std::vector<double> by = numbers(card.lines[0], 3);
            for (Node& node : instance.nodes)
                for (std::size_t a = 0; a < 3; ++a) node.at[a] += by[a];
        }
        if (card.lines.size() == 2) {
            const std::vector<double> turn = numbers(card.lines[1], 7);
            const std::array<double, 3> a{turn[0], turn[1], turn[2]};
            const std::array<double, 3> b{turn[3], turn[4], turn[5]};
            if (a == b) throw SceneFailure(card.lines[1].place, "the two points of the axis of rotation are the same");
            for (Node& node : instance.nodes) node.at = rotated(node.at, a, b, turn[6] * std::numbers::pi / 180);
        }
        open_ = &instance;
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
        card.only({"NSET"});
        for (const InpLine& line : card.lines) {
            if (line.fields.size() < 3 || line.fields.size() > 4)
                throw SceneFailure(line.place, fmt::format("{} entries: a number and 2 or 3 coordinates are expected",
                                                           line.fields.size()));
            Node node{inp_whole(line.fields[0], line.place), {}};
            for (std::size_t i = 1; i < line.fields.size(); ++i)
                node.at[i - 1] = inp_number(line.fields[i], line.place);
            if (!open_->node_of.emplace(node.id, open_->nodes.size()).second)
                throw SceneFailure(line.place, fmt::format("node {} is there twice", node.id));
            open_->nodes.push_back(node);
            if (card.has("NSET"))
                set_named(open_->node_sets, card.required("NSET"), card.place)
                    .entries.push_back({open_, line.fields[0], line.place});
        }
    }

    static const ElementType& type_named(const InpCard& card) {
        const std::string name = upper(card.required("TYPE"));
        std::vector<std::string> known;
        for (const ElementType& type : element_types) {
            if (type.name == name) return type;
            known.emplace_back(type.name);
        }
        if (name.rfind("COH", 0) == 0)
            throw SceneFailure(card.place, "type " + name + ": cohesive elements are not read: remove them, "
                                           "[[interfaces]] hold bodies that touch");
        throw SceneFailure(card.place, fmt::format("type {} is not read{}; these are: {}", name,
                                                   suggestion(name, known), listing(known)));
    }

    void take_elements(const InpCard& card) {
        card.only({"TYPE", "ELSET"});
        const ElementType& type = type_named(card);
        const std::size_t per_element = shape_of(type.cell).nodes;
        if (!type.note.empty()) set_note(fmt::format("{}: {}", type.name, type.note));
        if (!type.formulation.empty())
            set_note(fmt::format("{}: formulation \"{}\" unless the scene says otherwise", type.name,
                                 type.formulation));
        for (std::size_t i = 0; i < card.lines.size(); ++i) {
            // A line that ends with a comma goes on in the next.
            std::vector<std::string> fields = card.lines[i].fields;
            const Place place = card.lines[i].place;
            while (card.lines[i].continues && fields.size() < per_element + 1 && i + 1 < card.lines.size()) {
                ++i;
                fields.insert(fields.end(), card.lines[i].fields.begin(), card.lines[i].fields.end());
            }
            if (fields.size() != per_element + 1)
                throw SceneFailure(place, fmt::format("{} nodes: {} has {}", fields.empty() ? 0 : fields.size() - 1,
                                                      type.name, per_element));
            Element element{inp_whole(fields[0], place), &type, {}, card.parameter("ELSET"), place};
            for (std::size_t k = 1; k < fields.size(); ++k) element.nodes.push_back(inp_whole(fields[k], place));
            if (!open_->element_of.emplace(element.id, open_->elements.size()).second)
                throw SceneFailure(place, fmt::format("element {} is there twice", element.id));
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

    const Part* instance_named(const std::string& name, const Place& place) const {
        for (const auto& instance : instances_)
            if (upper(instance->name) == upper(name)) return instance.get();
        throw SceneFailure(place, "instance \"" + name + "\" is not there");
    }

    void take_set(const InpCard& card, std::map<std::string, Set>& sets, const std::string& key) {
        card.only(key == "NSET"
                      ? std::vector<std::string>{key, "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED", "ELSET"}
                      : std::vector<std::string>{key, "GENERATE", "INSTANCE", "INTERNAL", "UNSORTED"});
        Set& set = set_named(sets, card.required(key), card.place);
        const Part* scope =
            card.has("INSTANCE") ? instance_named(card.required("INSTANCE"), card.place) : open_;
        if (key == "NSET" && card.has("ELSET"))
            set.element_sets.push_back({scope, card.required("ELSET"), card.place});
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
            throw SceneFailure(line.place, fmt::format("{} entries: first, last and (1) increment are expected",
                                                       line.fields.size()));
        const std::int64_t first = inp_whole(line.fields[0], line.place);
        const std::int64_t last = inp_whole(line.fields[1], line.place);
        const std::int64_t by = line.fields.size() == 3 ? inp_whole(line.fields[2], line.place) : 1;
        if (by <= 0 || last < first || last - first > std::int64_t{1000000000} || (last - first) % by != 0)
            throw SceneFailure(line.place, fmt::format("{}, {}, {}: from first up to last in whole increments > 0",
                                                       first, last, by));
        for (std::int64_t id = first; id <= last; id += by)
            set.entries.push_back({scope, std::to_string(id), line.place});
    }

    void take_surface(const InpCard& card) {
        card.only({"NAME", "TYPE", "INTERNAL"});
        const std::string name = card.required("NAME");
        const std::string type = card.has("TYPE") ? upper(card.required("TYPE")) : "ELEMENT";
        if (type != "ELEMENT" && type != "NODE")
            throw SceneFailure(card.place, "TYPE=" + type + " is not read: ELEMENT and NODE are");
        Surface& surface = open_->surfaces[upper(name)];
        if (!surface.name.empty()) throw SceneFailure(card.place, "there is another surface \"" + name + "\"");
        surface.name = name;
        surface.place = card.place;
        surface.of_nodes = type == "NODE";
        for (const InpLine& line : card.lines) {
            if (surface.of_nodes) {
                surface.nodes.push_back({open_, line.fields.at(0), line.place});
                continue;
            }
            if (line.fields.size() != 2)
                throw SceneFailure(line.place, "an element or an element set and a side, S1 .. S6, are expected");
            const std::string side = upper(line.fields[1]);
            if (side.size() != 2 || side[0] != 'S' || side[1] < '1' || side[1] > '6')
                throw SceneFailure(line.place, "\"" + line.fields[1] + "\": a side, S1 .. S6, is expected");
            surface.sides.push_back({{open_, line.fields[0], line.place}, static_cast<std::size_t>(side[1] - '1')});
        }
    }

    void set_note(const std::string& text) {
        if (std::find(mesh_.notes.begin(), mesh_.notes.end(), text) == mesh_.notes.end()) mesh_.notes.push_back(text);
    }

    // ---- from entries to nodes and elements ----

    std::vector<const Part*> scopes() const {
        std::vector<const Part*> out{&root_};
        for (const auto& instance : instances_) out.push_back(instance.get());
        return out;
    }

    // Splits "instance.rest" off.
    Entry resolved_scope(const Entry& entry) const {
        const std::size_t dot = entry.text.find('.');
        if (dot == std::string::npos || entry.scope != &root_ || instances_.empty()) return entry;
        return {instance_named(entry.text.substr(0, dot), entry.place), entry.text.substr(dot + 1), entry.place};
    }

    // The elements of an entry: a number or the name of a set.
    void collect_elements(const Entry& raw, std::set<ElementAt>& out, int depth = 0) const {
        const Entry entry = resolved_scope(raw);
        if (const auto id = inp_whole(entry.text)) {
            const auto at = entry.scope->element_of.find(*id);
            if (at == entry.scope->element_of.end())
                throw SceneFailure(entry.place, fmt::format("element {} is not there", entry.text));
            out.insert({entry.scope, at->second});
            return;
        }
        const auto set = entry.scope->element_sets.find(upper(entry.text));
        if (set == entry.scope->element_sets.end())
            throw SceneFailure(entry.place, fmt::format("element set \"{}\" is not there", entry.text));
        if (depth > 20) throw SceneFailure(entry.place, "element sets contain each other");
        for (const Entry& part : set->second.entries) collect_elements(part, out, depth + 1);
    }

    std::int64_t node_number(const Part& scope, std::int64_t id, const Place& place) const {
        const auto at = scope.node_of.find(id);
        if (at == scope.node_of.end()) throw SceneFailure(place, fmt::format("node {} is not there", id));
        return scope.first_node + static_cast<std::int64_t>(at->second);
    }

    void collect_nodes(const Entry& raw, std::set<std::int64_t>& out, int depth = 0) const {
        const Entry entry = resolved_scope(raw);
        if (const auto id = inp_whole(entry.text)) {
            out.insert(node_number(*entry.scope, *id, entry.place));
            return;
        }
        const auto set = entry.scope->node_sets.find(upper(entry.text));
        if (set == entry.scope->node_sets.end())
            throw SceneFailure(entry.place, fmt::format("node set \"{}\" is not there", entry.text));
        if (depth > 20) throw SceneFailure(entry.place, "node sets contain each other");
        collect_set(set->second, out, depth + 1);
    }

    void collect_set(const Set& set, std::set<std::int64_t>& out, int depth = 0) const {
        for (const Entry& part : set.entries) collect_nodes(part, out, depth);
        for (const Entry& from : set.element_sets) {
            std::set<ElementAt> elements;
            collect_elements(from, elements);
            for (const ElementAt& at : elements) {
                const Element& element = at.scope->elements[at.index];
                for (const std::int64_t id : element.nodes) out.insert(node_number(*at.scope, id, element.place));
            }
        }
    }

    static std::string full_name(const Part& scope, const std::string& name) {
        return scope.name.empty() ? name : scope.name + "." + name;
    }

    // ---- the mesh ----

    void number_nodes() {
        bool plane = false;
        bool solid = false;
        for (const Part* scope : scopes())
            for (const Element& element : scope->elements) {
                (shape_of(element.type->cell).dimension == 2 ? plane : solid) = true;
                if (plane && solid) throw SceneFailure(element.place, "plane and solid elements in one mesh");
                if (element.type->plane.empty()) continue;
                if (!mesh_.plane.empty() && mesh_.plane != element.type->plane)
                    throw SceneFailure(element.place, "elements of plane strain and of plane stress in one mesh");
                mesh_.plane = element.type->plane;
            }
        if (!plane && !solid) throw SceneFailure(file_, "there are no elements in it");
        mesh_.dimension = plane ? 2 : 3;
        const auto dimension = static_cast<std::size_t>(mesh_.dimension);
        std::vector<Part*> all{&root_};
        for (const auto& instance : instances_) all.push_back(instance.get());
        double extent = 0;
        for (const Part* scope : all)
            for (const Node& node : scope->nodes)
                for (const double x : node.at) extent = std::max(extent, std::abs(x));
        for (Part* scope : all) {
            scope->first_node = static_cast<std::int64_t>(mesh_.nodes.size() / dimension);
            for (const Node& node : scope->nodes) {
                if (plane && std::abs(node.at[2]) > 1e-12 * extent)
                    throw SceneFailure(file_, fmt::format("node {} is at z = {}: a plane mesh must lie in z = 0",
                                                          full_name(*scope, std::to_string(node.id)), node.at[2]));
                mesh_.nodes.insert(mesh_.nodes.end(), node.at.begin(),
                                   node.at.begin() + static_cast<std::ptrdiff_t>(dimension));
            }
        }
    }

    void assign_body(const std::string& name, const Entry& elements) {
        std::set<ElementAt> members;
        collect_elements(elements, members);
        if (members.empty()) throw SceneFailure(elements.place, "\"" + elements.text + "\": there is no element in it");
        const auto at = std::find(mesh_.body_names.begin(), mesh_.body_names.end(), name);
        const auto label = static_cast<std::int32_t>(at - mesh_.body_names.begin());
        if (at == mesh_.body_names.end()) mesh_.body_names.push_back(name);
        for (const ElementAt& member : members) {
            const auto [entry, fresh] = body_of_.emplace(member, label);
            if (!fresh && entry->second != label)
                throw SceneFailure(elements.place,
                                   fmt::format("element {} is in \"{}\" and in \"{}\": it belongs to one body only",
                                               member.scope->elements[member.index].id,
                                               mesh_.body_names[static_cast<std::size_t>(entry->second)], name));
        }
    }

    // The name that a set has in the scene, as it was spelt first.
    std::string body_name(const Entry& raw) const {
        const Entry entry = resolved_scope(raw);
        const auto set = entry.scope->element_sets.find(upper(entry.text));
        return full_name(*entry.scope, set == entry.scope->element_sets.end() ? entry.text : set->second.name);
    }

    void assign_bodies(const std::vector<std::string>& wanted, const Place& place) {
        for (const std::string& name : wanted) {
            const Entry entry{&root_, name, {place.file, place.path + ".bodies", place.line}};
            assign_body(name, entry);
        }
        if (wanted.empty())
            for (const Part* scope : scopes())
                for (const Entry& section : scope->sections) assign_body(body_name(section), section);
        if (mesh_.body_names.empty()) {
            for (const Part* scope : scopes())
                for (const Element& element : scope->elements)
                    assign_body(element.set.empty() ? (scope->name.empty() ? "body" : scope->name)
                                                    : body_name({scope, element.set, element.place}),
                                {scope, std::to_string(element.id), element.place});
            return;
        }
        for (const Part* scope : scopes())
            for (std::size_t i = 0; i < scope->elements.size(); ++i)
                if (!body_of_.contains({scope, i}))
                    throw SceneFailure(scope->elements[i].place,
                                       fmt::format("element {} is in none of the bodies: {}", scope->elements[i].id,
                                                   listing(mesh_.body_names)));
    }

    void add_cells() {
        mesh_.formulations.resize(mesh_.body_names.size());
        for (const Part* scope : scopes())
            for (std::size_t i = 0; i < scope->elements.size(); ++i) {
                const Element& element = scope->elements[i];
                auto block = std::find_if(mesh_.blocks.begin(), mesh_.blocks.end(),
                                          [&](const CellBlock& b) { return b.type == element.type->cell; });
                if (block == mesh_.blocks.end())
                    block = mesh_.blocks.insert(block, CellBlock{element.type->cell, {}, {}});
                for (const std::int64_t id : element.nodes)
                    block->connectivity.push_back(node_number(*scope, id, element.place));
                const std::int32_t body = body_of_.at({scope, i});
                block->bodies.push_back(body);
                std::string& formulation = mesh_.formulations[static_cast<std::size_t>(body)];
                if (formulation.empty()) formulation = element.type->formulation;
            }
        if (std::all_of(mesh_.formulations.begin(), mesh_.formulations.end(), [](const auto& f) { return f.empty(); }))
            mesh_.formulations.clear();
    }

    void add_sets() {
        for (const Part* scope : scopes()) {
            for (const auto& [key, set] : scope->node_sets) {
                std::set<std::int64_t> nodes;
                collect_set(set, nodes);
                if (!nodes.empty()) mesh_.node_sets[full_name(*scope, set.name)].assign(nodes.begin(), nodes.end());
            }
            for (const auto& [key, surface] : scope->surfaces) {
                const std::string name = full_name(*scope, surface.name);
                if (mesh_.node_sets.contains(name))
                    throw SceneFailure(surface.place, "\"" + name + "\" is a node set too: give it a name of its own");
                std::set<std::int64_t> nodes;
                for (const Entry& entry : surface.nodes) collect_nodes(entry, nodes);
                for (const Side& side : surface.sides) add_sides(side, mesh_.face_sets[name], nodes);
                if (!nodes.empty()) mesh_.node_sets[name].assign(nodes.begin(), nodes.end());
            }
        }
    }

    void add_sides(const Side& side, std::vector<std::array<std::int64_t, 9>>& faces,
                   std::set<std::int64_t>& nodes) const {
        std::set<ElementAt> elements;
        collect_elements(side.elements, elements);
        for (const ElementAt& at : elements) {
            const Element& element = at.scope->elements[at.index];
            const CellShape& shape = shape_of(element.type->cell);
            if (side.side >= shape.sides.size())
                throw SceneFailure(side.elements.place, fmt::format("S{}: element {} ({}) has sides S1 .. S{}",
                                                                    side.side + 1, element.id, element.type->name,
                                                                    shape.sides.size()));
            std::array<std::int64_t, 9> face{};
            face.fill(-1);
            for (std::size_t k = 0; k < shape.sides[side.side].size(); ++k) {
                face[k] = node_number(*at.scope, element.nodes[shape.sides[side.side][k]], element.place);
                nodes.insert(face[k]);
            }
            faces.push_back(face);
        }
    }

    Place file_;
    Part root_;
    std::map<std::string, std::unique_ptr<Part>> parts_;  // by upper case
    std::vector<std::unique_ptr<Part>> instances_;
    Part* open_ = &root_;
    bool in_step_ = false;
    std::set<std::string> passed_;
    std::map<ElementAt, std::int32_t> body_of_;
    MeshData mesh_;
};

}  // namespace

MeshFile read_abaqus(const std::string& path, const std::vector<std::string>& bodies, const Place& place) {
    std::string bytes;
    const std::vector<InpCard> cards = read_cards(path, place, bytes);
    return {AbaqusReader().read(cards, path, bodies, place), hash_text(bytes)};
}

}  // namespace cli
