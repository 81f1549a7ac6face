// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/sparse/engine/engine_calls.hpp"

#include <algorithm>
#include <cmath>
#include <exception>

#include "base/cancel_scope.hpp"
#include "base/error.hpp"
#include "base/numbers.hpp"
#include "reduction/sparse/engine/engine_variables.hpp"

namespace delam {

namespace {

// Arguments of the callbacks of a solve. An exception waits until the engine has returned.
struct Calls {
    const BodySolver::Forcing& forcing;
    Monitor& monitor;
    bool reading;  // only a request made during the call stops it
    std::int64_t iteration = 0;
    std::exception_ptr stopped{};
};

extern "C" double ask_enough(double first, void* user) {
    auto& calls = *static_cast<Calls*>(user);
    try {
        return calls.forcing(first);
    } catch (...) {
        calls.stopped = std::current_exception();
        return 0.0;
    }
}

extern "C" std::int32_t ask_to_stop(void* user) {
    auto& calls = *static_cast<Calls*>(user);
    try {
        if (calls.stopped) return 1;
        if (calls.reading)
            poll_cancel_now("linear solve");
        else
            calls.monitor.progress("linear solve", ++calls.iteration, 0);
    } catch (...) {
        calls.stopped = std::current_exception();
    }
    return calls.stopped ? 1 : 0;
}

bool finite(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

void require_numbers(const EngineCalls::Answer& answer) {
    const delam_experimental_answer& a = answer.numbers;
    const double scalars[] = {a.first, a.norm, a.size, a.least, a.rounding};
    for (const std::span<const double> list :
         {std::span<const double>(answer.state), std::span<const double>(answer.products),
          std::span<const double>(answer.correction), std::span<const double>(answer.correction_balance),
          std::span<const double>(scalars)})
        if (!finite(list)) fail(DELAM_ERROR_NUMERICAL, "engine: solve: the answer is not finite");
    // 64 bits hold the sum of more solves than an analysis can make.
    constexpr std::int64_t most = std::int64_t{1} << 32;
    if (a.iterations < 0 || a.iterations > most)
        fail(DELAM_ERROR_NUMERICAL, "engine: solve: iterations = ", a.iterations, ", allowed: 0 to ", most);
}

void require_sizes(std::span<const double> sizes, const char* what) {
    for (std::size_t i = 0; i < sizes.size(); ++i)
        if (!(sizes[i] >= 0.0 && std::isfinite(sizes[i])))
            fail(DELAM_ERROR_NUMERICAL, "engine: prepare: ", what, "[", i, "] = ", sizes[i], ", allowed: >= 0");
}

}  // namespace

EngineEntries::EngineEntries(const SparseMatrix& matrix) {
    for (std::int64_t r = 0; r < matrix.rows; ++r)
        for (std::int64_t e = matrix.start[index(r)]; e < matrix.start[index(r) + 1]; ++e)
            if (matrix.value[index(e)] != 0.0) add(r, matrix.column[index(e)], matrix.value[index(e)]);
}

void EngineEntries::add(std::int64_t row, std::int64_t column, double value) {
    rows_.push_back(row);
    columns_.push_back(column);
    values_.push_back(value);
}

EngineCalls::~EngineCalls() {
    if (prepared()) engine_->owner = nullptr;
}

EngineCalls::Sizes EngineCalls::prepare(const BodySystem& bodies) {
    engine_->owner = nullptr;
    poll_cancel_now("engine");
    const EngineVariables variables(bodies);
    const delam_experimental_variables view = variables.view();
    Sizes sizes{std::vector<double>(index(bodies.variables().trailing()), 0.0),
                std::vector<double>(bodies.problem().patterns.size(), 0.0)};
    engine_->require(functions().prepare(&view, sizes.diagonal.data(), sizes.loads.data(), functions().user),
                     "prepare");
    require_sizes(sizes.diagonal, "diagonal");
    require_sizes(sizes.loads, "load_sizes");
    engine_->owner = this;
    return sizes;
}

void EngineCalls::set(const EngineEntries& couplings, std::span<const std::int64_t> fixed,
                      std::span<const std::int64_t> pivots, const EngineEntries& masters) const {
    const delam_experimental_entries acting = couplings.view(), of_pivots = masters.view();
    engine_->require(
        functions().set(&acting, static_cast<std::int64_t>(fixed.size()), fixed.data(),
                        static_cast<std::int64_t>(pivots.size()), pivots.data(), &of_pivots, functions().user),
        "set");
}

double EngineCalls::renew(const EngineEntries& entries) const {
    const delam_experimental_entries view = entries.view();
    double worth = 0.0;
    engine_->require(functions().renew(&view, &worth, functions().user), "renew");
    return worth;
}

EngineCalls::Answer EngineCalls::solve(const Question& question, const EngineLayout& at) const {
    Answer answer;
    answer.state.assign(at.size(), 0.0);
    const std::span<double> state = answer.state;
    answer.correction.assign(at.variables(state).size(), 0.0);
    answer.correction_balance.assign(at.variables(state).size(), 0.0);
    answer.products.assign(at.weights(state).size(), 0.0);
    delam_experimental_answer& a = answer.numbers;
    a.values = at.variables(state).data();
    a.balance = at.balance(state).data();
    a.correction = answer.correction.data();
    a.correction_balance = answer.correction_balance.data();
    a.products = answer.products.data();
    a.work = at.done(state).data();
    a.lifted = at.lifted(state).data();
    Calls calls{question.forcing, monitor_, question.reading};
    delam_experimental_request request{};
    request.theta = question.theta.data();
    request.force = question.force.data();
    request.right = question.right.data();
    request.start = question.start.empty() ? nullptr : question.start.data();
    request.place = static_cast<std::int64_t>(question.place);
    request.tolerance = question.tolerance;
    request.limit = question.limit;
    request.enough = question.forcing ? ask_enough : nullptr;
    request.poll = ask_to_stop;
    request.user = &calls;
    const std::int32_t status = functions().solve(&request, &a, functions().user);
    if (calls.stopped) std::rethrow_exception(calls.stopped);
    engine_->require(status, "solve");
    a.values = a.balance = a.correction = a.correction_balance = a.products = a.work = a.lifted = nullptr;
    if (answer.definite()) require_numbers(answer);
    return answer;
}

void EngineCalls::recover(std::span<const double> weights, std::span<double> displacement,
                          std::span<double> stressed) const {
    engine_->require(functions().recover(weights.data(), displacement.data(), stressed.data(), functions().user),
                     "recover");
    if (!finite(displacement) || !finite(stressed))
        fail(DELAM_ERROR_NUMERICAL, "engine: recover: the fields are not finite");
}

bool EngineCalls::recover_within(std::span<const double> weights, std::vector<double> moved) const {
    const std::int32_t status =
        functions().recover(weights.data(), moved.empty() ? nullptr : moved.data(), nullptr, functions().user);
    if (!moved.empty() && status == DELAM_ERROR_PROBLEM) return false;
    engine_->require(status, "recover");
    return true;
}

}  // namespace delam
