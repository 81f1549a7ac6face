// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/dual/parts.hpp"

#include <algorithm>

#include "base/numbers.hpp"
#include "base/team.hpp"
#include "body/assembly.hpp"
#include "body/rigid_modes.hpp"
#include "mesh/partition.hpp"
#include "scene/carriers.hpp"
#include "scene/pieces.hpp"

namespace delam {

namespace {

const HostPiece& piece_with(const HostStiffness& own, const std::vector<std::int64_t>& nodes) {
    return *std::find_if(own.pieces.begin(), own.pieces.end(), [&](const HostPiece& p) { return p.nodes == nodes; });
}

// The part of a matrix over the DOFs of `nodes` that belongs to some of them.
SparseMatrix restricted(const SparseMatrix& k, std::span<const std::int64_t> nodes, std::span<const std::int64_t> some,
                        std::int64_t dim) {
    std::vector<std::int64_t> place(index(k.rows), -1), rows;
    for (const std::int64_t node : some) {
        const std::int64_t i = std::lower_bound(nodes.begin(), nodes.end(), node) - nodes.begin();
        for (std::int64_t c = 0; c < dim; ++c) {
            place[index(i * dim + c)] = static_cast<std::int64_t>(rows.size());
            rows.push_back(i * dim + c);
        }
    }
    SparseMatrix part;
    part.rows = part.columns = static_cast<std::int64_t>(rows.size());
    for (const std::int64_t row : rows) {
        for (std::int64_t e = k.start[index(row)]; e < k.start[index(row) + 1]; ++e) {
            if (place[index(k.column[index(e)])] < 0) continue;  // a zero between pieces
            part.column.push_back(place[index(k.column[index(e)])]);
            part.value.push_back(k.value[index(e)]);
        }
        part.start.push_back(part.entries());
    }
    return part;
}

// Subdomains with their nodes, and the cells of each.
void cut(const Problem& problem, FetiParts& parts_of_scene) {
    const Mesh& mesh = *problem.mesh;
    std::vector<Subdomain>& subdomains = parts_of_scene.subdomains;
    std::vector<std::vector<std::int64_t>>& cells = parts_of_scene.cells;
    const std::vector<std::uint8_t> given = given_by_host(problem);
    std::int64_t whole = 0, cut_cells = 0;  // pieces of the host's, each a subdomain; cells of the other bodies
    for (const auto& own : problem.stiffness)
        whole += own != nullptr ? static_cast<std::int64_t>(own->pieces.size()) : 0;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) cut_cells += given[index(mesh.cell_body(c))] == 0 ? 1 : 0;
    const std::int64_t wanted = whole == 0 ? feti_subdomains(problem)
                                           : std::clamp<std::int64_t>(feti_subdomains(problem) - whole, 0, cut_cells);
    const Partition parts = partition(mesh, wanted, given);
    subdomains.resize(parts.subdomain_body.size());
    for (std::size_t s = 0; s < subdomains.size(); ++s) subdomains[s].body = parts.subdomain_body[s];
    cells.resize(subdomains.size());
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        if (parts.cell_subdomain[index(c)] < 0) continue;
        const std::size_t s = index(parts.cell_subdomain[index(c)]);
        cells[s].push_back(c);
        subdomains[s].nodes.insert(subdomains[s].nodes.end(), mesh.cell(c).begin(), mesh.cell(c).end());
    }
    for (Subdomain& s : subdomains) {
        std::sort(s.nodes.begin(), s.nodes.end());
        s.nodes.erase(std::unique(s.nodes.begin(), s.nodes.end()), s.nodes.end());
    }
    for (std::size_t b = 0; b < problem.stiffness.size(); ++b) {
        if (problem.stiffness[b] == nullptr) continue;
        for (const HostPiece& piece : problem.stiffness[b]->pieces) {
            Subdomain& own = subdomains.emplace_back();
            own.body = static_cast<std::int32_t>(b);
            own.nodes = piece.nodes;
            cells.emplace_back();
        }
    }
    if (const Carriers carriers(problem); !carriers.controls().empty()) {
        subdomains.emplace_back().nodes = carriers.controls();
        cells.emplace_back();
    }
}

// Stiffness and rigid motions of a subdomain of bodies, by one of the threads that share the subdomains.
void assemble(const Problem& problem, const std::vector<std::int64_t>& cells, Subdomain& subdomain, const Poll& poll) {
    if (const auto& own = problem.stiffness[index(subdomain.body)]; own == nullptr) {
        subdomain.stiffness =
            assemble_stiffness(*problem.mesh, cells, subdomain.nodes, problem.model(subdomain.body), 1, poll);
        subdomain.rigid = DenseMatrix(subdomain.stiffness.rows, problem.mesh->dimension() == 2 ? 3 : 6);
        const std::vector<double> modes = rigid_modes(*problem.mesh, subdomain.nodes);
        subdomain.rigid.value.assign(modes.begin(), modes.end());
    } else {
        const HostPiece& piece = piece_with(*own, subdomain.nodes);
        subdomain.stiffness =
            restricted(own->matrix, problem.mesh->body_nodes(subdomain.body), piece.nodes, problem.mesh->dimension());
        subdomain.rigid = piece.free;
    }
}

}  // namespace

// The dense boundary blocks pay as long as a subdomain stays small: about 20,000 DOFs in the plane, 4,000 in space.
std::int64_t feti_subdomains(const Problem& problem) {
    const std::int64_t bodies = problem.mesh->body_count();
    if (problem.options.subdomains > 0) return std::max<std::int64_t>(bodies, problem.options.subdomains);
    const std::int64_t dofs = problem.mesh->node_count() * problem.mesh->dimension();
    const std::int64_t size = problem.mesh->dimension() == 2 ? 20000 : 4000;
    return std::max<std::int64_t>(bodies, (dofs + size - 1) / size);
}

FetiParts make_parts(const Problem& problem, Monitor& monitor) {
    const auto parting = [&monitor] { monitor.progress("partition", 0, 0); };
    FetiParts result;
    parting();
    cut(problem, result);
    parting();
    std::vector<Subdomain>& subdomains = result.subdomains;
    DualRowBuilder builder(problem, subdomains, problem.options.gluing);
    parting();
    const auto touched = builder.touched(subdomains.size());
    const bool with_schur = problem.options.preconditioner == "dirichlet" || problem.options.preconditioner == "series";
    const auto parts = static_cast<std::int64_t>(subdomains.size());
    const Poll poll = monitor.poll_at("condense", parts, parts);
    const auto condense = [&](std::int64_t i) {
        const std::size_t s = index(i);
        Subdomain& subdomain = subdomains[s];
        if (subdomain.body < 0) {
            subdomain.hold_controls(
                builder.scale(static_cast<std::int32_t>(s),
                              static_cast<std::int64_t>(subdomain.nodes.size()) * problem.mesh->dimension()));
            return;
        }
        subdomain.boundary = touched[s];
        assemble(problem, result.cells[s], subdomain, poll);
        subdomain.condense(problem.mesh->body_label(subdomain.body), with_schur, poll);
    };
    Team(useful_threads(problem.options.threads)).run(parts, condense, [&](std::int64_t done) {
        monitor.progress("condense", done, parts);
    });
    call_if_set(poll);
    result.rows = builder.finish(subdomains);
    call_if_set(poll);
    result.copies = builder.copies();
    return result;
}

}  // namespace delam
