// SPDX-License-Identifier: BSD-3-Clause
// The scene: materials, laws, options and queries. Supports and loads: loads.cpp; assembled matrices: exports.cpp.
#include "scene/problem.hpp"
#include "base/numbers.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>
#include <optional>
#include <span>
#include <string>

#include "capi/handle/handles.hpp"
#include "law/admissible.hpp"
#include "mesh/selection.hpp"
#include "scene/check/validate_stages.hpp"
#include "scene/given_stiffness.hpp"

namespace {

using namespace delam;

std::size_t require_interface(const Problem& problem, std::int64_t index) {
    const auto count = static_cast<std::int64_t>(problem.interfaces.size());
    return static_cast<std::size_t>(require_index(index, count, 0, "interface_index"));
}

// -1: all bodies.
std::int32_t require_body(const Problem& problem, std::int32_t body) {
    const std::int32_t index = body < 0 ? -1 : problem.mesh->body_of_label(body);
    if (body != -1 && index < 0) fail(DELAM_ERROR_ARGUMENT, "body = ", body, ": no body has this label");
    return index;
}

void set_material(Problem& problem, std::int32_t body, const Material& material) {
    const std::int32_t index = require_body(problem, body);
    for (std::size_t i = 0; i < problem.material.size(); ++i)
        if (body == -1 || i == static_cast<std::size_t>(index)) problem.material[i] = material;
}

// Tells the host where a box ends between two pairs.
void say_moved(const Context& context, std::int64_t interface, double adhesion, const PairsInBox& found) {
    for (const MovedEnd& moved : found.moved)
        context.monitor.log(
            1, text("interface ", interface, ": the box ", moved.upper ? "ends" : "begins", " at ", "xyz"[moved.axis],
                    " = ", moved.end, ", between two pairs: ",
                    adhesion == 0.0 ? "the tip of the crack is the next pair, at " : "the next pair is at ", moved.next,
                    // Six digits may show both places as one.
                    text(moved.end) == text(moved.next) ? text(", ", std::abs(moved.next - moved.end), " away") : ""));
}

}  // namespace

int32_t delam_problem_create(delam_context* context, const delam_mesh* mesh, delam_problem** out) {
    if (out != nullptr) *out = nullptr;
    return guard(context, [&] {
        require_pointer(out, "out");
        require_handle(mesh, "mesh");
        auto problem = std::make_unique<delam_problem>();
        problem->context = context->context;
        problem->core = std::make_shared<Problem>(std::make_shared<const Mesh>(*mesh->core));
        *out = problem.release();
    });
}

void delam_problem_destroy(delam_problem** problem) { destroy(problem); }

int32_t delam_problem_set_plane(delam_problem* problem, const char* assumption) {
    return guard(problem, [&] {
        require_pointer(assumption, "assumption");
        if (problem->core->mesh->dimension() != 2) {
            fail(DELAM_ERROR_ARGUMENT, "assumption: a plane assumption needs a mesh of dimension 2, this one has 3");
        }
        const std::string word = assumption;
        if (word != "plane-strain" && word != "plane-stress") {
            fail(DELAM_ERROR_ARGUMENT, "assumption = '", word, "' is not known; known are plane-strain, plane-stress");
        }
        problem->core->plane = word == "plane-strain" ? Plane::strain : Plane::stress;
    });
}

int32_t delam_problem_set_elastic(delam_problem* problem, int32_t body, double young, double poisson) {
    return guard(problem, [&] {
        if (!(young > 0.0) || !std::isfinite(young)) {
            fail(DELAM_ERROR_ARGUMENT, "young = ", young, " (body ", body, ") must be finite and > 0");
        }
        if (!(poisson > -1.0 && poisson < 0.5)) {
            fail(DELAM_ERROR_ARGUMENT, "poisson = ", poisson, " (body ", body, ") is outside -1 < poisson < 0.5");
        }
        set_material(*problem->core, body, Elastic{young, poisson});
    });
}

int32_t delam_problem_set_orthotropic(delam_problem* problem, int32_t body, const double* constants) {
    return guard(problem, [&] {
        require_pointer(constants, "constants");
        Orthotropic material;
        std::copy_n(constants, material.constant.size(), material.constant.begin());
        if (const std::string wrong = indefinite_constant(material); !wrong.empty())
            fail(DELAM_ERROR_ARGUMENT, "constants (body ", body, "): ", wrong);
        set_material(*problem->core, body, material);
    });
}

