// SPDX-License-Identifier: BSD-3-Clause
// Stresses and rotations of the cells of a part, in another process: those of the whole, bit for bit.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <vector>

#include "base/numbers.hpp"
#include "body/assembly.hpp"
#include "body/rotation.hpp"
#include "check.hpp"
#include "delam/experimental.h"
#include "part_blocks.hpp"

using namespace delam;
using namespace delam::part_test;

namespace {

// Fields of all cells of the mesh, as a solver computes them, at displacements of any kind.
struct WholeFields {
    explicit WholeFields(const Blocks& b, const std::vector<std::int32_t>& bodies, const std::vector<double>& strains) {
        const Mesh& mesh = b.core();
        std::vector<BodyModel> models;
        std::vector<Strain> of_body(bodies.empty() ? 0 : index(mesh.body_count()));
        for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
            models.push_back(b.problem->core->model(body));
            for (std::size_t i = 0; i < bodies.size(); ++i)
                if (bodies[i] == mesh.body_label(body)) std::copy_n(&strains[6 * i], 6, of_body[index(body)].begin());
        }
        for (std::size_t i = 0; i < mesh.nodes().size(); ++i) u.push_back(1e-5 * std::sin(0.7 + 1.3 * double(i)));
        stress = centre_stress(mesh, models, u, of_body);
        rotation = centre_rotation(mesh, u);
    }
    std::vector<double> u, stress, rotation;
};

std::vector<double> rows_of(const std::vector<double>& values, const std::vector<std::int64_t>& rows,
                            std::size_t columns) {
    std::vector<double> some;
    for (const std::int64_t row : rows)
        some.insert(some.end(), values.begin() + static_cast<std::ptrdiff_t>(index(row) * columns),
                    values.begin() + static_cast<std::ptrdiff_t>((index(row) + 1) * columns));
    return some;
}

}  // namespace

// With eigenstrains of one body, of both, of a body that the mesh does not have, and without.
LOOP_TEST(fields_of_parts_have_the_bits_of_the_whole, 0, shape_count) {
    const Blocks b(shapes[loop]);
    const std::size_t dim = index(b.core().dimension());
    const std::vector<double> strains{
        1e-4, -2e-4, 3e-4, 4e-4, dim == 3 ? 5e-4 : 0.0, dim == 3 ? -6e-4 : 0.0, 2e-4, 7e-4, 1e-4, -3e-4, 0.0, 0.0};
    const std::vector<std::vector<std::int32_t>> cases{{}, {plies}, {core_layer, plies}, {99}};
    for (const std::vector<std::int32_t>& bodies : cases) {
        const WholeFields whole(b, bodies, strains);
        for (std::int64_t p = 0; p < 3; ++p) {
            std::vector<std::int64_t> cells;
            for (std::int64_t c = p; c < b.core().cell_count(); c += 3) cells.push_back(c);
            const std::vector<std::uint8_t> bytes = b.part(cells);
            const Matrix m = matrix_of(b, bytes);
            const std::vector<double> u = rows_of(whole.u, m.node, dim);
            std::vector<double> stress(cells.size() * (dim == 2 ? 4 : 6)), rotation(cells.size() * (dim == 2 ? 1 : 3));
            const auto fields = [&](std::int64_t nodes, std::int64_t count) {
                return delam_experimental_part_fields(b.context, static_cast<std::int64_t>(bytes.size()), bytes.data(),
                                                      nodes, u.data(), static_cast<std::int64_t>(bodies.size()),
                                                      bodies.data(), strains.data(), count, stress.data(),
                                                      rotation.data());
            };
            const auto count = static_cast<std::int64_t>(cells.size());
            b.expect(fields(m.nodes, count));
            ck_assert(same_bits(stress, rows_of(whole.stress, cells, dim == 2 ? 4 : 6)));
            ck_assert(same_bits(rotation, rows_of(whole.rotation, cells, dim == 2 ? 1 : 3)));
            b.refused(fields(m.nodes - 1, count), DELAM_ERROR_ARGUMENT, "node_count = ");
            b.refused(fields(m.nodes, count + 1), DELAM_ERROR_ARGUMENT, "cell_count = ");
        }
    }
}

TEST(wrong_arguments_of_fields) {
    const Blocks b(shapes[0]);
    const std::vector<std::uint8_t> bytes = b.part({0, 1});
    const Matrix m = matrix_of(b, bytes);
    std::vector<double> u(index(2 * m.nodes), 0.0), strains(12, 0.0);
    std::vector<std::int32_t> bodies{plies, plies};
    const auto fields = [&](std::int64_t body_count) {
        return delam_experimental_part_fields(b.context, static_cast<std::int64_t>(bytes.size()), bytes.data(), m.nodes,
                                              u.data(), body_count, bodies.data(), strains.data(), 2, nullptr, nullptr);
    };
    b.expect(fields(1));
    b.refused(fields(2), DELAM_ERROR_ARGUMENT, "bodies[1] = 7 occurs twice");
    b.refused(fields(-1), DELAM_ERROR_ARGUMENT, "body_count = -1");
    strains[3] = nan_number;
    b.refused(fields(1), DELAM_ERROR_ARGUMENT, "eigenstrains[3] = nan");
    strains[3] = 0.0;
    u[2] = infinite;
    b.refused(fields(1), DELAM_ERROR_ARGUMENT, "displacement[2] = inf");
}
