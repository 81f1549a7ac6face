// SPDX-License-Identifier: BSD-3-Clause
// The predictions behind the choice of the jump operator against counts: bytes within a factor of 1.5, operations of
// the sparse factor exactly, the entries of the monolithic factor against its own symbolic analysis; and the choice
// itself.
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "check.hpp"
#include "counting_allocator.hpp"
#include "delam/delam.h"
#include "evolution/analysis/solver.hpp"
#include "flexure.hpp"
#include "linalg/sparse/cholesky.hpp"
#include "reduction/choice/choose.hpp"
#include "reduction/condensed/bulk.hpp"
#include "reduction/sparse/iterated/iterated.hpp"
#include "refused.hpp"
#include "scene/advice/expected_parts.hpp"
#include "scene/advice/process_zone.hpp"

using namespace delam;

namespace {

// A slender laminate in the plane, six thin layers with much interface, three plates in space, of which nested
// dissection orders the last two.
unit::Flexure scene(int which) {
    unit::Flexure f;
    if (which == 0) {
        f.along = 480;
        f.through = 12;
    } else if (which == 1) {
        f.along = 120;
        f.through = 6;
        f.layers = 6;
        f.thickness = 1e-3;
        f.press = 2e-3;
    } else {
        f.dimension = 3;
        f.along = 40;
        f.across = 4;
        f.through = 2;
        if (which == 3) {
            f.along = 60;
            f.across = 20;
        } else if (which == 4) {
            f.along = f.across = 40;
            f.through = 1;
        }
    }
    return f;
}

// Peak memory of an analysis of a few steps, including the solver, above the use before.
double counted_analysis(const Problem& problem, double& predicted, double& unknowns) {
    Monitor monitor;
    const long before = unit::live_bytes;
    unit::peak_bytes = before;
    Solver solver(problem, monitor, 0.0);
    for (int k = 1; k <= (problem.options.reduction == "condensed" ? 8 : 1); ++k) {  // the others have their peak early
        ck_assert_int_ge(solver.advance(k / 8.0).status, 0);
        solver.commit();
    }
    const ReductionChoice& choice = solver.stepper().reduction();
    predicted = choice.own().bytes;
    unknowns = choice.condensed() ? static_cast<double>(choice.unknowns) : choice.boundary;
    return static_cast<double>(unit::peak_bytes - before);
}

void expect_within(double predicted, double counted, double factor, const std::string& what) {
    std::printf("%s: predicted %.4g, counted %.4g, ratio %.2f\n", what.c_str(), predicted, counted,
                predicted / counted);
    ck_assert_msg(predicted <= factor * counted && counted <= factor * predicted, "%s: predicted %g, counted %g",
                  what.c_str(), predicted, counted);
}

}  // namespace

// loop: scene and realisation.
LOOP_TEST(memory_is_what_was_predicted, 0, 9) {
    if (!unit::counting) return;
    unit::Flexure flexure = scene(loop % 3);
    if (loop == 3 || loop == 4 || loop == 6 || loop == 7) flexure.along /= 2;  // Krylov steps take long
    Problem problem = unit::make_flexure(flexure);
    constexpr const char* ways[] = {"condensed", "feti", "iterated"};
    problem.options.reduction = ways[loop / 3];
    double predicted = 0.0, unknowns = 0.0;
    const double counted = counted_analysis(problem, predicted, unknowns);
    expect_within(predicted, counted, 1.5,
                  "bytes, scene " + std::to_string(loop % 3) + ", " + problem.options.reduction);
}

// Fill of a symbolic analysis by its definition, from the column counts of a banded matrix: CHOLMOD reports sums of
// their squares as flops.
TEST(operations_of_the_sparse_factor_are_exact) {
    constexpr std::int64_t n = 200, band = 7;
    std::vector<Triplet> triplets;
    for (std::int64_t i = 0; i < n; ++i)
        for (std::int64_t j = std::max<std::int64_t>(0, i - band); j < std::min(n, i + band + 1); ++j)
            triplets.push_back({i, j, i == j ? 20.0 : -1.0});
    const SparseMatrix matrix = from_triplets(n, n, std::move(triplets));
    const SparseCholesky factor(matrix, n);  // the given order
    double entries = 0.0, flops = 0.0;
    for (std::int64_t j = 0; j < n; ++j) {
        const auto count = static_cast<double>(std::min(band, n - 1 - j) + 1);
        entries += count;
        flops += count * count;
    }
    ck_assert(factor.size().entries == entries);
    ck_assert(factor.size().flops == flops);
}

