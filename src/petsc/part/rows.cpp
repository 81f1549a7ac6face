// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/part/rows.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <span>
#include <string>
#include <unordered_map>
#include <vector>

#include "base/numbers.hpp"
#include "petsc/base/failure.hpp"
#include "petsc/part/places.hpp"

namespace delam::petsc {

namespace {

// The bound is that of a stiffness in one process (delam_problem_set_stiffness), relative to sqrt(k_rr k_cc): by Cauchy
// and Schwarz, no entry of a positive semidefinite matrix is larger. Nor are the terms that a host has added up to it.
constexpr double allowed_asymmetry = 1e-9;

// The ranks that have the rows of the nodes: rank node mod size keeps the entry of a node, and the others ask it.
class Owners {
public:
    Owners(const Communicator& comm, std::span<const std::int64_t> nodes) : comm_(comm) {
        const auto announced = comm.exchange(by_keeper(nodes));
        comm.together([&] {
            for (std::size_t r = 0; r < announced.size(); ++r)
                for (const std::int64_t node : announced[r])
                    if (const auto [found, is_new] = owner_.emplace(node, static_cast<int>(r)); !is_new)
                        fail(DELAM_ERROR_ARGUMENT, "nodes: node ", node, " has rows on rank ", found->second,
                             " and on rank ", r, ": each node belongs to one rank");
        });
    }
    // -1: nobody's.
    std::vector<int> find(std::span<const std::int64_t> nodes) const {
        const auto questions = comm_.exchange(by_keeper(nodes));
        std::vector<std::vector<int>> answers(questions.size());
        comm_.together([&] {
            for (std::size_t r = 0; r < questions.size(); ++r)
                for (const std::int64_t node : questions[r]) {
                    const auto found = owner_.find(node);
                    answers[r].push_back(found == owner_.end() ? -1 : found->second);
                }
        });
        const auto arrived = comm_.exchange(answers);
        std::vector<int> ranks;
        comm_.together([&] {
            std::vector<std::size_t> next(arrived.size(), 0);
            for (const std::int64_t node : nodes) ranks.push_back(arrived[keeper(node)][next[keeper(node)]++]);
        });
        return ranks;
    }

private:
    std::size_t keeper(std::int64_t node) const { return index(node % comm_.size()); }
    std::vector<std::vector<std::int64_t>> by_keeper(std::span<const std::int64_t> nodes) const {
        std::vector<std::vector<std::int64_t>> lists(index(comm_.size()));
        for (const std::int64_t node : nodes) lists[keeper(node)].push_back(node);
        return lists;
    }

    const Communicator& comm_;
    std::unordered_map<std::int64_t, int> owner_;
};

// An entry whose column belongs to another rank, which has the entry's mirror image.
struct Mirrored {
    std::int64_t row, column;  // DOFs
    double value, diagonal;    // that of the row
};

class Rows {
public:
    // Rows in the places of `part`, whose nodes grow by the ghosts.
    Rows(Part& part, std::int64_t count, const std::int64_t* row_starts, const std::int64_t* columns,
         const double* values)
        : dimension_(part.dimension), nodes_(part.nodes) {
        const std::size_t own = nodes_.size();
        Places places(dimension_, nodes_);
        matrix_.rows = petsc_int(count);
        for (std::int64_t r = 0; r < count; ++r) {
            for (std::int64_t e = row_starts[r]; e < row_starts[r + 1]; ++e) {
                if (columns[e] < 0)
                    fail(DELAM_ERROR_ARGUMENT, "columns: ", columns[e], " of entry ", e,
                         " is negative; a column is dimension * node + component");
                matrix_.column.push_back(places.of(columns[e]));
                matrix_.value.push_back(values[e]);
            }
            matrix_.start.push_back(petsc_int(matrix_.column.size()));
        }
        matrix_.columns = petsc_int(nodes_.size() * index(dimension_));
        matrix_.sort_rows();
        part.ghosts = nodes_.size() - own;
        for (std::size_t i = 0; i < nodes_.size(); ++i) place_.emplace(nodes_[i], i);
        for (std::size_t r = 0; r < index(count); ++r) {
            diagonal_.push_back(entry(r, r));
            if (!(diagonal_[r] > 0.0))
                fail(DELAM_ERROR_ARGUMENT, "rows: ", diagonal_[r], " on the diagonal at ", name(dof(r)),
                     ": has to be > 0");
        }
    }

    const LocalMatrix& matrix() const { return matrix_; }

