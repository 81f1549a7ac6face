// SPDX-License-Identifier: BSD-3-Clause
#include "body/assembly.hpp"

#include <algorithm>
#include <array>

#include "base/error.hpp"
#include "body/element.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"

namespace delam {

namespace {

std::vector<double> cell_coordinates(const Mesh& mesh, std::int64_t cell) {
    std::vector<double> x;
    x.reserve(3 * most_cell_nodes);
    for (const std::int64_t n : mesh.cell(cell)) x.insert(x.end(), mesh.node(n).begin(), mesh.node(n).end());
    return x;
}

// Which nodes share a cell: compressed rows over the local nodes, each with its neighbours (itself included) ascending.
struct NodeGraph {
    std::vector<std::int64_t> start;
    std::vector<std::int64_t> neighbour;
};

NodeGraph node_graph(std::span<const std::vector<std::int64_t>> cells, std::size_t nodes) {
    std::vector<std::int64_t> begin(nodes + 1, 0);
    for (const auto& cell : cells)
        for (const std::int64_t i : cell) ++begin[at(i) + 1];
    for (std::size_t i = 0; i < nodes; ++i) begin[i + 1] += begin[i];
    std::vector<std::size_t> cell_of(at(begin.back()));
    std::vector<std::int64_t> next(begin.begin(), begin.end() - 1);
    for (std::size_t c = 0; c < cells.size(); ++c)
        for (const std::int64_t i : cells[c]) cell_of[at(next[at(i)]++)] = c;

    NodeGraph graph{{0}, {}};
    std::vector<std::size_t> seen(nodes, nodes);  // the row that met a node last
    for (std::size_t i = 0; i < nodes; ++i) {
        const auto first = static_cast<std::ptrdiff_t>(graph.neighbour.size());
        for (std::size_t e = at(begin[i]); e < at(begin[i + 1]); ++e) {
            for (const std::int64_t j : cells[cell_of[e]]) {
                if (seen[at(j)] == i) continue;
                seen[at(j)] = i;
                graph.neighbour.push_back(j);
            }
        }
        std::sort(graph.neighbour.begin() + first, graph.neighbour.end());
        graph.start.push_back(static_cast<std::int64_t>(graph.neighbour.size()));
    }
    return graph;
}

}  // namespace

// The pattern is known from the graph of nodes before any number is: element matrices are added straight into their
// places, cell after cell, and no list of all their entries ever exists. Both triangles receive the same numbers in
// the same order.
SparseMatrix assemble_stiffness(const Mesh& mesh, std::span<const std::int64_t> cells,
                                std::span<const std::int64_t> nodes, const Elastic& material, Plane plane) {
    const std::size_t dim = at(mesh.dimension());
    std::vector<std::vector<std::int64_t>> local(cells.size());
    for (std::size_t c = 0; c < cells.size(); ++c) {
        for (const std::int64_t n : mesh.cell(cells[c])) {
            const auto place = std::lower_bound(nodes.begin(), nodes.end(), n);
            if (place == nodes.end() || *place != n)
                fail(DELAM_ERROR_INTERNAL, "node ", n, " of cell ", cells[c],
                     " is not among the nodes to assemble over");
            local[c].push_back(place - nodes.begin());
        }
    }
    const NodeGraph graph = node_graph(local, nodes.size());

    SparseMatrix k;
    k.rows = k.columns = static_cast<std::int64_t>(nodes.size() * dim);
    k.start.reserve(nodes.size() * dim + 1);
    k.column.reserve(graph.neighbour.size() * dim * dim);
    for (std::size_t i = 0; i < nodes.size(); ++i) {
        for (std::size_t row = 0; row < dim; ++row) {
            for (std::size_t e = at(graph.start[i]); e < at(graph.start[i + 1]); ++e)
                for (std::size_t j = 0; j < dim; ++j)
                    k.column.push_back(graph.neighbour[e] * mesh.dimension() + static_cast<std::int64_t>(j));
            k.start.push_back(static_cast<std::int64_t>(k.column.size()));
        }
    }
    k.value.assign(k.column.size(), 0.0);

    const std::vector<double> elasticity = elasticity_matrix(material, mesh.dimension(), plane);
    std::array<double, 9 * most_cell_nodes * most_cell_nodes> matrix;
    for (std::size_t c = 0; c < cells.size(); ++c) {
        element_stiffness(mesh.cell_type(cells[c]), cell_coordinates(mesh, cells[c]), elasticity, matrix);
        const std::size_t size = local[c].size() * dim;
        for (std::size_t a = 0; a < local[c].size(); ++a) {
            const std::size_t node = at(local[c][a]);
            const auto first = graph.neighbour.begin() + graph.start[node];
            const auto last = graph.neighbour.begin() + graph.start[node + 1];
            for (std::size_t b = 0; b < local[c].size(); ++b) {
                const std::size_t offset = at(std::lower_bound(first, last, local[c][b]) - first) * dim;
                for (std::size_t i = 0; i < dim; ++i) {
                    const std::size_t place = at(k.start[node * dim + i]) + offset;
                    for (std::size_t j = 0; j < dim; ++j)
                        k.value[place + j] += matrix[(a * dim + i) * size + b * dim + j];
                }
            }
        }
    }
    return k;
}

std::vector<double> centre_stress(const Mesh& mesh, std::span<const Elastic> materials, Plane plane,
                                  std::span<const double> displacement) {
    const std::size_t dim = at(mesh.dimension());
    std::vector<std::vector<double>> elasticity;
    for (const Elastic& material : materials)
        elasticity.push_back(elasticity_matrix(material, mesh.dimension(), plane));

    std::vector<double> stress;
    stress.reserve(at(mesh.cell_count()) * (dim == 2 ? 4 : 6));
    std::vector<double> u;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        u.clear();
        for (const std::int64_t n : mesh.cell(c))
            for (std::size_t i = 0; i < dim; ++i) u.push_back(displacement[at(n) * dim + i]);
        const std::vector<double> strain = centre_strain(mesh.cell_type(c), cell_coordinates(mesh, c), u);
        const std::size_t body = at(mesh.cell_body(c));
        const std::vector<double>& matrix = elasticity[body];
        std::array<double, 6> s{};
        for (std::size_t i = 0; i < strain.size(); ++i)
            for (std::size_t j = 0; j < strain.size(); ++j) s[i] += matrix[i * strain.size() + j] * strain[j];
        if (dim == 3) {
            stress.insert(stress.end(), s.begin(), s.end());
        } else {
            const double zz = plane == Plane::strain ? materials[body].poisson * (s[0] + s[1]) : 0.0;
            stress.insert(stress.end(), {s[0], s[1], zz, s[2]});
        }
    }
    return stress;
}

}  // namespace delam
