// SPDX-License-Identifier: BSD-3-Clause
#include "body/model.hpp"

#include "base/error.hpp"

namespace delam {

const char* name_of(Formulation formulation) {
    switch (formulation) {
        case Formulation::standard:
            return "standard";
        case Formulation::incompatible:
            return "incompatible";
        case Formulation::mean_dilatation:
            return "mean-dilatation";
    }
    return "";
}

void require_formulation(const Mesh& mesh, std::int32_t body, Formulation formulation, std::int32_t status) {
    if (formulation == Formulation::standard) return;
    const bool modes = formulation == Formulation::incompatible;
    bool (*allowed)(const CellRow&) = [](const CellRow& row) { return !row.simplex() && row.linear(); };
    // The others have one strain in the whole cell.
    if (!modes) allowed = [](const CellRow& row) { return !row.simplex() || !row.linear(); };
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c) {
        if (mesh.cell_body(c) != body) continue;
        const CellRow& row = cell_row(mesh.cell_type(c));
        if (allowed(row)) continue;
        fail(status, "formulation '", name_of(formulation), "' of body ", mesh.body_label(body), ": cell ", c, " is a ",
             row.topology.name, modes ? "" : ", whose dilatation is constant already, so that it locks as before",
             "; allowed are ", cell_names(allowed));
    }
}

}  // namespace delam
