// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/ply_cells.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <numbers>
#include <numeric>
#include <unordered_set>
#include <utility>

#include <fmt/format.h>

#include "mesh/cell_shape.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

using MeshFace = std::array<std::int64_t, 9>;

// Turns axes 1 and 2, six numbers, about axis 3.
std::array<double, 6> turned(const std::array<double, 6>& axes, double degrees) {
    const double c = std::cos(degrees * std::numbers::pi / 180), s = std::sin(degrees * std::numbers::pi / 180);
    std::array<double, 6> out{};
    for (std::size_t k = 0; k < 3; ++k) {
        out[k] = c * axes[k] + s * axes[k + 3];
        out[k + 3] = c * axes[k + 3] - s * axes[k];
    }
    for (double& x : out)
        if (std::abs(x) < 1e-15) x = 0;
    return out;
}

class PlySplitter {
public:
    PlySplitter(MeshData& mesh, const std::vector<const Plies*>& of_cell) : mesh_(mesh), of_cell_(of_cell) {}

    void split() {
        for_each_cell([&](std::size_t cell, const std::int64_t* nodes, std::size_t) {
            if (of_cell_[cell] != nullptr)
                for (std::size_t k = 0; k < corners; ++k) add_edge(nodes[k], nodes[k + corners], *of_cell_[cell]);
        });
        for_each_cell([&](std::size_t cell, const std::int64_t* nodes, std::size_t count) {
            require_same(nodes, count, of_cell_[cell]);
        });
        split_cells();
        for (auto& [name, nodes] : mesh_.node_sets) split_nodes(nodes);
        for (auto& [name, faces] : mesh_.face_sets) split_faces(faces);
        for (const CohesiveSet& set : mesh_.cohesive)
            for (const auto* side : {&set.lower, &set.upper})
                for (const MeshFace& face : *side)
                    if (const Edge* across = edge_in(face))
                        throw SceneFailure(across->plies->place,
                                           fmt::format("cohesive elements \"{}\" lie on the edges of the plies: give "
                                                       "the plies elements of their own",
                                                       set.name));
        say();
    }

private:
    static constexpr std::size_t corners = 4;  // of the side on which the plies lie
    struct Edge {
        const Plies* plies;
        std::vector<std::int64_t> nodes;  // from its first end to its second one
    };
    using Ends = std::pair<std::int64_t, std::int64_t>;

    // do_it: the cell, block after block, its nodes, and their number.
    template <class Do>
    void for_each_cell(Do do_it) const {
        std::size_t cell = 0;
        for (const CellBlock& block : mesh_.blocks) {
            const std::size_t count = shape_of(block.type).nodes;
            for (std::size_t i = 0; i < block.bodies.size(); ++i)
                do_it(cell++, block.connectivity.data() + i * count, count);
        }
    }

    void add_edge(std::int64_t from, std::int64_t to, const Plies& plies) {
        const auto [at, inserted] = edges_.try_emplace({from, to}, Edge{&plies, {from}});
        if (!inserted) {
            if (at->second.plies->thicknesses != plies.thicknesses) refuse(plies);
            return;
        }
        first_.insert(from);
        const auto dimension = static_cast<std::size_t>(mesh_.dimension);
        const double whole = std::accumulate(plies.thicknesses.begin(), plies.thicknesses.end(), 0.0);
        double below = 0;
        for (std::size_t k = 0; k + 1 < plies.thicknesses.size(); ++k) {
            below += plies.thicknesses[k];
            at->second.nodes.push_back(static_cast<std::int64_t>(mesh_.nodes.size() / dimension));
            for (std::size_t a = 0; a < dimension; ++a) {
                const double first = mesh_.nodes[static_cast<std::size_t>(from) * dimension + a];
                const double last = mesh_.nodes[static_cast<std::size_t>(to) * dimension + a];
                mesh_.nodes.push_back(first + (last - first) * (below / whole));
            }
        }
        at->second.nodes.push_back(to);
    }

    [[noreturn]] static void refuse(const Plies& plies) {
        throw SceneFailure(plies.place,
                           fmt::format("\"{}\" has {} plies in a cell, and a cell that shares an edge across them has "
                                       "others or none: cells at one edge need the same plies; give the plies elements "
                                       "of their own",
                                       plies.name, plies.thicknesses.size()));
    }

