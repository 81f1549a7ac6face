// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_interfaces.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "deck/abaqus/keywords.hpp"
#include "deck/deck_bodies.hpp"
#include "deck/deck_connections.hpp"
#include "deck/deck_laws.hpp"
#include "mesh/mesh_file.hpp"
#include "mesh/near_bodies.hpp"
#include "text/refusals.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

namespace {

// A small part more than the distance of the faces, so that rounding of coordinates does not part them.
constexpr double allowance = 1.001;
// Largest distance at which nodes match, in shortest edges: less than half, at which a node may have two others as
// near.
constexpr double most_tolerance = 0.49;

class Interfaces {
public:
    Interfaces(Deck& deck, const Model& model, const MeshData& mesh)
        : deck_(deck),
          model_(model),
          mesh_(mesh),
          faces_(mesh),
          nodes_(mesh),
          edge_(shortest_edge(mesh)),
          places_(mesh, edge_),
          cohesive_sections_(deck, model, &Part::cohesive_sections),
          laws_(deck, mesh.dimension, edge_),
          neighbours_(mesh.body_names.size()),
          connections_(mesh, places_) {
        for (const BodyPair& pair : pairs_of_bodies(mesh, faces_, edge_, model.file)) {
            touching_[{pair.a, pair.b}] = pair;
            neighbours_[static_cast<std::size_t>(pair.a)].push_back(pair.b);
            neighbours_[static_cast<std::size_t>(pair.b)].push_back(pair.a);
        }
        for (std::vector<std::int32_t>& bodies : neighbours_) std::sort(bodies.begin(), bodies.end());
    }

    std::string text() {
        RefusalList refused;
        for (const CohesiveSet& set : mesh_.cohesive) refused.attempt([&] { add_cohesive(set); });
        for (const ContactPair& pair : deck_.pairs) refused.attempt([&] { add_pair(pair); });
        refused.require_none();
        for (const Tie& tie : model_.ties) refused.attempt([&] { add_tie(tie); });
        refused.require_none();
        if (!deck_.adhering.empty()) add_everywhere();
        for (const auto& [key, pair] : touching_) bond_shared(pair);
        std::string out = laws_.text();
        out += connections_.text(laws_);
        for (const std::string& said : connections_.said()) deck_.changed.push_back(said);
        for (const auto& [key, pair] : touching_) {
            if (connections_.find(pair.a, pair.b) != nullptr) continue;
            out += fmt::format("[[interfaces]]\na = {}\nb = {}\n{} = true\n\n", body(pair.a), body(pair.b),
                               pair.shared > 0 ? "bonded" : "contact");
            if (pair.shared == 0 && !deck_.general_contact)
                deck_.changed.push_back(
                    fmt::format("{} and {} touch and have nothing between them: here they are in contact", body(pair.a),
                                body(pair.b)));
        }
        if (deck_.general_contact) {
            const double gap = general_gap();
            out += "[contact]\ngeneral = true\n";
            if (gap > 0) out += fmt::format("gap = {}\n", toml_number(gap));
            out += "\n";
            const std::string near = gap > 0 ? fmt::format("are up to {:.4g} apart", gap) : "lie on each other";
            deck_.changed.push_back(
                fmt::format("*CONTACT: faces that {} at the start are in contact, those that meet "
                            "later are left out",
                            near));
        }
        return out;
    }

private:
    [[nodiscard]] std::string body(std::int32_t label) const {
        return toml_text(mesh_.body_names[static_cast<std::size_t>(label)]);
    }

    // Returns the distance at which every body that is held by nothing meets another, up to an edge of a cell.
    [[nodiscard]] double general_gap() const {
        std::vector<bool> held(mesh_.body_names.size(), false);
        for (const Held& each : connections_.all())
            held[static_cast<std::size_t>(each.a)] = held[static_cast<std::size_t>(each.b)] = true;
        double out = 0;
        for (std::size_t body = 0; body < held.size(); ++body) {
            if (held[body] || !neighbours_[body].empty()) continue;
            const double distance = nearest_body(mesh_, static_cast<std::int32_t>(body)).distance;
            if (distance <= edge_) out = std::max(out, allowance * distance);
        }
        return out;
    }

