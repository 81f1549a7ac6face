// SPDX-License-Identifier: BSD-3-Clause
#include "deck/abaqus/abaqus_mesh.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <iterator>
#include <map>
#include <set>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "deck/abaqus/cell_axes.hpp"
#include "deck/abaqus/inp_cards.hpp"
#include "deck/abaqus/orientations.hpp"
#include "deck/abaqus/tied_faces.hpp"
#include "delam/delam.h"
#include "mesh/cell_shape.hpp"
#include "text/say.hpp"
#include "text/wording.hpp"

namespace cli::abaqus {

namespace {

// Converts the model to the mesh of the scene.
class MeshMaker {
public:
    explicit MeshMaker(Model& model) : model_(model) { mesh_.notes = model.notes; }

    MeshData make(const std::vector<std::string>& bodies, const Place& place) {
        number_nodes();
        assign_bodies(bodies, place);
        add_cells();
        add_sets();
        add_cohesive();
        split_plies();
        return std::move(mesh_);
    }

    // Returns the element of which each cell was made, block after block.
    [[nodiscard]] std::vector<ElementAt> made() const {
        std::vector<ElementAt> out;
        for (const auto& block : elements_)
            for (const ElementAt& at : block) {
                const auto plies = plies_in_.find(at);
                out.insert(out.end(), plies == plies_in_.end() ? 1 : plies->second, at);
            }
        return out;
    }

private:
    void number_nodes() {
        bool plane = false;
        bool solid = false;
        for (const Part* scope : model_.scopes())
            for (const Element& element : scope->elements) {
                (element.type->dimension() == 2 ? plane : solid) = true;
                if (plane && solid) throw SceneFailure(element.place, "plane and solid elements in one mesh");
                if (element.type->plane.empty()) continue;
                if (!mesh_.plane.empty() && mesh_.plane != element.type->plane)
                    throw SceneFailure(element.place, "elements of plane strain and of plane stress in one mesh");
                mesh_.plane = element.type->plane;
            }
        if (!plane && !solid) throw SceneFailure(model_.file, "there are no elements in it");
        mesh_.dimension = plane ? 2 : 3;
        const auto dimension = static_cast<std::size_t>(mesh_.dimension);
        std::vector<Part*> all{&model_.root};
        for (const auto& instance : model_.instances) all.push_back(instance.get());
        double extent = 0;
        for (const Part* scope : all)
            for (const Node& node : scope->nodes)
                for (const double x : node.at) extent = std::max(extent, std::abs(x));
        for (Part* scope : all) {
            scope->first_node = static_cast<std::int64_t>(mesh_.nodes.size() / dimension);
            for (const Node& node : scope->nodes) {
                if (plane && std::abs(node.at[2]) > 1e-12 * extent)
                    throw SceneFailure(model_.file,
                                       fmt::format("node {} is at z = {}: a plane mesh must lie in z = 0",
                                                   full_name(*scope, std::to_string(node.id)), node.at[2]));
                mesh_.nodes.insert(mesh_.nodes.end(), node.at.begin(),
                                   node.at.begin() + static_cast<std::ptrdiff_t>(dimension));
            }
        }
    }

    // True if an entry of this name has not been met yet; many cards may give it.
    using Met = std::set<std::tuple<std::string, const Part*, std::string>>;
    static bool is_new(Met& met, const Model& model, const std::string& name, const Entry& raw) {
        const Entry entry = model.resolved_scope(raw);
        return met.emplace(name, entry.scope, upper(entry.text)).second;
    }

    void assign_body(const std::string& name, const Entry& elements) {
        if (!is_new(assigned_, model_, name, elements)) return;
        std::set<ElementAt> members;
        model_.collect_elements(elements, members);
        std::erase_if(members, [](const ElementAt& at) { return at.type().cohesive(); });
        if (members.empty()) throw SceneFailure(elements.place, "\"" + elements.text + "\": there is no element in it");
        const auto [at, first] = label_of_.emplace(name, static_cast<std::int32_t>(mesh_.body_names.size()));
        const std::int32_t label = at->second;
        if (first) mesh_.body_names.push_back(name);
        for (const ElementAt& member : members) {
            const auto [entry, inserted] = body_of_.emplace(member, label);
            if (!inserted && entry->second != label)
                throw SceneFailure(elements.place,
                                   fmt::format("element {} is in \"{}\" and in \"{}\": it belongs to one body only",
                                               member.scope->elements[member.index].id,
                                               mesh_.body_names[static_cast<std::size_t>(entry->second)], name));
        }
    }

