// SPDX-License-Identifier: BSD-3-Clause
#include "body/assembly.hpp"

#include <algorithm>
#include <array>
#include <deque>
#include <limits>
#include <optional>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "base/team.hpp"
#include "body/cell_elasticity.hpp"
#include "body/cell_strains.hpp"
#include "body/element.hpp"
#include "body/equal/cell_shape.hpp"
#include "body/equal/centre_gradients.hpp"
#include "body/equal/row_table.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"

namespace delam {

namespace {

// Coordinates of a cell's nodes, as many as its type has.
struct Coordinates {
    std::array<double, 3 * most_cell_nodes> x;
    std::size_t count = 0;
    std::span<const double> view() const { return std::span(x).first(count); }
};
Coordinates cell_coordinates(const Mesh& mesh, std::int64_t cell) {
    Coordinates c;
    for (const std::int64_t n : mesh.cell(cell))
        for (const double x : mesh.node(n)) c.x[c.count++] = x;
    return c;
}

// Positions in `nodes` of the nodes of all cells, cell after cell. Neighbouring cells tend to be neighbours in the list
// too, so the search begins after the position of the same corner of the previous cell.
struct LocalCells {
    std::vector<std::size_t> start{0};
    std::vector<std::int32_t> node;
};
LocalCells local_cells(const Mesh& mesh, std::span<const std::int64_t> cells, std::span<const std::int64_t> nodes) {
    LocalCells local;
    local.start.reserve(cells.size() + 1);
    if (!cells.empty()) local.node.reserve(cells.size() * mesh.cell(cells.front()).size());
    std::array<std::size_t, most_cell_nodes> hint{};
    for (const std::int64_t c : cells) {
        poll_cancel("assemble");
        const auto cell = mesh.cell(c);
        for (std::size_t a = 0; a < cell.size(); ++a) {
            std::size_t place = hint[a] + 1;
            if (place >= nodes.size() || nodes[place] != cell[a])
                place = index(std::lower_bound(nodes.begin(), nodes.end(), cell[a]) - nodes.begin());
            if (place == nodes.size() || nodes[place] != cell[a])
                fail(DELAM_ERROR_INTERNAL, "node ", cell[a], " of cell ", c,
                     " is not among the nodes to assemble over");
            local.node.push_back(static_cast<std::int32_t>(place));
            hint[a] = place;
        }
        local.start.push_back(local.node.size());
    }
    return local;
}

// The nodes that share a cell: compressed rows over the local nodes, each with its neighbours (including itself)
// ascending. Node b of a cell is neighbour number place[a*n + b] of node a; place starts at the cell's own offset.
struct NodeGraph {
    std::vector<std::size_t> start;
    std::vector<std::int32_t> neighbour;
    std::vector<std::size_t> cell_start;
    std::vector<std::int32_t> place;
};

// Rows are gathered in the order in which cells name their nodes. Transposing them (row i is added to each of its
// neighbours for i = 0, 1, ...) sorts them in ascending order, because the graph is symmetric.
NodeGraph node_graph(const LocalCells& cells, std::size_t nodes) {
    // The cells of each node, as positions in the list of their nodes.
    std::vector<std::size_t> begin(nodes + 1, 0);
    for (const std::int32_t i : cells.node) ++begin[index(i) + 1];
    for (std::size_t i = 0; i < nodes; ++i) begin[i + 1] += begin[i];
    struct Corner {
        std::int32_t cell, local;
    };
    std::vector<Corner> corner(cells.node.size());
    std::vector<std::size_t> next(begin.begin(), begin.end() - 1);
    NodeGraph graph;
    graph.cell_start.reserve(cells.start.size());
    std::size_t places = 0;
    for (std::size_t c = 0; c + 1 < cells.start.size(); ++c) {
        const std::size_t n = cells.start[c + 1] - cells.start[c];
        for (std::size_t a = 0; a < n; ++a)
            corner[next[index(cells.node[cells.start[c] + a])]++] = {static_cast<std::int32_t>(c),
                                                                     static_cast<std::int32_t>(a)};
        graph.cell_start.push_back(places);
        places += n * n;
    }
    graph.cell_start.push_back(places);

    std::vector<std::int32_t> met;  // the rows, unsorted
    std::vector<std::int32_t> mark(nodes, -1);
    graph.start.reserve(nodes + 1);
    graph.start.push_back(0);
    for (std::size_t i = 0; i < nodes; ++i) {
        poll_cancel("assemble");
        for (std::size_t e = begin[i]; e < begin[i + 1]; ++e) {
            const auto c = index(corner[e].cell);
            for (std::size_t k = cells.start[c]; k < cells.start[c + 1]; ++k) {
                const std::int32_t j = cells.node[k];
                if (mark[index(j)] == static_cast<std::int32_t>(i)) continue;
                mark[index(j)] = static_cast<std::int32_t>(i);
                met.push_back(j);
            }
        }
        graph.start.push_back(met.size());
    }
    graph.neighbour.resize(met.size());
    next.assign(graph.start.begin(), graph.start.end() - 1);
    for (std::size_t i = 0; i < nodes; ++i)
        for (std::size_t e = graph.start[i]; e < graph.start[i + 1]; ++e)
            graph.neighbour[next[index(met[e])]++] = static_cast<std::int32_t>(i);

    graph.place.resize(places);
    for (std::size_t i = 0; i < nodes; ++i) {
        poll_cancel("assemble");
        const std::size_t first = graph.start[i];
        for (std::size_t k = first; k < graph.start[i + 1]; ++k)
            mark[index(graph.neighbour[k])] = static_cast<std::int32_t>(k - first);
        for (std::size_t e = begin[i]; e < begin[i + 1]; ++e) {
            const auto c = index(corner[e].cell);
            const std::int32_t* node = &cells.node[cells.start[c]];
            const std::size_t n = cells.start[c + 1] - cells.start[c];
            std::int32_t* place = &graph.place[graph.cell_start[c] + index(corner[e].local) * n];
            for (std::size_t b = 0; b < n; ++b) place[b] = mark[index(node[b])];
        }
    }
    return graph;
}

// Nodes and cells are numbered by int32.
void require_countable(std::size_t nodes, std::size_t cells) {
    if (std::max(nodes, cells) > index(std::numeric_limits<std::int32_t>::max()))
        fail(DELAM_ERROR_ARGUMENT, nodes, " nodes, ", cells, " cells to assemble at once: at most 2^31 - 1");
}

// The pattern of the matrix: each entry of the graph is a block of dimension x dimension.
SparseMatrix empty_matrix(const NodeGraph& graph, std::size_t dim) {
    const std::size_t nodes = graph.start.size() - 1;
    SparseMatrix k;
    k.rows = k.columns = static_cast<std::int64_t>(nodes * dim);
    k.start.resize(nodes * dim + 1);
    const std::size_t entries = graph.neighbour.size() * dim * dim;
    make_room(k.column, entries);
    make_room(k.value, entries);
    k.column.resize(entries);
    k.value.assign(entries, 0.0);
    std::size_t entry = 0;
    k.start[0] = 0;
    for (std::size_t i = 0; i < nodes; ++i) {
        poll_cancel("assemble");
        for (std::size_t row = 0; row < dim; ++row) {
            for (std::size_t e = graph.start[i]; e < graph.start[i + 1]; ++e)
                for (std::size_t j = 0; j < dim; ++j)
                    k.column[entry++] = static_cast<std::int64_t>(index(graph.neighbour[e]) * dim + j);
            k.start[i * dim + row + 1] = static_cast<std::int64_t>(entry);
        }
    }
    return k;
}

// A thread computes the matrices of so many cells at a time, and of a batch of them before they are added.
constexpr std::size_t cells_at_a_time = 32, batch = 8 * cells_at_a_time;

// The matrix of a cell and the positions of its nodes and pairs of nodes.
struct Block {
    std::span<const std::int32_t> node;
    const std::int32_t* place;
    const double* matrix;
};

template <std::size_t dim>
void add(const Block& block, SparseMatrix& k) {
    const std::size_t n = block.node.size();
    for (std::size_t a = 0; a < n; ++a) {
        for (std::size_t i = 0; i < dim; ++i) {
            double* row = &k.value[index(k.start[index(block.node[a]) * dim + i])];
            const double* own = &block.matrix[(a * dim + i) * n * dim];
            for (std::size_t b = 0; b < n; ++b) {
                double* to = row + index(block.place[a * n + b]) * dim;
                for (std::size_t j = 0; j < dim; ++j) to[j] += own[b * dim + j];
            }
        }
    }
}

// The matrices of the cells of a batch. Cells that a translation takes onto each other have the same one, which is
// computed from coordinates that begin at their first node.
class BatchMatrices {
public:
    BatchMatrices(const Mesh& mesh, std::span<const std::int64_t> cells) : mesh_(mesh), cells_(cells) {}

