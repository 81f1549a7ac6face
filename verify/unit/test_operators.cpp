// SPDX-License-Identifier: BSD-3-Clause
// What every jump operator promises, against the condensed one on the same scenes: answers while a front advances, also
// of a state that it left long ago; zones, and whether tangents leave a minimum; the bits of a state that is recalled.
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <memory>
#include <string>
#include <vector>

#include "base/numbers.hpp"
#include "check.hpp"
#include "layer_states.hpp"
#include "linalg/dense/dense.hpp"
#include "reduction/dense/rigid_jumps.hpp"
#include "reduction/feti/feti.hpp"
#include "reduction/sparse/engine/engine_operator.hpp"
#include "reduction/sparse/iterated/iterated.hpp"
#include "refused.hpp"
#include "serial_engine.hpp"

using namespace delam;

namespace {

using unit::expect_close;

enum class Kind { iterated, engine, feti };
constexpr const char* names[] = {"iterated", "engine", "feti"};
constexpr std::size_t kinds = std::size(names), runs = kinds * std::size(unit::layer_cases);

// An operator and the condensed one for a scene; loop: operator and scene.
struct Both {
    Kind kind;
    const unit::LayerCase& c;
    unit::LayerState scene;
    double tolerance;  // of answers; condensed answers are no better than that of the case
    unit::Engined engined;
    Monitor monitor;
    unit::Reference condensed;
    std::unique_ptr<JumpOperator> op = make();

    explicit Both(int loop)
        : kind(static_cast<Kind>(loop % static_cast<int>(kinds))),
          c(unit::layer_cases[loop / static_cast<int>(kinds)]),
          scene(c, static_cast<unsigned>(&c - unit::layer_cases) + 1U),
          tolerance(kind != Kind::feti && c.tolerance <= 1e-7 ? 1e-8 : c.tolerance),
          engined((scene.problem.options.damage_tolerance = 1e-8, scene.problem)),
          condensed(scene.problem) {}
    std::unique_ptr<JumpOperator> make() {
        if (kind == Kind::iterated) return std::make_unique<Iterated>(scene.problem, monitor);
        if (kind == Kind::engine) return std::make_unique<EngineOperator>(engined.problem, monitor);
        return std::make_unique<Feti>(scene.problem, monitor);
    }
    // What the engine of these tests leaves of the motions of layers on weak springs is more than the others leave.
    bool left_out() const { return kind == Kind::engine && c.floating && c.stiffness < 1e7; }
    std::string name() const { return std::string(names[static_cast<int>(kind)]) + ", " + c.name; }
};

// Without loads of its own, a part that only springs hold is in balance.
void expect_balance(const DenseMatrix& motions, const std::vector<double>& force, const std::string& where) {
    for (std::int64_t c = 0; c < motions.columns; ++c) {
        double sum = 0.0, size = 0.0;
        for (std::int64_t r = 0; r < motions.rows; ++r) {
            sum += motions(r, c) * force[index(r)];
            size += std::abs(motions(r, c) * force[index(r)]);
        }
        ck_assert_msg(std::abs(sum) <= 1e-5 * size, "%s, motion %d: %.2e of %.2e", where.c_str(), static_cast<int>(c),
                      sum, size);
    }
}

void expect_alike(const Response& a, const Response& b, double tolerance, const std::string& where) {
    expect_close(a.jump, b.jump, tolerance, max_abs(b.jump), where + ", jumps");
    expect_close(a.force, b.force, tolerance, max_abs(b.force), where + ", forces");
    expect_close(a.conjugate, b.conjugate, tolerance, max_abs(b.conjugate), where + ", conjugate forces");
    const double energies[] = {a.stored_bulk, a.load_potential}, others[] = {b.stored_bulk, b.load_potential};
    expect_close(energies, others, tolerance, std::max(max_abs(others), std::abs(dot(b.force, b.jump))),
                 where + ", energies");
}

}  // namespace