    void require_shells(const Entry& section) const {
        std::set<ElementAt> members;
        model_.collect_elements(section, members);
        for (const ElementAt& at : members)
            if (at.type().name != "SC8R")
                throw SceneFailure(section.place,
                                   fmt::format("element {} is a {}: shell sections of SC8R are imported; "
                                               "give *SOLID SECTION",
                                               at.element().id, at.type().name));
    }

    // The name of a set in the scene, in its first spelling.
    std::string body_name(const Entry& raw) const {
        const Entry entry = model_.resolved_scope(raw);
        const auto set = entry.scope->element_sets.find(upper(entry.text));
        return full_name(*entry.scope, set == entry.scope->element_sets.end() ? entry.text : set->second.name);
    }

    void assign_bodies(const std::vector<std::string>& wanted, const Place& place) {
        for (const std::string& name : wanted) {
            const Entry entry{&model_.root, name, {place.file, place.path + ".bodies", place.line}};
            assign_body(name, entry);
        }
        if (wanted.empty())
            for (const Part* scope : model_.scopes())
                for (std::size_t i = 0; i < scope->sections.size(); ++i) {
                    assign_body(body_name(scope->sections[i]), scope->sections[i]);
                    if (scope->section_cards[i]->keyword == "SHELL SECTION") require_shells(scope->sections[i]);
                }
        if (mesh_.body_names.empty()) {
            for (const Part* scope : model_.scopes())
                for (const Element& element : scope->elements)
                    if (!element.type->cohesive())
                        assign_body(element.set.empty() ? (scope->name.empty() ? "body" : scope->name)
                                                        : body_name({scope, element.set, element.place}),
                                    {scope, std::to_string(element.id), element.place});
            return;
        }
        for (const Part* scope : model_.scopes())
            for (std::size_t i = 0; i < scope->elements.size(); ++i)
                if (!scope->elements[i].type->cohesive() && !body_of_.contains({scope, i}))
                    throw SceneFailure(scope->elements[i].place,
                                       fmt::format("element {} is in none of the bodies: {}", scope->elements[i].id,
                                                   listing(mesh_.body_names)));
    }

    void add_cells() {
        for (const Part* scope : model_.scopes())
            for (std::size_t i = 0; i < scope->elements.size(); ++i) {
                const Element& element = scope->elements[i];
                if (element.type->cohesive()) continue;
                auto block = std::find_if(mesh_.blocks.begin(), mesh_.blocks.end(),
                                          [&](const CellBlock& b) { return b.type == element.type->cell; });
                if (block == mesh_.blocks.end()) {
                    block = mesh_.blocks.insert(block, CellBlock{element.type->cell, {}, {}});
                    elements_.emplace_back();
                }
                elements_[static_cast<std::size_t>(block - mesh_.blocks.begin())].push_back({scope, i});
                for (std::size_t k = 0; k < element.nodes.size(); ++k)
                    block->connectivity.push_back(node_number(*scope, element, k));
                block->bodies.push_back(body_of_.at({scope, i}));
            }
        set_cell_axes(model_, elements_, mesh_);
    }

    // The cells of a composite of several plies become one for each of them.
    void split_plies() {
        mesh_.given_nodes = static_cast<std::int64_t>(mesh_.nodes.size()) / mesh_.dimension;
        std::vector<Plies> laminates;
        std::map<ElementAt, std::size_t> laminate_at;
        std::int64_t made = 0;
        for (const Part* scope : model_.scopes())
            for (std::size_t i = 0; i < scope->sections.size(); ++i) {
                const InpCard& card = *scope->section_cards[i];
                Plies plies = card.has("COMPOSITE") ? laminate_of(card).plies : Plies{};
                if (plies.angles.size() < 2) continue;
                plies.name = body_name(scope->sections[i]);
                std::set<ElementAt> members;
                model_.collect_elements(scope->sections[i], members);
                for (const ElementAt& at : members) {
                    if (at.type().cell != DELAM_HEX8)
                        throw SceneFailure(
                            at.element().place,
                            fmt::format("element {} ({}) has {} plies: give it one, or take C3D8, C3D8I, "
                                        "C3D8R or SC8R",
                                        at.element().id, at.type().name, plies.angles.size()));
                    laminate_at[at] = laminates.size();
                    plies_in_[at] = plies.angles.size();
                    made += static_cast<std::int64_t>(plies.angles.size());
                }
                if (made > most_copies)
                    throw SceneFailure(card.place,
                                       fmt::format("{} cells for all plies: at most {} are made", made, most_copies));
                laminates.push_back(std::move(plies));
            }
        if (laminates.empty()) return;
        std::vector<const Plies*> of_cell;
        for (const auto& block : elements_)
            for (const ElementAt& at : block) {
                const auto found = laminate_at.find(at);
                of_cell.push_back(found == laminate_at.end() ? nullptr : &laminates[found->second]);
            }
        split_into_plies(mesh_, of_cell);
    }

