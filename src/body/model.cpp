// SPDX-License-Identifier: BSD-3-Clause
#include "body/model.hpp"

#include "base/error.hpp"
#include "base/numbers.hpp"

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

namespace {

bool has_modes(const CellRow& row) { return row.has_modes(); }
// The others have one strain in the whole cell.
bool has_dilatations(const CellRow& row) { return !row.one_strain(); }

// Returns the first cell of the body whose row is, or is not, of a kind; -1: there is none.
std::int64_t first_cell(const Mesh& mesh, std::int32_t body, bool (*kind)(const CellRow&), bool is) {
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        if (mesh.cell_body(c) == body && kind(cell_row(mesh.cell_type(c))) == is) return c;
    return -1;
}

}  // namespace

std::vector<Formulation> default_formulations(const Mesh& mesh) {
    std::vector<Formulation> formulation(index(mesh.body_count()), Formulation::standard);
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        if (has_modes(cell_row(mesh.cell_type(c)))) formulation[index(mesh.cell_body(c))] = Formulation::incompatible;
    return formulation;
}

void require_formulation(const Mesh& mesh, std::int32_t body, Formulation formulation, std::int32_t status) {
    if (formulation == Formulation::incompatible && first_cell(mesh, body, has_modes, true) < 0)
        fail(status, "formulation 'incompatible' of body ", mesh.body_label(body),
             ": it has no cells with such modes; cells that have them are ", cell_names(has_modes));
    if (formulation != Formulation::mean_dilatation) return;
    const std::int64_t cell = first_cell(mesh, body, has_dilatations, false);
    if (cell >= 0)
        fail(status, "formulation 'mean-dilatation' of body ", mesh.body_label(body), ": cell ", cell, " is a ",
             cell_row(mesh.cell_type(cell)).topology.name,
             ", whose dilatation is constant already, so that it locks as before; allowed are ",
             cell_names(has_dilatations));
}

}  // namespace delam
