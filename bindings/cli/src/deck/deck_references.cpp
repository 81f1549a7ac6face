// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_references.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "deck/deck_bodies.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

namespace {

constexpr std::size_t most_equations = 200;
// Nodes of a *DISTRIBUTING, each of which is a term in up to six equations: a megabyte of text.
constexpr std::size_t most_distributed = 1000;

using Row = std::array<double, 3>;

double dot(const Row& a, const Row& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Row axis_row(std::size_t axis) {
    Row out{};
    out[axis] = 1;
    return out;
}

// Returns the part of a row of length 1 that is orthogonal to an orthonormal basis.
Row across(const std::vector<Row>& basis, Row row) {
    for (const Row& b : basis) {
        const double share = dot(row, b);
        for (std::size_t a = 0; a < 3; ++a) row[a] -= share * b[a];
    }
    return row;
}

// Adds what a row has across the basis; a millionth of it is rounding.
void extend(std::vector<Row>& basis, const Row& row) {
    const double length = std::sqrt(dot(row, row));
    if (!(length > 0)) return;
    Row rest = across(basis, {row[0] / length, row[1] / length, row[2] / length});
    const double left = std::sqrt(dot(rest, rest));
    if (left < 1e-6) return;
    for (double& x : rest) x /= left;
    basis.push_back(rest);
}

// True if an equation holds for every common displacement of its nodes.
bool is_affine(const std::vector<EquationEntry>& terms) {
    std::map<int, double> sum;  // by degree of freedom
    double most = 0;
    for (const EquationEntry& term : terms) {
        sum[term.dof] += term.coefficient;
        most = std::max(most, std::abs(term.coefficient));
    }
    constexpr double digits_of_a_deck = 1e-8;  // weights of eight digits that add up to those on the other side
    return std::all_of(sum.begin(), sum.end(),
                       [&](const auto& s) { return std::abs(s.second) <= digits_of_a_deck * most; });
}

// Orthonormal directions across a basis; axes where these are such.
std::vector<Row> complement(std::vector<Row> basis, std::size_t dimension) {
    const std::size_t given = basis.size();
    while (basis.size() < dimension) {
        std::size_t best = 0;
        double most = -1;
        for (std::size_t a = 0; a < dimension; ++a) {
            const Row rest = across(basis, axis_row(a));
            if (dot(rest, rest) > most + 1e-9) {
                most = dot(rest, rest);
                best = a;
            }
        }
        extend(basis, axis_row(best));
    }
    return {basis.begin() + static_cast<std::ptrdiff_t>(given), basis.end()};
}

Row cross(const Row& a, const Row& b) {
    return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

// A point at the distance r from the centre of a rotation w moves along axis a by w . (r x e_a).
Row lever(const Row& r, std::size_t axis) { return cross(r, axis_row(axis)); }

// A term of an equation. place: the lines of a table that name it.
std::string line_of(std::string place, std::size_t axis, double coefficient) {
    while (!place.empty() && place.back() == '\n') place.pop_back();
    for (std::size_t i = 0; (i = place.find('\n', i)) != std::string::npos; i += 2) place.replace(i, 1, ", ");
    return fmt::format("    {{ {}, component = [\"{}\"], coefficient = {} }},\n", place, axis_names[axis],
                       toml_number(coefficient));
}

// The inertia of points with weights about their centre.
class Inertia {
public:
    // arms: from the centre. nullopt: the points leave a rotation open.
    static std::optional<Inertia> of(const std::vector<Row>& arms, const std::vector<double>& weights,
                                     std::size_t dimension) {
        Inertia out;
        for (std::size_t i = 0; i < arms.size(); ++i)
            for (std::size_t a = 0; a < 3; ++a)
                for (std::size_t b = 0; b < 3; ++b)
                    out.j_[a][b] += weights[i] * ((a == b ? dot(arms[i], arms[i]) : 0.0) - arms[i][a] * arms[i][b]);
        // Points in the plane turn about z alone.
        if (dimension == 2) out.j_[0] = axis_row(0), out.j_[1] = axis_row(1), out.j_[2] = {0, 0, out.j_[2][2]};
        const double size = out.j_[2][2] + (dimension == 3 ? out.j_[0][0] + out.j_[1][1] : 0.0);
        const double scale = dimension == 3 ? size * size * size : size;
        if (!(size > 0) || !(dot(out.j_[0], cross(out.j_[1], out.j_[2])) > 1e-9 * scale)) return std::nullopt;
        return out;
    }
    [[nodiscard]] Row inverse_times(const Row& right) const {
        const double whole = dot(j_[0], cross(j_[1], j_[2]));
        Row out{};
        for (std::size_t k = 0; k < 3; ++k) out[k] = dot(cross(j_[(k + 1) % 3], j_[(k + 2) % 3]), right) / whole;
        return out;
    }

private:
    std::array<Row, 3> j_{};
};

}  // namespace

std::string point_text(const MeshData& mesh, std::int64_t node, std::int32_t body) {
    const auto first = mesh.nodes.begin() + static_cast<std::ptrdiff_t>(node * mesh.dimension);
    return fmt::format("point = {}\nbody = {}\n", toml_list(std::vector<double>(first, first + mesh.dimension)),
                       toml_text(mesh.body_names[static_cast<std::size_t>(body)]));
}

References::References(const Deck& deck, const Model& model, const MeshData& mesh)
    : model_(model), mesh_(mesh), dimension_(static_cast<std::size_t>(mesh.dimension)), bodies_(mesh) {
    for (const auto& [set, nodes] : mesh.node_sets)
        if (nodes.size() == 1) set_of_.emplace(nodes.front(), set);
    for (const Coupling& coupling : deck.couplings) coupling.in_mean ? distribute(coupling) : couple(coupling);
    for (const auto& terms : deck.equations) equate(terms);
    for (const Pin& pin : deck.pins)
        for (int dof = 1; dof <= mesh.dimension; ++dof) equate({{pin.first, dof, 1.0}, {pin.second, dof, -1.0}});
}

std::vector<std::int64_t> References::nodes_of(const Entry& where) const {
    std::set<std::int64_t> nodes;
    model_.collect_nodes(where, nodes);
    return {nodes.begin(), nodes.end()};
}

const std::vector<std::int64_t>& References::of(const Entry& where) const {
    // Entries of loads and constraints stand outside of parts: their text says all.
    const auto [at, inserted] = of_.try_emplace(where.text);
    if (!inserted) return at->second;
    std::vector<std::int64_t> nodes = nodes_of(where);
    const auto loose = std::count_if(nodes.begin(), nodes.end(), [&](std::int64_t node) { return of_no_body(node); });
    if (loose == 0) return at->second;
    if (loose < static_cast<std::ptrdiff_t>(nodes.size()))
        throw SceneFailure(where.place,
                           fmt::format("{} of the {} nodes of \"{}\" belong to no body: give them, and the "
                                       "others, sets of their own",
                                       loose, nodes.size(), where.text));
    return at->second = std::move(nodes);
}

std::vector<double> References::position(std::int64_t node) const {
    const auto first = mesh_.nodes.begin() + static_cast<std::ptrdiff_t>(node * mesh_.dimension);
    return {first, first + mesh_.dimension};
}

std::pair<const Part*, std::int64_t> References::owner_of(std::int64_t node) const {
    const Part& owner = model_.owner_of(node);
    return {&owner, owner.nodes.at(static_cast<std::size_t>(node - owner.first_node)).id};
}
std::pair<std::size_t, std::int64_t> References::label_of(std::int64_t node) const {
    const auto [scope, id] = owner_of(node);
    return {scope->order, id};
}

// Returns the name of a set that consists of the node, or the number of the node; no other control node has this name.
std::string References::new_name(std::int64_t node, const std::string& ending) {
    const auto [scope, id] = owner_of(node);
    const auto set = set_of_.find(node);
    const std::string name =
        (set != set_of_.end() ? set->second : "node-" + full_name(*scope, std::to_string(id))) + ending;
    std::string out = name;
    while (!names_.emplace(out, 2).second) out = fmt::format("{}-{}", name, names_[name]++);
    return out;
}

std::string References::place_of(const Control& control) {
    return fmt::format("control = {}\n", toml_text(control.name));
}

std::size_t References::control_of(std::int64_t node) {
    const auto [at, inserted] = translations_.emplace(node, controls_.size());
    if (inserted) controls_.push_back({new_name(node, ""), position(node), {}, {}});
    return at->second;
}

std::size_t References::rotation_of(std::int64_t node) {
    stay_linear_ = true;
    const auto [at, inserted] = rotations_.emplace(node, controls_.size());
    if (inserted) controls_.push_back({new_name(node, "-rotation"), position(node), {}, {}});
    return at->second;
}

SceneComponent References::of_control(std::size_t control, std::size_t axis) const {
    return {place_of(controls_[control]), axis, control};
}

std::optional<SceneComponent> References::component(std::int64_t node, int dof) const {
    if (const auto turned = rotation_nodes_.find(node); turned != rotation_nodes_.end()) {
        if (dof > 3) return std::nullopt;
        return component(turned->second, dof + 3);
    }
    if (dof <= mesh_.dimension) {
        const auto control = translations_.find(node);
        if (control == translations_.end()) return std::nullopt;
        return of_control(control->second, static_cast<std::size_t>(dof - 1));
    }
    const bool plane = mesh_.dimension == 2;
    const auto control = rotations_.find(node);
    if (dof <= 3 || control == rotations_.end() || (plane && dof != 6)) return std::nullopt;
    // The rotation about z is the first component in the plane.
    return of_control(control->second, plane ? 0 : static_cast<std::size_t>(dof - 4));
}

void References::prescribe(const SceneComponent& component) {
    extend(controls_.at(component.control).determined, axis_row(component.axis));
}

void References::push(const SceneComponent& component, const Place& place) {
    controls_.at(component.control).pushed.emplace(component.axis, place);
}

std::int64_t References::reference_of(const Coupling& coupling) {
    const std::vector<std::int64_t>& found = of(coupling.reference);
    if (found.size() != 1)
        throw SceneFailure(coupling.place, fmt::format("REF NODE={}: one node that belongs to no body is expected",
                                                       coupling.reference.text));
    const std::int64_t reference = found.front();
    if (rotation_nodes_.contains(reference))
        throw SceneFailure(coupling.place,
                           fmt::format("REF NODE={} is the ROT NODE of another card", coupling.reference.text));
    if (coupling.rotation_node) {
        const std::vector<std::int64_t>& turned = of(*coupling.rotation_node);
        if (turned.size() != 1 || turned.front() == reference)
            throw SceneFailure(coupling.place, fmt::format("ROT NODE={}: one further node that belongs to no body is "
                                                           "expected",
                                                           coupling.rotation_node->text));
        const bool inserted = rotation_nodes_.emplace(turned.front(), reference).second;
        if (!inserted || translations_.contains(turned.front()))
            throw SceneFailure(coupling.place,
                               fmt::format("ROT NODE={}: another card uses this node too: each rotation "
                                           "has a node of its own",
                                           coupling.rotation_node->text));
    }
    return reference;
}

std::string References::coupled_set(const Coupling& coupling) {
    std::string set = surface_name(model_, coupling.where);
    if (set.empty()) set = node_set_name(model_, coupling.where);
    if (!mesh_.node_sets.contains(set))
        throw SceneFailure(coupling.place,
                           fmt::format("\"{}\": no surface or node set of this name has nodes", coupling.where.text));
    const std::vector<std::int64_t>& nodes = mesh_.node_sets.at(set);
    // Several couplings may name one large set.
    coupled_ += nodes.size();
    if (coupled_ > static_cast<std::size_t>(most_members))
        throw SceneFailure(coupling.place, fmt::format("with this more than {} nodes are coupled", most_members));
    if (std::any_of(nodes.begin(), nodes.end(), [&](std::int64_t node) { return of_no_body(node); }))
        throw SceneFailure(coupling.place, fmt::format("\"{}\" has nodes that belong to no body", coupling.where.text));
    return set;
}

void References::couple(const Coupling& coupling) {
    const std::int64_t reference = reference_of(coupling);
    const std::string set = coupled_set(coupling);
    const std::vector<std::int64_t>& nodes = mesh_.node_sets.at(set);
    std::vector<std::size_t> axes;
    for (std::size_t a = 0; a < dimension_; ++a)
        if (coupling.dofs.empty() ||
            std::find(coupling.dofs.begin(), coupling.dofs.end(), static_cast<int>(a) + 1) != coupling.dofs.end())
            axes.push_back(a);
    if (axes.empty())
        throw SceneFailure(coupling.place, "couples degree of freedom 3 alone, which a plane mesh does not have");

    Control& control = controls_[control_of(reference)];
    const std::vector<double> centre = control.at;
    const std::string place = place_of(control);
    std::vector<Row> levers;
    double longest = 0;
    for (const std::int64_t node : nodes) {
        const std::vector<double> at = position(node);
        Row r{};
        for (std::size_t a = 0; a < dimension_; ++a) r[a] = at[a] - centre[a];
        longest = std::max(longest, std::sqrt(dot(r, r)));
        for (const std::size_t a : axes) levers.push_back(lever(r, a));
    }
    std::vector<std::string> names;
    for (const std::size_t a : axes) {
        extend(control.determined, axis_row(a));
        names.emplace_back(axis_names[a]);
    }
    constraints_ += fmt::format("{}[[couplings]]\nset = {}\ncomponent = {}\n{}", origin_line(coupling.place),
                                toml_text(set), toml_list(names), place);
    // A rotation that moves none of the nodes is left out.
    std::erase_if(levers, [&](const Row& row) { return !(std::sqrt(dot(row, row)) > 1e-6 * longest); });
    if (!levers.empty()) {
        Control& rotation = controls_[rotation_of(reference)];
        for (const Row& row : levers) extend(rotation.determined, dimension_ == 2 ? Row{row[2], 0, 0} : row);
        constraints_ += fmt::format("rotation = {}\n", toml_text(rotation.name));
    }
    constraints_ += "\n";
}

// Returns the shares of the nodes of a set in its area: each face gives its nodes equal parts of its own. Nodes without
// faces have equal shares.
std::vector<double> References::weights_of(const std::string& set) const {
    const std::vector<std::int64_t>& nodes = mesh_.node_sets.at(set);
    std::vector<double> out(nodes.size(), 0.0);
    const auto faces = mesh_.face_sets.find(set);
    if (faces == mesh_.face_sets.end()) std::fill(out.begin(), out.end(), 1.0);
    for (std::size_t f = 0; faces != mesh_.face_sets.end() && f < faces->second.size(); ++f) {
        const auto& face = faces->second[f];
        const auto count = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
        const std::size_t corners = dimension_ == 2 ? 2 : count % 3 == 0 ? 3 : 4;
        const auto from_first = [&](std::size_t k) {
            const std::vector<double> at = position(face[k]), first = position(face[0]);
            Row r{};
            for (std::size_t a = 0; a < dimension_; ++a) r[a] = at[a] - first[a];
            return r;
        };
        double area = std::sqrt(dot(from_first(1), from_first(1)));
        if (dimension_ == 3) {
            area = 0;
            for (std::size_t k = 2; k < corners; ++k) {
                const Row normal = cross(from_first(k - 1), from_first(k));
                area += std::sqrt(dot(normal, normal)) / 2;
            }
        }
        for (std::size_t k = 0; k < count; ++k) {
            const auto at = std::lower_bound(nodes.begin(), nodes.end(), face[k]) - nodes.begin();
            out[static_cast<std::size_t>(at)] += area / static_cast<double>(count);
        }
    }
    const double whole = std::accumulate(out.begin(), out.end(), 0.0);
    for (double& share : out) share /= whole;
    return out;
}

// The reference node moves as the rigid motion that fits the nodes best, with weights: its translation is the mean, its
// rotation t has J t = sum w r x u with J = sum w (r.r - r r^T), r from the weighted centre (Abaqus, "Coupling
// constraints", continuum distributing). A force there acts on the nodes so that it leaves their shape free.
void References::distribute(const Coupling& coupling) {
    const std::int64_t reference = reference_of(coupling);
    const std::string set = coupled_set(coupling);
    const std::vector<std::int64_t>& nodes = mesh_.node_sets.at(set);
    if (nodes.size() > most_distributed)
        throw SceneFailure(coupling.place,
                           fmt::format("*DISTRIBUTING over {} nodes: at most {} are imported; give the surface a "
                                       "traction (*DSLOAD), or *KINEMATIC",
                                       nodes.size(), most_distributed));
    const std::vector<double> weights = weights_of(set);
    Row centre{}, offset{};
    std::vector<Row> arms;
    for (const std::int64_t node : nodes) {
        const std::vector<double> at = position(node);
        arms.emplace_back();
        std::copy(at.begin(), at.end(), arms.back().begin());
        for (std::size_t a = 0; a < 3; ++a) centre[a] += weights[arms.size() - 1] * arms.back()[a];
    }
    for (Row& arm : arms)
        for (std::size_t a = 0; a < 3; ++a) arm[a] -= centre[a];
    const std::vector<double> at = position(reference);
    for (std::size_t a = 0; a < dimension_; ++a) offset[a] = at[a] - centre[a];
    const std::optional<Inertia> inertia = Inertia::of(arms, weights, dimension_);
    if (!inertia)
        throw SceneFailure(coupling.place, "*DISTRIBUTING: its nodes lie on one line, which leaves a rotation open");
    // The share of the motion of a node along an axis in the rotation of all.
    const auto turn = [&](std::size_t i, std::size_t axis) {
        Row out = inertia->inverse_times(cross(arms[i], axis_row(axis)));
        for (double& x : out) x *= weights[i];
        return out;
    };
    const auto equation = [&](std::size_t control, std::size_t axis, const auto& share) {
        extend(controls_[control].determined, axis_row(axis));
        constraints_ += fmt::format("{}[[equations]]\nleft = [\n", origin_line(coupling.place));
        constraints_ += line_of(place_of(controls_[control]), axis, 1.0);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t a = 0; a < dimension_; ++a)
                if (const double part = share(i, a); std::fpclassify(part) != FP_ZERO)
                    constraints_ += line_of(point_text(mesh_, nodes[i], bodies_at(nodes[i]).front()), a, -part);
        constraints_ += "]\n\n";
    };
    const std::size_t control = control_of(reference);
    for (std::size_t k = 0; k < dimension_; ++k)
        equation(control, k, [&](std::size_t i, std::size_t a) {
            return (k == a ? weights[i] : 0.0) + cross(turn(i, a), offset)[k];
        });
    if (!coupling.turns) return;
    const std::size_t rotation = rotation_of(reference);
    if (dimension_ == 2) return equation(rotation, 0, [&](std::size_t i, std::size_t a) { return turn(i, a)[2]; });
    for (std::size_t k = 0; k < 3; ++k)
        equation(rotation, k, [&](std::size_t i, std::size_t a) { return turn(i, a)[k]; });
}

std::string References::term_text(const EquationEntry& term, std::int64_t node) {
    SceneComponent at;
    if (of_no_body(node)) {
        if (!rotation_nodes_.contains(node)) control_of(node);
        const auto found = component(node, term.dof);
        if (!found)
            throw SceneFailure(term.where.place, fmt::format("degree of freedom {} of \"{}\": nothing moves with it",
                                                             term.dof, term.where.text));
        prescribe(*found);
        at = *found;
    } else {
        if (term.dof > mesh_.dimension)
            throw SceneFailure(term.where.place,
                               fmt::format("degree of freedom {} of \"{}\": a node of a body has 1 to {}", term.dof,
                                           term.where.text, mesh_.dimension));
        at = {point_text(mesh_, node, bodies_at(node).front()), static_cast<std::size_t>(term.dof - 1), 0};
    }
    return line_of(at.place, at.axis, term.coefficient);
}

bool References::unsorted(const Entry& where) const {
    const Entry entry = model_.resolved_scope(where);
    const auto set = entry.scope->node_sets.find(upper(entry.text));
    return set != entry.scope->node_sets.end() && set->second.unsorted;
}

// An equation between sets is one for each of their nodes, in the order of their numbers.
void References::equate(const std::vector<EquationEntry>& terms) {
    std::vector<std::vector<std::int64_t>> nodes;
    std::size_t count = 1;
    for (const EquationEntry& term : terms) {
        nodes.push_back(nodes_of(term.where));
        std::sort(nodes.back().begin(), nodes.back().end(),
                  [&](std::int64_t a, std::int64_t b) { return label_of(a) < label_of(b); });
        count = std::max(count, nodes.back().size());
        if (nodes.back().size() > 1 && unsorted(term.where))
            throw SceneFailure(term.where.place, fmt::format("\"{}\" is UNSORTED: equations between sets are imported "
                                                             "in the order of their nodes' numbers",
                                                             term.where.text));
    }
    for (std::size_t k = 0; k < terms.size(); ++k)
        if (nodes[k].size() != count && nodes[k].size() != 1)
            throw SceneFailure(terms[k].where.place, fmt::format("\"{}\" has {} nodes, and another set of the equation "
                                                                 "has {}",
                                                                 terms[k].where.text, nodes[k].size(), count));
    const auto of_control = [&](const std::vector<std::int64_t>& own) { return of_no_body(own.front()); };
    if (std::any_of(nodes.begin(), nodes.end(), of_control) && !is_affine(terms)) stay_linear_ = true;
    if (count > most_equations)
        throw SceneFailure(terms.front().where.place,
                           fmt::format("equations for {} nodes: at most {} are imported; couple the nodes of a rigid "
                                       "face (*COUPLING, *KINEMATIC)",
                                       count, most_equations));
    for (std::size_t i = 0; i < count; ++i) {
        std::string left;
        for (std::size_t k = 0; k < terms.size(); ++k)
            if (std::fpclassify(terms[k].coefficient) != FP_ZERO)
                left += term_text(terms[k], nodes[k][nodes[k].size() == 1 ? 0 : i]);
        if (left.empty()) throw SceneFailure(terms.front().where.place, "all coefficients of the equation are 0");
        constraints_ += fmt::format("{}[[equations]]\nleft = [\n{}]\n\n", origin_line(terms.front().where.place), left);
    }
}

std::string References::held_text(const Control& control) const {
    const std::vector<Row> free = complement(control.determined, dimension_);
    for (const auto& [axis, place] : control.pushed)
        for (const Row& row : free)
            if (std::abs(row[axis]) > 1e-6)
                throw SceneFailure(
                    place, fmt::format("acts on a degree of freedom of \"{}\" with which nothing moves", control.name));
    std::string out;
    std::vector<std::string> axes;
    for (const Row& row : free) {
        const auto at =
            std::find_if(row.begin(), row.end(), [](double x) { return std::abs(std::abs(x) - 1) < 1e-12; });
        if (at != row.end())
            axes.emplace_back(axis_names[at - row.begin()]);
        else
            out += fmt::format("[[supports]]\n{}direction = {}\n\n", place_of(control),
                               toml_list(std::vector<double>(row.begin(), row.end())));
    }
    std::sort(axes.begin(), axes.end());
    if (!axes.empty()) out += fmt::format("[[supports]]\n{}fix = {}\n\n", place_of(control), toml_list(axes));
    return out;
}

std::string References::text() {
    std::string out, held;
    for (const Control& control : controls_) {
        out += fmt::format("[[controls]]\nname = {}\nat = {}\n\n", toml_text(control.name), toml_list(control.at));
        held += held_text(control);
    }
    if (!held.empty()) held = "# Motions of control nodes with which nothing moves.\n" + held;
    return out + constraints_ + held;
}

}  // namespace cli::abaqus