int32_t delam_problem_set_orientation(delam_problem* problem, int32_t body, int64_t count, const int64_t* cells,
                                      const double* axes, int32_t index_base) {
    return guard_build(problem, [&] {
        Problem& core = *problem->core;
        const Mesh& mesh = *core.mesh;
        const std::int32_t index = require_body(core, body);
        require_base(index_base);
        require_count(count, "count");
        if (count > std::numeric_limits<std::int32_t>::max() - mesh.cell_count())
            fail(DELAM_ERROR_ARGUMENT, "count = ", count, ": at most 2^31 - 1 with the cells of the mesh");
        if (cells == nullptr && count != 1)
            fail(DELAM_ERROR_ARGUMENT, "cells is NULL (one orientation for the whole body), but count = ", count,
                 ", not 1");
        require_array(axes, 6 * count, "axes");
        require_finite(axes, 6 * count, "axes");
        std::vector<std::int64_t> list;
        std::vector<Axes> chosen(static_cast<std::size_t>(count));
        for (std::int64_t i = 0; i < count; ++i) {
            poll_cancel("orientation");
            const double* own = axes + 6 * i;
            if (!orthonormal_axes(std::span<const double, 3>(own, 3), std::span<const double, 3>(own + 3, 3),
                                  chosen[static_cast<std::size_t>(i)]))
                fail(DELAM_ERROR_ARGUMENT, "axes[", i, "]: axis 1 = (", own[0], ", ", own[1], ", ", own[2],
                     "), axis 2 = (", own[3], ", ", own[4], ", ", own[5],
                     "): both must have a length > 0 and not be parallel");
            if (cells == nullptr) continue;
            const std::int64_t cell = require_index(cells[i], mesh.cell_count(), index_base, text("cells[", i, "]"));
            if (body != -1 && mesh.cell_body(cell) != index)
                fail(DELAM_ERROR_ARGUMENT, "cells[", i, "] = ", cells[i], " belongs to body ",
                     mesh.body_label(mesh.cell_body(cell)), ", not to body = ", body);
            list.push_back(cell);
        }
        if (cells == nullptr) {
            for (std::int64_t cell = 0; cell < mesh.cell_count(); ++cell)
                if (body == -1 || mesh.cell_body(cell) == index) list.push_back(cell);
            chosen.assign(list.size(), Axes(chosen.front()));
        }
        const Orientation before = core.orientation == nullptr ? Orientation{} : *core.orientation;
        core.orientation = std::make_shared<const Orientation>(oriented(before, mesh.cell_count(), list, chosen));
    });
}

int32_t delam_problem_set_formulation(delam_problem* problem, int32_t body, const char* formulation) {
    return guard(problem, [&] {
        require_pointer(formulation, "formulation");
        const std::string word = formulation;
        std::optional<Formulation> chosen;
        for (const Formulation f : {Formulation::standard, Formulation::incompatible, Formulation::mean_dilatation})
            if (word == name_of(f)) chosen = f;
        if (!chosen)
            fail(DELAM_ERROR_ARGUMENT, "formulation = '", word,
                 "' is not known; known are standard, incompatible, mean-dilatation");
        Problem& core = *problem->core;
        const std::int32_t index = require_body(core, body);
        std::vector<Formulation> changed = core.formulation;
        for (std::int32_t i = 0; i < core.mesh->body_count(); ++i) {
            if (body != -1 && i != index) continue;
            require_formulation(*core.mesh, i, *chosen, DELAM_ERROR_ARGUMENT);
            changed[static_cast<std::size_t>(i)] = *chosen;
        }
        core.formulation = std::move(changed);
    });
}

