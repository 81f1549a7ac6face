// SPDX-License-Identifier: BSD-3-Clause
// The solver: load steps, energies, fields, fronts. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_SOLVER_HPP
#define DELAM_CPP_SOLVER_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "delam/cpp/argument.hpp"
#include "delam/cpp/law.hpp"
#include "delam/cpp/problem.hpp"
#include "delam/cpp/shared.hpp"
#include "delam/cpp/status.hpp"
#include "delam/delam.h"

namespace delam {

// A field: values of nodes, cells or pairs.
struct Field {
    std::int64_t rows, columns;
    std::vector<double> values;  // [rows][columns]
};
// alias: another name for the value, or ""; cost: "free", "reads" (goes over pairs or fronts) or "recovers" (recovers
// the displacements, a sparse solve); scope: "whole", "interface" or "pattern".
struct ValueInfo {
    std::string alias, unit, cost, scope, meaning;
    bool recorded;  // record() takes it
};
// The first step of which values are recorded, and how many there are.
struct RecordedSteps {
    std::int64_t first, count;
};
// Volume, and means of strain and stress in the order of delam_solver_average.
struct Average {
    double volume;
    std::array<double, 6> strain, stress;
};
// At the factors theta the energy of bodies and dead forces is 1/2 x.S x - theta.L x + 1/2 theta.A theta, and the local
// jumps of all pairs are N x + O theta.
struct Condensed {
    std::int64_t unknowns;
    std::vector<double> stiffness;  // S [unknowns][unknowns]
    std::vector<double> load;       // L [patterns][unknowns]
    std::vector<double> constant;   // A [patterns][patterns]
    Matrix jump;                    // N, one row for each component of each pair
    std::vector<double> offset;     // O [rows of N][patterns]
};
// Crack fronts: points of front i are those from starts[i] to starts[i + 1].
struct Fronts {
    std::vector<std::int64_t> starts;
    std::vector<std::int32_t> closed;
    std::vector<double> places, directions, lengths, rates, zone_lengths, zone_pairs;
};
// A decision of the plan, why it was made, what it costs and saves, in `unit`.
struct PlanItem {
    std::string subject, decision, reason;
    double cost, saving;
    std::string unit;
};
// An unstable advance of a crack: energies before minus after, and where it was.
struct Jump {
    std::int64_t step;
    double before, time, stored, dissipated, released, debonded;
    std::int64_t interface_index, first_pair, last_pair;
    std::vector<double> reaction_before, reaction_after;  // [patterns]
};

// The analysis: load steps, which are committed or rolled back, and what they give.
class Solver {
public:
    Solver(const Problem& problem, double time)
        : shared_(problem.shared()), laws_(problem.host_laws()), patterns_(problem.pattern_count()) {
        delam_solver* made = nullptr;
        const auto status = delam_solver_create(problem.get(), time, &made);
        take(status, made);
    }
    // Shares the condensed bodies of another solver, if they are equal (delam_solver_create_like).
    Solver(const Problem& problem, double time, const Solver& other)
        : shared_(problem.shared()), laws_(problem.host_laws()), patterns_(problem.pattern_count()) {
        delam_solver* made = nullptr;
        const auto status = delam_solver_create_like(problem.get(), other.get(), time, &made);
        take(status, made);
    }

    // Returns the handle of C.
    delam_solver* get() const noexcept { return handle_.get(); }
    // Outcome of the displacement step at the initial time: done or not_converged.
    Outcome initial() const noexcept { return initial_; }

    [[nodiscard]] Outcome advance(double time) {
        return static_cast<Outcome>(shared_->settle(delam_solver_advance(get(), time)));
    }
    // adhesion: of all pairs; empty: the committed one.
    [[nodiscard]] Outcome equilibrate(double time, View<double> adhesion = {}) {
        detail::require(adhesion.size() == 0 || adhesion.count() == shape("adhesion", -1).rows,
                        "adhesion: not one for each pair of all interfaces");
        const double* values = adhesion.size() == 0 ? nullptr : adhesion.data();
        return static_cast<Outcome>(shared_->settle(delam_solver_equilibrate(get(), time, values)));
    }
    void commit() { shared_->check(delam_solver_commit(get())); }
    void rollback() { shared_->check(delam_solver_rollback(get())); }
    // Whether a step is pending, to be committed or rolled back.
    bool pending() const {
        std::int32_t pending = 0;
        shared_->check(delam_solver_pending(get(), &pending));
        return pending != 0;
    }
    // Changes the history of a pattern from the committed time on.
    void set_history(std::int64_t pattern, View<double> times, View<double> values) {
        detail::require(times.size() == values.size(), "times and values: unequal sizes");
        shared_->check(delam_solver_set_history(get(), pattern, times.count(), times.data(), values.data()));
    }

