// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/face_gaps.hpp"

#include "base/numbers.hpp"

namespace delam {

std::vector<double> face_gaps(const Mesh& mesh, const InterfaceGeometry& interface) {
    const auto dim = index(mesh.dimension());
    std::vector<double> gaps(interface.node_a.size(), 0.0);
    for (std::size_t p = 0; p < gaps.size(); ++p)
        for (std::size_t k = 0; k < dim; ++k)
            gaps[p] += interface.frame[p * dim * dim + k] *
                       (mesh.node(interface.node_b[p])[k] - mesh.node(interface.node_a[p])[k]);
    return gaps;
}

}  // namespace delam