// The structure with all springs, ordered freely, as a monolithic code would factor it.
LOOP_TEST(monolithic_factor_is_what_was_predicted, 0, 5) {
    const Problem problem = unit::make_flexure(scene(loop));
    Monitor monitor;
    const Bulk bulk(problem, monitor);
    const SparseCholesky free_order(bulk.transformed());
    expect_within(predict_monolithic_entries(bulk), free_order.size().entries, 1.5,
                  "entries of the monolithic factor, scene " + std::to_string(loop));
    if (!unit::counting || loop > 2) return;
    SparseMatrix matrix = bulk.transformed();
    for (std::int64_t r = 0; r < matrix.rows; ++r)
        for (std::int64_t e = matrix.start[static_cast<std::size_t>(r)];
             e < matrix.start[static_cast<std::size_t>(r) + 1]; ++e)
            if (matrix.column[static_cast<std::size_t>(e)] == r) matrix.value[static_cast<std::size_t>(e)] *= 2.0;
    const long before = unit::live_bytes;
    unit::peak_bytes = before;
    SparseCholesky factor(matrix);
    ck_assert(factor.factorise(matrix));
    const double own = 16.0 * static_cast<double>(matrix.entries());
    expect_within(predict_monolithic_bytes(bulk), own + static_cast<double>(unit::peak_bytes - before), 1.5,
                  "bytes of the monolithic factorisation, scene " + std::to_string(loop));
}

TEST(options_force_and_say_so) {
    Monitor monitor;
    Problem problem = unit::make_flexure({});
    {
        const Solver solver(problem, monitor, 0.0);
        ck_assert(solver.stepper().reduction().condensed() && !solver.stepper().reduction().forced);
        ck_assert(solver.stepper().reduction().condensation.longest > 0.0);
        ck_assert(solver.stepper().reduction().condensation.longest < solver.stepper().reduction().condensation.setup);
    }
    problem.options.subdomains = 4;
    {
        const Solver solver(problem, monitor, 0.0);
        ck_assert(!solver.stepper().reduction().condensed() && solver.stepper().reduction().forced &&
                  solver.stepper().reduction().subdomains == 4);
    }
    problem.options.reduction = "condensed";
    ck_assert(Solver(problem, monitor, 0.0).stepper().reduction().condensed());
    problem.options.subdomains = 0;
    problem.options.reduction = "feti";
    ck_assert(Solver(problem, monitor, 0.0).stepper().reduction().realisation == Realisation::feti);
    problem.options.reduction = "iterated";
    const Solver solver(problem, monitor, 0.0);
    ck_assert(solver.stepper().reduction().realisation == Realisation::iterated && solver.stepper().reduction().forced);
    ck_assert(solver.stepper().reduction().iteration.longest > 0.0 &&
              solver.stepper().reduction().iteration.bytes > 0.0);
}

// The prediction from the condensed operator's analysis agrees with the iterated operator.
LOOP_TEST(iterated_size_is_what_was_predicted, 0, 5) {
    const Problem problem = unit::make_flexure(scene(loop));
    Monitor monitor;
    const IteratedSize before = iterated_size(Bulk(problem, monitor)), after = Iterated(problem, monitor).size();
    const std::string where = ", scene " + std::to_string(loop);
    ck_assert(before.variables == after.variables && before.stiffness == after.stiffness);
    expect_within(before.transformed, after.transformed, 1.01, "entries of the matrix" + where);
    expect_within(before.stored, after.stored, 1.5, "numbers of the factor" + where);
    expect_within(predict_iterated(before).analysis(), predict_iterated(after).analysis(), 1.5, "operations" + where);
}

void note_stage(std::vector<std::string>& stages, Monitor& monitor) {
    monitor.progress_user = &stages;
    monitor.progress_callback = [](const char* stage, std::int64_t, std::int64_t, void* user) {
        static_cast<std::vector<std::string>*>(user)->emplace_back(stage);
        return 0;
    };
}