    void add_sets() {
        for (const Part* scope : model_.scopes()) {
            for (const auto& [key, set] : scope->node_sets) {
                std::set<std::int64_t> nodes;
                model_.collect_set(set, nodes);
                if (!nodes.empty()) mesh_.node_sets[full_name(*scope, set.name)].assign(nodes.begin(), nodes.end());
            }
            for (const auto& [key, surface] : scope->surfaces) {
                if (surface.refusal) continue;
                const std::string name = surface_set_name(*scope, surface), own = full_name(*scope, surface.name);
                if (name != own)
                    mesh_.notes.push_back(
                        fmt::format("\"{}\" is a node set and a surface: the surface is \"{}\" here", own, name));
                std::set<std::int64_t> nodes;
                for (const Entry& entry : surface.nodes) model_.collect_nodes(entry, nodes);
                std::vector<std::array<std::int64_t, 9>> faces;
                for (const Side& side : surface.sides) add_sides(side, faces, nodes);
                if (!faces.empty()) mesh_.face_sets[name] = std::move(faces);
                if (!nodes.empty()) mesh_.node_sets[name].assign(nodes.begin(), nodes.end());
            }
        }
    }

    // Cohesive elements by the sets of their sections, or of their *ELEMENT lines.
    void add_cohesive() {
        std::vector<bool> in_cell(mesh_.nodes.size() / static_cast<std::size_t>(mesh_.dimension), false);
        for (const CellBlock& block : mesh_.blocks)
            for (const std::int64_t node : block.connectivity) in_cell[static_cast<std::size_t>(node)] = true;
        std::map<ElementAt, std::string> set_of;
        Met met;
        for (const Part* scope : model_.scopes()) {
            for (std::size_t i = 0; i < scope->cohesive_sections.size(); ++i) {
                const Entry& section = scope->cohesive_sections[i];
                if (!is_new(met, model_, body_name(section), section)) continue;
                const InpCard& card = *scope->cohesive_cards[i];
                std::string alike = card.parameter("MATERIAL") + "\n" + card.parameter("ORIENTATION") + "\n" +
                                    card.parameter("THICKNESS");
                for (const InpLine& line : card.lines) alike += "\n" + listing(line.fields);
                alike_[upper(alike)].push_back(body_name(section));
                std::set<ElementAt> members;
                model_.collect_elements(section, members);
                for (const ElementAt& at : members) {
                    if (!at.type().cohesive())
                        throw SceneFailure(section.place, fmt::format("\"{}\": element {} ({}) is no cohesive element",
                                                                      section.text, at.element().id, at.type().name));
                    set_of[at] = body_name(section);
                }
            }
        }
        for (const Part* scope : model_.scopes())
            for (std::size_t i = 0; i < scope->elements.size(); ++i) {
                const Element& element = scope->elements[i];
                if (!element.type->cohesive()) continue;
                const auto known = set_of.find({scope, i});
                std::string name = known != set_of.end() ? known->second
                                   : element.set.empty() ? full_name(*scope, "cohesive")
                                                         : body_name({scope, element.set, element.place});
                add_cohesive_element(*scope, element, name, in_cell);
            }
        for (CohesiveSet& set : mesh_.cohesive) {
            set.faces = set.name;
            while (mesh_.node_sets.contains(set.faces)) set.faces += "-faces";
            auto& faces = mesh_.face_sets[set.faces];
            if (const auto loose = loose_.find(set.name); loose != loose_.end())
                tie_to_bodies(mesh_, ties(), loose->second, set, faces);
            std::set<std::int64_t> nodes;
            for (const auto* side : {&set.lower, &set.upper})
                for (const auto& face : *side) {
                    if (!set.apart.empty() && set.apart[static_cast<std::size_t>(&face - side->data())] >= 0) continue;
                    faces.push_back(face);
                    std::copy_if(face.begin(), face.end(), std::inserter(nodes, nodes.end()),
                                 [](std::int64_t node) { return node >= 0; });
                }
            for (const auto& face : faces)
                std::copy_if(face.begin(), face.end(), std::inserter(nodes, nodes.end()),
                             [](std::int64_t node) { return node >= 0; });
            mesh_.node_sets[set.faces].assign(nodes.begin(), nodes.end());
            mesh_.notes.push_back(fmt::format("cohesive: {} of \"{}\", no cells here: the set \"{}\" has their faces",
                                              counted(static_cast<std::int64_t>(set.lower.size()), "element"), set.name,
                                              set.faces));
        }
        join_alike();
    }