    double value(Text key) {
        double value = 0.0;
        shared_->check(delam_solver_value(get(), key.get(), &value));
        return value;
    }
    std::vector<std::string> value_names() const {
        std::int64_t count = 0;
        shared_->check(delam_solver_value_count(get(), &count));
        std::vector<std::string> names;
        for (std::int64_t i = 0; i < count; ++i) names.push_back(detail::copy(delam_solver_value_name(get(), i)));
        return names;
    }
    // What each value is, in the order of value_names().
    std::vector<ValueInfo> value_infos() const {
        std::int64_t count = 0;
        shared_->check(delam_solver_value_count(get(), &count));
        std::vector<ValueInfo> infos;
        for (std::int64_t i = 0; i < count; ++i) {
            const char *alias = nullptr, *unit = nullptr, *cost = nullptr, *scope = nullptr, *meaning = nullptr;
            std::int32_t recorded = 0;
            shared_->check(delam_solver_value_info(get(), i, &alias, &unit, &cost, &scope, &meaning, &recorded));
            infos.push_back({detail::copy(alias), detail::copy(unit), detail::copy(cost), detail::copy(scope),
                             detail::copy(meaning), recorded != 0});
        }
        return infos;
    }
    // Records this value for the committed state and, with each later commit(), for every further step.
    void record(Text key) { shared_->check(delam_solver_record(get(), key.get())); }
    // Range of the recorded steps: from the first to the committed one.
    RecordedSteps recorded_steps() const {
        RecordedSteps steps{};
        shared_->check(delam_solver_recorded_size(get(), &steps.first, &steps.count));
        return steps;
    }
    // A recorded value for each step; NaN for steps before it was requested.
    std::vector<double> recorded(Text key) const {
        std::vector<double> values(detail::length(recorded_steps().count));
        const auto capacity = static_cast<std::int64_t>(values.size());
        shared_->check(delam_solver_recorded(get(), key.get(), capacity, values.data()));
        return values;
    }
    // part: an interface, for the fields of pairs; -1 for other fields, and for all interfaces.
    Field field(Text key, std::int64_t part = -1) {
        Field field = shape(key, part);
        field.values.resize(detail::length(field.rows * field.columns));
        shared_->check(delam_solver_field(get(), key.get(), part, field.rows * field.columns, field.values.data()));
        return field;
    }
    // Writes to the caller's buffer.
    void field(Text key, std::int64_t part, double* values, std::size_t size) {
        shared_->check(delam_solver_field(get(), key.get(), part, static_cast<std::int64_t>(size), values));
    }
    // Only the numbers of rows and columns.
    Field shape(Text key, std::int64_t part = -1) const {
        Field field{};
        shared_->check(delam_solver_field_shape(get(), key.get(), part, &field.rows, &field.columns));
        return field;
    }
    Average average(std::int32_t body = -1) const {
        Average average{};
        shared_->check(
            delam_solver_average(get(), body, &average.volume, average.strain.data(), average.stress.data()));
        return average;
    }
    Fronts fronts(std::int64_t interface_index) const {
        std::int64_t count = 0;
        std::int64_t points = 0;
        shared_->check(delam_solver_front_count(get(), interface_index, &count, &points));
        const auto n = detail::length(points);
        const auto space = detail::length(shape("jump", interface_index).columns);
        Fronts fronts;
        fronts.starts.resize(detail::length(count) + 1);
        fronts.closed.resize(detail::length(count));
        fronts.places.resize(n * space);
        fronts.directions.resize(n * space);
        fronts.lengths.resize(n);
        fronts.rates.resize(3 * n);
        fronts.zone_lengths.resize(n);
        fronts.zone_pairs.resize(n);
        shared_->check(delam_solver_front(get(), interface_index, count, points, fronts.starts.data(),
                                          fronts.closed.data(), fronts.places.data(), fronts.directions.data(),
                                          fronts.lengths.data(), fronts.rates.data(), fronts.zone_lengths.data(),
                                          fronts.zone_pairs.data()));
        return fronts;
    }
    // [patterns][patterns]: at fixed adhesion and contact; for a pending step, damage included.
    std::vector<double> tangent() { return tangent_by(delam_solver_tangent); }
    std::vector<double> step_tangent() { return tangent_by(delam_solver_step_tangent); }
    Condensed condensed() const {
        std::int64_t unknowns = 0;
        std::int64_t entries = 0;
        shared_->check(delam_solver_condensed_size(get(), &unknowns, &entries));
        const Field jump = shape("jump");
        const auto rows = detail::length(jump.rows * jump.columns);
        Condensed all;
        all.unknowns = unknowns;
        all.stiffness.resize(detail::length(unknowns * unknowns));
        all.load.resize(detail::length(patterns_ * unknowns));
        all.constant.resize(detail::length(patterns_ * patterns_));
        all.jump.row_starts.resize(rows + 1);
        all.jump.columns.resize(detail::length(entries));
        all.jump.values.resize(detail::length(entries));
        all.offset.resize(rows * detail::length(patterns_));
        shared_->check(delam_solver_condensed(get(), unknowns * unknowns, all.stiffness.data(), all.load.data(),
                                              all.constant.data(), all.jump.row_starts.data(), all.jump.columns.data(),
                                              all.jump.values.data(), all.offset.data()));
        return all;
    }