// The message with which a solver is refused, "": it is not.
std::string refused(const Problem& problem, Monitor& monitor) {
    return unit::refusal(DELAM_ERROR_MEMORY, [&] { const Solver solver(problem, monitor, 0.0); });
}

constexpr double gibibyte = 1073741824.0;

// loop: realisation
LOOP_TEST(what_does_not_fit_is_refused_before_it_is_factored, 0, 3) {
    Problem problem = unit::make_flexure(scene(loop == 2 ? 0 : loop + 1));
    constexpr const char* ways[] = {"condensed", "iterated", "feti"};
    problem.options.reduction = ways[loop];
    std::vector<std::string> stages;
    Monitor monitor;
    note_stage(stages, monitor);
    const double least = design_operator(problem, monitor).choice.own().least;
    ck_assert(least > 0.0);
    problem.options.memory_limit = 0.99 * least / gibibyte;
    stages.clear();
    const std::string words = refused(problem, monitor);
    for (const char* part : {"takes at least", "option memory_limit", "coarser cells"})
        ck_assert_msg(words.find(part) != std::string::npos, "%s", words.c_str());
    for (const char* stage : {"factor", "condense", "subdomain"}) ck_assert(std::ranges::count(stages, stage) == 0);
    // Another realisation that was predicted and fits is named: six layers have many jumps.
    ck_assert((words.find("use reduction = iterated") != std::string::npos) == (loop == 0));
    problem.options.memory_limit = 1.01 * least / gibibyte;
    ck_assert(refused(problem, monitor).empty());
    if (loop == 2) return;
    // Not even the matrices fit: refused before they are assembled.
    problem.options.memory_limit = 1e-4;
    stages.clear();
    ck_assert(refused(problem, monitor).find("stiffness of the bodies") != std::string::npos);
    ck_assert(std::ranges::count(stages, "assemble") == 0);
}

TEST(auto_takes_what_fits) {
    Problem problem = unit::make_flexure(scene(1));
    Monitor monitor;
    ReductionChoice free = design_operator(problem, monitor).choice;
    ck_assert(free.condensed() && free.iteration.bytes < free.condensation.least);
    problem.options.memory_limit = 0.5 * (free.iteration.bytes + free.condensation.least) / gibibyte;
    const ReductionChoice bound = design_operator(problem, monitor).choice;
    ck_assert(bound.realisation == Realisation::iterated &&
              bound.reason.find("option memory_limit") != std::string::npos);
    free.iteration.bytes = 2.0 * free.condensation.bytes;
    free.iteration.step = 0.0;
    free.memory = {1.5 * free.condensation.bytes, "planted"};
    choose(free);
    ck_assert(free.condensed());
}

// FETI is taken where its subdomains alone fit, and only there.
TEST(auto_takes_feti_where_nothing_else_fits) {
    Monitor monitor;
    const ReductionChoice free = design_operator(unit::make_flexure(scene(4)), monitor).choice;
    ck_assert(free.realisation != Realisation::feti);
    ReductionChoice planted = free;
    planted.feti.bytes = 0.5 * planted.own().least;
    planted.memory = {0.7 * planted.own().least, "planted"};
    prefer_what_fits(planted);
    ck_assert(planted.realisation == Realisation::feti && planted.reason.find("planted") != std::string::npos);
    for (const double room : {0.4, 1.1}) {  // not even FETI fits; the other may
        ReductionChoice other = free;
        other.feti.bytes = 0.5 * other.own().least;
        other.memory = {room * other.own().least, "planted"};
        prefer_what_fits(other);
        ck_assert(other.realisation == free.realisation && other.reason == free.reason);
    }
    // Solid blocks: subdomains have less fill than one factor.
    unit::Flexure block;
    block.dimension = 3;
    block.along = block.across = 20;
    block.through = 10;
    Problem problem = unit::make_flexure(block);
    const ReductionChoice of_block = design_operator(problem, monitor).choice;
    const double others = std::min(of_block.condensation.least, of_block.iteration.least);
    ck_assert_msg(of_block.realisation != Realisation::feti && of_block.feti.bytes < others, "%g, others at least %g",
                  of_block.feti.bytes, others);
    problem.options.memory_limit = 0.5 * (of_block.feti.bytes + others) / gibibyte;
    const Design bound = design_operator(problem, monitor);
    ck_assert(bound.choice.realisation == Realisation::feti && !bound.choice.forced && bound.refusal.empty());
    ck_assert(bound.op == nullptr && bound.bulk == nullptr &&
              bound.choice.reason.find("option memory_limit") != std::string::npos);
}