    // Returns the names of a few sets, or that of the first and how many there are besides.
    static std::string joined_name(const std::vector<CohesiveSet*>& sets) {
        constexpr std::size_t most_names = 4;
        if (sets.size() > most_names) return fmt::format("{}+{}-others", sets.front()->faces, sets.size() - 1);
        std::string out;
        for (const CohesiveSet* set : sets) out += (out.empty() ? "" : "+") + set->faces;
        return out;
    }

    // Sections that say the same may lie in one interface: all of them are one set, too.
    void join_alike() {
        for (const auto& [section, names] : alike_) {
            std::set<std::size_t> places;
            for (const std::string& name : names)
                if (const auto at = cohesive_of_.find(name); at != cohesive_of_.end()) places.insert(at->second);
            std::vector<CohesiveSet*> sets;
            for (const std::size_t place : places) sets.push_back(&mesh_.cohesive[place]);
            if (sets.size() < 2) continue;
            std::string joined = joined_name(sets);
            while (mesh_.node_sets.contains(joined)) joined += "-faces";
            std::set<std::int64_t> nodes;
            for (CohesiveSet* set : sets) {
                const auto& faces = mesh_.face_sets.at(set->faces);
                mesh_.face_sets[joined].insert(mesh_.face_sets[joined].end(), faces.begin(), faces.end());
                const auto& of_it = mesh_.node_sets.at(set->faces);
                nodes.insert(of_it.begin(), of_it.end());
                set->joined = joined;
            }
            mesh_.node_sets[joined].assign(nodes.begin(), nodes.end());
        }
    }

    [[nodiscard]] std::string surface_name(const Entry& raw) const {
        const Entry entry = model_.resolved_scope(raw);
        const auto surface = entry.scope->surfaces.find(upper(entry.text));
        if (surface == entry.scope->surfaces.end())
            throw SceneFailure(raw.place, "surface \"" + raw.text + "\" is not there");
        surface->second.require_sound();
        return surface_set_name(*entry.scope, surface->second);
    }

    // The ties between a surface of nodes, as that of cohesive elements is, and one of sides of cells.
    [[nodiscard]] std::vector<TiedNodes> ties() const {
        std::vector<TiedNodes> out;
        for (const Tie& tie : model_.ties) {
            std::string own = surface_name(tie.slave), other = surface_name(tie.master);
            if (mesh_.face_sets.contains(own)) std::swap(own, other);
            const auto nodes = mesh_.node_sets.find(own);
            if (!mesh_.face_sets.contains(other) || nodes == mesh_.node_sets.end()) continue;
            out.push_back({{nodes->second.begin(), nodes->second.end()}, other});
        }
        return out;
    }

    void add_cohesive_element(const Part& scope, const Element& element, const std::string& name,
                              const std::vector<bool>& in_cell) {
        const auto [known, first] = cohesive_of_.emplace(name, mesh_.cohesive.size());
        if (first) mesh_.cohesive.push_back(CohesiveSet{name, "", "", {}, {}, {}});
        CohesiveSet& set = mesh_.cohesive[known->second];
        std::array<std::array<std::int64_t, 9>, 2> faces{};
        for (std::size_t k = 0; k < element.nodes.size(); ++k) {
            const std::size_t half = element.type->face_nodes;
            if (k % half == 0) faces[k / half].fill(-1);
            const std::int64_t node = node_number(scope, element, k);
            if (!in_cell[static_cast<std::size_t>(node)]) {
                if (model_.ties.empty())
                    throw SceneFailure(
                        element.place,
                        fmt::format("node {} of the cohesive element {} belongs to no cell: cohesive elements "
                                    "share their nodes with the bodies that they hold together, or surfaces of "
                                    "theirs are tied to them (*TIE)",
                                    full_name(scope, std::to_string(element.nodes[k])), element.id));
                loose_[name][set.lower.size()] = element.place;
            }
            faces[k / half][k % half] = node;
        }
        set.lower.push_back(faces[0]);
        set.upper.push_back(faces[1]);
    }