    // Finds those of the cells first .. last - 1 of the list. model_of: a cell's.
    void find(std::size_t first, std::size_t last, const auto& model_of, Team& team, const Poll& poll) {
        matrix_.assign(last - first, nullptr);
        jobs_.clear();
        own_.clear();
        for (std::size_t c = first; c < last; ++c) {
            const BodyModel& model = model_of(cells_[c]);
            take_shape(cells_[c], model);
            const RowTable::Found found = known_.find(shape_.row());
            const bool is_known = found.number >= 0 && !found.added;
            std::vector<double>* matrix = is_known      ? &kept_[index(found.number)]
                                          : found.added ? &kept_.emplace_back()
                                                        : &own_.emplace_back();
            if (!is_known) {
                const std::size_t size = shape_.coordinates().size();
                matrix->resize(size * size);
                jobs_.push_back({cells_[c], &model, matrix});
            }
            matrix_[c - first] = matrix->data();
        }
        const auto compute = [this](std::int64_t piece) {
            const BodyModel* model = nullptr;
            std::optional<CellElasticity> elasticity;
            CellShape shape;
            const std::size_t begin = index(piece) * cells_at_a_time;
            for (std::size_t j = begin; j < std::min(begin + cells_at_a_time, jobs_.size()); ++j) {
                const Job& job = jobs_[j];
                if (job.model != model) elasticity.emplace(*(model = job.model), mesh_.dimension());
                shape.take(mesh_, job.cell);
                cell_stiffness(mesh_.cell_type(job.cell), shape.coordinates(), job.cell, model->formulation,
                               *elasticity, *job.matrix);
            }
        };
        team.run(static_cast<std::int64_t>((jobs_.size() + cells_at_a_time - 1) / cells_at_a_time), compute,
                 [&](std::int64_t) { call_if_set(poll); });
    }
    // Returns that of a cell of the batch, by its place there.
    const double* matrix(std::size_t c) const { return matrix_[c]; }

private:
    struct Job {
        std::int64_t cell;
        const BodyModel* model;
        std::vector<double>* matrix;
    };

