// SPDX-License-Identifier: BSD-3-Clause
#include "scene/pieces.hpp"

#include <algorithm>

#include "base/cancel_scope.hpp"
#include "base/numbers.hpp"
#include "body/rigid_modes.hpp"
#include "mesh/partition.hpp"

namespace delam {

std::vector<std::uint8_t> given_by_host(const Problem& problem) {
    std::vector<std::uint8_t> given;
    for (const auto& own : problem.stiffness) given.push_back(own != nullptr ? 1 : 0);
    return given;
}

namespace {

Pieces find_pieces(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    const std::int64_t dim = mesh.dimension();
    const Partition parts = partition(mesh, 1, given_by_host(problem));
    Pieces pieces;
    pieces.body = parts.subdomain_body;
    pieces.nodes.resize(pieces.body.size());
    pieces.fixed.assign(pieces.body.size(), 0);
    pieces.of_node.assign(index(mesh.node_count()), -1);
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        poll_cancel("check");
        const std::int64_t piece = parts.cell_subdomain[index(c)];
        if (piece < 0) continue;
        for (const std::int64_t node : mesh.cell(c)) {
            auto& owner = pieces.of_node[index(node)];
            if (owner < 0) owner = piece;
            if (owner != piece) pieces.hinges.push_back({node, owner, piece});
            pieces.nodes[index(piece)].push_back(node);
        }
    }
    for (auto& nodes : pieces.nodes) {
        std::sort(nodes.begin(), nodes.end());
        nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
    }
    for (std::size_t b = 0; b < problem.stiffness.size(); ++b) {
        const auto body = static_cast<std::int32_t>(b);
        if (problem.stiffness[b] == nullptr && problem.engine != nullptr && mesh.host_body(body)) {
            const std::vector<std::int64_t> nodes = mesh.body_nodes(body);
            for (const std::int64_t node : nodes)
                pieces.of_node[index(node)] = static_cast<std::int64_t>(pieces.count());
            pieces.fixed.push_back(0);
            pieces.nodes.push_back(nodes);
            pieces.body.push_back(body);
        }
        if (problem.stiffness[b] == nullptr) continue;
        for (const HostPiece& own : problem.stiffness[b]->pieces) {
            for (const std::int64_t node : own.nodes)
                pieces.of_node[index(node)] = static_cast<std::int64_t>(pieces.count());
            pieces.fixed.push_back(own.fixed() ? 1 : 0);
            for (std::int64_t c = 0; c < own.held.columns; ++c) {
                Pieces::Row row;
                for (std::int64_t i = 0; i < own.held.rows; ++i)
                    row.emplace_back(own.nodes[index(i / dim)] * dim + i % dim, own.held(i, c));
                pieces.resisted.push_back(std::move(row));
            }
            pieces.nodes.push_back(own.nodes);
            pieces.body.push_back(static_cast<std::int32_t>(b));
        }
    }
    return pieces;
}

// Part of the displacements that remains of a motion without strain: rounding of the modes, which are orthonormal.
// (Measured by verify/bench/constants.py on 250 random scenes: from a hundredth to a hundred times all decide alike.)
constexpr double rigid = 1e-8;

// Largest displacement after subtracting each piece's own rigid motion.
double strained(const Problem& problem, std::span<const double> displacement) {
    const Mesh& mesh = *problem.mesh;
    const auto dim = index(mesh.dimension());
    double most = 0.0;
    for (const std::vector<std::int64_t>& nodes : rigid_pieces(problem).nodes) {
        std::vector<double> own;
        for (const std::int64_t node : nodes)
            for (std::size_t k = 0; k < dim; ++k) own.push_back(displacement[index(node) * dim + k]);
        const std::vector<double> modes = rigid_modes(mesh, nodes);
        for (std::size_t first = 0; first < modes.size(); first += own.size()) {
            double share = 0.0;
            for (std::size_t i = 0; i < own.size(); ++i) share += modes[first + i] * own[i];
            for (std::size_t i = 0; i < own.size(); ++i) own[i] -= share * modes[first + i];
        }
        most = std::max(most, max_abs(own));
    }
    return most;
}

}  // namespace

struct KnownPieces {
    std::shared_ptr<const Mesh> mesh;
    std::vector<std::shared_ptr<const HostStiffness>> stiffness;
    bool engine;
    Pieces pieces;
};

const Pieces& rigid_pieces(const Problem& problem) {
    const KnownPieces* known = problem.known_pieces.get();
    const bool engine = problem.engine != nullptr;
    if (known == nullptr || known->mesh != problem.mesh || known->stiffness != problem.stiffness ||
        known->engine != engine)
        problem.known_pieces = std::make_shared<const KnownPieces>(
            KnownPieces{problem.mesh, problem.stiffness, engine, find_pieces(problem)});
    return problem.known_pieces->pieces;
}

bool without_strain(const Problem& problem, std::span<const double> displacement, double least) {
    return strained(problem, displacement) <= std::max(rigid * max_abs(displacement), least);
}

}  // namespace delam