    // owner: of the ghosts.
    void require_owners(const std::vector<int>& owner) const {
        each_of_others([&](std::size_t r, std::size_t c, double) {
            if (owner[ghost(c)] < 0)
                fail(DELAM_ERROR_ARGUMENT, "columns: the row of ", name(dof(r)), " has column ", dof(c), ", ",
                     name(dof(c)), ", whose rows no rank has");
        });
    }
    void require_symmetry_here() const {
        for (std::size_t r = 0; r < index(matrix_.rows); ++r)
            for (auto e = index(matrix_.start[r]); e < index(matrix_.start[r + 1]) && index(matrix_.column[e]) < own();
                 ++e) {
                const std::size_t c = index(matrix_.column[e]);
                compare(dof(r), dof(c), matrix_.value[e], entry(c, r),
                        std::sqrt(diagonal_[r]) * std::sqrt(diagonal_[c]));
            }
    }
    std::vector<std::vector<Mirrored>> for_others(const std::vector<int>& owner, int ranks) const {
        std::vector<std::vector<Mirrored>> lists(index(ranks));
        each_of_others([&](std::size_t r, std::size_t c, double value) {
            lists[index(owner[ghost(c)])].push_back({dof(r), dof(c), value, diagonal_[r]});
        });
        return lists;
    }
    void require_symmetry_with(const std::vector<Mirrored>& theirs) const {
        for (const Mirrored& m : theirs) {
            const std::size_t r = index(m.column % dimension_) + place_.at(m.column / dimension_) * index(dimension_);
            const auto c = place_.find(m.row / dimension_);
            const double mine =
                c == place_.end() ? 0.0 : entry(r, c->second * index(dimension_) + index(m.row % dimension_));
            compare(m.row, m.column, m.value, mine, std::sqrt(m.diagonal) * std::sqrt(diagonal_[r]));
        }
    }
    // 1/2 (R + R^T)
    LocalMatrix halves() const {
        std::vector<PetscInt> count(index(matrix_.columns), 0);
        const auto both = [&](const auto& add) {
            for (std::size_t r = 0; r < index(matrix_.rows); ++r)
                for (auto e = index(matrix_.start[r]); e < index(matrix_.start[r + 1]); ++e) {
                    add(r, index(matrix_.column[e]), 0.5 * matrix_.value[e]);
                    add(index(matrix_.column[e]), r, 0.5 * matrix_.value[e]);
                }
        };
        LocalMatrix sum;
        sum.rows = sum.columns = matrix_.columns;
        both([&](std::size_t r, std::size_t, double) { ++count[r]; });
        for (const PetscInt entries : count) sum.start.push_back(petsc_int(std::int64_t{sum.start.back()} + entries));
        std::vector<PetscInt> next(sum.start.begin(), sum.start.end() - 1);
        sum.column.resize(index(sum.start.back()));
        sum.value.resize(sum.column.size());
        both([&](std::size_t r, std::size_t c, double value) {
            sum.column[index(next[r])] = static_cast<PetscInt>(c);
            sum.value[index(next[r]++)] = value;
        });
        sum.sort_rows();
        return sum;
    }

private:
    std::size_t own() const { return index(matrix_.rows); }  // DOFs
    std::size_t ghost(std::size_t place) const { return (place - own()) / index(dimension_); }
    std::int64_t dof(std::size_t place) const {
        return nodes_[place / index(dimension_)] * dimension_ + static_cast<std::int64_t>(place % index(dimension_));
    }
    std::string name(std::int64_t dof) const {
        return "component " + std::to_string(dof % dimension_) + " of node " + std::to_string(dof / dimension_);
    }
    double entry(std::size_t r, std::size_t c) const {
        const auto first = matrix_.column.begin() + matrix_.start[r],
                   last = matrix_.column.begin() + matrix_.start[r + 1];
        const auto found = std::lower_bound(first, last, static_cast<PetscInt>(c));
        return found == last || index(*found) != c ? 0.0 : matrix_.value[index(found - matrix_.column.begin())];
    }
    template <class Work>
    void each_of_others(const Work& work) const {
        for (std::size_t r = 0; r < index(matrix_.rows); ++r)
            for (auto e = index(matrix_.start[r]); e < index(matrix_.start[r + 1]); ++e)
                if (index(matrix_.column[e]) >= own()) work(r, index(matrix_.column[e]), matrix_.value[e]);
    }
    void compare(std::int64_t row, std::int64_t column, double value, double mirrored, double scale) const {
        if (!(std::abs(value - mirrored) <= allowed_asymmetry * scale))
            fail(DELAM_ERROR_ARGUMENT, "rows: the stiffness is not symmetric: ", value, " in row ", row, " (",
                 name(row), "), column ", column, " (", name(column), "), but ", mirrored, " in row ", column,
                 ", column ", row, "; allowed difference ", allowed_asymmetry * scale);
    }

    std::int64_t dimension_;
    std::vector<std::int64_t>& nodes_;
    std::unordered_map<std::int64_t, std::size_t> place_;  // of nodes
    LocalMatrix matrix_;
    std::vector<double> diagonal_;
};

}  // namespace

Part make_rows(const Communicator& comm, std::int32_t dimension, std::int64_t node_count, const std::int64_t* nodes,
               const double* coordinates, const std::int64_t* row_starts, const std::int64_t* columns,
               const double* values) {
    Part part;
    comm.together([&] {
        part = make_nodes(dimension, node_count, nodes, coordinates);
        check_rows(node_count * dimension, row_starts, columns, values);
        part.of_rows = true;
    });
    require_same_dimension(comm, dimension);
    const Owners owners(comm, part.nodes);
    std::unique_ptr<Rows> rows;
    comm.together([&] {
        rows = std::make_unique<Rows>(part, node_count * dimension, row_starts, columns, values);
        rows->require_symmetry_here();
    });
    const std::vector<int> owner = owners.find(std::span<const std::int64_t>(part.nodes).last(part.ghosts));
    std::vector<std::vector<Mirrored>> lists;
    comm.together([&] {
        rows->require_owners(owner);
        lists = rows->for_others(owner, comm.size());
    });
    const auto theirs = comm.exchange(lists);
    comm.together([&] {
        for (const auto& list : theirs) rows->require_symmetry_with(list);
        part.stiffness = rows->halves();
    });
    return part;
}

}  // namespace delam::petsc
