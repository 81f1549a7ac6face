// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/operator/jump_variables.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "base/numbers.hpp"
#include "linalg/dense/echelon.hpp"
#include "linalg/sparse/sparse_elimination.hpp"
#include "scene/carriers.hpp"

namespace delam {

namespace {

// Constraints on more variables than this are left to the dense stage.
constexpr std::size_t short_equation = 32;

using Row = SparseElimination::Row;

// Modulus of a body, precise enough to rank bodies; 0 if nothing is given. Entries of a given matrix are about E, in
// space E times an edge; its diagonal may contain supports of the host of any size.
double modulus(const Problem& problem, std::int32_t body) {
    const auto b = index(body);
    if (problem.stiffness[b] != nullptr && !(problem.renewed && problem.material[b])) {
        const SparseMatrix& k = problem.stiffness[b]->matrix;
        double largest = 0.0;
        for (std::int64_t row = 0; row < k.rows; ++row)
            for (auto e = index(k.start[index(row)]); e < index(k.start[index(row) + 1]); ++e)
                if (k.column[e] != row) largest = std::max(largest, std::abs(k.value[e]));
        const double rows = static_cast<double>(std::max<std::int64_t>(1, k.rows / 3));
        return problem.mesh->dimension() == 2 ? largest : largest * std::cbrt(rows) / problem.mesh->size();
    }
    if (!problem.material[b]) return 0.0;
    if (const auto* isotropic = std::get_if<Elastic>(&*problem.material[b])) return isotropic->young;
    const auto& constant = std::get<Orthotropic>(*problem.material[b]).constant;
    return std::max({constant[Orthotropic::e1], constant[Orthotropic::e2], constant[Orthotropic::e3]});
}

constexpr std::int64_t steps_per_poll = 1024;

// Variables before numbering: ids below the number of mesh DOFs are displacements, the others jump rows.
class Builder {
public:
    Builder(const Problem& problem, const Poll& poll)
        : problem_(problem),
          poll_(poll),
          carriers_(problem),
          dim_(problem.mesh->dimension()),
          dofs_(problem.mesh->node_count() * dim_) {
        for (std::int32_t b = 0; b < problem.mesh->body_count(); ++b) rank_.push_back(modulus(problem, b));
        find_pairs();
        hang_nodes();
        for (const std::size_t p : closing_) close_ring(pairs_[p]);
        take_constraints();
        solved_.close();
    }
    JumpVariables build() const;

private:
    struct Pair {
        std::int64_t a, b;
        std::int64_t first_row;
        const double* frame;  // [dim][dim]
        GapRow gap;           // pattern -1: none
    };

    const Problem& problem_;
    const Poll& poll_;
    Carriers carriers_;
    std::int64_t dim_;
    std::int64_t dofs_;
    std::vector<Pair> pairs_;
    std::vector<std::size_t> closing_;  // pairs outside the spanning trees: they close rings, or have a tied node
    SparseElimination solved_;
    std::vector<std::int64_t> bound_;  // jump rows for which constraints are solved
    std::vector<Row> open_;            // long constraints

    std::vector<double> rank_;  // [bodies] modulus