    // Bodies that share some nodes are bonded there, whatever they have between their doubled nodes elsewhere.
    void bond_shared(const BodyPair& pair) {
        Held* held = connections_.find(pair.a, pair.b);
        if (pair.shared == 0 || (pair.doubled == 0 && held == nullptr)) return;
        if (held == nullptr) {
            connections_.add({pair.a, pair.b, "", "", 0.0, true, model_.file});
            held = connections_.find(pair.a, pair.b);
            deck_.changed.push_back(
                fmt::format("{} and {} touch where they share no nodes, and have nothing between "
                            "them: here they are in contact",
                            body(pair.a), body(pair.b)));
        }
        if (held->bonded) return;
        if (!held->matching || held->tolerance > 0 || pair.doubled == 0)
            throw SceneFailure(
                held->place,
                fmt::format("{} and {} share the nodes of {} sides, where they would be bonded, and {}: {}",
                            body(pair.a), body(pair.b), pair.shared,
                            held->matching && !(held->tolerance > 0) ? "no other sides of them coincide"
                                                                     : "have faces that are apart elsewhere",
                            sections_of_one_side));
        held->shared = true;
    }

    [[nodiscard]] double distance(std::int64_t a, std::int64_t b) const {
        double square = 0;
        for (std::int32_t i = 0; i < mesh_.dimension; ++i) {
            const double d = mesh_.nodes[static_cast<std::size_t>(a * mesh_.dimension + i)] -
                             mesh_.nodes[static_cast<std::size_t>(b * mesh_.dimension + i)];
            square += d * d;
        }
        return std::sqrt(square);
    }

    // Returns the distance of the faces of a cohesive element at its nodes; in the plane the nodes go round.
    [[nodiscard]] double gap_of(const Face& lower, const Face& upper) const {
        const auto count = static_cast<std::size_t>(std::find(lower.begin(), lower.end(), -1) - lower.begin());
        double out = 0;
        for (std::size_t k = 0; k < count; ++k)
            out = std::max(out, distance(lower[k], upper[mesh_.dimension == 2 ? count - 1 - k : k]));
        return out;
    }

    [[nodiscard]] std::int32_t one_body(const CohesiveSet& set, std::size_t element, bool upper,
                                        const Place& section) const {
        const std::vector<std::int32_t> bodies = faces_.of(upper ? set.upper[element] : set.lower[element]);
        if (bodies.size() == 1) return bodies[0];
        refuse_face(model_, mesh_, faces_, {&set, element, upper}, section);
    }

