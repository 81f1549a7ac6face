// SPDX-License-Identifier: BSD-3-Clause
#include "deck/deck_bodies.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <unordered_map>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "deck/abaqus/keywords.hpp"
#include "deck/cards/deck.hpp"
#include "mesh/cell_shape.hpp"
#include "text/toml_text.hpp"

namespace cli::abaqus {

namespace {

FaceKey key_of(const Face& face, std::int32_t dimension) {
    const auto count = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
    const std::size_t corners = dimension == 2 ? 2 : count % 3 == 0 ? 3 : 4;
    FaceKey key(face.begin(), face.begin() + static_cast<std::ptrdiff_t>(std::min(corners, count)));
    std::sort(key.begin(), key.end());
    return key;
}

constexpr std::size_t most_pairs = 1000000;

void sort_once(std::vector<std::int32_t>& bodies) {
    std::sort(bodies.begin(), bodies.end());
    bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
}

// The element of a face, as the deck has it, and its name for people. Null: its faces are those of bodies, to which it
// is tied.
struct OfDeck {
    const Part* scope;
    const Element* element;
    std::string name;
};
OfDeck of_deck(const Model& model, const CohesiveFace& face) {
    const Face& lower = face.set->lower[face.element];
    const auto [scope, at] = cohesive_element(model, {lower.begin(), std::find(lower.begin(), lower.end(), -1)});
    if (at == nullptr) return {scope, at, fmt::format("an element of \"{}\"", face.set->name)};
    return {scope, at, fmt::format("element {} of \"{}\"", full_name(*scope, std::to_string(at->id)), face.set->name)};
}

}  // namespace

// Finds the first of the nodes that coincide.
class Coincidence {
public:
    Coincidence(const MeshData& mesh, double tolerance)
        : mesh_(mesh), dimension_(static_cast<std::size_t>(mesh.dimension)), tolerance_(tolerance) {}

    std::int64_t first(std::int64_t node) {
        const auto known = first_.find(node);
        if (known != first_.end()) return known->second;
        Cell cell{};
        for (std::size_t a = 0; a < dimension_; ++a) cell[a] = std::llround(std::floor(at(node)[a] / (8 * tolerance_)));
        std::int64_t found = node;
        for (const std::int64_t other : near(cell))
            if (found == node && distance(other, node) <= tolerance_) found = other;
        if (found == node) grid_[cell].push_back(node);
        return first_[node] = found;
    }

private:
    using Cell = std::array<std::int64_t, 3>;

    [[nodiscard]] const double* at(std::int64_t node) const {
        return mesh_.nodes.data() + static_cast<std::size_t>(node) * dimension_;
    }
    [[nodiscard]] double distance(std::int64_t a, std::int64_t b) const {
        double square = 0;
        for (std::size_t i = 0; i < dimension_; ++i) square += (at(a)[i] - at(b)[i]) * (at(a)[i] - at(b)[i]);
        return std::sqrt(square);
    }
    [[nodiscard]] std::vector<std::int64_t> near(const Cell& cell) const {
        std::vector<std::int64_t> out;
        for (int x = -1; x <= 1; ++x)
            for (int y = -1; y <= 1; ++y)
                for (int z = dimension_ == 3 ? -1 : 0; z <= (dimension_ == 3 ? 1 : 0); ++z) {
                    const auto found = grid_.find({cell[0] + x, cell[1] + y, cell[2] + z});
                    if (found != grid_.end()) out.insert(out.end(), found->second.begin(), found->second.end());
                }
        return out;
    }