    double rank_of(std::int64_t node) const {
        const std::int32_t body = problem_.mesh->node_body(node);
        return body < 0 ? 0.0 : rank_[index(body)];
    }
    bool displacement(std::int64_t id) const { return id < dofs_; }
    std::vector<double> nothing() const { return std::vector<double>(problem_.patterns.size(), 0.0); }
    // Adds factor * g to a right-hand side.
    static void add_gap(Row& row, const Pair& pair, double factor) {
        if (pair.gap.pattern >= 0) row.right[index(pair.gap.pattern)] += factor * pair.gap.value;
    }
    void find_pairs();
    void hang_nodes();
    void close_ring(const Pair& pair);
    std::int64_t moved_node(const Pair& pair) const;
    std::int64_t choose_pivot(const Row& row, std::int64_t preferred_node) const;
    void take_constraints();
    // row += factor * displacement of a node
    void add(Row& row, std::int64_t node, std::int64_t k, double factor) const {
        for (const auto& [carrier, weight] : carriers_.of(node)) row.terms[carrier * dim_ + k] += factor * weight;
    }
};

void Builder::find_pairs() {
    std::int64_t row = 0;
    for (const InterfaceGeometry& face : problem_.mesh->interfaces())
        for (std::size_t p = 0; p < face.node_a.size(); ++p, row += dim_)
            pairs_.push_back(
                {face.node_a[p], face.node_b[p], row, &face.frame[p * index(dim_ * dim_)], {row, -1, 0.0}});
    for (const GapRow& gap : problem_.gap_rows()) pairs_[index(gap.row / dim_)].gap = gap;
}

// Control nodes are the first roots, so that the nodes they move depend on them; then nodes of the stiffest bodies.
// Where soft meets stiff, the jump then moves only the soft side: on the stiff side its condensed stiffness, that of
// the soft body, would be a small difference of large numbers.
void Builder::hang_nodes() {
    std::map<std::int64_t, std::vector<std::size_t>> pairs_of;
    const auto tied = [this](std::int64_t node) { return carriers_.kind(node) == Carriers::Kind::tied; };
    std::vector<std::uint8_t> in_tree(pairs_.size(), 0);
    for (std::size_t p = 0; p < pairs_.size(); ++p) {
        if (tied(pairs_[p].a) || tied(pairs_[p].b)) continue;
        pairs_of[pairs_[p].a].push_back(p);
        pairs_of[pairs_[p].b].push_back(p);
    }
    std::vector<std::int64_t> roots;
    for (const std::int64_t node : carriers_.controls())
        if (pairs_of.contains(node)) roots.push_back(node);
    const auto first_body = static_cast<std::ptrdiff_t>(roots.size());
    for (const auto& [node, unused] : pairs_of) roots.push_back(node);
    std::stable_sort(roots.begin() + first_body, roots.end(),
                     [&](std::int64_t a, std::int64_t b) { return rank_of(a) > rank_of(b); });
    std::map<std::int64_t, bool> met;
    std::size_t pieces = 0;
    for (const std::int64_t root : roots) {
        if (met[root]) continue;
        if (++pieces % index(steps_per_poll) == 0) call_if_set(poll_);
        met[root] = true;
        std::vector<std::int64_t> front{root};
        while (!front.empty()) {
            const std::int64_t node = front.back();
            front.pop_back();
            for (const std::size_t p : pairs_of[node]) {
                const Pair& pair = pairs_[p];
                const std::int64_t other = pair.a == node ? pair.b : pair.a;
                if (met[other] || carriers_.kind(other) == Carriers::Kind::control) continue;
                met[other] = true;
                in_tree[p] = 1;
                const double sign = pair.a == node ? 1.0 : -1.0;
                for (std::int64_t k = 0; k < dim_; ++k) {
                    // u_other - u_node -+ Q^T (j - g theta) = 0
                    Row row{{{node * dim_ + k, -1.0}}, nothing()};
                    for (std::int64_t r = 0; r < dim_; ++r)
                        if (const double q = pair.frame[r * dim_ + k]; q != 0.0)
                            row.terms[dofs_ + pair.first_row + r] -= sign * q;
                    add_gap(row, pair, -sign * pair.frame[k]);
                    solved_.reduce(row);
                    row.terms[other * dim_ + k] = 1.0;
                    solved_.solve(row, other * dim_ + k);
                }
                front.push_back(other);
            }
        }
    }
    for (std::size_t p = 0; p < pairs_.size(); ++p)
        if (in_tree[p] == 0) closing_.push_back(p);
}

// The remainder of u_b - u_a - Q^T (j - g theta) = 0 after dependent nodes are replaced. If displacements are left
// (tied nodes, control nodes), one of them is expressed by the rest; otherwise the jump of this pair is a combination
// of the ring's others.
void Builder::close_ring(const Pair& pair) {
    std::vector<Row> apart;
    for (std::int64_t k = 0; k < dim_; ++k) {
        Row row{{}, nothing()};
        add(row, pair.b, k, 1.0);
        add(row, pair.a, k, -1.0);
        solved_.reduce(row);
        apart.push_back(std::move(row));
    }
    const bool moves = std::any_of(apart[0].terms.begin(), apart[0].terms.end(),
                                   [this](const auto& t) { return displacement(t.first); });
    for (std::int64_t i = 0; i < dim_; ++i) {
        Row row{{}, nothing()};
        if (moves) {
            row = apart[index(i)];
            for (std::int64_t r = 0; r < dim_; ++r)
                if (const double q = pair.frame[r * dim_ + i]; q != 0.0) row.terms[dofs_ + pair.first_row + r] -= q;
            add_gap(row, pair, -pair.frame[i]);
            solved_.reduce(row);
            solved_.solve(row, choose_pivot(row, moved_node(pair)));
            continue;
        }
        for (std::int64_t k = 0; k < dim_; ++k) {
            const double q = pair.frame[i * dim_ + k];
            for (const auto& [id, c] : apart[index(k)].terms) row.terms[id] -= q * c;
            add_scaled(-q, apart[index(k)].right, row.right);
        }
        if (i == 0) add_gap(row, pair, 1.0);
        solved_.reduce(row);
        row.terms[dofs_ + pair.first_row + i] = 1.0;
        solved_.solve(row, dofs_ + pair.first_row + i);
    }
}

// Returns the node that a pair with a tied node moves: b's or, where that is tied too, the one with the largest weight
// on either side, of the softer body.
std::int64_t Builder::moved_node(const Pair& pair) const {
    if (carriers_.kind(pair.b) != Carriers::Kind::tied) return pair.b;
    const auto main = [this](std::int64_t node) {
        const auto of = carriers_.of(node);
        return std::max_element(of.begin(), of.end(), [](const auto& p, const auto& q) { return p.second < q.second; })
            ->first;
    };
    const std::int64_t a = main(pair.a), b = main(pair.b);
    return rank_of(a) < rank_of(b) ? a : b;
}

// The largest coefficient among displacements of bodies, else of control nodes, else of jumps. The preferred node comes
// first unless its coefficient is small.
std::int64_t Builder::choose_pivot(const Row& row, std::int64_t preferred_node) const {
    const auto rank = [this](std::int64_t id) {
        if (!displacement(id)) return 2;
        return carriers_.kind(id / dim_) == Carriers::Kind::control ? 1 : 0;
    };
    int lowest = 2;
    double largest = 0.0;
    for (const auto& [id, c] : row.terms) lowest = std::min(lowest, rank(id));
    for (const auto& [id, c] : row.terms)
        if (rank(id) == lowest) largest = std::max(largest, std::abs(c));
    std::int64_t pivot = -1;
    for (const auto& [id, c] : row.terms) {
        if (rank(id) != lowest || std::abs(c) < (1.0 - 1e-9) * largest) continue;
        if (pivot < 0) pivot = id;
    }
    for (const auto& [id, c] : row.terms)
        if (displacement(id) && id / dim_ == preferred_node && rank(id) == lowest && std::abs(c) > 0.5 * largest)
            pivot = id;
    return pivot;
}

// Constraints on a single displacement are resolved first, because they shorten others; then short ones; long ones stay
// open.
void Builder::take_constraints() {
    for (const Constraint& constraint : problem_.constraints) {
        Row row{{}, constraint.prescribed};
        for (std::size_t i = 0; i < constraint.dof.size(); ++i)
            add(row, constraint.dof[i] / dim_, constraint.dof[i] % dim_, constraint.coefficient[i]);
        row.right.resize(problem_.patterns.size(), 0.0);
        solved_.reduce(row);
        open_.push_back(std::move(row));
        if (static_cast<std::int64_t>(open_.size()) % steps_per_poll == 0) call_if_set(poll_);
    }
    const auto pass = [this](std::size_t longest, bool jumps) {
        bool any = false;
        for (Row& row : open_) {
            if (row.terms.empty()) continue;
            solved_.reduce(row);
            if (row.terms.empty() || row.terms.size() > longest) continue;
            const std::int64_t pivot = choose_pivot(row, -1);
            if (!jumps && !displacement(pivot)) continue;
            solved_.solve(row, pivot);
            if (!displacement(pivot)) bound_.push_back(pivot - dofs_);
            row.terms.clear();
            any = true;
        }
        std::erase_if(open_, [](const Row& row) { return row.terms.empty(); });
        return any;
    };
    for (int sweep = 0; sweep < 4 && pass(1, false); ++sweep) {
    }
    while (pass(short_equation, true)) {
    }
}

JumpVariables Builder::build() const {
    JumpVariables v;
    const std::size_t patterns = problem_.patterns.size();
    constexpr std::int64_t absent = -1, kept = -2;
    std::vector<std::int64_t> number(index(dofs_), absent);
    for (std::int64_t dof = 0; dof < dofs_; ++dof) {
        const Carriers::Kind kind = carriers_.kind(dof / dim_);
        if (solved_.solved(dof) || kind == Carriers::Kind::nothing || kind == Carriers::Kind::tied) continue;
        number[index(dof)] = kind == Carriers::Kind::control ? kept : 0;
    }
    for (const Row& row : open_)
        for (const auto& [id, value] : row.terms)
            if (displacement(id)) number[index(id)] = kept;
    for (std::int64_t& i : number)
        if (i == 0) i = v.leading++;
    for (std::int64_t& i : number)
        if (i == kept) i = v.leading + v.kept++;

    const std::int64_t rows = problem_.jump_count();
    std::vector<std::int64_t> jump(index(rows), absent);
    for (std::int64_t r = 0; r < rows; ++r)
        if (!solved_.solved(dofs_ + r)) jump[index(r)] = v.jumps++;
    v.row_offset.resize(index(rows));
    for (std::int64_t r = 0; r < rows; ++r) {
        const SparseElimination::Solution* solution = solved_.find(dofs_ + r);
        if (solution == nullptr) {
            v.row.push_back({{jump[index(r)], 1.0}});
            continue;
        }
        SparseVector entries;
        for (const auto& [id, value] : solution->terms) entries.emplace_back(jump[index(id - dofs_)], value);
        v.row.push_back(std::move(entries));
        if (std::any_of(solution->right.begin(), solution->right.end(), [](double d) { return d != 0.0; }))
            v.row_offset[index(r)] = solution->right;
    }
    v.bound = bound_;
    const std::int64_t first_jump = v.leading + v.kept;
    const auto variable = [&](std::int64_t id) {
        return displacement(id) ? number[index(id)] : first_jump + jump[index(id - dofs_)];
    };

    v.lift.assign(patterns, std::vector<double>(index(dofs_), 0.0));
    v.transform.rows = dofs_;
    v.transform.columns = v.count();
    v.transform.column.reserve(index(dofs_ + 2 * rows));
    v.transform.value.reserve(index(dofs_ + 2 * rows));
    v.transform.start.reserve(index(dofs_) + 1);
    std::map<std::int64_t, double> entries;
    for (std::int64_t dof = 0; dof < dofs_; ++dof) {
        if (dof % (16 * steps_per_poll) == 0) call_if_set(poll_);
        entries.clear();
        for (const auto& [carrier, weight] : carriers_.of(dof / dim_)) {
            const std::int64_t at = carrier * dim_ + dof % dim_;
            if (const SparseElimination::Solution* solution = solved_.find(at); solution != nullptr) {
                for (const auto& [id, value] : solution->terms) entries[variable(id)] += weight * value;
                for (std::size_t p = 0; p < patterns; ++p) v.lift[p][index(dof)] += weight * solution->right[p];
            } else if (number[index(at)] >= 0) {
                entries[number[index(at)]] += weight;
            }
        }
        for (const auto& [column, value] : entries) {
            v.transform.column.push_back(column);
            v.transform.value.push_back(value);
        }
        v.transform.start.push_back(static_cast<std::int64_t>(v.transform.column.size()));
    }
    for (const Row& row : open_) {
        JumpVariables::Equation equation{{}, row.right};
        for (const auto& [id, value] : row.terms) equation.entries.emplace_back(variable(id) - v.leading, value);
        v.equations.push_back(std::move(equation));
    }
    return v;
}

}  // namespace

JumpVariables make_jump_variables(const Problem& problem, const Poll& poll) { return Builder(problem, poll).build(); }

void offset_jumps(JumpVariables& variables, std::span<const double> offset) {
    const std::size_t patterns = variables.lift.size();
    std::vector<double> v(index(variables.count()), 0.0);
    const std::int64_t first_jump = variables.leading + variables.kept;
    for (std::size_t r = 0; r < offset.size(); ++r)
        if (const SparseVector& row = variables.row[r]; row.size() == 1 && row.front().second == 1.0)
            v[index(first_jump + row.front().first)] = offset[r];
    for (std::size_t r = 0; r < offset.size(); ++r) {
        double own = offset[r];
        for (const auto& [jump, n] : variables.row[r]) own -= n * v[index(first_jump + jump)];
        if (own != 0.0) variables.row_offset[r].resize(patterns, 0.0);
        if (!variables.row_offset[r].empty()) variables.row_offset[r].back() = own;
    }
    for (JumpVariables::Equation& equation : variables.equations) {
        double& prescribed = equation.prescribed.back();
        prescribed = 0.0;
        for (const auto& [t, c] : equation.entries) prescribed += c * v[index(variables.leading + t)];
    }
    for (double& own : v) own = -own;
    multiply(variables.transform, v, variables.lift.back());
}

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
    DenseMatrix q(equations, static_cast<std::int64_t>(column.size())),
        value(equations, static_cast<std::int64_t>(patterns));
    for (std::int64_t i = 0; i < equations; ++i) {
        const JumpVariables::Equation& e = variables.equations[index(i)];
        for (const auto& [t, c] : e.entries)
            q(i, std::lower_bound(column.begin(), column.end(), t) - column.begin()) += c;
        for (std::size_t p = 0; p < patterns; ++p) value(i, static_cast<std::int64_t>(p)) = e.prescribed[p];
    }
    const Echelon echelon = reduced_echelon(std::move(q), kept, dependent_equation);
    const DenseMatrix prescribed = multiply(echelon.operations, value);
    for (std::size_t i = 0; i < echelon.pivot.size(); ++i) {
        const auto row = static_cast<std::int64_t>(i);
        SolvedEquation equation{column[index(echelon.pivot[i])], {}, {}};
        for (std::size_t j = 0; j < column.size(); ++j) {
            const double c = echelon.rows(row, static_cast<std::int64_t>(j));
            if (column[j] != equation.pivot && std::abs(c) > dependent_equation)
                equation.entries.emplace_back(column[j], -c);
        }
        for (std::size_t p = 0; p < patterns; ++p)
            equation.prescribed.push_back(prescribed(row, static_cast<std::int64_t>(p)));
        solved.push_back(std::move(equation));
    }
    return solved;
}