    void add_cohesive(const CohesiveSet& set) {
        const auto [found, scope] = cohesive_sections_.of(set.name);
        if (found == nullptr)
            throw SceneFailure(model_.file,
                               fmt::format("the cohesive elements \"{}\" have no *COHESIVE SECTION", set.name));
        const Section& section = *found;
        std::map<std::pair<std::int32_t, std::int32_t>, double> gaps;  // by lower and upper body
        double sum = 0, least = std::numeric_limits<double>::infinity(), most = 0;
        bool loose = false;
        for (std::size_t i = 0; i < set.lower.size(); ++i) {
            const std::int32_t a = one_body(set, i, false, section.place);
            const std::int32_t b = one_body(set, i, true, section.place);
            const bool tied = !set.apart.empty() && set.apart[i] >= 0;
            const double gap = tied ? set.apart[i] : gap_of(set.lower[i], set.upper[i]);
            if (a == b && (tied || gap > 1e-6 * edge_))
                refuse_thick(model_, mesh_, faces_, {&set, i, false}, gap, section.place);
            loose = loose || tied;
            sum += gap;
            least = std::min(least, gap);
            most = std::max(most, gap);
            // Elements may stand either way up.
            const auto key = gaps.contains({b, a}) ? std::pair(b, a) : std::pair(a, b);
            gaps[key] = std::max(gaps[key], gap);
        }
        const MaterialCards& material = named(deck_.materials, section.material, "material", section.place);
        const double mean = sum / static_cast<double>(set.lower.size());
        const double thickness = section.thickness == "GEOMETRY" ? mean : section.value;
        if (!(thickness > 1e-9 * edge_))
            throw SceneFailure(section.place, "THICKNESS=GEOMETRY, and the elements have none");
        if (section.thickness == "GEOMETRY" && most - least > 1e-3 * most)
            throw SceneFailure(section.place, fmt::format("THICKNESS=GEOMETRY, and the elements are {:.6g} to {:.6g} "
                                                          "thick: one law has one stiffness; give a section to each",
                                                          least, most));
        const std::string law = laws_.of_material(material, thickness);
        const Vector axis = laws_.has_axes(law) ? shear_axis(section, *scope) : Vector{1, 0, 0};
        for (const auto& [bodies, gap] : gaps) {
            const bool apart = gap > 1e-6 * edge_;
            // The nodes of both sides belong together, and no others are as near.
            const bool paired = apart && !loose && gap < most_tolerance * edge_;
            if (apart)
                deck_.changed.push_back(fmt::format("\"{}\" is {:.6g} thick: {}, and it has no volume", set.name, gap,
                                                    paired ? "the nodes of its two sides are paired"
                                                           : "the faces beside it are projected upon each other"));
            Held held{bodies.first, bodies.second, law, set.faces, 0.0, (paired || !apart) && !loose, section.place};
            held.shear_axis = axis;
            held.joined = set.joined;
            if (paired)
                held.tolerance = allowance * gap / edge_;
            else if (apart)
                held.gap = allowance * gap;
            connections_.add(held);
        }
        if (loose)
            deck_.changed.push_back(
                fmt::format("\"{}\" is tied: the bodies to which it is tied have its law between them, on their own "
                            "faces where its elements lie",
                            set.name));
    }

    // Axis 1 of the orientation of a section, projected; without one, x.
    [[nodiscard]] Vector shear_axis(const Section& section, const Part& scope) const {
        if (section.orientation.empty()) return {1, 0, 0};
        const Orientation& o = orientation_of(deck_, section);
        if (o.of_each_element())
            throw SceneFailure(section.place,
                               fmt::format("ORIENTATION={} differs from element to element, and an interface has one "
                                           "first axis of shear: give one orientation",
                                           section.orientation));
        const Vector axis = o.axes(o.points, {}, o.place)[0];
        return section.part.empty() ? axis : turned_by(scope, axis);
    }

    [[nodiscard]] std::string faces_named(const Entry& raw) const {
        std::string name = surface_name(model_, raw);
        if (!mesh_.face_sets.contains(name))
            throw SceneFailure(raw.place, fmt::format("\"{}\": a *SURFACE of sides of elements is expected", raw.text));
        return name;
    }

    const std::set<std::int32_t>& bodies_of(const std::string& surface) {
        const auto [at, inserted] = bodies_of_.try_emplace(surface);
        if (!inserted) return at->second;
        for (const Face& face : mesh_.face_sets.at(surface))
            for (const std::int32_t each : faces_.of(face)) at->second.insert(each);
        return at->second;
    }

