// SPDX-License-Identifier: BSD-3-Clause
// delam_solver_*: the façade of the analysis.
#include <algorithm>
#include <cstring>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/file.hpp"
#include "base/numbers.hpp"
#include "base/team.hpp"
#include "capi/handle/handles.hpp"
#include "evolution/analysis/condensed_matrices.hpp"
#include "evolution/analysis/plan.hpp"
#include "evolution/analysis/snapshot.hpp"
#include "evolution/analysis/solver.hpp"
#include "evolution/observe/fields.hpp"
#include "evolution/observe/values.hpp"

using namespace delam;

namespace {

// A positive outcome leaves the object valid and stores its text in the context.
std::int32_t report(Context& context, const Outcome& outcome) {
    return outcome.status == DELAM_OK ? DELAM_OK : delam::report(context, outcome.status, outcome.text.c_str());
}

template <class T>
void copy_out(const std::vector<T>& values, std::int64_t capacity, T* out, const char* name) {
    require_capacity(capacity, static_cast<std::int64_t>(values.size()), name);
    require_array(out, static_cast<std::int64_t>(values.size()), name);
    std::copy(values.begin(), values.end(), out);
}

const std::vector<CrackFront>& fronts_of(const delam_solver& solver, std::int64_t interface_index) {
    const auto count = static_cast<std::int64_t>(solver.core->problem().interfaces.size());
    return solver.core->observer().crack_fronts(require_index(interface_index, count, 0, "interface_index"));
}

// Does what guard_solve() does, with as many threads of the library as the options of the scene ask for.
template <class Body>
std::int32_t guard_step(delam_solver* solver, Listed listed, Body&& body) noexcept {
    return guard_solve(solver, listed, [&] {
        const TeamScope team(useful_threads(solver->core->problem().options.threads));
        return body();
    });
}

std::int32_t create(const delam_problem& problem, const Solver* other, double time, delam_solver** out) {
    require_pointer(out, "out");
    require_finite(&time, 1, "time");
    const TeamScope team(useful_threads(problem.core->options.threads));
    auto handle = std::make_unique<delam_solver>();
    handle->context = problem.context;
    handle->core = std::make_shared<Solver>(*problem.core, problem.context->monitor, time, other);
    handle->value_names = value_names(handle->core->problem());
    handle->plan = plan_of(*handle->core);
    const Outcome& outcome = handle->core->initial_outcome();
    *out = handle.release();
    return report(*problem.context, outcome);
}

}  // namespace