    const MeshData& mesh_;
    std::size_t dimension_;
    double tolerance_;
    std::map<Cell, std::vector<std::int64_t>> grid_;
    std::unordered_map<std::int64_t, std::int64_t> first_;
};

FaceBodies::FaceBodies(const MeshData& mesh) : dimension_(mesh.dimension) {
    for (const CellBlock& block : mesh.blocks) {
        const CellShape& shape = shape_of(block.type);
        for (std::size_t c = 0; c < block.bodies.size(); ++c)
            for (const auto& side : shape.sides) {
                FaceKey key;
                for (const std::size_t corner : shape.corners_of(side))
                    key.push_back(block.connectivity[c * shape.nodes + corner]);
                std::sort(key.begin(), key.end());
                const auto [at, inserted] = bodies_.emplace(std::move(key), std::vector{block.bodies[c]});
                if (!inserted) at->second.push_back(block.bodies[c]);
            }
    }
    for (auto& [key, bodies] : bodies_) sort_once(bodies);
}

std::vector<std::size_t> FaceBodies::order_by_sides(const std::vector<std::int64_t>& nodes) const {
    // The other ways in which a quadrilateral and a brick lie between two of their opposite sides.
    static const std::vector<std::size_t> orders[] = {{1, 2, 3, 0}, {0, 3, 7, 4, 1, 2, 6, 5}, {0, 4, 5, 1, 3, 7, 6, 2}};
    for (const auto& order : orders) {
        if (order.size() != nodes.size()) continue;
        bool sides = true;
        for (std::size_t first = 0; first < order.size(); first += order.size() / 2) {
            Face face;
            face.fill(-1);
            for (std::size_t k = 0; k < order.size() / 2; ++k) face[k] = nodes[order[first + k]];
            sides = sides && !of(face).empty();
        }
        if (sides) return order;
    }
    return {};
}

void refuse_face(const Model& model, const MeshData& mesh, const FaceBodies& faces, const CohesiveFace& face,
                 const Place& section) {
    const auto [scope, at, name] = of_deck(model, face);
    if (at == nullptr) throw SceneFailure(section, fmt::format("\"{}\" has a face at no body", face.set->name));
    const Face& own = face.upper ? face.set->upper[face.element] : face.set->lower[face.element];
    const std::vector<std::int32_t> bodies = faces.of(own);
    const auto body = [&](std::size_t k) { return toml_text(mesh.body_names[static_cast<std::size_t>(bodies[k])]); };
    if (!bodies.empty())
        throw SceneFailure(at->place, fmt::format("{} has a face between {} and {}: its nodes must be those of one of "
                                                  "them",
                                                  name, body(0), body(1)));
    const auto [owner, cell] = cell_with(model, {own.begin(), std::find(own.begin(), own.end(), -1)});
    if (cell != nullptr)
        throw SceneFailure(
            cell->place,
            fmt::format("element {} has the nodes of a face of {} ({}), and no such side: it is degenerate, or its "
                        "nodes are in another order",
                        full_name(*owner, std::to_string(cell->id)), name, at->place.text()));
    std::vector<std::int64_t> nodes, better;
    for (std::size_t k = 0; k < at->nodes.size(); ++k) nodes.push_back(node_number(*scope, *at, k));
    for (const std::size_t k : faces.order_by_sides(nodes)) better.push_back(at->nodes[k]);
    throw SceneFailure(
        at->place,
        fmt::format("{} has a face that is no side of a cell: the first half of its nodes is one face, the second half "
                    "the other{}",
                    name, better.empty() ? "" : fmt::format("; write {}, {}", at->id, fmt::join(better, ", "))));
}

void refuse_thick(const Model& model, const MeshData& mesh, const FaceBodies& faces, const CohesiveFace& face,
                  double gap, const Place& section) {
    const OfDeck of = of_deck(model, face);
    const std::vector<std::int32_t> bodies = faces.of(face.set->lower[face.element]);
    throw SceneFailure(
        of.element == nullptr ? section : of.element->place,
        fmt::format("{} lies within {}, and its faces are {:.6g} apart: within one body the nodes of both faces "
                    "coincide; {}",
                    of.name, toml_text(mesh.body_names[static_cast<std::size_t>(bodies.front())]), gap,
                    sections_of_one_side));
}

std::vector<std::int32_t> FaceBodies::of(const Face& face) const {
    const auto found = bodies_.find(key_of(face, dimension_));
    return found == bodies_.end() ? std::vector<std::int32_t>{} : found->second;
}

std::vector<BodyPair> pairs_of_bodies(const MeshData& mesh, const FaceBodies& faces, double shortest_edge,
                                      const Place& place) {
    std::map<std::pair<std::int32_t, std::int32_t>, BodyPair> out;
    const auto pair = [&](std::int32_t a, std::int32_t b) -> BodyPair& {
        const auto [at, inserted] = out.emplace(std::minmax(a, b), BodyPair{});
        if (inserted) std::tie(at->second.a, at->second.b) = std::minmax(a, b);
        // Each has an interface of its own. Where bodies lie in one place, all pairs of them touch.
        if (out.size() > most_pairs)
            throw SceneFailure(place,
                               fmt::format("\"{}\" and \"{}\" touch, and {} pairs of bodies before: at most {} "
                                           "are imported; do bodies lie in one place?",
                                           mesh.body_names[static_cast<std::size_t>(a)],
                                           mesh.body_names[static_cast<std::size_t>(b)], most_pairs, most_pairs));
        return at->second;
    };
    Coincidence coincidence(mesh, 1e-6 * shortest_edge);
    std::map<FaceKey, std::vector<std::int32_t>> places;  // by nodes of which each stands for all that coincide
    for (const auto& [key, bodies] : faces.all()) {
        for (std::size_t i = 1; i < bodies.size(); ++i) ++pair(bodies[0], bodies[i]).shared;
        FaceKey where;
        for (const std::int64_t node : key) where.push_back(coincidence.first(node));
        std::sort(where.begin(), where.end());
        std::vector<std::int32_t>& there = places[std::move(where)];
        for (const std::int32_t body : bodies) {
            for (const std::int32_t other : there)
                if (other != body) ++pair(other, body).doubled;
        }
        there.insert(there.end(), bodies.begin(), bodies.end());
    }
    std::vector<BodyPair> list;
    for (const auto& [key, found] : out) list.push_back(found);
    return list;
}

struct FacePlaces::Known {
    explicit Known(const MeshData& of, double shortest_edge) : mesh(of), coincidence(of, 1e-6 * shortest_edge) {}