    // b is the slave's body, whose nodes make the pairs.
    void add_pair(const ContactPair& pair) {
        const InteractionCards& interaction =
            named(deck_.interactions, pair.interaction, "surface interaction", pair.place);
        const std::string slave = faces_named(pair.slave);
        const std::string master = faces_named(pair.master);
        std::string law;
        if (interaction.cohesive) {
            law = laws_.of_interaction(interaction);
            require_extent(pair, interaction, slave, master);
        }
        const std::set<std::int32_t>&slaves = bodies_of(slave), &masters = bodies_of(master);
        std::string set = law.empty() ? "" : slave;
        if (!law.empty() && !pair.bonded.empty()) set = bonded_set(pair);
        std::size_t added = 0;
        // Surfaces of several bodies hold those together that touch; those of two need not match.
        const bool two = slaves.size() == 1 && masters.size() == 1;
        if (two && *slaves.begin() != *masters.begin()) {
            const std::int32_t a = *masters.begin(), b = *slaves.begin();
            Held held{a, b, law, set, 0.0, touching_.contains(std::minmax(a, b)), pair.place};
            if (!held.matching) {
                held.gap = allowance * farthest(mesh_, slave, master);
                held.open = true;
                held.adjust = pair.adjust;
            }
            connections_.add(held);
            ++added;
        }
        for (auto b = slaves.begin(); b != slaves.end() && !two; ++b)
            for (const std::int32_t a : neighbours_[static_cast<std::size_t>(*b)]) {
                if (!masters.contains(a)) continue;
                connections_.add({a, *b, law, set, 0.0, true, pair.place});
                ++added;
            }
        if (added == 0)
            throw SceneFailure(
                pair.place, fmt::format("no body of \"{}\" touches one of \"{}\"", pair.slave.text, pair.master.text));
    }

    // Returns the bodies that a tie joins; none where its surface is of cohesive elements.
    std::set<std::int32_t> tied_bodies(const Entry& raw) {
        const std::string name = surface_name(model_, raw);
        if (mesh_.face_sets.contains(name)) return bodies_of(name);
        if (!mesh_.node_sets.contains(name)) throw SceneFailure(raw.place, "surface \"" + raw.text + "\" is not there");
        std::set<std::int32_t> out;
        for (const std::int64_t node : mesh_.node_sets.at(name))
            out.insert(nodes_.of(node).begin(), nodes_.of(node).end());
        return out;
    }

    // Bodies that are tied are bonded wherever they touch.
    void add_tie(const Tie& tie) {
        const std::set<std::int32_t> slaves = tied_bodies(tie.slave), masters = tied_bodies(tie.master);
        if (slaves.empty() || masters.empty()) return;  // of cohesive elements, whose faces are those of bodies
        std::size_t added = 0;
        for (const std::int32_t b : slaves)
            for (const std::int32_t a : masters) {
                if (a == b || (slaves.size() + masters.size() > 2 && !touching_.contains(std::minmax(a, b)))) continue;
                Held held{a, b, "", "", 0.0, touching_.contains(std::minmax(a, b)), tie.place};
                held.bonded = true;
                if (!held.matching) held.gap = tied_gap(tie);
                require_whole(tie, held);
                connections_.add(held);
                ++added;
            }
        if (added == 0)
            throw SceneFailure(
                tie.place, fmt::format("no body of \"{}\" touches another one of \"{}\": ties of several bodies are "
                                       "imported where their nodes coincide; give each two bodies a tie of their own",
                                       tie.slave.text, tie.master.text));
    }

    [[nodiscard]] double tied_gap(const Tie& tie) const {
        if (tie.tolerance > 0) return tie.tolerance;
        const std::string slave = surface_name(model_, tie.slave), master = surface_name(model_, tie.master);
        if (!mesh_.face_sets.contains(slave) || !mesh_.face_sets.contains(master))
            throw SceneFailure(tie.place,
                               "surfaces of nodes that do not coincide need POSITION TOLERANCE=, or give "
                               "sides of elements");
        return allowance * farthest(mesh_, slave, master);
    }

    // A bonded interface is bonded everywhere.
    void require_whole(const Tie& tie, const Held& held) {
        const std::string slave = surface_name(model_, tie.slave), master = surface_name(model_, tie.master);
        if (!mesh_.face_sets.contains(slave) || !mesh_.face_sets.contains(master)) return;
        if (!held.matching) {
            deck_.changed.push_back(
                fmt::format("*TIE of \"{}\" and \"{}\": the meshes do not match; {} and {} are bonded "
                            "wherever they meet",
                            tie.slave.text, tie.master.text, body(held.a), body(held.b)));
            return;
        }
        const std::int64_t touching = touching_.at(std::minmax(held.a, held.b)).doubled;
        const std::int64_t tied = places_.coinciding(slave, master);
        if (tied < touching)
            throw SceneFailure(tie.place,
                               fmt::format("{} and {} touch at {} sides, of which {} are tied: bodies are bonded "
                                           "everywhere or not at all; split the body of \"{}\" there",
                                           body(held.a), body(held.b), touching, tied, tie.slave.text));
    }