int32_t delam_problem_set_stiffness(delam_problem* problem, int64_t count, const int64_t* nodes, const int64_t* dofs,
                                    const int64_t* row_starts, const int64_t* columns, const double* values,
                                    int64_t kernel_count, const double* kernel, int32_t index_base) {
    return guard_solve(problem, [&] {
        Problem& core = *problem->core;
        require_count(count, "count", 1);
        require_base(index_base);
        const std::int64_t rows = count * core.mesh->dimension();
        require_pointer(row_starts, "row_starts");
        GivenMatrix given{
            require_indices(nodes, count, core.mesh->node_count(), index_base, "nodes"), {}, {}, {}, {}, {}};
        if (dofs != nullptr) given.dofs = require_indices(dofs, rows, rows, index_base, "dofs");
        for (std::int64_t r = 0; r <= rows; ++r) {
            const std::int64_t before = r == 0 ? 0 : given.row_starts.back(), start = row_starts[r];
            if (start < before + index_base || (r == 0 && start != index_base) || start > (std::int64_t{1} << 48))
                fail(DELAM_ERROR_ARGUMENT, "row_starts[", r, "] = ", row_starts[r],
                     r == 0 ? ": must be " : ": must be at least ", before + index_base);
            given.row_starts.push_back(start - index_base);
        }
        const std::int64_t entries = given.row_starts.back();
        require_array(values, entries, "values");
        require_finite(values, entries, "values");
        given.columns = require_indices(columns, entries, rows, index_base, "columns");
        given.values.assign(values, values + entries);
        if (kernel_count < -1 || kernel_count > 6 * count)
            fail(DELAM_ERROR_ARGUMENT, "kernel_count = ", kernel_count, " is outside -1 .. ", 6 * count);
        given.kernel.told = kernel_count >= 0;
        if (kernel_count > 0) {
            require_array(kernel, kernel_count * rows, "kernel");
            require_finite(kernel, kernel_count * rows, "kernel");
            given.kernel.motions = DenseMatrix(rows, kernel_count);
            std::copy(kernel, kernel + kernel_count * rows, given.kernel.motions.value.begin());
        }
        take_stiffness(core, given, problem->context->monitor);
    });
}

int32_t delam_problem_set_law(delam_problem* problem, int64_t interface_index, const delam_law* law) {
    return guard(problem, [&] {
        InterfaceProperties& interface = problem->core->interfaces[require_interface(*problem->core, interface_index)];
        require_handle(law, "law");
        const Law taken = *law->core;  // its callbacks may destroy the handle
        validate(taken);
        if (interface.contact) std::fill(interface.adhesion.begin(), interface.adhesion.end(), 1.0);
        interface.law = taken;
        interface.bonded = interface.contact = false;
    });
}

int32_t delam_problem_set_bonded(delam_problem* problem, int64_t interface_index) {
    return guard(problem, [&] {
        InterfaceProperties& interface = problem->core->interfaces[require_interface(*problem->core, interface_index)];
        if (interface.contact) std::fill(interface.adhesion.begin(), interface.adhesion.end(), 1.0);
        interface.bonded = true;
        interface.contact = false;
        interface.law.reset();
    });
}

int32_t delam_problem_set_contact(delam_problem* problem, int64_t interface_index) {
    return guard(problem, [&] {
        InterfaceProperties& interface = problem->core->interfaces[require_interface(*problem->core, interface_index)];
        interface.contact = true;
        interface.bonded = false;
        interface.law.reset();
        std::fill(interface.adhesion.begin(), interface.adhesion.end(), 0.0);
    });
}

int32_t delam_problem_set_adhesion(delam_problem* problem, int64_t interface_index, int64_t count, const int64_t* pairs,
                                   const double* adhesion, int32_t index_base) {
    return guard(problem, [&] {
        InterfaceProperties& interface = problem->core->interfaces[require_interface(*problem->core, interface_index)];
        require_count(count, "count");
        require_array(pairs, count, "pairs");
        require_array(adhesion, count, "adhesion");
        require_base(index_base);
        std::vector<double> changed = interface.adhesion;
        for (std::int64_t i = 0; i < count; ++i) {
            if (!(adhesion[i] >= 0.0 && adhesion[i] <= 1.0)) {
                fail(DELAM_ERROR_ARGUMENT, "adhesion[", i, "] = ", adhesion[i], " is outside 0 .. 1");
            }
            const std::int64_t pair =
                require_index(pairs[i], static_cast<std::int64_t>(changed.size()), index_base, text("pairs[", i, "]"));
            changed[index(pair)] = adhesion[i];
        }
        interface.adhesion = std::move(changed);
    });
}

