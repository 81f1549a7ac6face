// SPDX-License-Identifier: BSD-3-Clause
// The problem: materials, laws, supports, loads, options. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_PROBLEM_HPP
#define DELAM_CPP_PROBLEM_HPP

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "delam/cpp/argument.hpp"
#include "delam/cpp/context.hpp"
#include "delam/cpp/law.hpp"
#include "delam/cpp/mesh.hpp"
#include "delam/cpp/shared.hpp"
#include "delam/cpp/status.hpp"
#include "delam/delam.h"

namespace delam {

// A sparse matrix by rows: row i has columns[k] and values[k], k from row_starts[i] to row_starts[i + 1].
struct Matrix {
    std::vector<std::int64_t> row_starts, columns;
    std::vector<double> values;
};
// Prescribed displacements and equations: matrix u = coefficients times the factors of the patterns.
struct Constraints {
    Matrix matrix;
    std::vector<double> coefficients;  // [rows][patterns]
};
// Estimated length of the process zone, and mean distance between pairs.
struct ProcessZone {
    double length, spacing;
};
// Numbers for the law of an interface; 0: unknown or none.
struct Proposal {
    double stiffness;  // the least, 50 E3/t of the adjacent layer
    double share;      // of that layer's stiffness that the present normal stiffness leaves
    double normal_strength, tangential_strength;
};
// What an analysis would do, before it begins.
struct Forecast {
    std::string plan;
    double setup;   // s, of the factorisations before the first step
    double memory;  // bytes, at the peak
};
// Numbers of displacements (primal) and of components of jumps (dual).
struct Dofs {
    std::int64_t primal, dual;
};

// Materials, laws, supports, loads and options of a mesh.
class Problem {
public:
    Problem(const Context& context, const Mesh& mesh) : shared_(context.shared()), dimension_(mesh.dimension()) {
        delam_problem* made = nullptr;
        const auto status = delam_problem_create(context.get(), mesh.get(), &made);
        handle_.reset(made);
        shared_->check(status);
        const std::int64_t interfaces = mesh.size().interfaces;
        for (std::int64_t i = 0; i < interfaces; ++i) pairs_.push_back(mesh.interface_size(i).pairs);
    }

    // Returns the handle of C.
    delam_problem* get() const noexcept { return handle_.get(); }

