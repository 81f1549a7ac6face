// SPDX-License-Identifier: BSD-3-Clause
// The variables of jumps, and the motions that no support resists, on junctions and layers with random constraints.
#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

#include "mesh/layers.hpp"
#include "mesh/pairing/interfaces.hpp"
#include "random_dense.hpp"
#include "reduction/dense/rigid_jumps.hpp"
#include "reduction/operator/jump_variables.hpp"
#include "scene/problem.hpp"

using namespace delam;
using namespace unit;

namespace {

// A block of quads, whose nodes are mapped linearly so that frames are oblique.
void add_block(std::vector<double>& nodes, std::vector<Index>& cells, std::vector<std::int32_t>& bodies,
               std::int32_t body, double x0, double y0, Index nx, Index ny, bool slanted) {
    const auto first = static_cast<Index>(nodes.size() / 2);
    for (Index j = 0; j <= ny; ++j)
        for (Index i = 0; i <= nx; ++i) {
            const double x = x0 + static_cast<double>(i), y = y0 + static_cast<double>(j);
            nodes.push_back(slanted ? 0.9 * x - 0.35 * y : x);
            nodes.push_back(slanted ? 0.4 * x + 0.8 * y : y);
        }
    for (Index j = 0; j < ny; ++j)
        for (Index i = 0; i < nx; ++i) {
            const Index corner = first + j * (nx + 1) + i;
            cells.insert(cells.end(), {corner, corner + 1, corner + nx + 2, corner + nx + 1});
            bodies.push_back(body);
        }
}

Problem junction(int kind, bool slanted) {
    std::vector<double> nodes{50.0, 50.0};  // the first belongs to no cell
    std::vector<Index> cells;
    std::vector<std::int32_t> bodies;
    std::vector<std::pair<std::int32_t, std::int32_t>> faces;
    if (kind == 0) {  // tee
        add_block(nodes, cells, bodies, 0, -3, -2, 6, 2, slanted);
        add_block(nodes, cells, bodies, 1, -3, 0, 3, 2, slanted);
        add_block(nodes, cells, bodies, 2, 0, 0, 3, 2, slanted);
        faces = {{0, 1}, {0, 2}, {1, 2}};
    } else {  // cross
        for (std::int32_t b = 0; b < 4; ++b)
            add_block(nodes, cells, bodies, b, b % 2 == 0 ? -2 : 0, b / 2 == 0 ? -2 : 0, 2, 2, slanted);
        faces = {{0, 1}, {2, 3}, {0, 2}, {1, 3}};
    }
    auto mesh = std::make_shared<Mesh>(2, nodes);
    mesh->add_cells(CellType::quad4, cells, bodies);
    for (const auto& [a, b] : faces) add_interface(*mesh, a, b, 1e-6);
    return Problem(mesh);
}

Problem plies(int dimension, std::size_t layers) {
    const std::vector<double> lengths{4.0, 2.0};
    const std::vector<Index> divisions{4, 2};
    const auto axes = static_cast<std::size_t>(dimension - 1);
    auto mesh = std::make_shared<Mesh>(make_layers(
        dimension, std::span(lengths).first(axes), std::span(divisions).first(axes), std::vector<double>(layers, 1.0),
        std::vector<Index>(layers, 1), dimension == 2 ? CellType::quad8 : CellType::hex8));
    for (std::size_t i = 0; i + 1 < layers; ++i)
        add_interface(*mesh, static_cast<std::int32_t>(i), static_cast<std::int32_t>(i + 1), 1e-6);
    return Problem(mesh);
}

DenseMatrix jumps_of(const Problem& problem) {
    const Index dim = problem.mesh->dimension();
    DenseMatrix b(problem.jump_count(), dim * problem.mesh->node_count());
    Index row = 0;
    for (const InterfaceGeometry& face : problem.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p)
            for (Index r = 0; r < dim; ++r, ++row)
                for (Index k = 0; k < dim; ++k) {
                    const double q = face.frame[(p * at(dim) + at(r)) * at(dim) + at(k)];
                    b(row, face.node_b[p] * dim + k) += q;
                    b(row, face.node_a[p] * dim + k) -= q;
                }
    return b;
}

// Random constraints of all kinds: on single components, oblique, means over several nodes, on nodes of pairs and
// others.
void constrain(Problem& problem, Random& random, int count) {
    problem.patterns.push_back({"a", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    problem.patterns.push_back({"b", {0.0, 1.0}, {0.0, 1.0}, Pattern::Drives::displacement});
    const Index dim = problem.mesh->dimension();
    std::vector<Index> alive, faces;
    for (Index n = 0; n < problem.mesh->node_count(); ++n)
        if (problem.mesh->node_body(n) >= 0) alive.push_back(n);
    for (const InterfaceGeometry& face : problem.mesh->interfaces()) {
        faces.insert(faces.end(), face.node_a.begin(), face.node_a.end());
        faces.insert(faces.end(), face.node_b.begin(), face.node_b.end());
    }
    std::vector<Index> used;
    for (int k = 0; k < count; ++k) {
        const auto& list = random.one_in(2) ? faces : alive;
        Constraint c;
        const int nodes = random.one_in(3) ? 3 : 1;
        const bool slanted = random.one_in(3);
        const Index axis = random.below(dim);
        for (int i = 0; i < nodes; ++i) {
            const Index node = list[at(random.below(static_cast<Index>(list.size())))];
            if (std::find(used.begin(), used.end(), node) != used.end()) continue;  // independent rows
            used.push_back(node);
            for (Index d = 0; d < dim; ++d) {
                if (!slanted && d != axis) continue;
                c.dof.push_back(node * dim + d);
                c.coefficient.push_back(slanted ? random.real(0.2, 1.0) : 1.0 / nodes);
            }
        }
        if (c.dof.empty()) continue;
        c.prescribed = random.one_in(2) ? std::vector<double>{} : random.vector(2);
        problem.constraints.push_back(std::move(c));
    }
}

}  // namespace

LOOP_TEST(variables, 0, 60) {
    Random random(static_cast<unsigned>(loop) + 1700U);
    const int kind = loop % 6;
    Problem problem = kind < 4 ? junction(kind / 2, kind % 2 == 1) : plies(kind == 4 ? 2 : 3, kind == 4 ? 4 : 3);
    constrain(problem, random, 1 + loop / 2);
    const JumpVariables v = make_jump_variables(problem);
    const Index dofs = problem.mesh->dimension() * problem.mesh->node_count();
    ck_assert_int_eq(v.transform.rows, dofs);
    ck_assert_int_eq(v.transform.columns, v.count());
    ck_assert_int_eq(static_cast<Index>(v.row.size()), problem.jump_count());
    const DenseMatrix t = dense_of(v.transform), b = jumps_of(problem);

    // B T = [0 | rows], B U = offsets: the jump variables are the jumps, and nothing else moves them.
    DenseMatrix expected(problem.jump_count(), v.count());
    for (std::size_t r = 0; r < v.row.size(); ++r)
        for (const auto& [j, c] : v.row[r]) expected(static_cast<Index>(r), v.leading + v.kept + j) += c;
    const DenseMatrix product = multiply(b, t);
    ck_assert_msg(distance(product.value, expected.value) < 1e-13, "B T: %.2e",
                  distance(product.value, expected.value));
    ck_assert_uint_eq(v.lift.size(), problem.patterns.size());
    for (std::size_t p = 0; p < v.lift.size(); ++p) {
        std::vector<double> jump(at(b.rows));
        multiply(b, v.lift[p], jump);
        for (std::size_t r = 0; r < jump.size(); ++r)
            if (!v.row_offset[r].empty()) jump[r] -= v.row_offset[r][p];
        ck_assert_msg(largest(jump) < 1e-12, "B U: %.2e", largest(jump));
    }

    // Trailing variables that satisfy the equations at some theta give displacements that satisfy the constraints,
    // whatever the leading variables are.
    const std::vector<double> theta = random.vector(2);
    const auto equations = static_cast<Index>(v.equations.size());
    std::vector<double> values = random.vector(v.count());
    if (equations > 0) {
        DenseMatrix q(equations, v.trailing());
        std::vector<double> off(at(equations));
        for (Index i = 0; i < equations; ++i) {
            off[at(i)] = dot(v.equations[at(i)].prescribed, theta);
            for (const auto& [k, c] : v.equations[at(i)].entries) {
                ck_assert(k >= 0 && k < v.trailing());
                q(i, k) += c;
                off[at(i)] -= c * values[at(v.leading + k)];
            }
        }
        const Eigen eigen = eigen_symmetric(multiply(q, flipped(q)));
        for (Index e = 0; e < equations; ++e) {
            if (eigen.value[at(e)] < 1e-10 * eigen.value.back()) continue;
            double along = 0.0;
            for (Index i = 0; i < equations; ++i) along += eigen.vector(i, e) * off[at(i)];
            for (Index i = 0; i < equations; ++i)
                for (Index k = 0; k < v.trailing(); ++k)
                    values[at(v.leading + k)] += q(i, k) * eigen.vector(i, e) * along / eigen.value[at(e)];
        }
    }
    std::vector<double> u(at(dofs));
    multiply(v.transform, values, u);
    for (std::size_t p = 0; p < theta.size(); ++p) add_scaled(theta[p], v.lift[p], u);
    DenseMatrix d(static_cast<Index>(problem.constraints.size()), dofs);
    for (std::size_t c = 0; c < problem.constraints.size(); ++c) {
        const Constraint& row = problem.constraints[c];
        double value = 0.0;
        for (std::size_t i = 0; i < row.dof.size(); ++i) {
            value += row.coefficient[i] * u[at(row.dof[i])];
            d(static_cast<Index>(c), row.dof[i]) += row.coefficient[i];
        }
        double wanted = 0.0;
        for (std::size_t p = 0; p < row.prescribed.size(); ++p) wanted += row.prescribed[p] * theta[p];
        ck_assert_msg(std::abs(value - wanted) < 1e-11, "constraint %d: %.2e", static_cast<int>(c), value - wanted);
    }
    // The number of free variables is right: nothing is lost.
    Index alive = 0;
    for (Index n = 0; n < problem.mesh->node_count(); ++n)
        alive += problem.mesh->node_body(n) >= 0 ? problem.mesh->dimension() : 0;
    const auto rank = d.rows == 0 ? Index{0} : pivoted_columns(flipped(d), 1e-10).rank;
    ck_assert_int_eq(v.count() - equations, alive - rank);
    const Eigen gram = eigen_symmetric(multiply_transposed(t, t));
    ck_assert_msg(gram.value.front() > 1e-6, "columns of T depend on each other: %.2e", gram.value.front());
}

// Motions that no support resists, as seen at the interfaces: the freedoms of the bodies less those of the whole.
LOOP_TEST(rigid_motions, 0, 2) {
    Problem problem = junction(1, loop == 1);
    DenseMatrix z = RigidMotions(problem).jumps();
    ck_assert_int_eq(z.columns, 9);  // four bodies of three motions; the common ones open nothing
    const DenseMatrix unit = multiply_transposed(z, z);
    for (Index j = 0; j < unit.columns; ++j)
        for (Index i = 0; i < unit.rows; ++i) ck_assert(std::abs(unit(i, j) - (i == j ? 1.0 : 0.0)) < 1e-10);
    for (const Index dof : {2, 3, 5}) problem.constraints.push_back({{dof}, {1.0}, {}});  // body 0 is held
    ck_assert_int_eq(RigidMotions(problem).jumps().columns, 9);
    std::vector<std::uint8_t> active(at(z.rows), 0);
    ck_assert_int_eq(split_motions(z, active).free.columns, 9);
    std::fill(active.begin(), active.end(), std::uint8_t{1});
    ck_assert_int_eq(split_motions(z, active).free.columns, 0);
    ck_assert_int_eq(split_motions(z, active).held.columns, 9);
}
