// SPDX-License-Identifier: BSD-3-Clause
// The table of the calls: name, subject, statuses that they may return, and the call.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>

#include "api_mesh.hpp"
#include "api_parts.hpp"
#include "api_problem.hpp"
#include "api_solver.hpp"
#include "small_scene.hpp"

namespace fuzz {

struct Asked {
    World& world;
    Input& in;
    Host& host;  // that owns the subject
    delam_mesh* mesh;
    delam_law* law;
    delam_problem* problem;
    delam_solver* solver;
};

enum class Subject { host, mesh, law, problem, solver };

struct Call {
    const char* name;
    Subject subject;
    Statuses documented;
    std::int32_t (*make)(const Asked&);
};

inline const Call calls[] = {
    {"delam_mesh_create", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.mesh, a.in, a.host, [&](delam_mesh** o) { return create_mesh(a.in, a.host, o); });
     }},
    {"delam_mesh_create_layers", Subject::host, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         return a.world.make(a.world.mesh, a.in, a.host,
                             [&](delam_mesh** o) { return create_layers(a.in, a.host, o); });
     }},
    {"delam_law_create", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.law, a.in, a.host,
                             [&](delam_law** o) { return delam_law_create(a.host.context, a.in.word(law_kinds), o); });
     }},
    {"delam_law_create_host", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.law, a.in, a.host, [&](delam_law** o) {
             const std::int32_t status =
                 IN_ORDER(delam_law_create_host, a.host.context, a.in.seldom() ? "" : "bilinear", host_adhesion,
                     a.in.seldom() ? nullptr : host_dissipation, &a.world.host_law, o);
             if (status == DELAM_OK)
                 for (const char* key : {"normal_stiffness", "tangential_stiffness"}) delam_law_set(*o, key, 1e4);
             return status;
         });
     }},
    {"delam_problem_create", Subject::host, may::argument,
     [](const Asked& a) {
         return a.world.make(a.world.problem, a.in, a.host, [&](delam_problem** o) {
             return delam_problem_create(a.host.context, a.world.mesh.pick(a.in), o);
         });
     }},
    {"delam_context_cancel", Subject::host, may::usual,
     [](const Asked& a) { return a.in.seldom() ? delam_context_cancel(a.host.context) : DELAM_OK; }},
    {"delam_context_set_log", Subject::host, may::usual,
     [](const Asked& a) {
         a.host.listens = false;
         return delam_context_set_log(a.host.context, nullptr, nullptr);
     }},
    {"a whole scene", Subject::host, may::usual,
     [](const Asked& a) {
         SmallScene scene = small_scene(a.host, a.in);
         const auto slot = static_cast<std::size_t>(a.in.below(slots));
         a.world.mesh.put(slot, scene.mesh, &a.host);
         a.world.law.put(slot, scene.law, &a.host);
         a.world.problem.put(slot, scene.problem, &a.host);
         return DELAM_OK;
     }},
    {"a whole scene with an engine", Subject::host, may::usual,
     [](const Asked& a) {
         SmallScene scene = small_scene(a.host, a.in);
         delam_problem_set_text(scene.problem, "reduction", "auto");
         delam_problem_set_number(scene.problem, "subdomains", 0.0);
         const std::int32_t status = set_engine(a.world, a.in, scene.mesh, scene.problem, true);
         expect(status == DELAM_OK, "a sound engine is taken", "delam_experimental_problem_set_engine");
         delam_solver* solver = nullptr;
         delam_solver_create(scene.problem, 0.0, &solver);
         const auto slot = static_cast<std::size_t>(a.in.below(slots));
         a.world.mesh.put(slot, scene.mesh, &a.host);
         a.world.law.put(slot, scene.law, &a.host);
         a.world.problem.put(slot, scene.problem, &a.host);
         a.world.solver.put(slot, solver, &a.host);
         return DELAM_OK;
     }},
    {"the engines turn", Subject::host, may::usual,
     [](const Asked& a) {
         turn_engines(a.world, a.in);
         return DELAM_OK;
     }},
    {"delam_experimental_part_matrix", Subject::host, may::cancelled | may::argument | may::snapshot,
     [](const Asked& a) { return part_matrix(a.world, a.in, a.host.context); }},
    {"delam_experimental_part_fields", Subject::host, may::cancelled | may::argument | may::snapshot,
     [](const Asked& a) { return part_fields(a.world, a.in, a.host.context); }},
    {"the next call is interrupted", Subject::host, may::usual,
     [](const Asked& a) {
         a.world.interrupt_in = a.in.below(16);
         a.world.interrupt_by_call = a.in.flag();
         return DELAM_OK;
     }},
    {"the host's law turns", Subject::host, may::usual,
     [](const Asked& a) {
         a.world.host_law.nonsense = a.in.flag();
         return DELAM_OK;
     }},

    {"delam_mesh_add_cells", Subject::mesh, may::cancelled | may::argument | may::mesh | may::state,
     [](const Asked& a) { return add_cells(a.in, a.mesh, false); }},
    {"delam_mesh_add_conforming_cells", Subject::mesh, may::cancelled | may::argument | may::mesh | may::state,
     [](const Asked& a) { return add_cells(a.in, a.mesh, true); }},
    {"delam_mesh_add_interface", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t index = -1;
         return IN_ORDER(delam_mesh_add_interface, a.mesh, a.in.small_label(3), a.in.small_label(3),
             a.in.flag() ? 0.0 : a.in.fraction(), a.in.seldom() ? nullptr : &index);
     }},
    {"delam_mesh_add_all_interfaces", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t count = -1;
         return IN_ORDER(delam_mesh_add_all_interfaces, a.mesh, a.in.flag() ? 0.0 : a.in.fraction(),
             a.in.seldom() ? nullptr : &count);
     }},
    {"delam_mesh_add_seams", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t count = -1;
         return IN_ORDER(delam_mesh_add_seams, a.mesh, a.in.flag() ? 0.0 : a.in.fraction(),
             a.in.seldom() ? nullptr : &count);
     }},
    {"delam_mesh_add_self_contact", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t count = -1;
         return IN_ORDER(delam_mesh_add_self_contact, a.mesh, a.in.flag() ? 1.5 : a.in.real(),
             a.in.seldom() ? nullptr : &count);
     }},
    {"delam_mesh_add_projected_interface", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t index = -1;
         return IN_ORDER(delam_mesh_add_projected_interface, a.mesh, a.in.small_label(3), a.in.small_label(3),
             a.in.flag() ? 0.0 : a.in.real(), a.in.seldom() ? nullptr : &index);
     }},
    {"delam_mesh_add_mortar_interface", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         std::int64_t index = -1;
         return IN_ORDER(delam_mesh_add_mortar_interface, a.mesh, a.in.small_label(3), a.in.small_label(3),
             a.in.flag() ? 0.0 : a.in.real(), a.in.seldom() ? nullptr : &index);
     }},
    {"delam_mesh_add_obstacle", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_obstacle(a.in, a.mesh); }},
    {"delam_mesh_add_host_body", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_host_body(a.in, a.mesh); }},
    {"delam_mesh_add_pairs", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_pairs(a.in, a.mesh); }},
    {"delam_mesh_find_nodes", Subject::mesh, may::argument,
     [](const Asked& a) { return find_in(a.in, a.mesh, false); }},
    {"delam_mesh_find_patch", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return find_in(a.in, a.mesh, true); }},
    {"delam_mesh_nodes", Subject::mesh, may::argument,
     [](const Asked& a) {
         Room<double> room(a.in, sizes_of(a.mesh).nodes * sizes_of(a.mesh).dimension);
         return delam_mesh_nodes(a.mesh, room.capacity, room.data());
     }},
    {"delam_mesh_destroy", Subject::mesh, may::usual,
     [](const Asked& a) {
         a.world.mesh.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},

    {"delam_law_set", Subject::law, may::argument,
     [](const Asked& a) { return IN_ORDER(delam_law_set, a.law, a.in.word(law_keys), a.in.signed_real()); }},
    {"delam_law_set_text", Subject::law, may::argument,
     [](const Asked& a) {
         return IN_ORDER(delam_law_set_text, a.law, a.in.seldom() ? a.in.word(law_keys) : "criterion",
             a.in.word(criteria));
     }},
    {"delam_law_set_table", Subject::law, may::argument, [](const Asked& a) { return law_table(a.in, a.law); }},
    {"delam_law_check", Subject::law, may::problem,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return delam_law_check(a.law); }); }},
    {"delam_law_toughness", Subject::law, may::argument | may::problem,
     [](const Asked& a) { return law_toughness(a.in, a.law); }},
    {"delam_law_respond", Subject::law, may::argument | may::problem,
     [](const Asked& a) { return law_respond(a.in, a.law); }},
    {"delam_law_destroy", Subject::law, may::usual,
     [](const Asked& a) {
         a.world.law.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},

    {"delam_problem_set_plane", Subject::problem, may::argument,
     [](const Asked& a) {
         static const char* const planes[] = {"plane-strain", "plane-stress"};
         return delam_problem_set_plane(a.problem, a.in.word(planes));
     }},
    {"delam_problem_set_elastic", Subject::problem, may::argument,
     [](const Asked& a) {
         return IN_ORDER(delam_problem_set_elastic, a.problem, a.in.body(), 1000.0 * a.in.real(),
             0.25 * a.in.signed_real());
     }},
    {"delam_problem_set_orthotropic", Subject::problem, may::argument,
     [](const Asked& a) { return set_orthotropic(a.in, a.problem); }},
    {"delam_problem_set_orientation", Subject::problem, may::cancelled | may::argument,
     [](const Asked& a) { return set_orientation(a.in, a.problem); }},
    {"delam_problem_set_formulation", Subject::problem, may::argument,
     [](const Asked& a) {
         static const char* const words[] = {"standard", "incompatible", "mean-dilatation"};
         return IN_ORDER(delam_problem_set_formulation, a.problem, a.in.body(), a.in.word(words));
     }},
    {"delam_problem_set_stiffness", Subject::problem, may::argument | may::numerical | may::cancelled,
     [](const Asked& a) { return set_stiffness(a.world.mesh.pick(a.in), a.in, a.problem); }},
    {"delam_problem_set_law", Subject::problem, may::argument | may::problem,
     [](const Asked& a) {
         return watched(a.world, a.in,
                        [&] { return IN_ORDER(delam_problem_set_law, a.problem, a.in.index(2),
                            a.world.law.pick(a.in)); });
     }},
    {"delam_problem_set_bonded", Subject::problem, may::argument,
     [](const Asked& a) { return delam_problem_set_bonded(a.problem, a.in.index(2)); }},
    {"delam_problem_set_contact", Subject::problem, may::argument,
     [](const Asked& a) { return delam_problem_set_contact(a.problem, a.in.index(2)); }},
    {"delam_problem_set_adhesion", Subject::problem, may::argument,
     [](const Asked& a) {
         const std::size_t count = few(a.in);
         const std::int32_t base = a.in.base();
         std::vector<std::int64_t> pairs = a.in.indices(count, 4, base);
         std::vector<double> adhesion(count);
         for (double& zeta : adhesion) zeta = a.in.fraction();
         return IN_ORDER(delam_problem_set_adhesion, a.problem, a.in.index(2), static_cast<std::int64_t>(count),
             maybe(a.in, pairs), maybe(a.in, adhesion), base);
     }},
    {"delam_problem_set_adhesion_box", Subject::problem, may::argument,
     [](const Asked& a) {
         std::vector<double> lower = a.in.reals(3), upper = a.in.reals(3);
         const double adhesion = a.in.fraction();
         std::int64_t count = 0;
         return IN_ORDER(delam_problem_set_adhesion_box, a.problem, a.in.index(2), maybe(a.in, lower), maybe(a.in,
             upper), adhesion, a.in.seldom() ? nullptr : &count);
     }},
    {"delam_problem_add_pattern", Subject::problem, may::argument,
     [](const Asked& a) { return add_pattern(a.in, a.problem); }},
    {"delam_problem_prescribe_nodes", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::nodes); }},
    {"delam_problem_prescribe_mean", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::mean); }},
    {"delam_problem_add_equation", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::equation); }},
    {"delam_problem_begin_constraints", Subject::problem, may::argument | may::problem,
     [](const Asked& a) { return change_constraints(a.in, a.problem, true); }},
    {"delam_problem_end_constraints", Subject::problem, may::argument | may::problem,
     [](const Asked& a) { return change_constraints(a.in, a.problem, false); }},
    {"delam_problem_add_forces", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return add_load(a.in, a.problem, Load::forces); }},
    {"delam_problem_add_periodic", Subject::problem, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) { return add_periodic(a.in, a.problem); }},
    {"delam_problem_add_eigenstrain", Subject::problem, may::argument | may::problem,
     [](const Asked& a) {
         std::vector<double> strain = a.in.reals(6);
         for (double& e : strain) e *= 1e-3;
         return IN_ORDER(delam_problem_add_eigenstrain, a.problem, a.in.index(sizes_of(a.problem).patterns),
             a.in.body(), maybe(a.in, strain));
     }},
    {"delam_problem_set_gaps", Subject::problem, may::cancelled | may::argument | may::problem | may::mesh,
     [](const Asked& a) { return set_gaps(a.in, a.problem); }},
    {"delam_problem_set_number", Subject::problem, may::argument,
     [](const Asked& a) {
         const char* key = option_key(a.in);
         return IN_ORDER(delam_problem_set_number, a.problem, key, a.in.seldom() ? a.in.hostile_real() : a.in.real());
     }},
    {"delam_problem_set_text", Subject::problem, may::argument,
     [](const Asked& a) {
         const char* key = option_key(a.in);
         return delam_problem_set_text(a.problem, key, a.in.word(option_texts()));
     }},
    {"delam_problem_check", Subject::problem, may::cancelled | may::mesh | may::problem,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return delam_problem_check(a.problem); }); }},
    {"delam_problem_process_zone", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         double length = 0.0;
         return delam_problem_process_zone(a.problem, a.in.index(2), &length, nullptr);
     }},
    {"delam_problem_propose", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         const std::int64_t interface_index = a.in.index(2);
         double stiffness = 0.0, share = 0.0, normal = 0.0, tangential = 0.0;
         return IN_ORDER(delam_problem_propose, a.problem, interface_index, a.in.seldom() ? a.in.hostile_real() : 3.0,
             &stiffness, &share, &normal, &tangential);
     }},
    {"delam_problem_body_matrix", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return body_matrix(a.in, a.problem); }},
    {"delam_problem_constraints", Subject::problem, may::cancelled,
     [](const Asked& a) { return constraints(a.in, a.problem); }},
    {"delam_problem_forces", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         Room<double> room(a.in, sizes_of(a.problem).dofs);
         return delam_problem_forces(a.problem, a.in.index(sizes_of(a.problem).patterns), room.capacity, room.data());
     }},
    {"delam_problem_eigenstrain_energy", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         const std::int64_t patterns = sizes_of(a.problem).patterns;
         Room<double> room(a.in, patterns * patterns);
         return delam_problem_eigenstrain_energy(a.problem, room.capacity, room.data());
     }},
    {"delam_problem_factors", Subject::problem, may::argument,
     [](const Asked& a) {
         Room<double> room(a.in, sizes_of(a.problem).patterns);
         const std::int32_t status = delam_problem_factors(a.problem, a.in.signed_real(), room.capacity, room.data());
         for (std::int64_t p = 0; status == DELAM_OK && p < sizes_of(a.problem).patterns; ++p)
             expect(std::isfinite(room.entries[static_cast<std::size_t>(p)]), "factors are finite",
                    "delam_problem_factors");
         return status;
     }},
    {"delam_experimental_problem_set_engine", Subject::problem, may::argument,
     [](const Asked& a) {
         const delam_mesh* mesh = a.world.mesh.pick(a.in);
         return set_engine(a.world, a.in, mesh, a.problem, false);
     }},
    {"delam_experimental_problem_part", Subject::problem, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return problem_part(a.world, a.in, a.problem); }},
    {"delam_problem_destroy", Subject::problem, may::usual,
     [](const Asked& a) {
         a.world.problem.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},
    {"delam_solver_create", Subject::problem,
     may::not_converged | may::cancelled | may::limit | may::argument | may::mesh | may::problem | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] {
             return a.world.make(a.world.solver, a.in, a.host, [&](delam_solver** o) {
                 return IN_ORDER(delam_solver_create, a.problem, a.in.seldom() ? a.in.hostile_real() : 0.0, o);
             });
         });
     }},
    {"delam_solver_create_like", Subject::problem,
     may::not_converged | may::cancelled | may::limit | may::argument | may::mesh | may::problem | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] {
             return a.world.make(a.world.solver, a.in, a.host, [&](delam_solver** o) {
                 return IN_ORDER(delam_solver_create_like, a.problem,
                                 a.world.solver.handle[static_cast<std::size_t>(a.in.below(slots))], 0.0, o);
             });
         });
     }},
    {"delam_solver_shares_bodies", Subject::solver, may::argument,
     [](const Asked& a) {
         std::int32_t shares = 0;
         const delam_problem* problem = a.world.problem.handle[static_cast<std::size_t>(a.in.below(slots))];
         return problem == nullptr ? DELAM_OK : delam_solver_shares_bodies(a.solver, problem, &shares);
     }},

    {"delam_solver_advance", Subject::solver,
     may::not_converged | may::cancelled | may::limit | may::argument | may::problem | may::state | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] { return delam_solver_advance(a.solver, next_time(a.in, a.solver)); });
     }},
    {"delam_solver_commit", Subject::solver, may::problem | may::state,
     [](const Asked& a) { return delam_solver_commit(a.solver); }},
    {"delam_solver_commit, the law may fail", Subject::solver, may::problem | may::state,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return delam_solver_commit(a.solver); }); }},
    {"delam_solver_rollback", Subject::solver, may::state,
     [](const Asked& a) { return delam_solver_rollback(a.solver); }},
    {"delam_solver_equilibrate", Subject::solver,
     may::not_converged | may::cancelled | may::limit | may::argument | may::problem | may::state | may::numerical,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return equilibrate(a.in, a.solver); }); }},
    {"delam_solver_look", Subject::solver, may::argument,
     [](const Asked& a) {
         const std::int64_t step = a.in.index(7);
         return delam_solver_look(a.solver, step == std::numeric_limits<std::int64_t>::min() ? step : step - 1);
     }},
    {"delam_solver_value", Subject::solver, may::cancelled | may::argument | may::problem,
     [](const Asked& a) {
         double value = 0.0;
         return IN_ORDER(delam_solver_value, a.solver, a.in.word(value_keys), a.in.seldom() ? nullptr : &value);
     }},
    {"all values", Subject::solver, may::cancelled | may::argument | may::problem,
     [](const Asked& a) { return read_all_values(a.solver); }},
    {"delam_solver_field", Subject::solver, may::cancelled | may::argument,
     [](const Asked& a) { return read_field(a.in, a.solver); }},
    {"delam_solver_average", Subject::solver, may::cancelled | may::argument,
     [](const Asked& a) {
         std::vector<double> strain(6), stress(6);
         double volume = 0.0;
         return IN_ORDER(delam_solver_average, a.solver, a.in.body(), &volume, maybe(a.in, strain), maybe(a.in,
             stress));
     }},
    {"delam_solver_front", Subject::solver, may::argument | may::problem,
     [](const Asked& a) { return read_front(a.in, a.solver); }},
    {"delam_solver_tangent", Subject::solver, may::cancelled | may::argument | may::state | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] { return tangent(a.in, a.solver, patterns_of(a.solver)); });
     }},
    {"delam_solver_step_tangent", Subject::solver, may::cancelled | may::argument | may::state | may::numerical,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] {
             const std::int64_t patterns = patterns_of(a.solver);
             Room<double> room(a.in, patterns * patterns);
             return delam_solver_step_tangent(a.solver, room.capacity, room.data());
         });
     }},
    {"delam_solver_set_history", Subject::solver, may::argument | may::state,
     [](const Asked& a) { return set_history(a.in, a.solver); }},
    {"delam_solver_record", Subject::solver, may::argument | may::problem | may::state,
     [](const Asked& a) {
         const char* key = a.in.word(value_keys);
         return watched(a.world, a.in, [&] { return delam_solver_record(a.solver, key); });
     }},
    {"delam_solver_recorded", Subject::solver, may::argument,
     [](const Asked& a) { return recorded(a.in, a.solver); }},
    {"delam_solver_condensed", Subject::solver, may::cancelled | may::argument | may::state,
     [](const Asked& a) { return condensed(a.in, a.solver); }},
    {"delam_solver_pending", Subject::solver, may::argument,
     [](const Asked& a) {
         std::int32_t pending = -1;
         const std::int32_t status = delam_solver_pending(a.solver, a.in.seldom() ? nullptr : &pending);
         expect(status != DELAM_OK || pending == 0 || pending == 1, "0 or 1", "delam_solver_pending");
         return status;
     }},
    {"delam_solver_save_file", Subject::solver, may::argument | may::file,
     [](const Asked& a) { return delam_solver_save_file(a.solver, some_path(a.in)); }},
    {"delam_solver_load_file", Subject::solver,
     may::cancelled | may::argument | may::numerical | may::snapshot | may::file,
     [](const Asked& a) {
         return watched(a.world, a.in, [&] { return delam_solver_load_file(a.solver, some_path(a.in)); });
     }},
    {"delam_solver_jump", Subject::solver, may::argument,
     [](const Asked& a) { return read_jumps(a.in, a.solver, patterns_of(a.solver)); }},
    {"delam_solver_plan_item", Subject::solver, may::argument,
     [](const Asked& a) { return read_plan(a.in, a.solver); }},
    {"delam_solver_option", Subject::solver, may::argument,
     [](const Asked& a) {
         expect(delam_solver_option(a.solver, "solution") != nullptr, "a known option has a value",
                "delam_solver_option");
         expect(delam_solver_searched(a.solver) != nullptr, "never NULL", "delam_solver_searched");
         return DELAM_OK;
     }},
    {"delam_solver_load", Subject::solver, may::cancelled | may::argument | may::numerical | may::snapshot,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return save_and_load(a.world, a.in, a.solver); }); }},
    {"delam_experimental_solver_recover", Subject::solver, may::cancelled | may::numerical | may::state,
     [](const Asked& a) { return delam_experimental_solver_recover(a.solver); }},
    {"delam_experimental_solver_eigenstrains", Subject::solver, may::argument,
     [](const Asked& a) { return eigenstrains(a.in, a.solver); }},
    {"delam_experimental_solver_follow", Subject::solver,
     may::cancelled | may::argument | may::state | may::numerical,
     [](const Asked& a) { return watched(a.world, a.in, [&] { return follow(a.in, a.solver); }); }},
    {"delam_experimental_solver_sensitivity", Subject::solver, may::argument | may::state,
     [](const Asked& a) { return sensitivity(a.in, a.solver); }},
    {"delam_experimental_mesh_cut", Subject::mesh, may::cancelled | may::argument | may::mesh | may::state,
     [](const Asked& a) {
         std::int64_t made = -1;
         const std::int64_t faces[] = {a.in.index(6), a.in.index(6), a.in.index(6), a.in.index(6)};
         return IN_ORDER(delam_experimental_mesh_cut, a.mesh, a.in.flag() ? 1 : 2, a.in.flag() ? 2 : 4, faces, 0,
             a.in.seldom() ? nullptr : &made);
     }},
    {"delam_experimental_mesh_split_interface", Subject::mesh, may::argument,
     [](const Asked& a) {
         std::int64_t index = -1;
         const std::int64_t pairs[] = {a.in.index(3), a.in.index(3)};
         return IN_ORDER(delam_experimental_mesh_split_interface, a.mesh, a.in.index(2), a.in.flag() ? 1 : 2, pairs, 0,
             a.in.seldom() ? nullptr : &index);
     }},
    {"delam_experimental_mesh_set_tangents", Subject::mesh, may::cancelled | may::argument | may::mesh,
     [](const Asked& a) {
         const double direction[] = {a.in.signed_real(), a.in.signed_real(), a.in.signed_real()};
         return IN_ORDER(delam_experimental_mesh_set_tangents, a.mesh, a.in.index(2), 1, direction);
     }},
    {"delam_solver_destroy", Subject::solver, may::usual,
     [](const Asked& a) {
         a.world.solver.put(static_cast<std::size_t>(a.in.below(slots)), nullptr, nullptr);
         return DELAM_OK;
     }},
};

}  // namespace fuzz
