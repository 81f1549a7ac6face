// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <memory>
#include <vector>

#include "delam/experimental.h"
#include "petsc/bodies/mesh_fields.hpp"
#include "petsc/bodies/part_state.hpp"
#include "petsc/solve/solve.hpp"

namespace delam::petsc {

enum class Recovered : std::int32_t { nothing, on_root, on_ranks };

// The functions of delam_experimental_engine, as the ranks do them together: one object from `prepare` to the next. All
// functions are collective; their pointers are those of rank 0, and NULL elsewhere.
class Engine {
public:
    struct Counts {
        double solves = 0.0, iterations = 0.0, renewals = 0.0;
    };

    Engine(const Communicator& comm, const Part& part, const delam_experimental_variables* variables, Counts& counts);
    Engine(const Engine&) = delete;
    Engine& operator=(const Engine&) = delete;

    void sizes(double* diagonal, double* load_sizes) const;
    void set(const delam_experimental_entries* couplings, std::int64_t fixed_count, const std::int64_t* fixed,
             std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries* masters);
    void renew(const delam_experimental_entries* entries, double* cost);
    // Returns true unless the solve was given up.
    bool solve(const delam_experimental_request* request, delam_experimental_answer* answer);
    // Recovers fields. Where rank 0 has no force to fill, each rank keeps the fields of its part, in `kept`, with rank
    // 0's eigenstrains; displacement then has rigid motions, which are added, or is NULL. Nothing: the ranks have nodes
    // that the mesh lacks, whose motions are not known.
    Recovered recover(const double* weights, double* displacement, double* force,
                      const PartState::Eigenstrains& eigenstrains, PartState& kept);
    const Preconditioner& preconditioner() const { return preconditioner_; }

private:
    Question share(const delam_experimental_request* request) const;
    bool has_other_nodes() const;
    std::vector<double> here(const double* field) const;
    void answer(const Question& question, delam_experimental_answer* out);
    double relative_rounding(const BodyState& state, Vec v, Vec work) const;

    const Communicator& comm_;
    Counts& counts_;
    SceneVariables scene_;
    Bodies bodies_;
    Visible visible_;
    Constraints constraints_;
    Operator operator_;
    Preconditioner preconditioner_;
    Solve solve_;
    KeptStates kept_;
    std::unique_ptr<MeshFields> fields_;
    std::int64_t pivot_count_ = 0;
};

}  // namespace delam::petsc