    void set_plane(Text assumption) { shared_->check(delam_problem_set_plane(get(), assumption.get())); }
    // body -1: for all bodies, here and below.
    void set_elastic(std::int32_t body, double young, double poisson) {
        shared_->check(delam_problem_set_elastic(get(), body, young, poisson));
    }
    // constants: E1 E2 E3 nu12 nu13 nu23 G12 G13 G23
    void set_orthotropic(std::int32_t body, const std::array<double, 9>& constants) {
        shared_->check(delam_problem_set_orthotropic(get(), body, constants.data()));
    }
    // axes: [cells][2][3]
    void set_orientation(std::int32_t body, View<std::int64_t> cells, View<double> axes) {
        detail::require(axes.size() == 6 * cells.size(), "axes: not [cells][2][3]");
        shared_->check(delam_problem_set_orientation(get(), body, cells.count(), cells.data(), axes.data(), 0));
    }
    void set_orientation(std::int32_t body, const std::array<double, 6>& axes) {
        shared_->check(delam_problem_set_orientation(get(), body, 1, nullptr, axes.data(), 0));
    }
    void set_formulation(std::int32_t body, Text formulation) {
        shared_->check(delam_problem_set_formulation(get(), body, formulation.get()));
    }
    // The stiffness of whole bodies as assembled by the host. nodes: all of their nodes, in the order of the rows,
    // unless dofs [nodes][dimension] gives the row of each displacement; kernel: [motions][rows] without energy, empty
    // if there are none; without it the library finds them.
    void set_stiffness(View<std::int64_t> nodes, View<std::int64_t> row_starts, View<std::int64_t> columns,
                       View<double> values, View<std::int64_t> dofs = {},
                       std::optional<View<double>> kernel = std::nullopt) {
        const std::size_t rows = nodes.size() * detail::length(dimension_);
        detail::require(row_starts.size() == rows + 1, "row_starts: not one for each row and one behind the last");
        detail::require(columns.size() == values.size() && row_starts.data()[rows] == values.count(),
                        "columns and values: not as many as row_starts ends with");
        detail::require(dofs.size() == 0 || dofs.size() == rows, "dofs: not [nodes][dimension]");
        detail::require(!kernel || kernel->size() == 0 || (rows > 0 && kernel->size() % rows == 0),
                        "kernel: not a whole number of motions");
        std::int64_t motions = -1;
        if (kernel) motions = kernel->size() == 0 ? 0 : static_cast<std::int64_t>(kernel->size() / rows);
        shared_->check(delam_problem_set_stiffness(
            get(), nodes.count(), nodes.data(), dofs.size() == 0 ? nullptr : dofs.data(), row_starts.data(),
            columns.data(), values.data(), motions, motions > 0 ? kernel->data() : nullptr, 0));
    }
    // The same with a matrix as one argument.
    void set_stiffness(View<std::int64_t> nodes, const Matrix& matrix, View<std::int64_t> dofs = {},
                       std::optional<View<double>> kernel = std::nullopt) {
        set_stiffness(nodes, matrix.row_starts, matrix.columns, matrix.values, dofs, kernel);
    }
    void set_law(std::int64_t interface_index, const Law& law) {
        if (law.host()) laws_.push_back(law.host());
        shared_->check(delam_problem_set_law(get(), interface_index, law.get()));
    }
    void set_bonded(std::int64_t interface_index) { shared_->check(delam_problem_set_bonded(get(), interface_index)); }
    void set_contact(std::int64_t interface_index) {
        shared_->check(delam_problem_set_contact(get(), interface_index));
    }
    void set_adhesion(std::int64_t interface_index, View<std::int64_t> pairs, View<double> adhesion) {
        detail::require(pairs.size() == adhesion.size(), "pairs and adhesion: unequal sizes");
        shared_->check(
            delam_problem_set_adhesion(get(), interface_index, pairs.count(), pairs.data(), adhesion.data(), 0));
    }
    // Of the pairs in a box from lower to upper, [dimension] each; returns their number.
    std::int64_t set_adhesion_box(std::int64_t interface_index, View<double> lower, View<double> upper,
                                  double adhesion = 0.0) {
        in_space(lower.size(), 1);
        in_space(upper.size(), 1);
        std::int64_t count = 0;
        shared_->check(
            delam_problem_set_adhesion_box(get(), interface_index, lower.data(), upper.data(), adhesion, &count));
        return count;
    }