int32_t delam_problem_set_adhesion_box(delam_problem* problem, int64_t interface_index, const double* lower,
                                       const double* upper, double adhesion, int64_t* count) {
    return guard(problem, [&] {
        const std::size_t i = require_interface(*problem->core, interface_index);
        const Mesh& mesh = *problem->core->mesh;
        require_box(mesh.dimension(), lower, upper);
        if (!(adhesion >= 0.0 && adhesion <= 1.0))
            fail(DELAM_ERROR_ARGUMENT, "adhesion = ", adhesion, " is outside 0 .. 1");
        const auto axes = index(mesh.dimension());
        const PairsInBox found = find_pairs(mesh, interface_index, {lower, axes}, {upper, axes});
        if (found.pairs.empty() && count == nullptr)
            fail(DELAM_ERROR_ARGUMENT, "lower, upper: no pair of interface ", interface_index, " is in this box");
        for (const std::int64_t pair : found.pairs) problem->core->interfaces[i].adhesion[index(pair)] = adhesion;
        if (count != nullptr) *count = static_cast<std::int64_t>(found.pairs.size());
        say_moved(*problem->context, interface_index, adhesion, found);
        if (found.pairs.empty())
            problem->context->monitor.log(
                1, text("interface ", interface_index, ": no pair is in a box of delam_problem_set_adhesion_box"));
    });
}

int32_t delam_problem_set_number(delam_problem* problem, const char* key, double value) {
    return guard(problem, [&] {
        require_pointer(key, "key");
        problem->core->options.set_number(key, value);
    });
}

int32_t delam_problem_set_text(delam_problem* problem, const char* key, const char* value) {
    return guard(problem, [&] {
        require_pointer(key, "key");
        require_pointer(value, "value");
        problem->core->options.set_text(key, value);
    });
}

int64_t delam_option_count(void) {
    try {
        return static_cast<std::int64_t>(option_table().size());
    } catch (...) {
        return 0;
    }
}

int32_t delam_option_info(int64_t index, const char** key, const char** type, const char** unit, const char** initial,
                          const char** range, const char** meaning) {
    if (index < 0 || index >= delam_option_count()) return DELAM_ERROR_ARGUMENT;
    const Option& option = option_table()[static_cast<std::size_t>(index)];
    if (key != nullptr) *key = option.key;
    if (type != nullptr) *type = option.type;
    if (unit != nullptr) *unit = option.unit;
    if (initial != nullptr) *initial = option.initial;
    if (range != nullptr) *range = option.range.c_str();
    if (meaning != nullptr) *meaning = option.meaning.c_str();
    return DELAM_OK;
}

int32_t delam_option_alias(int64_t index, const char** alias) {
    if (index < 0 || index >= delam_option_count() || alias == nullptr) return DELAM_ERROR_ARGUMENT;
    *alias = option_table()[static_cast<std::size_t>(index)].alias;
    return DELAM_OK;
}

int32_t delam_option_bounds(int64_t index, double* lower, double* upper, int32_t* lower_open, int32_t* upper_open) {
    if (index < 0 || index >= delam_option_count()) return DELAM_ERROR_ARGUMENT;
    const Option& option = option_table()[static_cast<std::size_t>(index)];
    if (!option.words.empty()) return DELAM_ERROR_ARGUMENT;
    if (lower != nullptr) *lower = option.lower.number;
    if (upper != nullptr) *upper = option.upper.number;
    if (lower_open != nullptr) *lower_open = option.lower.included ? 0 : 1;
    if (upper_open != nullptr) *upper_open = option.upper.included ? 0 : 1;
    return DELAM_OK;
}

int32_t delam_problem_check(delam_problem* problem) {
    return guard_build(problem, [&] { validate_stages(*problem->core, -infinite); });
}

int32_t delam_problem_hash(const delam_problem* problem, char* out) {
    return guard_read(problem, [&] {
        require_pointer(out, "out");
        std::snprintf(out, 17, "%016llx", static_cast<unsigned long long>(hash(*problem->core)));
    });
}

int32_t delam_problem_dofs(const delam_problem* problem, int64_t* primal, int64_t* dual) {
    return guard(problem, [&] {
        const Problem& core = *problem->core;
        if (primal != nullptr) *primal = core.mesh->node_count() * core.mesh->dimension();
        if (dual != nullptr) *dual = core.jump_count();
    });
}