std::vector<JumpRow> express_rows(const JumpVariables& variables, std::span<const SolvedEquation> solved) {
    const std::size_t patterns = variables.lift.size();
    std::map<std::int64_t, const SolvedEquation*> of_jump;
    for (const SolvedEquation& equation : solved)
        if (equation.pivot >= variables.kept) of_jump.emplace(equation.pivot - variables.kept, &equation);
    std::vector<JumpRow> rows;
    rows.reserve(variables.row.size());
    std::map<std::int64_t, double> terms;
    for (std::size_t r = 0; r < variables.row.size(); ++r) {
        JumpRow row{{}, variables.row_offset[r]};
        terms.clear();
        for (const auto& [jump, n] : variables.row[r]) {
            const auto at = of_jump.find(jump);
            if (at == of_jump.end()) {
                terms[variables.leading + variables.kept + jump] += n;
                continue;
            }
            for (const auto& [t, c] : at->second->entries) terms[variables.leading + t] += n * c;
            row.offset.resize(patterns, 0.0);
            for (std::size_t p = 0; p < patterns; ++p) row.offset[p] += n * at->second->prescribed[p];
        }
        for (const auto& [i, n] : terms)
            if (std::abs(n) > dependent_equation) row.unknowns.emplace_back(i, n);
        rows.push_back(std::move(row));
    }
    return rows;
}

std::int64_t free_jumps(const JumpVariables& variables) {
    const std::vector<SolvedEquation> solved = solve_equations(variables);
    return variables.jumps - std::count_if(solved.begin(), solved.end(),
                                           [&](const SolvedEquation& e) { return e.pivot >= variables.kept; });
}

std::vector<std::uint8_t> prescribed_rows(const JumpVariables& variables) {
    std::vector<std::uint8_t> prescribed;
    for (const JumpRow& row : express_rows(variables, solve_equations(variables)))
        prescribed.push_back(row.prescribed() ? 1 : 0);
    return prescribed;
}

}  // namespace delam
