// SPDX-License-Identifier: BSD-3-Clause
#include "body/eigenstrain.hpp"

#include <algorithm>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/cell_elasticity.hpp"
#include "body/element.hpp"
#include "delam/delam.h"
#include "mesh/faces.hpp"

namespace delam {

EigenstrainLoads eigenstrain_loads(const Mesh& mesh, std::span<const std::int64_t> cells,
                                   std::span<const std::int64_t> nodes, const BodyModel& model,
                                   std::span<const Strain> strains) {
    const std::size_t dim = index(mesh.dimension()), count = strains.size();
    constexpr std::size_t plane_row[] = {0, 1, 3};  // of xx, yy, 2xy among all six
    EigenstrainLoads loads{{count, std::vector<double>(nodes.size() * dim, 0.0)},
                           std::vector<double>(count * count, 0.0)};
    if (count == 0) return loads;
    const bool stress_free = dim == 2 && model.plane == Plane::stress;
    CellElasticity elasticity(model, mesh.dimension());
    std::vector<double> x, integral;
    std::vector<Strain> strain(count);
    std::vector<std::array<double, 6>> stress(count);
    for (const std::int64_t c : cells) {
        poll_cancel("loads");
        const auto cell = mesh.cell(c);
        x.clear();
        for (const std::int64_t n : cell) x.insert(x.end(), mesh.node(n).begin(), mesh.node(n).end());
        integral.resize(x.size());
        const double volume = integrate_gradients(mesh.cell_type(c), x, integral);
        const std::span<const double> plane = elasticity.matrix(c);
        const SpaceElasticity& space = elasticity.space(c);
        const Axes* axes = elasticity.axes(c);
        for (std::size_t k = 0; k < count; ++k) {
            strain[k] = axes == nullptr ? strains[k] : rotated_strain(strains[k], *axes);
            stress[k] = {};
            for (std::size_t i = 0; i < 6; ++i)
                for (std::size_t j = 0; j < 6; ++j) stress[k][i] += space[i * 6 + j] * strain[k][j];
            if (!stress_free) continue;
            stress[k] = {};
            for (std::size_t i = 0; i < 3; ++i)
                for (std::size_t j = 0; j < 3; ++j)
                    stress[k][plane_row[i]] += plane[i * 3 + j] * strain[k][plane_row[j]];
        }
        for (std::size_t k = 0; k < count; ++k)
            for (std::size_t l = 0; l < count; ++l)
                for (std::size_t i = 0; i < 6; ++i) loads.energy[k * count + l] += volume * strain[k][i] * stress[l][i];
        for (std::size_t a = 0; a < cell.size(); ++a) {
            const auto node = std::lower_bound(nodes.begin(), nodes.end(), cell[a]);
            if (node == nodes.end() || *node != cell[a])
                fail(DELAM_ERROR_INTERNAL, "node ", cell[a], " of cell ", c,
                     " is not among the nodes to assemble over");
            const double* g = &integral[a * dim];
            double* f = nullptr;
            for (std::size_t k = 0; k < count; ++k) {
                f = &loads.force[k][index(node - nodes.begin()) * dim];
                const auto& s = stress[k];
                if (dim == 2) {
                    f[0] += s[0] * g[0] + s[3] * g[1];
                    f[1] += s[3] * g[0] + s[1] * g[1];
                } else {
                    f[0] += s[0] * g[0] + s[3] * g[1] + s[5] * g[2];
                    f[1] += s[3] * g[0] + s[1] * g[1] + s[4] * g[2];
                    f[2] += s[5] * g[0] + s[4] * g[1] + s[2] * g[2];
                }
            }
        }
    }
    // Symmetric to the bit.
    for (std::size_t k = 0; k < count; ++k)
        for (std::size_t l = 0; l < k; ++l) loads.energy[k * count + l] = loads.energy[l * count + k];
    return loads;
}

}  // namespace delam