    const MeshData& mesh;
    Coincidence coincidence;
    std::map<std::string, std::map<FaceKey, std::int64_t>> places;  // by set: how many faces are there
    std::map<std::pair<std::string, std::string>, std::int64_t> coinciding;

    const std::map<FaceKey, std::int64_t>& of(const std::string& set) {
        const auto [at, inserted] = places.try_emplace(set);
        if (!inserted) return at->second;
        for (const Face& face : mesh.face_sets.at(set)) {
            FaceKey place = key_of(face, mesh.dimension);
            for (std::int64_t& node : place) node = coincidence.first(node);
            std::sort(place.begin(), place.end());
            ++at->second[std::move(place)];
        }
        return at->second;
    }
};

FacePlaces::FacePlaces(const MeshData& mesh, double shortest_edge)
    : known_(std::make_unique<Known>(mesh, shortest_edge)) {}
FacePlaces::~FacePlaces() = default;

std::int64_t FacePlaces::coinciding(const std::string& set, const std::string& other) {
    const auto [at, inserted] = known_->coinciding.try_emplace({set, other}, 0);
    if (!inserted) return at->second;
    const auto &faces = known_->of(set), &others = known_->of(other);
    // Goes through the smaller one: the other may be that of many pairs.
    const bool turned = others.size() < faces.size();
    for (const auto& [place, count] : turned ? others : faces) {
        const auto found = (turned ? faces : others).find(place);
        if (found != (turned ? faces : others).end()) at->second += turned ? found->second : count;
    }
    return at->second;
}

double farthest(const MeshData& mesh, const std::string& from, const std::string& to) {
    const auto dimension = static_cast<std::size_t>(mesh.dimension);
    const auto places = [&](const std::string& name) {
        std::set<std::int64_t> nodes;
        for (const Face& face : mesh.face_sets.at(name)) nodes.insert(face.begin(), face.end());
        nodes.erase(-1);
        std::vector<std::array<double, 3>> out;
        for (const std::int64_t node : nodes) {
            std::array<double, 3> place{};
            const auto first = mesh.nodes.begin() + static_cast<std::ptrdiff_t>(node) * mesh.dimension;
            std::copy_n(first, dimension, place.begin());
            out.push_back(place);
        }
        std::sort(out.begin(), out.end());
        return out;
    };
    const auto others = places(to);
    double most = 0;
    for (const std::array<double, 3>& x : places(from)) {
        // Outward along the first axis from where x would stand, until that distance alone is too large.
        double nearest = std::numeric_limits<double>::infinity();
        const auto compare = [&](const std::array<double, 3>& y) {
            nearest = std::min(nearest, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
        };
        const auto middle = std::lower_bound(others.begin(), others.end(), x);
        for (auto y = middle; y != others.end() && (*y)[0] - x[0] <= nearest; ++y) compare(*y);
        for (auto y = middle; y != others.begin() && x[0] - (*(y - 1))[0] <= nearest; --y) compare(*(y - 1));
        most = std::max(most, nearest);
    }
    return most;
}

NodeBodies::NodeBodies(const MeshData& mesh) : of_(mesh.nodes.size() / static_cast<std::size_t>(mesh.dimension)) {
    for (const CellBlock& block : mesh.blocks) {
        const std::size_t nodes = shape_of(block.type).nodes;
        for (std::size_t c = 0; c < block.bodies.size(); ++c)
            for (std::size_t k = 0; k < nodes; ++k)
                of_[static_cast<std::size_t>(block.connectivity[c * nodes + k])].push_back(block.bodies[c]);
    }
    for (std::vector<std::int32_t>& bodies : of_) sort_once(bodies);
}

}  // namespace cli::abaqus
