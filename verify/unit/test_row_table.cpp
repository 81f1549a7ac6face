// SPDX-License-Identifier: BSD-3-Clause
// Equal cells are found to the last bit, and what they share is computed once and right, on meshes with few and with
// too many different cells.
#include <array>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "body/assembly.hpp"
#include "body/equal/centre_gradients.hpp"
#include "body/equal/row_table.hpp"
#include "check.hpp"
#include "meshes.hpp"

using namespace delam;

namespace {

// A square or cube of n^dimension cells whose nodes are moved at random: no two cells are equal.
Mesh moved(CellType type, std::int64_t n) {
    const auto length = static_cast<double>(n);
    const std::vector<double> lengths(static_cast<std::size_t>(topology(type).dimension - 1), length);
    const std::vector<std::int64_t> divisions(lengths.size(), n);
    std::mt19937 random(1);
    std::uniform_real_distribution<double> draw(-0.2, 0.2);
    const auto move = [&](std::span<double> x) {
        for (double& v : x) v += draw(random);
    };
    return unit::rebuilt(unit::layers(type, lengths, divisions, {length}, {n}), 0, move);
}

// u = A x has the gradient A in all cells.
void expect_gradient(const Mesh& mesh, const CentreGradients& gradients) {
    const auto dim = static_cast<std::size_t>(mesh.dimension());
    const std::array<double, 9> a{0.3, -1.2, 0.7, 0.9, 0.1, -0.4, 1.1, 0.6, -0.8};
    std::vector<double> u;
    for (std::int64_t n = 0; n < mesh.node_count(); ++n)
        for (std::size_t i = 0; i < dim; ++i) {
            double sum = 0.0;
            for (std::size_t j = 0; j < dim; ++j) sum += a[i * dim + j] * mesh.node(n)[j];
            u.push_back(sum);
        }
    const std::vector<double> slopes = gradients.slopes(u);
    ck_assert_uint_eq(slopes.size(), static_cast<std::size_t>(mesh.cell_count()) * dim * dim);
    for (std::size_t i = 0; i < slopes.size(); ++i) ck_assert_double_eq_tol(slopes[i], a[i % (dim * dim)], 1e-11);
}

}  // namespace

TEST(rows_are_equal_to_the_last_bit) {
    RowTable rows;
    const std::vector<double> one{1.0, 2.0}, two{1.0, std::nextafter(2.0, 3.0)}, longer{1.0, 2.0, 0.0};
    const RowTable::Found first = rows.find(one);
    ck_assert(first.added && first.number == 0);
    for (const std::vector<double>& other : {two, longer, std::vector<double>{1.0, -2.0}, std::vector<double>{1.0}})
        ck_assert(rows.find(other).added);
    const RowTable::Found again = rows.find(one);
    ck_assert(!again.added && again.number == 0);
    ck_assert_uint_eq(rows.count(), 5);
}

TEST(only_so_many_rows_are_kept) {
    RowTable rows;
    std::int64_t kept = 0;
    for (int i = 0; i < 5000; ++i) kept += rows.find(std::vector<double>{double(i), 1.0}).added ? 1 : 0;
    ck_assert_int_eq(kept, static_cast<std::int64_t>(rows.count()));
    ck_assert_int_lt(kept, 5000);
    for (int i = 0; i < 5000; ++i) {
        const RowTable::Found found = rows.find(std::vector<double>{double(i), 1.0});
        ck_assert(!found.added && found.number == (i < kept ? i : -1));
    }
}

// 240 x (6 + 6) cells of the ENF example at .5 mm: 33 differ, by the rounding of their places.
TEST(layers_have_few_different_cells) {
    const Mesh plane = unit::layers(CellType::quad4, {0.12}, {240}, {0.003, 0.003}, {6, 6});
    const CentreGradients gradients(plane);
    ck_assert_int_eq(plane.cell_count(), 2880);
    ck_assert_uint_le(gradients.distinct(), 64);
    expect_gradient(plane, gradients);
    const Mesh space = unit::layers(CellType::hex8, {1.0, 0.5}, {16, 8}, {0.25, 0.25}, {2, 2});
    const CentreGradients cubes(space);
    ck_assert_uint_eq(cubes.distinct(), 1);  // powers of two: nothing is rounded
    expect_gradient(space, cubes);
}

TEST(different_cells_have_their_own_gradients) {
    for (const Mesh& mesh : {moved(CellType::quad4, 40), moved(CellType::hex8, 12)}) {
        const CentreGradients gradients(mesh);
        ck_assert_uint_lt(gradients.distinct(), static_cast<std::size_t>(mesh.cell_count()));
        expect_gradient(mesh, gradients);
    }
}

// The sum of the stiffnesses of single cells is that of all, with equal and with different cells and two materials.
TEST(assembled_cells_are_those_of_one_cell) {
    for (const Mesh& mesh :
         {moved(CellType::quad4, 36), unit::layers(CellType::quad4, {8.0}, {8}, {1.0, 1.0}, {1, 1})}) {
        std::vector<std::int64_t> cells, nodes;
        for (std::int64_t c = 0; c < mesh.cell_count(); ++c) cells.push_back(c);
        for (std::int64_t n = 0; n < mesh.node_count(); ++n) nodes.push_back(n);
        std::vector<BodyModel> models;
        for (std::int32_t b = 0; b < mesh.body_count(); ++b)
            models.push_back({Elastic{1.0 + 3.0 * b, 0.3}, Plane::strain, Formulation::incompatible, nullptr});
        const SparseMatrix all = assemble_stiffness(mesh, cells, nodes, models);
        std::vector<double> sum(all.value.size(), 0.0);
        for (const std::int64_t c : cells) {
            const SparseMatrix one = assemble_stiffness(mesh, std::vector<std::int64_t>{c}, nodes, models);
            for (std::int64_t r = 0; r < one.rows; ++r)
                for (std::int64_t e = one.start[index(r)]; e < one.start[index(r) + 1]; ++e) {
                    std::int64_t at = all.start[index(r)];
                    while (all.column[index(at)] != one.column[index(e)]) ++at;
                    sum[index(at)] += one.value[index(e)];
                }
        }
        for (std::size_t e = 0; e < sum.size(); ++e) ck_assert_double_eq_tol(all.value[e], sum[e], 1e-13);
    }
}