TEST(limits_of_the_process_are_seen) {
    const MemoryLimit machine = memory_limit();
    ck_assert(machine.bytes > 1e8 && !machine.what.empty());
    if (!unit::counting) return;  // sanitizers map more than there is
    rlimit before{};
    ck_assert_int_eq(getrlimit(RLIMIT_AS, &before), 0);
    const double planted = 0.999 * std::min(machine.bytes, 1e15);  // the mapped memory of the process must fit
    const rlimit less{static_cast<rlim_t>(planted), before.rlim_max};
    ck_assert_int_eq(setrlimit(RLIMIT_AS, &less), 0);
    const MemoryLimit limited = memory_limit();
    ck_assert_int_eq(setrlimit(RLIMIT_AS, &before), 0);
    ck_assert(limited.bytes == std::floor(planted) && limited.what.find("address space") != std::string::npos);
}

// METIS took 3.3 s for a million displacements.
TEST(waits_for_orderings_are_predicted) {
    IteratedSize size;
    size.variables = 1.05e6;
    const double ordering = predict_iterated(size).ordering / nominal_rate;
    ck_assert(ordering > 2.0 && ordering < 5.0);
    Monitor monitor;
    const Problem problem = unit::make_flexure({});
    const Bulk bulk(problem, monitor);
    // Piece by piece.
    const double expected =
        ordering * nominal_rate * static_cast<double>(bulk.superelements().largest_inside()) / 1.05e6;
    ck_assert(std::abs(predict_condensed(bulk, 1.0).ordering - expected) < 1e-9 * expected);
}

// A front advances by a tenth of its zone or half a pair in a part; half of the pairs break.
TEST(parts_follow_from_the_zone) {
    const Problem problem = unit::make_flexure({});
    ck_assert(expected_parts(problem, false, 0.1).growth == 0.0);
    const ProcessZone zone = predicted_process_zone(problem, 0);
    const double pairs = zone.length / zone.spacing;
    ck_assert(pairs > 0.0);
    const auto& adhesion = problem.interfaces[0].adhesion;
    const auto adhering = static_cast<double>(std::ranges::count_if(adhesion, [](double z) { return z > 0.0; }));
    const double expected = 0.5 * adhering / std::max(0.5, 0.1 * pairs);
    ck_assert(std::abs(expected_parts(problem, true, 0.1).growth - expected) < 1e-9 * expected);
    // Longer parts are no more.
    ck_assert(expected_parts(problem, true, 0.5).growth <= expected);
}

TEST(size_memory_and_time_decide) {
    ReductionChoice c;
    const auto iterated = [&] { return c.realisation == Realisation::iterated; };
    c.condensation = {1e9, 1e9, 1e8, 1e10};
    c.iteration = {1e9, 1e9, 1e9, 5e9};
    c.monolithic = 5e9;
    c.memory = {1.5e10, "planted"};
    choose(c);
    ck_assert(c.condensed() && c.reason.find("2 times") != std::string::npos);
    c.monolithic = 3e9;  // 3.3 times
    choose(c);
    ck_assert(iterated() && c.reason.find("more than 2.5") != std::string::npos);
    c.memory.bytes = 3e10;  // less than half of it
    choose(c);
    ck_assert(c.condensed());
    c.memory.bytes = 1.5e10;
    c.iteration.bytes = 1.4e10;  // more than condensed
    choose(c);
    ck_assert(c.condensed());
    c.condensation.bytes = 1e8;  // three times, but little
    c.monolithic = 3e7;
    choose(c);
    ck_assert(c.condensed());
    c.iteration.step = 1e7;
    choose(c);
    ck_assert(iterated() && c.reason.find("predicted to take") != std::string::npos);
    c.unknowns = dense_limit + 1;
    c.condensation.possible = false;
    c.iteration.step = 1e12;
    choose(c);
    ck_assert(iterated() && c.reason.find("46340") != std::string::npos);
}