    void take_shape(std::int64_t cell, const BodyModel& model) {
        if (&model != model_) {
            model_ = &model;
            elasticity_.emplace(model, mesh_.dimension());
        }
        shape_.take(mesh_, cell);
        shape_.add(static_cast<double>(model.formulation));
        shape_.add(elasticity_->matrix(cell));
        if (model.formulation != Formulation::mean_dilatation) return;
        const Dilatation dilatation = elasticity_->dilatation(cell);
        shape_.add(dilatation.stress);
        shape_.add(dilatation.bulk);
    }

    const Mesh& mesh_;
    std::span<const std::int64_t> cells_;
    const BodyModel* model_ = nullptr;
    std::optional<CellElasticity> elasticity_;  // of model_
    CellShape shape_;
    RowTable known_;
    std::deque<std::vector<double>> kept_, own_;  // by the numbers of known_; those of a batch that are not kept
    std::vector<const double*> matrix_;
    std::vector<Job> jobs_;
};

// The pattern follows from the graph of nodes before any number is known: element matrices are added directly at their
// positions, cell after cell, and no list of all their entries ever exists. Both triangles receive the same numbers in
// the same order, whatever the number of threads. model_of: a cell's.
SparseMatrix assemble(const Mesh& mesh, std::span<const std::int64_t> cells, std::span<const std::int64_t> nodes,
                      const auto& model_of, std::int64_t threads, const Poll& poll) {
    require_countable(nodes.size(), cells.size());
    const std::size_t dim = index(mesh.dimension());
    const LocalCells local = local_cells(mesh, cells, nodes);
    call_if_set(poll);
    const NodeGraph graph = node_graph(local, nodes.size());
    call_if_set(poll);
    SparseMatrix k = empty_matrix(graph, dim);

    Team team(std::min(useful_threads(threads), static_cast<std::int64_t>(cells.size() / batch + 1)));
    BatchMatrices matrices(mesh, cells);
    for (std::size_t first = 0; first < cells.size(); first += batch) {
        const std::size_t last = std::min(first + batch, cells.size());
        matrices.find(first, last, model_of, team, poll);
        for (std::size_t c = first; c < last; ++c) {
            const Block block{std::span(local.node).subspan(local.start[c], local.start[c + 1] - local.start[c]),
                              &graph.place[graph.cell_start[c]], matrices.matrix(c - first)};
            dim == 2 ? add<2>(block, k) : add<3>(block, k);
        }
    }
    return k;
}

}  // namespace

void cell_stiffness(CellType type, std::span<const double> coordinates, std::int64_t cell, Formulation formulation,
                    CellElasticity& elasticity, std::span<double> matrix) {
    const std::span<const double> own = elasticity.matrix(cell);
    if (formulation == Formulation::mean_dilatation)
        mean_dilatation_stiffness(type, coordinates, own, elasticity.dilatation(cell), matrix);
    else
        element_stiffness(type, coordinates, own, formulation, matrix);
}

SparseMatrix assemble_stiffness(const Mesh& mesh, std::span<const std::int64_t> cells,
                                std::span<const std::int64_t> nodes, std::span<const BodyModel> models,
                                std::int64_t threads, const Poll& poll) {
    const auto own = [&](std::int64_t cell) -> const BodyModel& { return models[index(mesh.cell_body(cell))]; };
    return assemble(mesh, cells, nodes, own, threads, poll);
}

SparseMatrix assemble_stiffness(const Mesh& mesh, std::span<const std::int64_t> cells,
                                std::span<const std::int64_t> nodes, const BodyModel& model, std::int64_t threads,
                                const Poll& poll) {
    return assemble(
        mesh, cells, nodes, [&](std::int64_t) -> const BodyModel& { return model; }, threads, poll);
}

std::int64_t stiffness_entries(const Mesh& mesh, std::span<const std::int64_t> cells,
                               std::span<const std::int64_t> nodes) {
    require_countable(nodes.size(), cells.size());
    const NodeGraph graph = node_graph(local_cells(mesh, cells, nodes), nodes.size());
    return static_cast<std::int64_t>(graph.neighbour.size()) * mesh.dimension() * mesh.dimension();
}

std::vector<double> centre_stress(const Mesh& mesh, std::span<const BodyModel> models,
                                  std::span<const double> displacement, std::span<const Strain> eigenstrain) {
    return centre_stress(mesh, models, displacement, CentreGradients(mesh).slopes(displacement), eigenstrain);
}

std::vector<double> centre_stress(const Mesh& mesh, std::span<const BodyModel> models,
                                  std::span<const double> displacement, std::span<const double> slopes,
                                  std::span<const Strain> eigenstrain) {
    const std::size_t dim = index(mesh.dimension());
    std::array<double, 3 * most_cell_nodes> own;
    const auto of_cell = [&](std::int64_t cell) {
        auto to = own.begin();
        for (const std::int64_t n : mesh.cell(cell))
            to = std::copy_n(displacement.begin() + n * mesh.dimension(), dim, to);
        return std::span<const double>(own.begin(), to);
    };
    return centre_stress(mesh, models, of_cell, slopes, eigenstrain);
}

// Without eigenstrains the in-plane rows suffice, and isotropic bodies have their zz from the others.
std::vector<double> centre_stress(const Mesh& mesh, std::span<const BodyModel> models,
                                  const DisplacementOfCell& displacement, std::span<const double> slopes,
                                  std::span<const Strain> eigenstrain) {
    const std::size_t dim = index(mesh.dimension());
    std::vector<CellElasticity> elasticity;
    for (const BodyModel& model : models) elasticity.emplace_back(model, mesh.dimension());

    std::vector<double> stress;
    stress.reserve(index(mesh.cell_count()) * (dim == 2 ? 4 : 6));
    const std::size_t count = dim == 2 ? 3 : 6;  // of strains
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        poll_cancel("recover");
        const double* slope = &slopes[index(c) * dim * dim];
        std::array<double, 6> strain = dim == 2 ? strain_of<2>(slope) : strain_of<3>(slope);
        const std::size_t body = index(mesh.cell_body(c));
        const BodyModel& model = models[body];
        const std::span<const double> matrix = elasticity[body].matrix(c);
        const bool projected = model.formulation == Formulation::mean_dilatation;
        if (!eigenstrain.empty() || projected) {
            const Axes* axes = elasticity[body].axes(c);
            Strain e = eigenstrain.empty() ? Strain{} : eigenstrain[body];
            if (axes != nullptr) e = rotated_strain(e, *axes);
            if (projected) {
                const double third =
                    dilatation_correction(mesh.cell_type(c), cell_coordinates(mesh, c).view(), displacement(c)) / 3.0;
                for (std::size_t i = 0; i < 3; ++i) e[i] -= third;
            }
            if (dim == 3) {
                for (std::size_t i = 0; i < 6; ++i) strain[i] -= e[i];
            } else {
                strain[0] -= e[0];
                strain[1] -= e[1];
                strain[2] -= e[3];
                if (model.plane == Plane::strain) {
                    const SpaceElasticity& space = elasticity[body].space(c);
                    const double all[] = {strain[0], strain[1], -e[2], strain[2], -e[4], -e[5]};
                    for (std::size_t i = 0; i < 4; ++i) {
                        double sum = 0.0;
                        for (std::size_t j = 0; j < 6; ++j) sum += space[i * 6 + j] * all[j];
                        stress.push_back(sum);
                    }
                    continue;
                }
            }
        }
        std::array<double, 6> s{};
        for (std::size_t i = 0; i < count; ++i)
            for (std::size_t j = 0; j < count; ++j) s[i] += matrix[i * count + j] * strain[j];
        if (dim == 3) {
            stress.insert(stress.end(), s.begin(), s.end());
            continue;
        }
        double zz = 0.0;
        if (model.plane == Plane::strain) {
            if (const auto* isotropic = std::get_if<Elastic>(&model.material)) {
                zz = isotropic->poisson * (s[0] + s[1]);
            } else {
                const SpaceElasticity& space = elasticity[body].space(c);
                zz = space[12] * strain[0] + space[13] * strain[1] + space[15] * strain[2];
            }
        }
        stress.insert(stress.end(), {s[0], s[1], zz, s[2]});
    }
    return stress;
}

}  // namespace delam
