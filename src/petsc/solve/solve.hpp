// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <vector>

#include "base/restarts.hpp"
#include "petsc/bodies/kept_states.hpp"
#include "petsc/solve/iterations.hpp"

namespace delam::petsc {

// The question that rank 0 has been asked; the other ranks get theta from it.
struct Question {
    std::vector<double> theta;  // on all ranks
    std::vector<double> start;  // likewise: weights of kept answers, or empty
    std::int64_t place = 0;     // likewise
    std::vector<double> force;  // from here on rank 0 only
    std::vector<double> right;
    double tolerance = 0.0;
    std::int64_t limit = 0;
    double (*enough)(double first, void* user) = nullptr;
    std::int32_t (*poll)(void* user) = nullptr;
    void* user = nullptr;
};

struct Result {
    double first = 0.0;
    double norm = 0.0;
    double size = 0.0;
    double least = 1.0;
    std::int64_t iterations = 0;
    bool converged = false;
    bool definite = true;
    bool cancelled = false;
};

// Finds the state in which the free variables are in equilibrium, by rounds of corrections: each begins with the true
// residual, so that what the recursion of conjugate gradients loses to rounding is made good.
class Solve {
public:
    Solve(const Bodies& bodies, const Visible& visible, const Constraints& constraints, const Operator& matrix,
          const Preconditioner& preconditioner);

    Result run(const Question& question, const KeptStates& kept);
    // A new preconditioner measures rounding anew.
    void forget_rounding() { rounded_ = 0.0; }
    Vec answer() const { return best_; }        // v, expressed variables included
    Vec correction() const { return best_z_; }  // M r there, likewise

private:
    void begin(const Question& question, const KeptStates& kept);
    double residual(const Question& question);  // r at v; returns the size of the state
    double precondition();                      // z = M r; returns sqrt(r.z)
    double rounding(const Question& question);
    // The sizes of the terms of the residual, in work_.
    void residual_sizes(const Question& question);
    // The same, times what rounding may make of each, in largest_. False: they are not known.
    bool largest_rounding(const Question& question);
    bool confirms(const Question& question, Vec recursion);
    Result rounds(const Question& question);
    bool iterate(const Question& question, const Restarts& restarts, double& size, Result& result);
    // True if a tolerance asks for all that rounding leaves.
    static bool asks_for_all(const Restarts& restarts);

    const Bodies& bodies_;
    const Visible& visible_;
    const Constraints& constraints_;
    const Operator& operator_;
    const Preconditioner& preconditioner_;
    Iterations iterations_;
    double rounded_ = 0.0;  // of the residual over the size, once it has been estimated
    OwnedVec recursion_, right_, rest_, v_, av_, cv_, r_, z_, x_, work_, best_, best_z_, largest_;
};

}  // namespace delam::petsc