LOOP_TEST(answers_as_the_condensed_operator, 0, runs) {
    Both both(loop);
    if (both.left_out()) return;
    Condensed& condensed = *both.condensed;
    JumpOperator& op = *both.op;
    ck_assert(std::ranges::equal(condensed.prescribed_rows(), op.prescribed_rows()));
    const DenseMatrix motions = RigidMotions(both.scene.problem).jumps();
    Response a, b, first, first_condensed;
    std::vector<double> theta = both.scene.theta, first_theta;
    std::int64_t iterations = 0;
    for (const double x : {0.0, 0.06, 0.07, 0.075}) {
        const std::string where = both.name() + ", front at " + std::to_string(x);
        for (double& t : theta) t *= 1.1;
        const Springs springs = unit::advanced(both.scene, x);
        condensed.solve(springs, theta, b);
        op.solve(springs, theta, a);
        ck_assert_int_eq(a.balanced, b.balanced);
        if (!b.balanced) continue;
        ck_assert_msg(a.converged, "%s: %d iterations, residual %.1e", where.c_str(), static_cast<int>(a.iterations),
                      a.residual);
        if (both.kind == Kind::iterated) ck_assert_int_le(a.iterations, 12);
        iterations += a.iterations;
        if (both.c.floating) expect_balance(motions, a.force, where);
        expect_alike(a, b, both.tolerance, where);
        const std::vector<double> u = condensed.displacement(theta, b);
        expect_close(op.displacement(theta, a), u, both.tolerance, max_abs(u), where + ", displacements");
        const std::vector<double> rho = condensed.reaction(theta, b);
        expect_close(op.reaction(theta, a), rho, 10.0 * both.tolerance, max_abs(rho), where + ", reactions");
        ck_assert(op.equilibrium_defect(theta, a) <= 10.0 * both.tolerance * max_abs(rho));
        if (!first_theta.empty()) continue;
        first_theta = theta;
        first = a;
        first_condensed = b;
    }
    std::printf("%s: %d iterations\n", both.name().c_str(), static_cast<int>(iterations));
    if (first_theta.empty()) return;
    // A state of long ago has its displacements, and the next one is none the worse.
    for (int i = 0; i < 12; ++i) {
        for (double& t : theta) t *= 1.01;
        op.solve(both.scene.springs, theta, a);
    }
    const std::vector<double> u = condensed.displacement(first_theta, first_condensed);
    expect_close(op.displacement(first_theta, first), u, both.tolerance, max_abs(u), both.name() + ", found again");
    op.solve(both.scene.springs, theta, a);
    condensed.solve(both.scene.springs, theta, b);
    expect_close(a.jump, b.jump, both.tolerance, max_abs(b.jump), both.name() + ", jumps afterwards");
}

