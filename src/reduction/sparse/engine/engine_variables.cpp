// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/engine/engine_variables.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/error.hpp"
#include "base/numbers.hpp"

namespace delam {

namespace {

// Largest entry that is no pivot, relative to the largest entry of a node's rows.
constexpr double no_pivot = 1e-8;

void take(const std::vector<double>& values, std::vector<std::int64_t>& starts, std::vector<std::int64_t>& dofs,
          std::vector<double>& out) {
    for (std::size_t i = 0; i < values.size(); ++i)
        if (values[i] != 0.0) {
            dofs.push_back(static_cast<std::int64_t>(i));
            out.push_back(values[i]);
        }
    starts.push_back(static_cast<std::int64_t>(dofs.size()));
}

}  // namespace

EngineVariables::EngineVariables(const BodySystem& bodies)
    : dimension_(bodies.problem().mesh->dimension()),
      dofs_(bodies.dofs()),
      patterns_(static_cast<std::int64_t>(bodies.problem().patterns.size())) {
    const JumpVariables& variables = bodies.variables();
    find_own(variables);
    replace(variables);
    find_homes(variables, dimension_);
    take_loads(bodies);
    for (std::int64_t i = variables.leading; i < variables.count(); ++i) visible_.push_back(number_of(variables, i));
}

void EngineVariables::find_own(const JumpVariables& variables) {
    const SparseMatrix& t = variables.transform;
    dof_of_.assign(index(variables.leading + variables.kept), -1);
    own_.assign(index(dofs_), -1);
    for (std::int64_t dof = 0; dof < dofs_; ++dof) {
        const std::int64_t e = t.start[index(dof)];
        if (t.start[index(dof) + 1] != e + 1 || t.value[index(e)] != 1.0) continue;
        const std::int64_t variable = t.column[index(e)];
        if (variable >= static_cast<std::int64_t>(dof_of_.size()) || dof_of_[index(variable)] >= 0) continue;
        dof_of_[index(variable)] = dof;
        own_[index(dof)] = variable;
    }
}

std::int64_t EngineVariables::number_of(const JumpVariables& variables, std::int64_t variable) const {
    const std::int64_t jump = variable - variables.leading - variables.kept;
    return jump >= 0 ? dofs_ + jump : dof_of_[index(variable)];
}

void EngineVariables::replace(const JumpVariables& variables) {
    const SparseMatrix& t = variables.transform;
    for (std::int64_t dof = 0; dof < dofs_; ++dof) {
        if (own_[index(dof)] >= 0) continue;
        replaced_.push_back(dof);
        for (std::int64_t e = t.start[index(dof)]; e < t.start[index(dof) + 1]; ++e) {
            columns_.push_back(number_of(variables, t.column[index(e)]));
            coefficients_.push_back(t.value[index(e)]);
        }
        row_starts_.push_back(static_cast<std::int64_t>(columns_.size()));
    }
}

// Node by node, those that depend on the fewest jumps first, which are the ends of single pairs: Gauss elimination with
// full pivoting of the rows of a node over the jumps that have no home yet. A pivot's row is the home of its column.
void EngineVariables::find_homes(const JumpVariables& variables, std::int64_t dimension) {
    homes_.assign(index(variables.jumps), -1);
    std::map<std::int64_t, std::vector<std::size_t>> rows_of;  // nodes, of replaced DOFs with jumps
    std::vector<std::pair<std::int64_t, std::int64_t>> order;  // jumps, node
    for (std::size_t r = 0; r < replaced_.size(); ++r)
        for (std::int64_t e = row_starts_[r]; e < row_starts_[r + 1]; ++e)
            if (columns_[index(e)] >= dofs_) {
                rows_of[replaced_[r] / dimension].push_back(r);
                break;
            }
    for (const auto& [node, rows] : rows_of) {
        std::int64_t jumps = 0;
        for (const std::size_t r : rows)
            for (std::int64_t e = row_starts_[r]; e < row_starts_[r + 1]; ++e)
                jumps += columns_[index(e)] >= dofs_ ? 1 : 0;
        order.emplace_back(jumps, node);
    }
    std::sort(order.begin(), order.end());
    for (const auto& [jumps, node] : order) {
        std::vector<std::pair<std::size_t, std::map<std::int64_t, double>>> rows;
        for (const std::size_t r : rows_of[node]) {
            auto& row = rows.emplace_back(r, std::map<std::int64_t, double>{}).second;
            for (std::int64_t e = row_starts_[r]; e < row_starts_[r + 1]; ++e)
                if (const std::int64_t k = columns_[index(e)] - dofs_; k >= 0 && homes_[index(k)] < 0)
                    row[k] += coefficients_[index(e)];
        }
        while (!rows.empty()) {
            std::size_t best = 0;
            std::pair<std::int64_t, double> pivot{-1, no_pivot};
            for (std::size_t i = 0; i < rows.size(); ++i)
                for (const auto& [k, c] : rows[i].second)
                    if (std::abs(c) > std::abs(pivot.second)) {
                        best = i;
                        pivot = {k, c};
                    }
            if (pivot.first < 0) break;
            homes_[index(pivot.first)] = replaced_[rows[best].first];
            const std::map<std::int64_t, double> taken = std::move(rows[best].second);
            rows.erase(rows.begin() + static_cast<std::ptrdiff_t>(best));
            for (auto& [r, row] : rows) {
                const auto at = row.find(pivot.first);
                if (at == row.end()) continue;
                const double share = at->second / pivot.second;
                for (const auto& [k, c] : taken) row[k] -= share * c;
                row.erase(pivot.first);
            }
        }
    }
    for (std::size_t k = 0; k < homes_.size(); ++k)
        if (homes_[k] < 0)
            fail(DELAM_ERROR_PROBLEM, "engine: the constraints leave jump ", k,
                 " no displacement of its own: solve this scene without an engine");
}

void EngineVariables::take_loads(const BodySystem& bodies) {
    for (std::size_t p = 0; p < index(patterns_); ++p) {
        take(bodies.variables().lift[p], lift_starts_, lift_dofs_, lift_values_);
        take(bodies.force()[p], force_starts_, force_dofs_, force_values_);
    }
}

delam_experimental_variables EngineVariables::view() const {
    delam_experimental_variables v{};
    v.dimension = dimension_;
    v.dofs = dofs_;
    v.pattern_count = patterns_;
    v.jump_count = static_cast<std::int64_t>(homes_.size());
    v.homes = homes_.data();
    v.replaced_count = static_cast<std::int64_t>(replaced_.size());
    v.replaced = replaced_.data();
    v.row_starts = row_starts_.data();
    v.columns = columns_.data();
    v.coefficients = coefficients_.data();
    v.lift_starts = lift_starts_.data();
    v.lift_dofs = lift_dofs_.data();
    v.lift_values = lift_values_.data();
    v.force_starts = force_starts_.data();
    v.force_dofs = force_dofs_.data();
    v.force_values = force_values_.data();
    v.visible_count = static_cast<std::int64_t>(visible_.size());
    v.visible = visible_.data();
    return v;
}

}  // namespace delam
