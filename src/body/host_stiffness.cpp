// SPDX-License-Identifier: BSD-3-Clause
#include "body/host_stiffness.hpp"

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/rigid_modes.hpp"
#include "delam/delam.h"
#include "linalg/sparse/cholesky.hpp"

namespace delam {

namespace {

// Energy of a rigid motion relative to that of the diagonal alone: rounding below the first number, a support above the
// second.
constexpr double free_motion = 1e-12, resisted = 1e-9;
// Tolerances of a declared motion: its distance from a rigid one, and the force that it needs.
constexpr double told_tolerance = 1e-6;
// Smaller ratios of pivots are rounding.
constexpr double mechanism = 1e-14;

// Connected components of nodes joined by non-zero entries, each ascending.
std::vector<std::vector<std::int64_t>> components(const SparseMatrix& k, std::int64_t dim) {
    const std::int64_t nodes = k.rows / dim;
    std::vector<std::int64_t> of(index(nodes), -1), open;
    std::vector<std::vector<std::int64_t>> found;
    for (std::int64_t first = 0; first < nodes; ++first) {
        if (of[index(first)] >= 0) continue;
        const auto name = static_cast<std::int64_t>(found.size());
        found.emplace_back();
        open.assign(1, first);
        of[index(first)] = name;
        while (!open.empty()) {
            const std::int64_t node = open.back();
            open.pop_back();
            found.back().push_back(node);
            for (std::int64_t e = k.start[index(node * dim)]; e < k.start[index((node + 1) * dim)]; ++e) {
                const std::int64_t other = k.column[index(e)] / dim;
                if (k.value[index(e)] == 0.0 || of[index(other)] >= 0) continue;
                of[index(other)] = name;
                open.push_back(other);
            }
        }
        std::sort(found.back().begin(), found.back().end());
    }
    return found;
}

double diagonal(const SparseMatrix& k, std::int64_t row) {
    const auto begin = k.column.begin() + k.start[index(row)], end = k.column.begin() + k.start[index(row) + 1];
    const auto found = std::lower_bound(begin, end, row);
    return found != end && *found == row ? k.value[index(found - k.column.begin())] : 0.0;
}

// K Q of some nodes' DOFs; entries to other nodes are zero.
DenseMatrix forces(const SparseMatrix& k, std::span<const std::int64_t> nodes, std::int64_t dim,
                   const DenseMatrix& motions) {
    std::vector<double> u(index(k.rows), 0.0);
    DenseMatrix f(motions.rows, motions.columns);
    for (std::int64_t c = 0; c < motions.columns; ++c) {
        for (std::int64_t i = 0; i < motions.rows; ++i) u[index(nodes[index(i / dim)] * dim + i % dim)] = motions(i, c);
        for (std::int64_t i = 0; i < motions.rows; ++i) {
            const std::int64_t row = nodes[index(i / dim)] * dim + i % dim;
            double sum = 0.0;
            for (std::int64_t e = k.start[index(row)]; e < k.start[index(row) + 1]; ++e)
                sum += k.value[index(e)] * u[index(k.column[index(e)])];
            f(i, c) = sum;
        }
    }
    return f;
}

DenseMatrix some_columns(const DenseMatrix& q, const DenseMatrix& combination, std::int64_t first, std::int64_t last) {
    DenseMatrix part(combination.rows, last - first);
    std::copy(combination.value.begin() + combination.rows * first, combination.value.begin() + combination.rows * last,
              part.value.begin());
    return multiply(q, part);
}

// D Q for the DOFs of some nodes, D the diagonal of K: the forces if everything else were fixed.
DenseMatrix diagonal_forces(const SparseMatrix& k, std::span<const std::int64_t> nodes, std::int64_t dim,
                            const DenseMatrix& motions) {
    DenseMatrix f = motions;
    for (std::int64_t i = 0; i < f.rows; ++i) {
        const double d = diagonal(k, nodes[index(i / dim)] * dim + i % dim);
        for (std::int64_t c = 0; c < f.columns; ++c) f(i, c) *= d;
    }
    return f;
}

// Pieces without a free motion need not be distinguished: the host may have disconnected many nodes to support them.
void unite_held_pieces(HostStiffness& own, std::int64_t dim) {
    HostPiece united;
    std::vector<HostPiece> pieces;
    for (HostPiece& piece : own.pieces) {
        if (piece.free.columns > 0)
            pieces.push_back(std::move(piece));
        else
            united.nodes.insert(united.nodes.end(), piece.nodes.begin(), piece.nodes.end());
    }
    if (!united.nodes.empty()) {
        std::sort(united.nodes.begin(), united.nodes.end());
        united.free = DenseMatrix(dim * static_cast<std::int64_t>(united.nodes.size()), 0);
        pieces.push_back(std::move(united));
    }
    own.pieces = std::move(pieces);
}

// With as many DOFs fixed as there are free motions, a solid has no motion without energy left. The check scales the
// matrix to a unit diagonal, because a row that is soft relative to another one proves nothing (rows that the host has
// emptied may have any diagonal).
void refuse_mechanisms(const Mesh& mesh, std::int32_t body, const HostStiffness& own, Monitor& monitor) {
    const std::int64_t dim = mesh.dimension();
    const std::vector<std::int64_t> nodes = mesh.body_nodes(body);
    std::vector<std::int64_t> place(index(own.matrix.rows), 0), kept;
    for (const HostPiece& piece : own.pieces) {
        if (piece.fixed()) continue;
        DenseMatrix rows(piece.free.columns, piece.free.rows);
        for (std::int64_t i = 0; i < piece.free.rows; ++i)
            for (std::int64_t c = 0; c < piece.free.columns; ++c) rows(c, i) = piece.free(i, c);
        const PivotedColumns pivots = pivoted_columns(std::move(rows), 1e-12);
        for (std::int64_t c = 0; c < piece.free.columns; ++c) {
            const std::int64_t dof = pivots.order[index(c)];
            const auto local =
                std::lower_bound(nodes.begin(), nodes.end(), piece.nodes[index(dof / dim)]) - nodes.begin();
            place[index(local * dim + dof % dim)] = -1;
        }
    }
    std::vector<double> scale;
    for (std::int64_t r = 0; r < own.matrix.rows; ++r) {
        if (place[index(r)] < 0) continue;
        place[index(r)] = static_cast<std::int64_t>(kept.size());
        kept.push_back(r);
        scale.push_back(1.0 / std::sqrt(diagonal(own.matrix, r)));
    }
    SparseMatrix held;
    held.rows = held.columns = static_cast<std::int64_t>(kept.size());
    for (const std::int64_t r : kept) {
        for (std::int64_t e = own.matrix.start[index(r)]; e < own.matrix.start[index(r) + 1]; ++e) {
            const std::int64_t column = place[index(own.matrix.column[index(e)])];
            if (column < 0) continue;
            held.column.push_back(column);
            held.value.push_back(scale[index(place[index(r)])] * own.matrix.value[index(e)] * scale[index(column)]);
        }
        held.start.push_back(held.entries());
    }
    monitor.progress("analyse", 0, 0);
    SparseCholesky factor(held);
    monitor.progress("factor", 0, 0);
    factor.factorise(held);
    monitor.progress("factor", 1, 1);
    const SparseCholesky::Pivot pivot = factor.smallest_pivot();
    if (pivot.variable < 0 || pivot.ratio > mechanism) return;
    const std::int64_t dof = kept[index(pivot.variable)];
    fail(DELAM_ERROR_ARGUMENT, "body ", mesh.body_label(body),
         ": with its rigid motions held its stiffness is not positive definite (pivot ratio ", pivot.ratio,
         ", allowed > ", mechanism, ") at node ", nodes[index(dof / dim)], ", component ", dof % dim,
         ": a mechanism, or an indefinite matrix");
}

// The matrix used to judge rigid motions. In a free solid no diagonal entry exceeds the sum of the others in its row.
// Any excess is a support of the host (a penalty, a number on an emptied row), whose size does not matter; if it were
// 1e25, everything else would be rounding in comparison.
SparseMatrix with_tame_supports(SparseMatrix k, std::int64_t dim) {
    const auto entry = [&](std::int64_t row) -> double& {
        const auto begin = k.column.begin() + k.start[index(row)], end = k.column.begin() + k.start[index(row) + 1];
        return k.value[index(std::lower_bound(begin, end, row) - k.column.begin())];
    };
    std::vector<double> others(index(k.rows), 0.0);
    for (std::int64_t row = 0; row < k.rows; ++row)
        for (std::int64_t e = k.start[index(row)]; e < k.start[index(row) + 1]; ++e)
            if (k.column[index(e)] != row) others[index(row)] += std::abs(k.value[index(e)]);
    for (std::int64_t row = 0; row < k.rows; ++row)
        if (others[index(row)] > 0.0) entry(row) = std::min(entry(row), 2.0 * others[index(row)]);
    for (std::int64_t row = 0; row < k.rows; ++row) {
        double beside = 0.0;  // of the same node
        for (std::int64_t c = row / dim * dim; c < (row / dim + 1) * dim && others[index(row)] == 0.0; ++c)
            if (others[index(c)] > 0.0) beside = std::max(beside, entry(c));
        if (beside > 0.0) entry(row) = std::min(entry(row), beside);
    }
    return k;
}

// The rigid motions of a piece in another basis: the free ones, then the held ones orthogonal to them.
struct Split {
    DenseMatrix combination;  // [rigid motions][rigid motions], of the orthonormal columns of q
    std::int64_t free_count = 0;
};

// Splits by vectors that span the free motions; vectors shorter than told_tolerance times the others span nothing.
Split split_by(const DenseMatrix& free) {
    DenseMatrix span(free.rows, free.rows);  // negative definite on their span, so that its eigenvectors come first
    for (std::int64_t c = 0; c < free.columns; ++c) {
        double square = 0.0;
        for (std::int64_t i = 0; i < free.rows; ++i) square += free(i, c) * free(i, c);
        if (square == 0.0) continue;
        for (std::int64_t i = 0; i < free.rows; ++i)
            for (std::int64_t j = 0; j < free.rows; ++j) span(i, j) -= free(i, c) * free(j, c) / square;
    }
    Eigen eigen = eigen_symmetric(std::move(span));
    Split split;
    while (split.free_count < free.rows && eigen.value[index(split.free_count)] < -told_tolerance) ++split.free_count;
    split.combination = std::move(eigen.vector);
    return split;
}

// Splits by the energy of the motions relative to that of the diagonal alone: x.A x / x.B x, A = Q^T K Q, B = Q^T D Q =
// L L^T.
Split found_split(const SparseMatrix& k, std::span<const std::int64_t> local, std::int64_t dim, const DenseMatrix& q,
                  const std::string& where) {
    DenseMatrix energy = multiply_transposed(q, forces(k, local, dim, q)),
                lower = multiply_transposed(q, diagonal_forces(k, local, dim, q));
    if (!factor_definite(lower))
        fail(DELAM_ERROR_ARGUMENT, where, ": diagonal entries differ by a factor of more than 1e16");
    for (int side = 0; side < 2; ++side) {  // L^-1 A, then L^-1 of its transpose
        solve_lower(lower, energy);
        for (std::int64_t i = 0; i < q.columns; ++i)
            for (std::int64_t j = 0; j < i; ++j) std::swap(energy(i, j), energy(j, i));
    }
    for (std::int64_t i = 0; i < q.columns; ++i)
        for (std::int64_t j = 0; j < i; ++j) energy(i, j) = energy(j, i) = 0.5 * (energy(i, j) + energy(j, i));
    const Eigen eigen = eigen_symmetric(std::move(energy));
    DenseMatrix free(q.columns, 0);
    for (std::int64_t e = 0; e < q.columns; ++e) {
        const double ratio = eigen.value[index(e)];
        if (ratio < -resisted)
            fail(DELAM_ERROR_ARGUMENT, where, ": a rigid motion has a negative energy, ", ratio,
                 " times that of the diagonal alone: the matrix is indefinite");
        if (std::abs(ratio) > free_motion) {
            if (ratio >= resisted) continue;
            fail(DELAM_ERROR_ARGUMENT, where, ": the energy of a rigid motion is ", ratio,
                 " times that of the diagonal alone, neither <= ", free_motion, " (free) nor >= ", resisted,
                 " (held): give the kernel");
        }
        std::vector<double> x(eigen.vector.value.begin() + e * q.columns,
                              eigen.vector.value.begin() + (e + 1) * q.columns);
        solve_lower_transposed(lower, x);
        free.value.insert(free.value.end(), x.begin(), x.end());
        ++free.columns;
    }
    return split_by(free);
}

// Splits by the motions that the host declares, as far as they move the piece.
Split told_split(const SparseMatrix& k, std::span<const std::int64_t> local, std::int64_t dim, const DenseMatrix& q,
                 const DenseMatrix& told, const std::string& where) {
    DenseMatrix own(q.rows, told.columns);
    for (std::int64_t c = 0; c < own.columns; ++c) {
        double largest_part = 0.0;  // a declared motion may have any size
        for (std::int64_t i = 0; i < own.rows; ++i) {
            own(i, c) = told(local[index(i / dim)] * dim + i % dim, c);
            largest_part = std::max(largest_part, std::abs(own(i, c)));
        }
        for (std::int64_t i = 0; i < own.rows && largest_part > 0.0; ++i) own(i, c) /= largest_part;
    }
    const DenseMatrix share = multiply_transposed(q, own), back = multiply(q, share);
    const DenseMatrix needed = forces(k, local, dim, own), held = diagonal_forces(k, local, dim, own);
    for (std::int64_t c = 0; c < own.columns; ++c) {
        double length = 0.0, off = 0.0, pull = 0.0, most = 0.0;
        for (std::int64_t i = 0; i < own.rows; ++i) {
            length += own(i, c) * own(i, c);
            off += (own(i, c) - back(i, c)) * (own(i, c) - back(i, c));
            pull += needed(i, c) * needed(i, c);
            most += held(i, c) * held(i, c);
        }
        if (std::sqrt(off) > told_tolerance * std::sqrt(length))
            fail(DELAM_ERROR_ARGUMENT, "kernel[", c, "] is not a rigid motion of ", where, ": it deviates by ",
                 std::sqrt(off / length), " of its norm, allowed: up to ", told_tolerance);
        if (std::sqrt(pull) > told_tolerance * std::sqrt(most))
            fail(DELAM_ERROR_ARGUMENT, "kernel[", c, "] is not free: moving ", where, " along it takes forces of ",
                 std::sqrt(pull / most), " times those of the diagonal alone, allowed: up to ", told_tolerance);
    }
    return split_by(share);
}

}  // namespace

HostStiffness host_stiffness(const Mesh& mesh, std::int32_t body, SparseMatrix matrix, const ToldKernel& kernel,
                             Monitor& monitor) {
    const std::int64_t dim = mesh.dimension(), rigid = dim == 2 ? 3 : 6;
    const std::vector<std::int64_t> nodes = mesh.body_nodes(body);
    HostStiffness made;
    made.matrix = std::move(matrix);
    const SparseMatrix judged = with_tame_supports(made.matrix, dim);
    std::int64_t free_motions = 0;
    for (const std::vector<std::int64_t>& local : components(made.matrix, dim)) {
        monitor.progress("stiffness", 0, 0);
        HostPiece piece;
        for (const std::int64_t i : local) piece.nodes.push_back(nodes[index(i)]);
        const std::string where = text("body ", mesh.body_label(body), ", the ", local.size(),
                                       " nodes connected with node ", piece.nodes.front());
        DenseMatrix q(dim * static_cast<std::int64_t>(local.size()), 0);
        const std::vector<double> modes = rigid_modes(mesh, piece.nodes);
        q.value.assign(modes.begin(), modes.end());
        q.columns = static_cast<std::int64_t>(q.value.size()) / q.rows;
        const Split split = kernel.told ? told_split(judged, local, dim, q, kernel.motions, where)
                                        : found_split(judged, local, dim, q, where);
        // A single node whose rows the host has emptied for its own supports has only translations; its diagonal
        // resists them.
        if (split.free_count > 0 && q.columns < rigid)
            fail(DELAM_ERROR_ARGUMENT, where, ", lie ", dim == 2 ? "in one point" : "on one line",
                 " and have fewer rigid motions than the ", rigid, " of a solid");
        piece.free = some_columns(q, split.combination, 0, split.free_count);
        piece.held = some_columns(q, split.combination, split.free_count, q.columns);
        free_motions += split.free_count;
        made.pieces.push_back(std::move(piece));
    }
    // Motions declared for several bodies at once may leave this one at rest.
    std::int64_t moving = 0;
    for (std::int64_t c = 0; c < kernel.motions.columns; ++c) {
        const auto motion =
            std::span(kernel.motions.value).subspan(index(c * kernel.motions.rows), index(kernel.motions.rows));
        moving += std::any_of(motion.begin(), motion.end(), [](double u) { return u != 0.0; }) ? 1 : 0;
    }
    if (kernel.told && free_motions < moving && made.pieces.size() == 1)
        fail(DELAM_ERROR_ARGUMENT, "kernel: of ", moving, " motions of body ", mesh.body_label(body), " only ",
             free_motions, " are independent");
    refuse_mechanisms(mesh, body, made, monitor);
    unite_held_pieces(made, dim);
    return made;
}

}  // namespace delam