// The questions of Newton's method: minimisers with springs and held rows, and whether tangents leave a minimum at all.
LOOP_TEST(zone_answers_as_the_condensed_one, 0, runs) {
    Both both(loop);
    if (both.left_out()) return;
    const unit::LayerState& scene = both.scene;
    Zone* dense = both.condensed->zone(scene.springs, scene.wanted, false);
    ck_assert_int_eq(both.op->zones()->zone_traits().whole, both.kind != Kind::feti);
    Zone* zone = both.op->zones()->zone(scene.springs, scene.wanted, false);
    ck_assert_msg(zone != nullptr, "%s: no zone", both.name().c_str());
    std::vector<unit::ZoneAnswer> a, b;
    for (const double scale : {1.0, 0.3}) {
        a.push_back(unit::ask(*zone, scene, scale));
        b.push_back(unit::ask(*dense, scene, scale));
        const std::string where = both.name() + ", scale " + std::to_string(scale);
        expect_close(a.back().jump, b.back().jump, both.c.tolerance, max_abs(b.back().jump), where + ", jumps");
        expect_close(a.back().force, b.back().force, both.c.tolerance, max_abs(b.back().force), where + ", forces");
    }
    // Each zone has an energy of its own up to a constant, and that of all bodies is the larger one.
    const double off = (a[1].energy - a[0].energy) - (b[1].energy - b[0].energy);
    const double allowed = both.kind == Kind::feti ? both.c.tolerance * std::abs(b[1].energy - b[0].energy)
                                                   : 1e-8 * std::max(std::abs(a[0].energy), std::abs(b[0].energy));
    ck_assert_msg(std::abs(off) <= allowed, "%s: energies off by %.2e, %.3g allowed", both.name().c_str(), off,
                  allowed);

    int indefinite = 0, definite = 0;
    // Along a motion in which a layer floats, tangents of any size leave no minimum.
    for (const double share :
         {-1e-15, -1e-12, -1e-10, -1e-8, -1e-6, -1e-4, -1e-3, -3e-3, -1e-2, -3e-2, -0.1, -0.3, -1.0, -3.0}) {
        const auto has_minimum = [&](Zone& asked, const std::vector<double>& theta) {
            std::vector<Zone::Coupling> couplings;
            std::vector<std::uint8_t> held(asked.jump_rows().size());
            for (std::size_t z = 0; z < held.size(); ++z) {
                const std::size_t r = index(asked.jump_rows()[z]);
                held[z] = scene.springs.held[r];
                const double s =
                    scene.wanted[r] != 0 ? share * both.condensed.bulk->diagonal(0) : scene.springs.stiffness[r];
                const auto at = static_cast<std::int64_t>(z);
                if (held[z] == 0 && s != 0.0) couplings.push_back({at, at, s});
            }
            return asked.factor(couplings, held) && asked.solve(theta, {}).definite;
        };
        const bool expected = has_minimum(*dense, scene.theta);
        (expected ? definite : indefinite) += 1;
        ck_assert_msg(has_minimum(*zone, scene.theta) == expected, "%s: with tangents of %g of the bodies",
                      both.name().c_str(), share);
        // Rigid motions are checked whether or not a load acts on them.
        const std::vector<double> nothing(scene.theta.size(), 0.0);
        ck_assert_msg(!both.c.floating || has_minimum(*zone, nothing) == expected, "%s: without load, tangents of %g",
                      both.name().c_str(), share);
    }
    ck_assert(indefinite > 0 && (definite > 0 || both.c.floating));
}

// The digits of an engine are its own.
LOOP_TEST(continues_bit_for_bit, 0, runs) {
    Both both(loop);
    if (both.kind == Kind::engine) return;
    const unit::LayerState& scene = both.scene;
    JumpOperator& one = *both.op;
    const std::unique_ptr<JumpOperator> other = both.make();
    Response first, second;
    for (const double x : {0.0, 0.05, 0.06}) one.solve(unit::advanced(scene, x), scene.theta, first);
    const std::vector<double> memory = one.memory();
    ck_assert(both.kind != Kind::iterated || !memory.empty());
    other->require_memory(memory);
    other->recall(memory);
    second = first;
    for (const double x : {0.065, 0.08}) {
        one.solve(unit::advanced(scene, x), scene.theta, first);
        other->solve(unit::advanced(scene, x), scene.theta, second);
        ck_assert(first.jump == second.jump && first.force == second.force && first.multipliers == second.multipliers);
        ck_assert(first.stored_bulk == second.stored_bulk && first.iterations == second.iterations);
    }
    ck_assert(one.memory() == other->memory());
    for (const std::size_t damaged : {std::size_t{0}, memory.size() - 1}) {
        std::vector<double> wrong = memory;
        if (wrong.empty())
            wrong.push_back(1.0);
        else
            wrong[damaged] = -1.0;
        ck_assert_refused(DELAM_ERROR_SNAPSHOT, "", other->require_memory(wrong));
    }
}

