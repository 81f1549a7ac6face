// SPDX-License-Identifier: BSD-3-Clause
#include "scene/problem.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "body/assembly.hpp"
#include "delam/delam.h"

namespace delam {

double Pattern::at(double time) const {
    const auto after = std::upper_bound(times.begin(), times.end(), time);
    if (after == times.begin()) return values.front();
    if (after == times.end()) return values.back();
    const auto i = index(after - times.begin());
    const double half = std::isfinite(times[i] - times[i - 1]) ? 1.0 : 0.5;  // for times as far apart as doubles allow
    const double s = (half * time - half * times[i - 1]) / (half * times[i] - half * times[i - 1]);
    return (1.0 - s) * values[i - 1] + s * values[i];
}

Problem::Problem(std::shared_ptr<const Mesh> mesh_) : mesh(std::move(mesh_)) {
    material.resize(index(mesh->body_count()));
    formulation = default_formulations(*mesh);
    stiffness.resize(material.size());
    interfaces.resize(mesh->interfaces().size());
    for (std::size_t i = 0; i < interfaces.size(); ++i) {
        interfaces[i].adhesion.assign(index(mesh->interfaces()[i].pair_count()), 1.0);
    }
}

std::int64_t Problem::pair_count() const {
    std::int64_t count = 0;
    for (const InterfaceGeometry& face : mesh->interfaces()) count += face.pair_count();
    return count;
}

BodyModel Problem::model(std::int32_t body) const {
    const auto i = index(body);
    if (formulation[i] == Formulation::mean_dilatation && mesh->dimension() == 2 && plane == Plane::stress)
        fail(DELAM_ERROR_PROBLEM, "body ", mesh->body_label(body),
             ": formulation 'mean-dilatation' is for plane strain and 3D only; in plane stress no formulation "
             "locks");
    return {*material[i], plane, formulation[i], orientation};
}

SparseMatrix Problem::body_stiffness(std::int32_t body, const Poll& poll) const {
    if (const auto& own = stiffness[index(body)]) return own->matrix;
    return assemble_stiffness(*mesh, mesh->body_cells(body), mesh->body_nodes(body), model(body), options.threads,
                              poll);
}

void require_material(const Problem& problem, std::int32_t body) {
    if (!problem.material[index(body)])
        fail(DELAM_ERROR_PROBLEM, "body ", problem.mesh->body_label(body),
             ": no material (delam_problem_set_elastic or delam_problem_set_orthotropic)");
}

std::vector<double> Problem::factors(double time) const {
    std::vector<double> factor;
    factor.reserve(patterns.size());
    for (const Pattern& pattern : patterns) factor.push_back(pattern.at(time));
    return factor;
}

std::vector<double> Problem::prescribed_matrix() const {
    std::vector<double> matrix(constraints.size() * patterns.size(), 0.0);
    for (std::size_t i = 0; i < constraints.size(); ++i) {
        std::copy(constraints[i].prescribed.begin(), constraints[i].prescribed.end(),
                  matrix.begin() + static_cast<std::ptrdiff_t>(i * patterns.size()));
    }
    return matrix;
}

std::vector<GapRow> Problem::gap_rows() const {
    std::vector<GapRow> rows;
    std::int64_t row = 0;
    for (const InterfaceProperties& own : interfaces) {
        for (std::size_t p = 0; p < own.adhesion.size(); ++p, row += mesh->dimension())
            if (!own.gap.empty() && own.gap[p] != 0.0) rows.push_back({row, own.gap_pattern, own.gap[p]});
    }
    return rows;
}

}  // namespace delam
