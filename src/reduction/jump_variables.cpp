// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/jump_variables.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "linalg/echelon.hpp"

namespace delam {

namespace {

// What is smaller than this part of a row's largest coefficient is left over from cancellation.
constexpr double rounding = 1e-12;

// A displacement component in provisional variables: ids below the number of mesh DOFs are displacements of roots, the others
// jump rows.
using Combination = std::map<std::int64_t, double>;

void tidy(Combination& c) {
    double largest = 0.0;
    for (const auto& [id, value] : c) largest = std::max(largest, std::abs(value));
    std::erase_if(c, [&](const auto& e) { return std::abs(e.second) <= rounding * largest; });
}

struct Pair {
    std::int64_t a, b;
    std::int64_t first_row;
    const double* frame;  // [dim][dim]
};

class Builder {
public:
    explicit Builder(const Problem& problem)
        : problem_(problem), dim_(problem.mesh->dimension()), dofs_(problem.mesh->node_count() * dim_) {
        hang_nodes();
        take_constraints();
    }
    JumpVariables build() const;

private:
    const Problem& problem_;
    std::int64_t dim_;
    std::int64_t dofs_;
    std::vector<Pair> pairs_;
    std::map<std::int64_t, Combination> hanging_;       // mesh DOF -> combination, for nodes of pairs that are no roots
    std::map<std::int64_t, Combination> ring_;          // jump row that closes a ring -> other rows
    std::map<std::int64_t, std::vector<double>> fixed_; // root DOF -> factors of the patterns
    struct Row {
        Combination left;
        std::vector<double> prescribed;
    };
    std::vector<Row> open_;  // constraints on more than one variable, or on jumps alone

