// SPDX-License-Identifier: BSD-3-Clause
#include "body/model.hpp"

#include "base/error.hpp"

namespace delam {

void require_formulation(const Mesh& mesh, std::int32_t body, Formulation formulation, std::int32_t status) {
    if (formulation == Formulation::standard) return;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        const CellType type = mesh.cell_type(c);
        if (type == CellType::quad4 || type == CellType::hex8 || mesh.cell_body(c) != body) continue;
        fail(status, "formulation 'incompatible' of body ", mesh.body_label(body), ": cell ", c, " is a ",
             topology(type).name, ", it is for quad4 and hex8 only");
    }
}

}  // namespace delam