    // A cell that has both ends of an edge must have its plies there.
    void require_same(const std::int64_t* nodes, std::size_t count, const Plies* plies) const {
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count && first_.contains(nodes[i]); ++j) {
                const auto edge = i == j ? edges_.end() : edges_.find({nodes[i], nodes[j]});
                if (edge != edges_.end() && (plies == nullptr || i >= corners || j != i + corners))
                    refuse(*edge->second.plies);
            }
    }

    void split_cells() {
        std::vector<std::array<double, 6>> orientation;
        std::size_t cell = 0;
        for (CellBlock& block : mesh_.blocks) {
            const std::size_t count = shape_of(block.type).nodes;
            CellBlock out{block.type, {}, {}};
            for (std::size_t i = 0; i < block.bodies.size(); ++i, ++cell) {
                const std::int64_t* nodes = block.connectivity.data() + i * count;
                const Plies* plies = of_cell_[cell];
                const std::size_t number = plies == nullptr ? 1 : plies->thicknesses.size();
                for (std::size_t ply = 0; ply < number; ++ply) {
                    if (plies == nullptr)
                        out.connectivity.insert(out.connectivity.end(), nodes, nodes + count);
                    else
                        for (std::size_t k = 0; k < 2 * corners; ++k)
                            out.connectivity.push_back(
                                edges_.at({nodes[k % corners], nodes[k % corners + corners]}).nodes[ply + k / corners]);
                    out.bodies.push_back(block.bodies[i]);
                    if (!mesh_.orientation.empty())
                        orientation.push_back(plies == nullptr ? mesh_.orientation[cell]
                                                               : turned(mesh_.orientation[cell], plies->angles[ply]));
                }
                if (plies != nullptr) count_cell(*plies);
            }
            block = std::move(out);
        }
        mesh_.orientation = std::move(orientation);
    }

    void count_cell(const Plies& plies) {
        auto at = std::find_if(cells_.begin(), cells_.end(), [&](const auto& each) { return each.first == &plies; });
        if (at == cells_.end()) at = cells_.insert(at, {&plies, 0});
        ++at->second;
    }

    void split_nodes(std::vector<std::int64_t>& nodes) const {
        std::vector<std::int64_t> more;
        const auto has = [&](std::int64_t node) { return std::binary_search(nodes.begin(), nodes.end(), node); };
        for (const auto& [ends, edge] : edges_)
            if (has(ends.first) && has(ends.second))
                more.insert(more.end(), edge.nodes.begin() + 1, edge.nodes.end() - 1);
        std::sort(more.begin(), more.end());
        nodes.insert(nodes.end(), more.begin(), more.end());  // the new ones have the larger numbers
    }

    [[nodiscard]] const Edge* edge_between(std::int64_t a, std::int64_t b) const {
        const auto found = edges_.find({a, b});
        return found == edges_.end() ? nullptr : &found->second;
    }
    [[nodiscard]] const Edge* edge_in(const MeshFace& face) const {
        for (std::size_t k = 0; k < corners && face[corners] < 0 && face[corners - 1] >= 0; ++k) {
            const std::int64_t a = face[k], b = face[(k + 1) % corners];
            if (const Edge* edge = edge_between(a, b)) return edge;
            if (const Edge* edge = edge_between(b, a)) return edge;
        }
        return nullptr;
    }

    void split_faces(std::vector<MeshFace>& faces) const {
        std::vector<MeshFace> out;
        for (const MeshFace& face : faces) {
            const std::size_t before = out.size();
            for (std::size_t k = 0; k < corners && edge_in(face) != nullptr && out.size() == before; ++k) {
                // The sides k to k + 1 and k + 3 to k + 2 cross the plies.
                const auto at = [&](std::size_t n) { return face[(k + n) % corners]; };
                const Edge *one = edge_between(at(0), at(1)), *other = edge_between(at(3), at(2));
                if (one == nullptr || other == nullptr) continue;
                for (std::size_t ply = 0; ply + 1 < one->nodes.size(); ++ply) {
                    MeshFace each;
                    each.fill(-1);
                    each[0] = one->nodes[ply];
                    each[1] = one->nodes[ply + 1];
                    each[2] = other->nodes[ply + 1];
                    each[3] = other->nodes[ply];
                    out.push_back(each);
                }
            }
            if (out.size() == before) out.push_back(face);
        }
        faces = std::move(out);
    }

    void say() {
        for (const auto& [plies, count] : cells_)
            mesh_.notes.push_back(
                fmt::format("\"{}\": {} of {} plies, one for each ply here: {} cells, with nodes between "
                            "those of the file; sets have the nodes between two of theirs",
                            plies->name, counted(count, "cell"), plies->thicknesses.size(),
                            count * static_cast<std::int64_t>(plies->thicknesses.size())));
    }

    MeshData& mesh_;
    const std::vector<const Plies*>& of_cell_;
    std::map<Ends, Edge> edges_;  // by the nodes at their ends
    std::unordered_set<std::int64_t> first_;
    std::vector<std::pair<const Plies*, std::int64_t>> cells_;  // and their number of cells
};

}  // namespace

void split_into_plies(MeshData& mesh, const std::vector<const Plies*>& of_cell) { PlySplitter(mesh, of_cell).split(); }

}  // namespace cli