    Combination of(std::int64_t dof) const {
        const auto found = hanging_.find(dof);
        return found == hanging_.end() ? Combination{{dof, 1.0}} : found->second;
    }
    void hang_nodes();
    void take_constraints();
};

void Builder::hang_nodes() {
    std::int64_t row = 0;
    std::map<std::int64_t, std::vector<std::size_t>> pairs_of;
    for (const InterfaceGeometry& face : problem_.mesh->interfaces()) {
        for (std::size_t p = 0; p < face.node_a.size(); ++p, row += dim_) {
            pairs_of[face.node_a[p]].push_back(pairs_.size());
            pairs_of[face.node_b[p]].push_back(pairs_.size());
            pairs_.push_back({face.node_a[p], face.node_b[p], row, &face.frame[p * static_cast<std::size_t>(dim_ * dim_)]});
        }
    }
    std::vector<std::uint8_t> in_tree(pairs_.size(), 0);
    std::map<std::int64_t, bool> met;
    for (const auto& [root, unused] : pairs_of) {
        if (met[root]) continue;
        met[root] = true;
        std::vector<std::int64_t> front{root};
        while (!front.empty()) {
            const std::int64_t node = front.back();
            front.pop_back();
            for (const std::size_t p : pairs_of[node]) {
                const Pair& pair = pairs_[p];
                const std::int64_t other = pair.a == node ? pair.b : pair.a;
                if (met[other]) continue;
                met[other] = true;
                in_tree[p] = 1;
                const double sign = pair.a == node ? 1.0 : -1.0;
                for (std::int64_t k = 0; k < dim_; ++k) {
                    Combination c = of(node * dim_ + k);
                    for (std::int64_t r = 0; r < dim_; ++r)
                        if (const double q = pair.frame[r * dim_ + k]; q != 0.0) c[dofs_ + pair.first_row + r] += sign * q;
                    hanging_[other * dim_ + k] = std::move(c);
                }
                front.push_back(other);
            }
        }
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        if (in_tree[p] != 0) continue;
        for (std::int64_t r = 0; r < dim_; ++r) {
            Combination c;
            for (std::int64_t k = 0; k < dim_; ++k) {
                const double q = pairs_[p].frame[r * dim_ + k];
                if (q == 0.0) continue;
                for (const auto& [id, value] : of(pairs_[p].b * dim_ + k)) c[id] += q * value;
                for (const auto& [id, value] : of(pairs_[p].a * dim_ + k)) c[id] -= q * value;
            }
            // The root cancels exactly in exact arithmetic.
            std::erase_if(c, [&](const auto& e) { return e.first < dofs_ || std::abs(e.second) <= rounding; });
            ring_[pairs_[p].first_row + r] = std::move(c);
        }
    }
}

// Constraints on one root each are resolved first, one after another since each may leave others with a single variable.
void Builder::take_constraints() {
    const std::size_t patterns = problem_.patterns.size();
    for (const Constraint& constraint : problem_.constraints) {
        Row row;
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            for (const auto& [id, value] : of(constraint.dof[i])) row.left[id] += constraint.coefficient[i] * value;
        tidy(row.left);
        row.prescribed = constraint.prescribed;
        row.prescribed.resize(patterns, 0.0);
        open_.push_back(std::move(row));
    }
    for (bool again = true; again;) {
        again = false;
        for (Row& row : open_) {
            for (auto e = row.left.begin(); e != row.left.end();) {
                const auto known = fixed_.find(e->first);
                if (known == fixed_.end()) {
                    ++e;
                    continue;
                }
                for (std::size_t p = 0; p < patterns; ++p) row.prescribed[p] -= e->second * known->second[p];
                e = row.left.erase(e);
            }
            if (row.left.size() != 1 || row.left.begin()->first >= dofs_) continue;
            const auto [dof, coefficient] = *row.left.begin();
            std::vector<double> value = row.prescribed;
            for (double& v : value) v /= coefficient;
            fixed_[dof] = std::move(value);
            row.left.clear();
            again = true;
        }
    }
    std::erase_if(open_, [](const Row& row) { return row.left.empty(); });
}

JumpVariables Builder::build() const {
    JumpVariables v;
    const std::size_t patterns = problem_.patterns.size();
    enum : std::int64_t { absent = -1, fixed = -2, kept = -3 };
    std::vector<std::int64_t> index(static_cast<std::size_t>(dofs_), 0);
    for (std::int64_t node = 0; node < problem_.mesh->node_count(); ++node)
        if (problem_.mesh->node_body(node) < 0)
            for (std::int64_t k = 0; k < dim_; ++k) index[static_cast<std::size_t>(node * dim_ + k)] = absent;
    for (const auto& [dof, unused] : hanging_) index[static_cast<std::size_t>(dof)] = absent;
    for (const auto& [dof, unused] : fixed_) index[static_cast<std::size_t>(dof)] = fixed;
    for (const Row& row : open_)
        for (const auto& [id, value] : row.left)
            if (id < dofs_) index[static_cast<std::size_t>(id)] = kept;
    for (std::int64_t& i : index)
        if (i == 0) i = v.leading++;
    for (std::int64_t& i : index)
        if (i == kept) i = v.leading + v.kept++;

    const std::int64_t rows = problem_.jump_count();
    std::vector<std::int64_t> jump(static_cast<std::size_t>(rows), absent);
    for (std::int64_t r = 0; r < rows; ++r)
        if (!ring_.contains(r)) jump[static_cast<std::size_t>(r)] = v.jumps++;
    for (std::int64_t r = 0; r < rows; ++r) {
        if (const auto ring = ring_.find(r); ring != ring_.end()) {
            SparseVector entries;
            for (const auto& [id, value] : ring->second) entries.emplace_back(jump[static_cast<std::size_t>(id - dofs_)], value);
            v.row.push_back(std::move(entries));
        } else {
            v.row.push_back({{jump[static_cast<std::size_t>(r)], 1.0}});
        }
    }
    const std::int64_t first_jump = v.leading + v.kept;
    const auto variable = [&](std::int64_t id) {
        return id < dofs_ ? index[static_cast<std::size_t>(id)] : first_jump + jump[static_cast<std::size_t>(id - dofs_)];
    };

    v.lift.assign(patterns, std::vector<double>(static_cast<std::size_t>(dofs_), 0.0));
    v.transform.rows = dofs_;
    v.transform.columns = v.count();
    v.transform.column.reserve(static_cast<std::size_t>(dofs_ + 2 * rows));
    v.transform.value.reserve(static_cast<std::size_t>(dofs_ + 2 * rows));
    v.transform.start.reserve(static_cast<std::size_t>(dofs_) + 1);
    const auto append = [&](std::int64_t dof, std::int64_t id, double value) {
        if (id < dofs_ && index[static_cast<std::size_t>(id)] == fixed) {
            const std::vector<double>& factors = fixed_.at(id);
            for (std::size_t p = 0; p < patterns; ++p) v.lift[p][static_cast<std::size_t>(dof)] += value * factors[p];
            return;
        }
        v.transform.column.push_back(variable(id));
        v.transform.value.push_back(value);
    };
    auto next = hanging_.begin();
    for (std::int64_t dof = 0; dof < dofs_; ++dof) {
        if (next != hanging_.end() && next->first == dof) {
            for (const auto& [id, value] : next->second) append(dof, id, value);
            ++next;
        } else if (index[static_cast<std::size_t>(dof)] != absent) {
            append(dof, dof, 1.0);
        }
        v.transform.start.push_back(static_cast<std::int64_t>(v.transform.column.size()));
    }
    for (const Row& row : open_) {
        JumpVariables::Equation equation{{}, row.prescribed};
        for (const auto& [id, value] : row.left) equation.entries.emplace_back(variable(id) - v.leading, value);
        v.equations.push_back(std::move(equation));
    }
    return v;
}

}  // namespace

JumpVariables make_jump_variables(const Problem& problem) { return Builder(problem).build(); }

// Only variables that occur in an equation are columns: a few, however many jumps there are.
std::vector<SolvedEquation> solve_equations(const JumpVariables& variables) {
    std::vector<SolvedEquation> solved;
    if (variables.equations.empty()) return solved;
    std::vector<std::int64_t> column;
    for (const JumpVariables::Equation& e : variables.equations)
        for (const auto& [t, c] : e.entries) column.push_back(t);
    std::sort(column.begin(), column.end());
    column.erase(std::unique(column.begin(), column.end()), column.end());
    const auto kept = std::lower_bound(column.begin(), column.end(), variables.kept) - column.begin();

    const auto equations = static_cast<std::int64_t>(variables.equations.size());
    const std::size_t patterns = variables.equations.front().prescribed.size();
    DenseMatrix q(equations, static_cast<std::int64_t>(column.size())), value(equations, static_cast<std::int64_t>(patterns));
    for (std::int64_t i = 0; i < equations; ++i) {
        const JumpVariables::Equation& e = variables.equations[static_cast<std::size_t>(i)];
        for (const auto& [t, c] : e.entries) q(i, std::lower_bound(column.begin(), column.end(), t) - column.begin()) += c;
        for (std::size_t p = 0; p < patterns; ++p) value(i, static_cast<std::int64_t>(p)) = e.prescribed[p];
    }
    const Echelon echelon = reduced_echelon(std::move(q), kept, dependent_equation);
    const DenseMatrix prescribed = multiply(echelon.operations, value);
    for (std::size_t i = 0; i < echelon.pivot.size(); ++i) {
        const auto row = static_cast<std::int64_t>(i);
        SolvedEquation equation{column[static_cast<std::size_t>(echelon.pivot[i])], {}, {}};
        for (std::size_t j = 0; j < column.size(); ++j) {
            const double c = echelon.rows(row, static_cast<std::int64_t>(j));
            if (column[j] != equation.pivot && std::abs(c) > dependent_equation) equation.entries.emplace_back(column[j], -c);
        }
        for (std::size_t p = 0; p < patterns; ++p) equation.prescribed.push_back(prescribed(row, static_cast<std::int64_t>(p)));
        solved.push_back(std::move(equation));
    }
    return solved;
}

}  // namespace delam
