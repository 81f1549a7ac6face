// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/quadratic_cells.hpp"

#include <algorithm>
#include <stdexcept>
#include <unordered_map>

#include "delam/delam.h"
#include "mesh/cell_jacobian.hpp"
#include "mesh/cell_shape.hpp"
#include "mesh/periodic_mesh.hpp"

namespace cli {

namespace {

constexpr double least_jacobian = 0.2;  // relative to the cell with straight sides

// Fractions of the way from the straight midpoint to the interface, tried in turn.
constexpr std::array<double, 4> parts{1.0, 0.5, 0.25, 0.0};

struct Edge {
    std::vector<std::int32_t> bodies;  // of the cells around it
    std::size_t part = parts.size() - 1;
};

const CellShape& quadratic_of(std::int32_t linear) {
    switch (linear) {
        case DELAM_TRI3:
            return shape_of(DELAM_TRI6);
        case DELAM_QUAD4:
            return shape_of(DELAM_QUAD8);
        case DELAM_TET4:
            return shape_of(DELAM_TET10);
        default:
            throw std::logic_error("only tri3, quad4 and tet4 are made quadratic");
    }
}

class Elevation {
public:
    explicit Elevation(MeshData& mesh)
        : mesh_(mesh), dimension_(static_cast<std::size_t>(mesh.dimension)), first_(count()) {}

    std::int64_t run(const Bend& bend) {
        for (CellBlock& block : mesh_.blocks) add_middles(block);
        straight_.assign(
            mesh_.nodes.begin() + static_cast<std::ptrdiff_t>(first_) * static_cast<std::ptrdiff_t>(dimension_),
            mesh_.nodes.end());
        for (std::size_t e = 0; e < edges_.size(); ++e) {
            Edge& edge = edges_[e];
            if (edge.bodies.size() < 2) continue;
            edge.part = 0;
            bend(edge.bodies, mesh_.nodes.data() + (static_cast<std::size_t>(first_) + e) * dimension_);
        }
        bent_.assign(
            mesh_.nodes.begin() + static_cast<std::ptrdiff_t>(first_) * static_cast<std::ptrdiff_t>(dimension_),
            mesh_.nodes.end());
        straighten();
        extend_sets();
        return std::count_if(edges_.begin(), edges_.end(),
                             [](const Edge& e) { return e.bodies.size() > 1 && e.part > 0; });
    }

private:
    [[nodiscard]] std::int64_t count() const { return static_cast<std::int64_t>(mesh_.nodes.size() / dimension_); }

    static std::uint64_t key(std::int64_t a, std::int64_t b) {
        return (static_cast<std::uint64_t>(std::min(a, b)) << 32U) | static_cast<std::uint64_t>(std::max(a, b));
    }

    std::int64_t middle(std::int64_t a, std::int64_t b) {
        const auto [at, added] = number_.emplace(key(a, b), count());
        if (added) {
            edges_.emplace_back();
            for (std::size_t k = 0; k < dimension_; ++k)
                mesh_.nodes.push_back(0.5 * (mesh_.nodes[static_cast<std::size_t>(a) * dimension_ + k] +
                                             mesh_.nodes[static_cast<std::size_t>(b) * dimension_ + k]));
        }
        return at->second;
    }

    [[nodiscard]] std::size_t edge_of(std::int64_t node) const { return static_cast<std::size_t>(node - first_); }

    void add_middles(CellBlock& block) {
        const std::size_t corners = shape_of(block.type).nodes;
        const CellShape& to = quadratic_of(block.type);
        std::vector<std::int64_t> connectivity;
        for (std::size_t c = 0; c < block.bodies.size(); ++c) {
            const std::int64_t* cell = block.connectivity.data() + c * corners;
            connectivity.insert(connectivity.end(), cell, cell + corners);
            for (const auto& [a, b] : to.middles) {
                const std::int64_t node = middle(cell[a], cell[b]);
                connectivity.push_back(node);
                std::vector<std::int32_t>& bodies = edges_[edge_of(node)].bodies;
                const auto at = std::lower_bound(bodies.begin(), bodies.end(), block.bodies[c]);
                if (at == bodies.end() || *at != block.bodies[c]) bodies.insert(at, block.bodies[c]);
            }
        }
        block.type = to.type;
        block.connectivity = std::move(connectivity);
    }