// Four blocks around a point, one of them held: the jumps of the last interface follow from those of the others, and
// free blocks resist some jumps by nothing. The stiffness against a row is still that of the nodes which it moves.
LOOP_TEST(rows_have_the_stiffness_of_their_nodes, 0, 3) {
    std::vector<double> nodes;
    std::vector<std::int64_t> cells;
    for (int block = 0; block < 4; ++block)
        for (const auto& [x, y] : {std::pair{0, 0}, {1, 0}, {1, 1}, {0, 1}}) {
            cells.push_back(static_cast<std::int64_t>(nodes.size() / 2));
            nodes.push_back(x + block % 2);
            nodes.push_back(y + block / 2);
        }
    auto mesh = std::make_shared<Mesh>(2, nodes);
    mesh->add_cells(CellType::quad4, cells, std::vector<std::int32_t>{0, 1, 2, 3});
    ck_assert_int_eq(add_all_interfaces(*mesh, 0.0), 4);
    Problem problem(mesh);
    for (auto& material : problem.material) material = Elastic{30.0, 0.2};
    for (auto& interface : problem.interfaces) {
        interface.contact = true;
        std::fill(interface.adhesion.begin(), interface.adhesion.end(), 0.0);
    }
    for (std::int64_t dof = 0; dof < 8; ++dof) problem.constraints.push_back({{dof}, {1.0}, {}});
    unit::Reference condensed(problem);
    const SparseMatrix& k = condensed.bulk->system().stiffness();
    double nodal = 0.0;  // equal for all
    for (std::int64_t e = k.start[0]; e < k.start[1]; ++e)
        if (k.column[index(e)] == 0) nodal = k.value[index(e)];
    std::vector<double> stiffness = condensed->row_stiffness();
    if (loop == 1) stiffness = Iterated(problem, condensed.monitor).row_stiffness();
    if (loop == 2) stiffness = Feti(problem, condensed.monitor).row_stiffness();
    ck_assert_uint_eq(stiffness.size(), index(problem.jump_count()));
    for (std::size_t r = 0; r < stiffness.size(); ++r)
        ck_assert_msg(stiffness[r] >= 0.5 * nodal && stiffness[r] <= 4.0 * nodal, "row %d: %.3e, a node has %.3e",
                      static_cast<int>(r), stiffness[r], nodal);
}

// FETI: another zone first, a solve between, another operator: the same bits.
LOOP_TEST(feti_does_not_depend_on_the_past, 0, 7) {
    const unit::LayerCase& c = unit::layer_cases[loop < 6 ? loop : 15];
    const unit::LayerState scene(c, 7), other(c, 8);
    Monitor monitor;
    Feti unused(scene.problem, monitor), used(scene.problem, monitor);
    std::vector<std::uint8_t> elsewhere(scene.wanted.size(), 0);
    std::fill(elsewhere.end() - static_cast<std::ptrdiff_t>(scene.dim) * 20, elsewhere.end(), std::uint8_t{1});
    ck_assert(used.zone(other.springs, elsewhere, false) != nullptr);
    Response before, after;
    used.solve(scene.springs, scene.theta, before);
    ck_assert(used.zone(scene.springs, elsewhere, false) != nullptr);
    DenseZone* of_used = used.zone(scene.springs, scene.wanted, false);
    DenseZone* of_unused = unused.zone(scene.springs, scene.wanted, false);
    ck_assert(of_used->jump_rows() == of_unused->jump_rows());
    ck_assert(of_used->energy().stiffness.value == of_unused->energy().stiffness.value);
    ck_assert(of_used->energy().load.value == of_unused->energy().load.value);
    // Nor does a solve depend on the zones before it.
    unused.solve(scene.springs, scene.theta, after);
    ck_assert(before.jump == after.jump && before.force == after.force);
    ck_assert(before.stored_bulk == after.stored_bulk);
}