    // General contact whose property adheres: all bodies that touch with nodes of their own.
    void add_everywhere() {
        const InteractionCards& interaction =
            named(deck_.interactions, deck_.adhering, "surface interaction", deck_.adhering_place);
        if (!interaction.eligibility.empty() && interaction.eligibility != "CURRENT CONTACTS" &&
            interaction.eligibility != "ORIGINAL CONTACTS")
            throw SceneFailure(interaction.place, "ELIGIBILITY=" + interaction.eligibility +
                                                      " needs surfaces in *CONTACT PROPERTY ASSIGNMENT");
        for (const auto& [key, pair] : touching_)
            if (pair.shared == 0 && connections_.find(pair.a, pair.b) == nullptr)
                connections_.add(
                    {pair.a, pair.b, laws_.of_interaction(interaction), "", 0.0, true, deck_.adhering_place});
    }

    // The slave surface, or its bonded nodes, determine what adheres; the master must not say less.
    void require_extent(const ContactPair& pair, const InteractionCards& interaction, const std::string& slave,
                        const std::string& master) {
        const bool specified = interaction.eligibility == "SPECIFIED CONTACTS";
        if (specified == pair.bonded.empty())
            throw SceneFailure(pair.place,
                               "ELIGIBILITY=SPECIFIED CONTACTS and *INITIAL CONDITIONS, TYPE=CONTACT are "
                               "imported together: one of them is missing");
        if (!interaction.eligibility.empty() && !specified && interaction.eligibility != "CURRENT CONTACTS" &&
            interaction.eligibility != "ORIGINAL CONTACTS")
            throw SceneFailure(interaction.place, "ELIGIBILITY=" + interaction.eligibility +
                                                      " is not imported: CURRENT, ORIGINAL and SPECIFIED CONTACTS are");
        const auto& faces = mesh_.face_sets.at(slave);
        const auto opposite = places_.coinciding(slave, master);
        if (opposite == 0)
            deck_.changed.push_back(
                fmt::format("\"{}\" and \"{}\" do not match: the slave adheres wherever it meets "
                            "the body of the master",
                            pair.slave.text, pair.master.text));
        else if (!specified && opposite < static_cast<std::int64_t>(faces.size()))
            throw SceneFailure(pair.place, fmt::format("{} of the {} sides of \"{}\" lie opposite \"{}\": only these "
                                                       "would adhere; make the slave surface as small",
                                                       opposite, faces.size(), pair.slave.text, pair.master.text));
    }

    [[nodiscard]] std::string bonded_set(const ContactPair& pair) const {
        std::string name = node_set_name(model_, {pair.slave.scope, pair.bonded, pair.place});
        if (!mesh_.node_sets.contains(name))
            throw SceneFailure(pair.place, "node set \"" + pair.bonded + "\" is not there, or empty");
        return name;
    }

    Deck& deck_;
    const Model& model_;
    const MeshData& mesh_;
    FaceBodies faces_;
    NodeBodies nodes_;
    double edge_;
    FacePlaces places_;
    SectionIndex cohesive_sections_;
    DeckLaws laws_;
    std::map<std::pair<std::int32_t, std::int32_t>, BodyPair> touching_;
    std::vector<std::vector<std::int32_t>> neighbours_;  // by body: those that touch it, ascending
    Connections connections_;
    std::map<std::string, std::set<std::int32_t>> bodies_of_;  // by surface
};

}  // namespace

std::string interfaces_text(Deck& deck, const Model& model, const MeshData& mesh) {
    return Interfaces(deck, model, mesh).text();
}

}  // namespace cli::abaqus