    // Every cell with straight sides only is as good as the linear one was, so this terminates.
    void straighten() {
        PointTable places(1e-9 * extent());
        for (std::size_t e = 0; e < edges_.size(); ++e)
            if (bent(e)) places.add(straight_place(e), static_cast<std::int64_t>(e));
        for (bool again = true; again;) {
            again = false;
            for (const CellBlock& block : mesh_.blocks) {
                const std::size_t per_cell = shape_of(block.type).nodes;
                const std::size_t corners = shape_of(block.type).corners;
                for (std::size_t c = 0; c < block.bodies.size(); ++c) {
                    const std::int64_t* cell = block.connectivity.data() + c * per_cell;
                    const bool any_bent =
                        std::any_of(cell + corners, cell + per_cell, [&](std::int64_t n) { return bent(edge_of(n)); });
                    if (!any_bent || sound(block.type, cell)) continue;
                    again = true;
                    for (std::size_t k = corners; k < per_cell; ++k)
                        if (const std::size_t e = edge_of(cell[k]); bent(e)) bend_less(e, edges_[e].part + 1, places);
                }
            }
        }
    }

    [[nodiscard]] bool bent(std::size_t edge) const { return edges_[edge].part + 1 < parts.size(); }

    [[nodiscard]] double extent() const {
        double largest = 0;
        for (const double x : mesh_.nodes) largest = std::max(largest, std::abs(x));
        return largest;
    }

    [[nodiscard]] std::array<double, 3> straight_place(std::size_t edge) const {
        std::array<double, 3> at{};
        std::copy_n(straight_.begin() + static_cast<std::ptrdiff_t>(edge * dimension_), dimension_, at.begin());
        return at;
    }

    // Together with the edge's periodic images; those around the corner of the cell are reached through two periods.
    // other.
    void bend_less(std::size_t e, std::size_t part, const PointTable& places) {
        if (edges_[e].part >= part) return;
        edges_[e].part = part;
        const std::size_t node = static_cast<std::size_t>(first_) + e;
        for (std::size_t k = 0; k < dimension_; ++k) {
            const double straight = straight_[e * dimension_ + k];
            mesh_.nodes[node * dimension_ + k] = straight + parts[part] * (bent_[e * dimension_ + k] - straight);
        }
        for (const auto& period : mesh_.periods)
            for (const double sign : {1.0, -1.0}) {
                std::array<double, 3> at = straight_place(e);
                for (std::size_t k = 0; k < dimension_; ++k) at[k] += sign * period[k];
                if (const auto image = places.find(at)) bend_less(static_cast<std::size_t>(*image), part, places);
            }
    }

    [[nodiscard]] bool sound(std::int32_t type, const std::int64_t* cell) const {
        const std::size_t nodes = shape_of(type).nodes;
        std::array<double, 30> bent{};
        std::array<double, 30> straight{};
        for (std::size_t i = 0; i < nodes; ++i)
            for (std::size_t k = 0; k < dimension_; ++k) {
                const auto n = static_cast<std::size_t>(cell[i]);
                bent[i * dimension_ + k] = mesh_.nodes[n * dimension_ + k];
                straight[i * dimension_ + k] =
                    cell[i] >= first_ ? straight_[edge_of(cell[i]) * dimension_ + k] : mesh_.nodes[n * dimension_ + k];
            }
        return smallest_jacobian(type, bent.data()) >= least_jacobian * smallest_jacobian(type, straight.data());
    }

    void extend_sets() {
        for (auto& [name, faces] : mesh_.face_sets) {
            auto& nodes = mesh_.node_sets[name];
            for (auto& face : faces) {
                const auto corners = static_cast<std::size_t>(std::find(face.begin(), face.end(), -1) - face.begin());
                const std::size_t sides = corners == 2 ? 1 : corners;
                for (std::size_t i = 0; i < sides; ++i) {
                    const auto at = number_.find(key(face[i], face[(i + 1) % corners]));
                    if (at == number_.end()) throw std::logic_error("a face of a set that no cell has");
                    face[corners + i] = at->second;
                    nodes.push_back(at->second);
                }
            }
            std::sort(nodes.begin(), nodes.end());
            nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
        }
    }

    MeshData& mesh_;
    std::size_t dimension_;
    std::int64_t first_;  // middle node
    std::unordered_map<std::uint64_t, std::int64_t> number_;
    std::vector<Edge> edges_;       // by middle node
    std::vector<double> straight_;  // places of middle nodes halfway
    std::vector<double> bent_;      // and on the interface
};

}  // namespace

std::int64_t make_quadratic(MeshData& mesh, const Bend& bend) { return Elevation(mesh).run(bend); }

}  // namespace cli