extern "C" {

int32_t delam_solver_create(const delam_problem* problem, double time, delam_solver** out) {
    if (out != nullptr) *out = nullptr;
    return guard_solve(problem, listed::solver_create, [&] { return create(*problem, nullptr, time, out); });
}

int32_t delam_solver_create_like(const delam_problem* problem, const delam_solver* other, double time,
                                 delam_solver** out) {
    if (out != nullptr) *out = nullptr;
    return guard_solve(problem, listed::solver_create_like, [&] {
        if (other != nullptr) {
            if (!alive(other)) fail(DELAM_ERROR_HANDLE, "other: no solver, or a destroyed one");
            if (other->context != problem->context)
                fail(DELAM_ERROR_ARGUMENT, "other: a solver of another context than the problem's");
        }
        return create(*problem, other != nullptr ? other->core.get() : nullptr, time, out);
    });
}

int32_t delam_solver_shares_bodies(const delam_solver* solver, const delam_problem* problem, int32_t* shares) {
    return guard(solver, [&] {
        require_pointer(shares, "shares");
        if (!alive(problem)) fail(DELAM_ERROR_HANDLE, "problem: no problem, or a destroyed one");
        *shares = share_bodies(*solver->core, *problem->core) ? 1 : 0;
    });
}

void delam_solver_destroy(delam_solver** solver) { destroy(solver); }

int32_t delam_solver_advance(delam_solver* solver, double time) {
    return guard_step(solver, listed::solver_advance,
                      [&] { return report(*solver->context, solver->stages.advance(solver->core, time)); });
}

int32_t delam_solver_commit(delam_solver* solver) {
    return guard(solver, listed::solver_commit, [&] { solver->stages.commit(solver->core); });
}

int32_t delam_solver_rollback(delam_solver* solver) {
    return guard(solver, [&] { solver->stages.rollback(solver->core); });
}

int32_t delam_solver_pending(const delam_solver* solver, int32_t* pending) {
    return guard(solver, [&] {
        require_pointer(pending, "pending");
        *pending = solver->core->states().pending() != nullptr ? 1 : 0;
    });
}

int32_t delam_solver_set_history(delam_solver* solver, int64_t pattern, int64_t count, const double* times,
                                 const double* values) {
    return guard(solver, [&] {
        const auto patterns = static_cast<std::int64_t>(solver->core->problem().patterns.size());
        require_index(pattern, patterns, 0, "pattern");
        require_history(count, times, values);
        solver->core->set_history(pattern, {times, index(count)}, {values, index(count)});
    });
}

int32_t delam_solver_equilibrate(delam_solver* solver, double time, const double* adhesion) {
    return guard_step(solver, listed::solver_equilibrate, [&] {
        std::span<const double> held;
        if (adhesion != nullptr) held = {adhesion, solver->core->states().committed().adhesion.size()};
        return report(*solver->context, solver->core->equilibrate(time, held));
    });
}

int32_t delam_solver_value(delam_solver* solver, const char* key, double* out) {
    return guard_read(solver, listed::solver_value, [&] {
        require_pointer(key, "key");
        require_pointer(out, "value");
        *out = value(*solver->core, key);
    });
}

int32_t delam_solver_value_count(const delam_solver* solver, int64_t* count) {
    return guard(solver, [&] {
        require_pointer(count, "count");
        *count = static_cast<int64_t>(solver->value_names.size());
    });
}

const char* delam_solver_value_name(const delam_solver* solver, int64_t index) {
    const char* name = nullptr;
    guard(solver, [&] {
        const auto count = static_cast<int64_t>(solver->value_names.size());
        if (index < 0 || index >= count)
            fail(DELAM_ERROR_ARGUMENT, "value index ", index, ", allowed: 0 to ", count - 1);
        name = solver->value_names[static_cast<std::size_t>(index)].c_str();
    });
    return name;
}

int32_t delam_solver_value_info(const delam_solver* solver, int64_t index, const char** alias, const char** unit,
                                const char** cost, const char** scope, const char** meaning, int32_t* recorded) {
    return guard(solver, [&] {
        const auto count = static_cast<int64_t>(solver->value_names.size());
        require_index(index, count, 0, "index");
        const ValueInfo* info = find_value(solver->value_names[static_cast<std::size_t>(index)]);
        if (info == nullptr) fail(DELAM_ERROR_INTERNAL, "value ", index, " has no row");
        if (alias != nullptr) *alias = info->alias;
        if (unit != nullptr) *unit = info->unit;
        if (cost != nullptr) *cost = name_of(info->cost);
        if (scope != nullptr) *scope = name_of(info->scope);
        if (meaning != nullptr) *meaning = info->meaning;
        if (recorded != nullptr) *recorded = info->unrecorded == nullptr ? 1 : 0;
    });
}

int32_t delam_solver_record(delam_solver* solver, const char* key) {
    return guard(solver, listed::solver_record, [&] {
        require_pointer(key, "key");
        solver->core->record(key);
    });
}

int32_t delam_solver_recorded_size(const delam_solver* solver, int64_t* first, int64_t* steps) {
    return guard(solver, [&] {
        const Record& record = solver->core->recorded();
        if (first != nullptr) *first = record.first();
        if (steps != nullptr) *steps = record.steps();
    });
}

int32_t delam_solver_recorded(const delam_solver* solver, const char* key, int64_t capacity, double* values) {
    return guard(solver, [&] {
        require_pointer(key, "key");
        const Record& record = solver->core->recorded();
        const Record::Column* column = record.find(value_key(key));
        if (column == nullptr) {
            std::string kept;
            for (const Record::Column& other : record.columns()) kept += (kept.empty() ? "" : ", ") + other.key;
            fail(DELAM_ERROR_ARGUMENT, "value '", key,
                 "' is not recorded (delam_solver_record); recorded: ", kept.empty() ? "none" : kept);
        }
        copy_out(column->values, capacity, values, "values");
    });
}

int32_t delam_solver_field_shape(const delam_solver* solver, const char* key, int64_t part, int64_t* rows,
                                 int64_t* columns) {
    return guard(solver, [&] {
        require_pointer(key, "key");
        const FieldShape shape = field_shape(solver->core->observer(), key, part);
        if (rows != nullptr) *rows = shape.rows;
        if (columns != nullptr) *columns = shape.columns;
    });
}

int32_t delam_solver_field(delam_solver* solver, const char* key, int64_t part, int64_t capacity, double* values) {
    return guard_read(solver, listed::solver_field, [&] {
        require_pointer(key, "key");
        const FieldShape shape = field_shape(solver->core->observer(), key, part);
        require_capacity(capacity, shape.rows * shape.columns, "values");
        copy_out(field(solver->core->observer(), key, part), capacity, values, "values");
    });
}

int32_t delam_solver_front_count(const delam_solver* solver, int64_t interface_index, int64_t* fronts,
                                 int64_t* points) {
    return guard(solver, listed::solver_front_count, [&] {
        const std::vector<CrackFront>& found = fronts_of(*solver, interface_index);
        if (fronts != nullptr) *fronts = static_cast<int64_t>(found.size());
        if (points == nullptr) return;
        *points = 0;
        for (const CrackFront& front : found) *points += static_cast<int64_t>(front.points.size());
    });
}

int32_t delam_solver_front(const delam_solver* solver, int64_t interface_index, int64_t front_capacity,
                           int64_t point_capacity, int64_t* starts, int32_t* closed, double* places, double* directions,
                           double* lengths, double* rates, double* zone_lengths, double* zone_pairs) {
    return guard(solver, listed::solver_front, [&] {
        const std::vector<CrackFront>& found = fronts_of(*solver, interface_index);
        const auto dim = static_cast<std::size_t>(solver->core->problem().mesh->dimension());
        std::size_t points = 0;
        for (const CrackFront& front : found) points += front.points.size();
        require_capacity(front_capacity, static_cast<int64_t>(found.size()), "fronts");
        require_capacity(point_capacity, static_cast<int64_t>(points), "points");
        std::size_t at = 0;
        for (std::size_t f = 0; f < found.size(); ++f) {
            if (starts != nullptr) starts[f] = static_cast<int64_t>(at);
            if (closed != nullptr) closed[f] = found[f].closed ? 1 : 0;
            for (const FrontPoint& point : found[f].points) {
                if (places != nullptr) std::copy_n(point.place.begin(), dim, places + at * dim);
                if (directions != nullptr) std::copy_n(point.direction.begin(), dim, directions + at * dim);
                if (lengths != nullptr) lengths[at] = point.length;
                if (rates != nullptr) std::copy(point.rate.begin(), point.rate.end(), rates + 3 * at);
                if (zone_lengths != nullptr) zone_lengths[at] = point.zone;
                if (zone_pairs != nullptr) zone_pairs[at] = point.zone_pairs;
                ++at;
            }
        }
        if (starts != nullptr) starts[found.size()] = static_cast<int64_t>(at);
    });
}

int32_t delam_solver_average(const delam_solver* solver, int32_t body, double* volume, double* strain, double* stress) {
    return guard_read(solver, listed::solver_average, [&] {
        const Mesh& mesh = *solver->core->problem().mesh;
        const std::int32_t index = body < 0 ? -1 : mesh.body_of_label(body);
        if (body != -1 && index < 0) fail(DELAM_ERROR_ARGUMENT, "body ", body, ": no body has this label");
        if (index >= 0 && mesh.host_body(index))
            fail(DELAM_ERROR_ARGUMENT, "body ", body, " has no cells to average over");
        const VolumeAverage average = solver->core->observer().average(index);
        if (volume != nullptr) *volume = average.volume;
        if (strain != nullptr) std::copy(average.strain.begin(), average.strain.end(), strain);
        if (stress != nullptr) std::copy(average.stress.begin(), average.stress.end(), stress);
    });
}

int32_t delam_solver_tangent(delam_solver* solver, int64_t capacity, double* matrix) {
    return guard_step(solver, listed::solver_tangent, [&] {
        const auto patterns = static_cast<int64_t>(solver->core->problem().patterns.size());
        require_capacity(capacity, patterns * patterns, "matrix");
        copy_out(solver->core->tangent(), capacity, matrix, "matrix");
    });
}

int32_t delam_solver_step_tangent(delam_solver* solver, int64_t capacity, double* matrix) {
    return guard_step(solver, listed::solver_step_tangent, [&] {
        const auto patterns = static_cast<int64_t>(solver->core->problem().patterns.size());
        require_capacity(capacity, patterns * patterns, "matrix");
        copy_out(solver->core->step_tangent(), capacity, matrix, "matrix");
        solver->core->take_whole_steps();
    });
}

int32_t delam_solver_condensed_size(const delam_solver* solver, int64_t* unknowns, int64_t* entries) {
    return guard(solver, listed::solver_condensed_size, [&] {
        const CondensedSize size = condensed_size(*solver->core);
        if (unknowns != nullptr) *unknowns = size.unknowns;
        if (entries != nullptr) *entries = size.entries;
    });
}

int32_t delam_solver_condensed(const delam_solver* solver, int64_t capacity, double* stiffness, double* load,
                               double* constant, int64_t* row_starts, int64_t* columns, double* values,
                               double* offset) {
    return guard_read(solver, listed::solver_condensed, [&] {
        const CondensedSize size = condensed_size(*solver->core);
        require_capacity_if(stiffness != nullptr, capacity, size.unknowns * size.unknowns, "stiffness");
        copy_condensed(*solver->core, {stiffness, load, constant, row_starts, columns, values, offset});
    });
}

const char* delam_solver_plan(delam_solver* solver) {
    const std::int32_t status = guard(solver, [&] { solver->plan_words = plan_in_words(solver->plan); });
    return status == DELAM_OK ? solver->plan_words.c_str() : "";
}

int32_t delam_solver_plan_count(const delam_solver* solver, int64_t* count) {
    return guard(solver, [&] {
        require_pointer(count, "count");
        *count = static_cast<int64_t>(solver->plan.size());
    });
}

int32_t delam_solver_plan_item(const delam_solver* solver, int64_t index, const char** subject, const char** decision,
                               const char** reason, double* cost, double* saving, const char** unit) {
    return guard(solver, [&] {
        const auto count = static_cast<int64_t>(solver->plan.size());
        if (index < 0 || index >= count)
            fail(DELAM_ERROR_ARGUMENT, "plan index ", index, ", allowed: 0 to ", count - 1);
        const PlanItem& item = solver->plan[static_cast<std::size_t>(index)];
        if (subject != nullptr) *subject = item.subject.c_str();
        if (decision != nullptr) *decision = item.decision.c_str();
        if (reason != nullptr) *reason = item.reason.c_str();
        if (cost != nullptr) *cost = item.cost;
        if (saving != nullptr) *saving = item.saving;
        if (unit != nullptr) *unit = item.unit.c_str();
    });
}

const char* delam_solver_option(const delam_solver* solver, const char* key) {
    const char* found = nullptr;
    guard(solver, [&] {
        require_pointer(key, "key");
        solver->option = solver->core->problem().options.value_of(key);
        found = solver->option.c_str();
    });
    return found;
}

const char* delam_solver_searched(const delam_solver* solver) {
    const char* words = "";
    guard(solver, [&] { words = solver->core->states().searched().c_str(); });
    return words;
}

int32_t delam_solver_look(delam_solver* solver, int64_t step) {
    return guard(solver, [&] { solver->core->select(step); });
}

int32_t delam_solver_jump_count(const delam_solver* solver, int64_t* count) {
    return guard(solver, [&] {
        require_pointer(count, "count");
        *count = static_cast<int64_t>(solver->core->states().jumps().size());
    });
}

int32_t delam_solver_jump(const delam_solver* solver, int64_t index, int64_t* step, double* before, double* time,
                          double* stored, double* dissipated, double* released, double* debonded,
                          int64_t* interface_index, int64_t* first_pair, int64_t* last_pair) {
    return guard(solver, [&] {
        const std::vector<JumpEvent> jumps = solver->core->states().jumps();
        const JumpEvent& jump =
            jumps[static_cast<std::size_t>(require_index(index, static_cast<std::int64_t>(jumps.size()), 0, "index"))];
        const auto give = [](auto* out, auto value) {
            if (out != nullptr) *out = value;
        };
        give(step, jump.step);
        give(before, jump.before);
        give(time, jump.time);
        give(stored, jump.stored);
        give(dissipated, jump.dissipated);
        give(released, jump.released);
        give(debonded, jump.debonded);
        give(interface_index, jump.interface);
        give(first_pair, jump.first_pair);
        give(last_pair, jump.last_pair);
    });
}

int32_t delam_solver_jump_reactions(const delam_solver* solver, int64_t index, int64_t capacity, double* before,
                                    double* after) {
    return guard(solver, [&] {
        const std::vector<JumpEvent> jumps = solver->core->states().jumps();
        const auto at =
            static_cast<std::size_t>(require_index(index, static_cast<std::int64_t>(jumps.size()), 0, "index"));
        const std::size_t patterns = solver->core->problem().patterns.size();
        require_capacity_if(before != nullptr || after != nullptr, capacity, static_cast<std::int64_t>(patterns),
                            before != nullptr ? "before" : "after");
        const auto give = [&](double* out, std::vector<double> reactions) {
            if (out == nullptr) return;
            reactions.resize(patterns, std::numeric_limits<double>::quiet_NaN());
            std::copy(reactions.begin(), reactions.end(), out);
        };
        give(before, jumps[at].conjugate_before);
        give(after, jumps[at].conjugate_after);
    });
}

int32_t delam_solver_save(const delam_solver* solver, int64_t capacity, uint8_t* bytes, int64_t* needed) {
    return guard(solver, [&] {
        require_pointer(needed, "needed");
        const std::vector<std::uint8_t> saved = save(solver->stages.committed(*solver->core));
        *needed = static_cast<int64_t>(saved.size());
        if (capacity != 0) copy_out(saved, capacity, bytes, "bytes");
    });
}

int32_t delam_solver_load(delam_solver* solver, int64_t size, const uint8_t* bytes) {
    return guard_step(solver, listed::solver_load, [&] {
        require_count(size, "size");
        require_array(bytes, size, "bytes");
        poll_cancel_now("load");  // a small state would be read before the first poll
        solver->stages.load(solver->core, {bytes, index(size)});
    });
}

int32_t delam_solver_save_file(const delam_solver* solver, const char* path) {
    return guard(solver, [&] {
        require_pointer(path, "path");
        write_file(path, save(solver->stages.committed(*solver->core)));
    });
}

int32_t delam_solver_load_file(delam_solver* solver, const char* path) {
    return guard_step(solver, listed::solver_load_file, [&] {
        require_pointer(path, "path");
        poll_cancel_now("load");
        solver->stages.load_file(solver->core, path);
    });
}

}  // extern "C"