    std::int64_t add_pattern(Text name, View<double> times, View<double> values) {
        detail::require(times.size() == values.size(), "times and values: unequal sizes");
        std::int64_t made = -1;
        shared_->check(delam_problem_add_pattern(get(), name.get(), times.count(), times.data(), values.data(), &made));
        return made;
    }
    // coefficients: [nodes][patterns]; without patterns: fixed at zero.
    void prescribe_nodes(View<std::int64_t> nodes, View<double> direction, View<std::int64_t> patterns = {},
                         View<double> coefficients = {}) {
        in_space(direction.size(), 1);
        detail::require(coefficients.size() == nodes.size() * patterns.size(), "coefficients: not [nodes][patterns]");
        shared_->check(delam_problem_prescribe_nodes(get(), nodes.count(), nodes.data(), direction.data(),
                                                     patterns.count(), patterns.data(), coefficients.data(), 0));
    }
    void prescribe_mean(View<std::int64_t> nodes, View<double> weights, View<double> direction,
                        View<std::int64_t> patterns = {}, View<double> coefficients = {}) {
        in_space(direction.size(), 1);
        detail::require(weights.size() == nodes.size() && coefficients.size() == patterns.size(),
                        "nodes and weights, patterns and coefficients: unequal sizes");
        shared_->check(delam_problem_prescribe_mean(get(), nodes.count(), nodes.data(), weights.data(),
                                                    direction.data(), patterns.count(), patterns.data(),
                                                    coefficients.data(), 0));
    }
    // coefficients: [nodes][dimension]
    void add_equation(View<std::int64_t> nodes, View<double> coefficients, View<std::int64_t> patterns = {},
                      View<double> prescribed = {}) {
        in_space(coefficients.size(), nodes.size());
        detail::require(prescribed.size() == patterns.size(), "patterns and prescribed: unequal sizes");
        shared_->check(delam_problem_add_equation(get(), nodes.count(), nodes.data(), coefficients.data(),
                                                  patterns.count(), patterns.data(), prescribed.data(), 0));
    }
    // Constraints, in the order in which they were added, begin at a time, from where the nodes are then; or end, and
    // leave their forces. pattern: its factor, over that at the time, is what is left of either.
    void begin_constraints(std::int64_t first, std::int64_t count, double time, std::int64_t pattern) {
        shared_->check(delam_problem_begin_constraints(get(), first, count, time, pattern));
    }
    void end_constraints(std::int64_t first, std::int64_t count, double time, std::int64_t pattern) {
        shared_->check(delam_problem_end_constraints(get(), first, count, time, pattern));
    }
    // periods: [control nodes][dimension]
    void add_periodic(View<double> periods, View<std::int64_t> control_nodes, double tolerance = 0.0) {
        in_space(periods.size(), control_nodes.size());
        shared_->check(delam_problem_add_periodic(get(), control_nodes.count(), periods.data(), control_nodes.data(),
                                                  tolerance, 0));
    }
    // forces: [nodes][dimension]
    void add_forces(std::int64_t pattern, View<std::int64_t> nodes, View<double> forces) {
        in_space(forces.size(), nodes.size());
        shared_->check(delam_problem_add_forces(get(), pattern, nodes.count(), nodes.data(), forces.data(), 0));
    }
    void add_eigenstrain(std::int64_t pattern, std::int32_t body, const std::array<double, 6>& strain) {
        shared_->check(delam_problem_add_eigenstrain(get(), pattern, body, strain.data()));
    }
    // gaps: [pairs], along the normals; empty for the distances in the mesh. Magnitudes up to adjust count as 0.
    void set_gaps(std::int64_t interface_index, std::int64_t pattern, View<double> gaps = {}, double adjust = 0.0) {
        const bool known = interface_index >= 0 && interface_index < static_cast<std::int64_t>(pairs_.size());
        detail::require(gaps.size() == 0 || !known || gaps.count() == pairs_[detail::length(interface_index)],
                        "gaps: not one for each pair");
        shared_->check(
            delam_problem_set_gaps(get(), interface_index, pattern, gaps.size() == 0 ? nullptr : gaps.data(), adjust));
    }