    void add_sides(const Side& side, std::vector<std::array<std::int64_t, 9>>& faces, std::set<std::int64_t>& nodes) {
        std::set<ElementAt> elements;
        model_.collect_elements(side.elements, elements);
        for (const ElementAt& at : elements) {
            const Element& element = at.scope->elements[at.index];
            if (side.side == free_sides) {
                add_free_sides(at, faces, nodes);
                continue;
            }
            if (element.type->cohesive()) {
                add_cohesive_side(side, at, nodes);
                continue;
            }
            const CellShape& shape = shape_of(element.type->cell);
            if (side.side >= shape.sides.size())
                throw SceneFailure(side.elements.place,
                                   fmt::format("S{}: element {} ({}) has sides S1 .. S{}", side.side + 1, element.id,
                                               element.type->name, shape.sides.size()));
            faces.push_back(face_of(at, side.side));
            take_nodes(faces.back(), nodes);
        }
    }

    static std::array<std::int64_t, 9> face_of(const ElementAt& at, std::size_t side) {
        std::array<std::int64_t, 9> face{};
        face.fill(-1);
        const std::vector<std::size_t>& places = shape_of(at.type().cell).sides[side];
        for (std::size_t k = 0; k < places.size(); ++k) face[k] = node_number(*at.scope, at.element(), places[k]);
        return face;
    }

    static void take_nodes(const std::array<std::int64_t, 9>& face, std::set<std::int64_t>& nodes) {
        for (const std::int64_t node : face)
            if (node >= 0) nodes.insert(node);
    }

    // The sides of a cell that no other element has.
    void add_free_sides(const ElementAt& at, std::vector<std::array<std::int64_t, 9>>& faces,
                        std::set<std::int64_t>& nodes) {
        if (at.type().cohesive()) return;
        if (elements_at_.empty())
            for (const Part* scope : model_.scopes())
                for (std::size_t i = 0; i < scope->elements.size(); ++i) count_sides({scope, i});
        for (std::size_t k = 0; k < shape_of(at.type().cell).sides.size(); ++k) {
            const auto face = face_of(at, k);
            if (elements_at_.at(sorted(face)) > 1) continue;
            faces.push_back(face);
            take_nodes(face, nodes);
        }
    }

    void count_sides(const ElementAt& at) {
        const std::size_t half = at.type().face_nodes;
        if (!at.type().cohesive())
            for (std::size_t k = 0; k < shape_of(at.type().cell).sides.size(); ++k)
                ++elements_at_[sorted(face_of(at, k))];
        for (std::size_t first = 0; at.type().cohesive() && first < 2 * half; first += half) {
            std::array<std::int64_t, 9> face{};
            face.fill(-1);
            for (std::size_t k = 0; k < half; ++k) face[k] = node_number(*at.scope, at.element(), first + k);
            ++elements_at_[sorted(face)];
        }
    }

    static std::array<std::int64_t, 9> sorted(std::array<std::int64_t, 9> face) {
        std::sort(face.begin(), face.end());
        return face;
    }

    // A side of a cohesive element is a place for ties: its nodes count, and it is no face of a body.
    static void add_cohesive_side(const Side& side, const ElementAt& at, std::set<std::int64_t>& nodes) {
        const Element& element = at.element();
        const std::size_t half = element.type->face_nodes, upper_side = element.type->dimension() == 2 ? 2 : 1;
        if (side.side != 0 && side.side != upper_side)
            throw SceneFailure(side.elements.place,
                               fmt::format("S{}: the faces of the cohesive element {} are S1 and S{}", side.side + 1,
                                           element.id, upper_side + 1));
        for (std::size_t k = 0; k < half; ++k)
            nodes.insert(node_number(*at.scope, element, (side.side == 0 ? 0 : half) + k));
    }

    Model& model_;
    std::vector<std::vector<ElementAt>> elements_;  // by block of cells
    std::map<ElementAt, std::size_t> plies_in_;     // cells of an element with several plies
    std::map<ElementAt, std::int32_t> body_of_;
    std::map<std::string, std::int32_t> label_of_;            // of bodies, by name
    std::map<std::array<std::int64_t, 9>, int> elements_at_;  // number of elements by the sorted nodes of a side
    Met assigned_;
    std::map<std::string, std::size_t> cohesive_of_;         // by name
    std::map<std::string, LooseElements> loose_;             // by name of their set
    std::map<std::string, std::vector<std::string>> alike_;  // cohesive sets by what their sections say
    MeshData mesh_;
};

}  // namespace

MeshData mesh_of(Model& model, const std::vector<std::string>& bodies, const Place& place,
                 std::vector<ElementAt>* made) {
    MeshMaker maker(model);
    MeshData mesh = maker.make(bodies, place);
    if (made != nullptr) *made = maker.made();
    return mesh;
}

}  // namespace cli::abaqus