    std::string plan() { return delam_solver_plan(get()); }
    std::vector<PlanItem> plan_items() const {
        std::int64_t count = 0;
        shared_->check(delam_solver_plan_count(get(), &count));
        std::vector<PlanItem> items;
        for (std::int64_t i = 0; i < count; ++i) {
            const char *subject = nullptr, *decision = nullptr, *reason = nullptr, *unit = nullptr;
            double cost = 0.0;
            double saving = 0.0;
            shared_->check(delam_solver_plan_item(get(), i, &subject, &decision, &reason, &cost, &saving, &unit));
            items.push_back({detail::copy(subject), detail::copy(decision), detail::copy(reason), cost, saving,
                             detail::copy(unit)});
        }
        return items;
    }
    // "" for an unknown key.
    std::string option(Text key) const { return detail::copy(delam_solver_option(get(), key.get())); }
    std::string searched() const { return delam_solver_searched(get()); }
    // -1: back to the pending state, or the committed one if none is pending.
    void look(std::int64_t step) { shared_->check(delam_solver_look(get(), step)); }
    std::vector<Jump> jumps() const {
        std::int64_t count = 0;
        shared_->check(delam_solver_jump_count(get(), &count));
        std::vector<Jump> jumps;
        for (std::int64_t i = 0; i < count; ++i) {
            Jump jump{};
            shared_->check(delam_solver_jump(get(), i, &jump.step, &jump.before, &jump.time, &jump.stored,
                                             &jump.dissipated, &jump.released, &jump.debonded, &jump.interface_index,
                                             &jump.first_pair, &jump.last_pair));
            jump.reaction_before.resize(detail::length(patterns_));
            jump.reaction_after.resize(detail::length(patterns_));
            shared_->check(delam_solver_jump_reactions(get(), i, patterns_, jump.reaction_before.data(),
                                                       jump.reaction_after.data()));
            jumps.push_back(std::move(jump));
        }
        return jumps;
    }
    std::vector<std::uint8_t> save() const {
        std::int64_t needed = 0;
        shared_->check(delam_solver_save(get(), 0, nullptr, &needed));
        std::vector<std::uint8_t> bytes(detail::length(needed));
        shared_->check(delam_solver_save(get(), needed, bytes.data(), &needed));
        return bytes;
    }
    void load(View<std::uint8_t> bytes) { shared_->check(delam_solver_load(get(), bytes.count(), bytes.data())); }
    // The same bytes in a file.
    void save(const std::filesystem::path& path) const { shared_->check(delam_solver_save_file(get(), path.c_str())); }
    void load(const std::filesystem::path& path) { shared_->check(delam_solver_load_file(get(), path.c_str())); }

private:
    void take(std::int32_t status, delam_solver* made) {
        handle_.reset(made);
        initial_ = static_cast<Outcome>(shared_->settle(status));
        if (!handle_) shared_->fail(status);
    }
    std::vector<double> tangent_by(std::int32_t (*function)(delam_solver*, std::int64_t, double*)) {
        std::vector<double> matrix(detail::length(patterns_ * patterns_));
        shared_->check(function(get(), patterns_ * patterns_, matrix.data()));
        return matrix;
    }

    std::shared_ptr<detail::Shared> shared_;
    std::vector<std::shared_ptr<detail::HostLaw>> laws_;
    std::int64_t patterns_;
    detail::Handle<delam_solver, delam_solver_destroy> handle_;
    Outcome initial_ = Outcome::done;
};

}  // namespace delam

#endif