    void set(Text key, double value) { shared_->check(delam_problem_set_number(get(), key.get(), value)); }
    void set(Text key, Text value) { shared_->check(delam_problem_set_text(get(), key.get(), value.get())); }
    void check() { shared_->check(delam_problem_check(get())); }
    std::string hash() const {
        std::array<char, 17> digits{};
        shared_->check(delam_problem_hash(get(), digits.data()));
        return digits.data();
    }
    Dofs dofs() const {
        Dofs dofs{};
        shared_->check(delam_problem_dofs(get(), &dofs.primal, &dofs.dual));
        return dofs;
    }
    ProcessZone process_zone(std::int64_t interface_index) const {
        ProcessZone zone{};
        shared_->check(delam_problem_process_zone(get(), interface_index, &zone.length, &zone.spacing));
        return zone;
    }
    // For the law of an interface, with at least `pairs` pairs in the process zone.
    Proposal propose(std::int64_t interface_index, double pairs = 3.0) const {
        Proposal found{};
        shared_->check(delam_problem_propose(get(), interface_index, pairs, &found.stiffness, &found.share,
                                             &found.normal_strength, &found.tangential_strength));
        return found;
    }
    // Nothing is factored.
    Forecast plan() {
        const char* plan = nullptr;
        Forecast forecast{};
        shared_->check(delam_problem_plan(get(), &plan, &forecast.setup, &forecast.memory));
        forecast.plan = plan;
        return forecast;
    }
    Matrix body_matrix(std::int32_t body) const {
        std::int64_t rows = 0;
        std::int64_t entries = 0;
        shared_->check(delam_problem_body_matrix(get(), body, &rows, &entries, nullptr, nullptr, nullptr));
        Matrix matrix = sized(rows, entries);
        shared_->check(delam_problem_body_matrix(get(), body, &rows, &entries, matrix.row_starts.data(),
                                                 matrix.columns.data(), matrix.values.data()));
        return matrix;
    }
    Constraints constraints() const {
        std::int64_t rows = 0;
        std::int64_t entries = 0;
        std::int64_t patterns = 0;
        shared_->check(
            delam_problem_constraints(get(), &rows, &entries, &patterns, nullptr, nullptr, nullptr, nullptr));
        Constraints all{sized(rows, entries), std::vector<double>(detail::length(rows * patterns))};
        shared_->check(delam_problem_constraints(get(), &rows, &entries, &patterns, all.matrix.row_starts.data(),
                                                 all.matrix.columns.data(), all.matrix.values.data(),
                                                 all.coefficients.data()));
        return all;
    }
    std::vector<double> forces(std::int64_t pattern) const {
        std::vector<double> forces(detail::length(dofs().primal));
        shared_->check(delam_problem_forces(get(), pattern, static_cast<std::int64_t>(forces.size()), forces.data()));
        return forces;
    }
    std::vector<double> eigenstrain_energy() const {
        const std::int64_t count = pattern_count();
        std::vector<double> matrix(detail::length(count * count));
        shared_->check(delam_problem_eigenstrain_energy(get(), count * count, matrix.data()));
        return matrix;
    }
    std::vector<double> factors(double time) const {
        std::vector<double> factors(detail::length(pattern_count()));
        shared_->check(delam_problem_factors(get(), time, static_cast<std::int64_t>(factors.size()), factors.data()));
        return factors;
    }
    std::int64_t pattern_count() const {
        std::int64_t count = 0;
        shared_->check(delam_problem_pattern_count(get(), &count));
        return count;
    }
    std::string pattern_name(std::int64_t pattern) const {
        return detail::copy(delam_problem_pattern_name(get(), pattern));
    }

    // Returns what the other classes of this layer share.
    const std::shared_ptr<detail::Shared>& shared() const noexcept { return shared_; }
    // Returns the functions of the host laws, which a solver keeps.
    const std::vector<std::shared_ptr<detail::HostLaw>>& host_laws() const noexcept { return laws_; }

private:
    void in_space(std::size_t components, std::size_t vectors) const {
        detail::require(components == vectors * detail::length(dimension_), "a vector has not the problem's dimension");
    }
    static Matrix sized(std::int64_t rows, std::int64_t entries) {
        Matrix matrix;
        matrix.row_starts.resize(detail::length(rows) + 1);
        matrix.columns.resize(detail::length(entries));
        matrix.values.resize(detail::length(entries));
        return matrix;
    }

    std::shared_ptr<detail::Shared> shared_;
    std::vector<std::shared_ptr<detail::HostLaw>> laws_;
    std::int32_t dimension_;
    std::vector<std::int64_t> pairs_;  // of each interface
    detail::Handle<delam_problem, delam_problem_destroy> handle_;
};

}  // namespace delam

#endif
