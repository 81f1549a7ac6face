// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/feti/lockstep_cg.hpp"

#include <algorithm>
#include <cmath>

#include "base/numbers.hpp"
#include "linalg/sparse/block.hpp"
#include "reduction/feti/descent.hpp"
#include "reduction/feti/projected_cg.hpp"

namespace delam {

namespace {

// State of one column in a descent.
struct Column {
    explicit Column(const Limits& limits) : lowest(limits.feti_noticed) {}
    double rz = 0.0;
    Lowest lowest;
    bool done = false;
};

class Descent {
public:
    Descent(const DualOperator& op, Team& team, const DenseMatrix& right, double tolerance, const Limits& limits,
            DenseMatrix& lambda)
        : op_(op),
          team_(team),
          tolerance_(tolerance),
          limits_(limits),
          lambda_(lambda),
          a_lambda_(right.rows, right.columns),
          r_(right),
          z_(right.rows, right.columns),
          p_(right.rows, right.columns),
          ap_(right.rows, right.columns),
          columns_(index(right.columns), Column(limits)) {
        op_.apply(team_, lambda_, a_lambda_);
        for (std::size_t i = 0; i < r_.value.size(); ++i) r_.value[i] -= a_lambda_.value[i];
        project_transposed(r_);
    }
    // The residual's size over the solution's, of the column that has most left; of the start where `first`.
    double residual() {
        precondition();
        double worst = 0.0;
        for (std::int64_t c = 0; c < r_.columns; ++c) {
            Column& own = columns_[index(c)];
            own.rz = dot(column(r_, c), column(z_, c));
            worst = std::max(worst, relative(c));
        }
        return worst;
    }
    void run(const std::function<void(std::int64_t)>& each_iteration) {
        p_ = z_;
        for (std::int64_t iteration = 1; iteration <= limits_.feti_column_iterations && advance(); ++iteration)
            each_iteration(iteration);
    }

private:
    const DualOperator& op_;
    Team& team_;
    double tolerance_;
    const Limits& limits_;
    DenseMatrix& lambda_;
    DenseMatrix a_lambda_, r_, z_, p_, ap_;
    std::vector<Column> columns_;

    double relative(std::int64_t c) const {
        const double norm = std::sqrt(std::abs(columns_[index(c)].rz));
        const double energy = std::sqrt(std::max(dot(column(lambda_, c), column(a_lambda_, c)), norm * norm));
        return energy > 0.0 ? norm / energy : 0.0;
    }
    void project_transposed(DenseMatrix& x) const {
        for (std::int64_t c = 0; c < x.columns; ++c) {
            op_.coarse().project_transposed(column(x, c));
            op_.mask(column(x, c));
        }
    }
    void precondition() {
        op_.precondition(team_, r_, z_);
        for (std::int64_t c = 0; c < z_.columns; ++c) op_.coarse().project(column(z_, c));
    }
    // One step of all columns that are not done: s = r^T z / p^T A p,  lambda <- lambda + s p,  r <- r - s P^T A p,
    // z = P M r,  p <- z + (r^T z / r^T z before) p.  False: none is left.
    bool advance() {
        op_.apply(team_, p_, ap_);
        project_transposed(ap_);
        for (std::int64_t c = 0; c < p_.columns; ++c) {
            Column& own = columns_[index(c)];
            const double pap = dot(column(p_, c), column(ap_, c));
            own.done = own.done || !(own.rz > 0.0) || !(pap > 0.0) || relative(c) <= tolerance_;
            if (own.done) continue;
            const double step = own.rz / pap;
            add_scaled(step, column(p_, c), column(lambda_, c));
            add_scaled(step, column(ap_, c), column(a_lambda_, c));
            add_scaled(-step, column(ap_, c), column(r_, c));
        }
        precondition();
        bool any = false;
        for (std::int64_t c = 0; c < p_.columns; ++c) {
            Column& own = columns_[index(c)];
            if (own.done) continue;
            const double rz = dot(column(r_, c), column(z_, c)), ratio = rz / own.rz;
            own.rz = rz;
            own.lowest.take(std::sqrt(std::max(rz, 0.0)));
            own.done = !(rz > 0.0) || relative(c) <= tolerance_ || own.lowest.idle() > limits_.feti_column_idle;
            if (own.done) continue;
            any = true;
            const std::span<double> p = column(p_, c);
            const std::span<const double> z = column(z_, c);
            for (std::size_t i = 0; i < p.size(); ++i) p[i] = z[i] + ratio * p[i];
        }
        return any;
    }
};

// The forces nearest to these that carry the resultants. False: no forces can carry one of the resultants. Columns
// without a resultant are not tested, because what is left of them is the rounding of the forces.
bool balance(const DualOperator& op, const DenseMatrix& resultant, DenseMatrix& lambda) {
    double left = 0.0;
    for (std::int64_t c = 0; c < lambda.columns; ++c) {
        const double size = max_abs(column(resultant, c));
        const double rest = op.coarse().balance(column(resultant, c), column(lambda, c), size);
        if (size > 0.0) left = std::max(left, rest);
    }
    return left <= unbalanced_part;
}

}  // namespace

bool lockstep_cg(const DualOperator& op, Team& team, const DenseMatrix& right, const DenseMatrix& resultant,
                 double tolerance, const Limits& limits, DenseMatrix& lambda,
                 const std::function<void(std::int64_t)>& each_iteration) {
    Rounds rounds(limits);
    DenseMatrix best = lambda;
    while (true) {
        if (!balance(op, resultant, lambda) && rounds.begun() == 0) return false;
        Descent descent(op, team, right, tolerance, limits, lambda);
        if (rounds.begin(descent.residual())) best = lambda;
        if (rounds.best() <= tolerance || rounds.over()) break;
        descent.run(each_iteration);
    }
    lambda = std::move(best);
    return rounds.best() <= limits.feti_slack * tolerance;
}

}  // namespace delam
