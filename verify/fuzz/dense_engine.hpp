// SPDX-License-Identifier: BSD-3-Clause
// An engine (delam/experimental.h) of the smallest kind: dense matrices, one exact solve. It can be made to fail and to
// answer nonsense.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "delam/experimental.h"

namespace fuzz {

// Row after row.
class Dense {
public:
    Dense() = default;
    Dense(std::size_t rows, std::size_t columns) : rows(rows), columns(columns), value(rows * columns, 0.0) {}
    double& operator()(std::size_t r, std::size_t c) { return value[r * columns + c]; }
    double operator()(std::size_t r, std::size_t c) const { return value[r * columns + c]; }
    [[nodiscard]] std::vector<double> times(const std::vector<double>& x) const;
    [[nodiscard]] std::vector<double> transposed_times(const std::vector<double>& x) const;

    std::size_t rows = 0, columns = 0;
    std::vector<double> value;
};

// The stiffness of all bodies over the DOFs of the mesh, as delam_problem_body_matrix returns it. Where mesh is NULL or
// that of another problem, a diagonal matrix, in which nothing fits the scene.
Dense stiffness_of(const delam_mesh* mesh, const delam_problem* problem);

class DenseEngine {
public:
    explicit DenseEngine(Dense stiffness) : k_(std::move(stiffness)) {}
    DenseEngine(const DenseEngine&) = delete;
    DenseEngine& operator=(const DenseEngine&) = delete;

    // In the place of the stiffness that it has, before any problem took the engine.
    void take(Dense stiffness) { k_ = std::move(stiffness); }

    // Calls this object, which has to outlive the engine's release.
    delam_experimental_engine functions();

    enum class Nonsense : std::int32_t {
        none,
        not_finite,
        huge,
        negative_iterations,
        many_iterations,
        not_converged,
        indefinite,
        no_message,
        count
    };
    // Kind of the answers and diagonals, where `spoiled` says so.
    Nonsense nonsense = Nonsense::none;
    // The engine fails in the call after `fail_in` others (-1: never) and returns fail_with.
    std::int64_t fail_in = -1;
    std::int32_t fail_with = DELAM_ERROR_NUMERICAL;
    // No input may run for ever: then every call fails.
    std::int64_t calls_at_most = 1000000;
    // True if faults occur at all: a host that only reads an object leaves them out.
    bool awake = true;
    bool failed = false;  // since it was reset
    std::int64_t calls = 0, released = 0;

private:
    using Values = std::vector<double>;
    bool spoils(Nonsense what);
    bool fails();
    void spoil(double* values, std::size_t count);
    void prepare(const delam_experimental_variables& v, double* diagonal, double* load_sizes);
    void set(const delam_experimental_entries& couplings, std::int64_t fixed_count, const std::int64_t* fixed,
             std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries& masters);
    std::int32_t solve(const delam_experimental_request& request, delam_experimental_answer& answer);
    void recover(const double* weights, double* displacement, double* force) const;
    void keep(const delam_experimental_request& request, delam_experimental_answer& answer, const Values& v);

    Dense k_, t_, a_, couplings_, spread_;
    std::vector<std::size_t> visible_, pivots_;
    std::vector<Values> lift_, force_, load_, kept_;
    std::string message_;
};

}  // namespace fuzz
