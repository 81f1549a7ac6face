// SPDX-License-Identifier: BSD-3-Clause
#include "reduction/choice/choose.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "base/numbers.hpp"
#include "delam/delam.h"
#include "reduction/condensed/condensed.hpp"
#include "reduction/feti/feti.hpp"
#include "reduction/operator/open_bonds.hpp"
#include "reduction/sparse/engine/engine_operator.hpp"
#include "reduction/sparse/iterated/iterated.hpp"
#include "scene/carriers.hpp"
#include "scene/check/step_control.hpp"

namespace delam {

namespace {

double number(std::int64_t n) { return static_cast<double>(n); }
double square(double x) { return x * x; }
double cube(double x) { return x * x * x; }

#define DELAM_PRICE(name, value, reason) constexpr double name = value;
#include "reduction/choice/prices.inc"
#undef DELAM_PRICE

std::string mebibytes(double bytes) { return text(std::round(bytes / 1048576.0), " MiB"); }
std::string seconds(double operations) {
    const double s = operations / nominal_rate;
    return text(s < 0.01 ? std::round(s * 1e5) / 1e5 : std::round(s * 100.0) / 100.0, " s");
}

// Nodes on the cuts through a box of `nodes` nodes in that many parts: the longest side is cut repeatedly.
double cut_nodes(const std::array<double, 3>& side, int dimension, double nodes, double parts) {
    double volume = 1.0;
    for (int i = 0; i < dimension; ++i) volume *= side[index(i)];
    if (!(volume > 0.0) || parts < 1.5) return 0.0;
    const double spacing = std::pow(volume / nodes, 1.0 / dimension);
    std::array<double, 3> pieces{1.0, 1.0, 1.0};
    while (pieces[0] * pieces[1] * pieces[2] < parts) {
        std::size_t longest = 0;
        for (std::size_t i = 1; i < index(dimension); ++i)
            if (side[i] / pieces[i] > side[longest] / pieces[longest]) longest = i;
        pieces[longest] += 1.0;
    }
    double cut = 0.0;
    for (std::size_t i = 0; i < index(dimension); ++i) {
        double area = 1.0;  // in nodes
        for (std::size_t j = 0; j < index(dimension); ++j)
            if (j != i) area *= side[j] / spacing + 1.0;
        cut += (pieces[i] - 1.0) * area;
    }
    return cut;
}

}  // namespace

ReductionCost predict_condensed(const Bulk& bulk, double minimisations) {
    const Superelements& pieces = bulk.superelements();
    const CondensationSize once = pieces.condensation();
    const double stiffness = 16.0 * number(bulk.system().stiffness().entries()),
                 transformed = 16.0 * number(bulk.transformed().entries()), factor = 8.0 * pieces.factor_entries(),
                 dense = 8.0 * (pieces.dense_entries() + once.numbers);
    ReductionCost cost;
    cost.setup = pieces.size().flops + 2.0 * once.operations + setup_overhead * number(bulk.transformed().rows);
    cost.longest = pieces.longest();
    cost.ordering = ordering_operations * number(pieces.largest_inside());
    cost.part = step_overhead * number(bulk.system().variables().trailing());
    cost.step = condensed_step * once.operations + minimisations * cost.part;
    // T^T K T while the leaves are condensed; afterwards what is left of the skeleton.
    cost.bytes = stiffness + factor + 8.0 * pieces.dense_entries() +
                 std::max(transformed,
                          8.0 * (once.numbers + zone_squares * square(number(bulk.system().variables().trailing()))));
    cost.least = stiffness + factor + dense;
    return cost;
}

ReductionCost predict_iterated(const IteratedSize& size) {
    // Two passes over the factor in single precision, and three products with the matrix.
    const double product = from_memory * (2.0 * size.stored + 6.0 * size.transformed);
    const double solves = iterated_solves * (size.softening > 1.0 ? many_interfaces : 1.0);
    ReductionCost cost;
    cost.longest = size.factor.flops;
    cost.setup = size.factor.flops + setup_overhead * size.variables;
    cost.ordering = ordering_operations * size.variables;
    cost.step = solves * iterated_products * product + patch_operations * std::min(size.variables, patch_variables) +
                iterated_renewals * size.factor.flops;
    cost.part = solves / usual_minimisations * iterated_products * product;
    // K, T^T K T, CHOLMOD's permuted copy of half of it, the factor, some states and the directions of an
    // iteration.
    const double factors = 8.0 * size.factors * size.stored;
    cost.bytes = 16.0 * (size.stiffness + 1.5 * size.transformed) + factors +
                 8.0 * (iterated_vectors + size.columns) * size.variables;
    cost.least = 16.0 * (size.stiffness + size.transformed) + factors + 8.0 * size.columns * size.variables;
    cost.most = cost.bytes + 8.0 * (most_vectors - iterated_vectors) * size.variables +
                2.0 * Limits{}.patch_largest * (16.0 * size.transformed + 8.0 * size.stored);
    return cost;
}

IteratedSize iterated_size(const Bulk& bulk) {
    IteratedSize size;
    size.variables = number(bulk.transformed().rows);
    size.stiffness = number(bulk.system().stiffness().entries());
    size.transformed = number(bulk.transformed().entries());
    size.factor.entries = predict_monolithic_entries(bulk);
    size.factor.flops = column_spread * square(size.factor.entries) / std::max(size.variables, 1.0);
    size.stored = relaxed_supernodes * size.factor.entries;
    size.factors = Reanalysis::keeps_two_factors(bulk.system().problem()) ? 2.0 : 1.0;
    size.columns = number(static_cast<std::int64_t>(bulk.system().variables().equations.size()));
    size.softening = number(bulk.system().problem().softening_count());
    return size;
}

const ReductionCost& ReductionChoice::own() const {
    switch (realisation) {
        case Realisation::condensed:
            return condensation;
        case Realisation::feti:
            return feti;
        case Realisation::engine:
            return engine;
        case Realisation::iterated:
            break;
    }
    return iteration;
}

double predict_monolithic_entries(const Bulk& bulk) { return bulk.superelements().entries_in_order(); }

double predict_monolithic_bytes(const Bulk& bulk) {
    return 40.0 * number(bulk.transformed().entries()) + 8.0 * supernodes * predict_monolithic_entries(bulk);
}

ReductionCost predict_feti(const Problem& problem, std::int64_t subdomains, double& boundary) {
    const Mesh& mesh = *problem.mesh;
    const int dim = mesh.dimension();
    const double dofs = number(mesh.node_count() * dim), parts = number(subdomains);
    const Carriers carriers(problem);
    const auto of_a_body = [&](std::int64_t node) { return carriers.kind(node) == Carriers::Kind::body; };
    std::set<std::int64_t> touched;
    for (const InterfaceGeometry& face : mesh.interfaces())
        for (const auto* side : {&face.node_a, &face.node_b})
            for (const std::int64_t node : *side)
                for (const auto& [carrier, weight] : carriers.of(node))
                    if (of_a_body(carrier)) touched.insert(carrier);
    std::set<std::int64_t> driven;
    for (const Constraint& constraint : problem.constraints)
        for (const std::int64_t dof : constraint.dof)
            if (of_a_body(dof / dim) && !touched.contains(dof / dim)) driven.insert(dof);
    double copies =
        number(static_cast<std::int64_t>(touched.size())) * dim + number(static_cast<std::int64_t>(driven.size()));
    double element_entries = 0.0;
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        element_entries += square(number(static_cast<std::int64_t>(mesh.cell(c).size()) * dim));
    for (const auto& own : problem.stiffness)
        if (own != nullptr) element_entries += 2.0 * number(own->matrix.entries());
    for (std::int32_t body = 0; body < mesh.body_count(); ++body) {
        std::array<double, 3> low{}, high{}, side{1.0, 1.0, 1.0};
        const std::vector<std::int64_t> nodes = mesh.body_nodes(body);
        for (std::size_t i = 0; i < nodes.size(); ++i)
            for (std::size_t k = 0; k < index(dim); ++k) {
                const double x = mesh.node(nodes[i])[k];
                low[k] = i == 0 ? x : std::min(low[k], x);
                high[k] = i == 0 ? x : std::max(high[k], x);
            }
        for (std::size_t k = 0; k < index(dim); ++k) side[k] = high[k] - low[k];
        const double size = number(static_cast<std::int64_t>(nodes.size()));
        const double share = std::max(1.0, std::round(parts * size / number(mesh.node_count())));
        copies += 2.0 * dim * cut_nodes(side, dim, size, share);
    }
    boundary = std::min(copies, dofs) / parts;
    const double jumps = 2.0 * number(problem.jump_count()) / parts;
    const double inside = std::max(dofs / parts, 2.0);
    // The factor has that many interior unknowns, and its coupling to the boundary counts, too.
    const double entries = dim == 2 ? 5.0 * inside * std::log2(inside) : 17.0 * std::pow(inside, 4.0 / 3.0);
    const double sparse = 3.0 * entries * entries / inside + cube(boundary) / 3.0;
    const bool series = problem.options.preconditioner == "series";
    const bool schur = series || problem.options.preconditioner == "dirichlet";

    ReductionCost cost;
    cost.possible = boundary <= number(dense_limit);
    cost.setup = parts * (sparse + (2.0 / 3.0 + 2.0) * cube(boundary));
    cost.longest = std::max(sparse, 2.0 * cube(boundary));
    const double product = (schur ? 2.0 : 1.0) * 2.0 * boundary * boundary * from_memory;
    cost.step = feti_solves * parts * (feti_iterations * product + (series ? 2.0 / 3.0 * cube(jumps) : 0.0));
    cost.part = cost.step / usual_minimisations;
    cost.bytes =
        16.0 * 0.5 * element_entries + parts * 8.0 * (supernodes * entries + (schur ? 3.0 : 2.0) * boundary * boundary);
    if (series) cost.bytes += parts * series_bytes * jumps * jumps;
    cost.least = 0.5 * cost.bytes;  // predicted by counts alone
    return cost;
}

std::string does_not_fit(const ReductionChoice& choice) {
    const ReductionCost& own = choice.own();
    if (!(own.least > choice.memory.bytes)) return {};
    const struct {
        Realisation realisation;
        const char *name, *option;
        const ReductionCost& cost;
    } all[] = {{Realisation::condensed, "the condensed operator", "condensed", choice.condensation},
               {Realisation::iterated, "the iterated operator", "iterated", choice.iteration},
               {Realisation::feti, "FETI", "feti", choice.feti}};
    std::string name, others;
    for (const auto& one : all) {
        if (one.realisation == choice.realisation)
            name = one.name;
        else if (one.cost.setup > 0.0 && one.cost.possible && one.cost.bytes < choice.memory.bytes)
            others += text("reduction = ", one.option, ", predicted to take ", mebibytes(one.cost.bytes), ", ");
    }
    return text(name, " takes at least ", mebibytes(own.least), ", at its peak ", mebibytes(own.bytes),
                " are predicted, but there are ", mebibytes(choice.memory.bytes), " (", choice.memory.what, "): use ",
                others, "coarser cells, or a machine with more memory");
}

void choose(ReductionChoice& choice) {
    const ReductionCost &c = choice.condensation, &i = choice.iteration;
    const auto decide = [&](Realisation realisation, std::string reason) {
        choice.realisation = realisation;
        choice.reason = std::move(reason);
    };
    if (!c.possible)
        return decide(Realisation::iterated, text("the condensed operator would have ", choice.unknowns,
                                                  " rows, allowed: up to ", dense_limit, " (LAPACK)"));
    const double limit = choice.memory.bytes;
    if ((c.bytes > limit) != (i.bytes > limit))
        return decide(c.bytes > limit ? Realisation::iterated : Realisation::condensed,
                      text("the condensed operator is predicted to take ", mebibytes(c.bytes), ", the iterated one ",
                           mebibytes(i.bytes), "; there are ", mebibytes(limit), " (", choice.memory.what, ")"));
    const double ratio = choice.monolithic > 0.0 ? c.bytes / choice.monolithic : 0.0;
    const std::string memory =
        text("the condensed operator needs ", mebibytes(c.bytes), ", ", std::round(10.0 * ratio) / 10.0,
             " times the memory of one monolithic factorisation");
    if (c.bytes > memory_share * limit && ratio > memory_ratio && i.bytes < c.bytes)
        return decide(Realisation::iterated,
                      text(memory, ", more than ", memory_ratio, ", and more than ", memory_share, " of ",
                           mebibytes(limit), " (", choice.memory.what, ")"));
    const std::string times =
        text(nominal_steps, " load steps, the measure of this choice, are predicted to take ", seconds(c.analysis()),
             " condensed and ", seconds(i.analysis()), " iterated, at ", nominal_rate * 1e-9, " GF/s");
    if (i.analysis() < c.analysis()) return decide(Realisation::iterated, times);
    decide(Realisation::condensed, text(memory, "; ", times));
}

namespace {

// Entries of the stiffness of all bodies, counted without it.
double stiffness_entries(const Problem& problem) {
    const Mesh& mesh = *problem.mesh;
    std::vector<std::int64_t> start(index(mesh.node_count()) + 1, 0), seen(index(mesh.node_count()), -1);
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        for (const std::int64_t node : mesh.cell(c)) ++start[index(node) + 1];
    std::partial_sum(start.begin(), start.end(), start.begin());
    std::vector<std::int64_t> cells(index(start.back())), next(start.begin(), start.end() - 1);
    for (std::int64_t c = 0; c < mesh.cell_count(); ++c)
        for (const std::int64_t node : mesh.cell(c)) cells[index(next[index(node)]++)] = c;
    double neighbours = 0.0, given = 0.0;
    for (std::int64_t node = 0; node < mesh.node_count(); ++node)
        for (std::int64_t k = start[index(node)]; k < start[index(node) + 1]; ++k)
            for (const std::int64_t other : mesh.cell(cells[index(k)]))
                neighbours += std::exchange(seen[index(other)], node) != node ? 1.0 : 0.0;
    for (const auto& own : problem.stiffness)
        if (own != nullptr) given += number(own->matrix.entries());
    return square(mesh.dimension()) * neighbours + given;
}

// Bytes without which the bodies cannot even be assembled and analysed, 0: too few to matter. Per entry of K, 16 bytes
// in K, 16 in T^T K T and 9.6 in the ordering by minimum degree, which only the free displacements have.
double least_to_analyse(const Problem& problem, const MemoryLimit& limit) {
    const double dofs = number(problem.mesh->node_count() * problem.mesh->dimension());
    if (1e4 * dofs < limit.bytes) return 0.0;  // no cells have so many neighbours
    const double bound = number(static_cast<std::int64_t>(problem.constraints.size()));
    const double free = std::max(0.0, 1.0 - 2.0 * bound / std::max(dofs, 1.0));
    return (16.0 + 25.6 * free) * stiffness_entries(problem);
}

// Tells the design what is known of its jump rows before anything is factored.
void take_rows(Design& design, const Problem& problem, const JumpVariables& variables) {
    refuse_open_bonds(problem, variables);
    design.bound = bound_rows(variables);
}

Design of_iterated(Design design, const Problem& problem, std::unique_ptr<Iterated> iterated) {
    design.choice.iteration = predict_iterated(iterated->size());
    design.choice.factor_entries = iterated->size().factor.entries;
    design.description = iterated->description();
    take_rows(design, problem, iterated->variables());
    design.prescribed.assign(iterated->prescribed_rows().begin(), iterated->prescribed_rows().end());
    design.op = std::move(iterated);
    return design;
}

Design of_engine(Design design, const Problem& problem, Monitor& monitor) {
    if (problem.options.reduction != "auto" || problem.options.subdomains > 0)
        fail(DELAM_ERROR_PROBLEM, "the problem has an engine: option 'reduction' = '", problem.options.reduction,
             "', 'subdomains' = ", problem.options.subdomains, ", allowed: auto and 0");
    auto op = std::make_unique<EngineOperator>(problem, monitor);
    design.choice.forced = true;
    design.choice.realisation = Realisation::engine;
    design.choice.reason = "the engine of the host";
    design.choice.unknowns = problem.jump_count();
    design.description = op->description();
    take_rows(design, problem, op->variables());
    design.prescribed.assign(op->prescribed_rows().begin(), op->prescribed_rows().end());
    design.in_engine = op.get();
    design.op = std::move(op);
    return design;
}

Design of_feti(Design design, const Problem& problem, Monitor& monitor) {
    design.description = text("total FETI: ", design.choice.subdomains, " subdomains, ", problem.jump_count(),
                              " jump multipliers, preconditioner ", problem.options.preconditioner);
    const JumpVariables variables = make_jump_variables(problem, [&monitor] { monitor.progress("assemble", 0, 0); });
    take_rows(design, problem, variables);
    design.prescribed = prescribed_rows(variables);
    return design;
}

Design of_condensed(Design design, const Problem& problem, std::shared_ptr<Bulk> bulk) {
    design.description = Condensed::description_of(*bulk);
    take_rows(design, problem, bulk->system().variables());
    design.prescribed = prescribed_rows(bulk->system().variables());
    design.bulk = std::move(bulk);
    return design;
}

}  // namespace

Design::Design() = default;
Design::Design(ReductionChoice made) : choice(std::move(made)) {}
Design::Design(Design&&) noexcept = default;
Design& Design::operator=(Design&&) noexcept = default;
Design::~Design() = default;

namespace {

bool feti_fits(const ReductionChoice& choice) {
    return !choice.forced && choice.feti.possible && choice.feti.bytes < choice.memory.bytes;
}

void take_feti(ReductionChoice& choice, const std::string& instead) {
    choice.reason = text(instead, ", FETI is predicted to take ", mebibytes(choice.feti.bytes), "; there are ",
                         mebibytes(choice.memory.bytes), " (", choice.memory.what, "); ", nominal_steps,
                         " load steps, the measure of this choice, are predicted to take ",
                         seconds(choice.feti.analysis()), " with it");
    choice.realisation = Realisation::feti;
}

}  // namespace

void prefer_what_fits(ReductionChoice& choice) {
    const double least = choice.own().least;
    if (!feti_fits(choice) || !(least > choice.memory.bytes)) return;
    take_feti(choice, text(choice.condensed() ? "the condensed" : "the iterated", " operator takes at least ",
                           mebibytes(least)));
}

namespace {

Design chosen(const Problem& problem, Monitor& monitor) {
    const Options& options = problem.options;
    Design design;
    ReductionChoice& choice = design.choice;
    choice.memory = memory_limit(problem.options.memory_limit);
    if (problem.engine != nullptr) return of_engine(std::move(design), problem, monitor);
    const StepControl control = used_step_control(problem, options);
    choice.parts = expected_parts(problem, control.name == "load", control.path_step);
    choice.unknowns = problem.jump_count();
    choice.subdomains = feti_subdomains(problem);
    choice.feti = predict_feti(problem, choice.subdomains, choice.boundary);
    choice.condensation.possible = choice.unknowns <= dense_limit;
    const auto force = [&](Realisation realisation, std::string reason) {
        choice.forced = true;
        choice.realisation = realisation;
        choice.reason = std::move(reason);
    };

    if (options.reduction == "feti" || (options.reduction == "auto" && options.subdomains > 0)) {
        force(Realisation::feti, options.reduction == "feti" ? "option reduction = feti"
                                                             : text("option subdomains = ", options.subdomains));
        return of_feti(std::move(design), problem, monitor);
    }
    if (const double least = least_to_analyse(problem, choice.memory); least > choice.memory.bytes) {
        const std::string words =
            text("the stiffness of the bodies, ", problem.mesh->node_count() * problem.mesh->dimension(),
                 " displacements, and its analysis take at least ", mebibytes(least));
        if (options.reduction == "auto" && feti_fits(choice)) {
            take_feti(choice, words);
            return of_feti(std::move(design), problem, monitor);
        }
        fail(DELAM_ERROR_MEMORY, words, ", but there are ", mebibytes(choice.memory.bytes), " (", choice.memory.what,
             "): use coarser cells, or a machine with more memory");
    }
    if (options.reduction == "iterated") {
        force(Realisation::iterated, "option reduction = iterated");
        return of_iterated(std::move(design), problem, std::make_unique<Iterated>(problem, monitor));
    }
    if (!choice.condensation.possible) {
        if (options.reduction == "condensed")
            fail(DELAM_ERROR_PROBLEM, "option 'reduction' = 'condensed': the condensed operator would have ",
                 choice.unknowns, " rows, allowed: up to ", dense_limit, "; iterated and feti have no such limit");
        choose(choice);
        return of_iterated(std::move(design), problem, std::make_unique<Iterated>(problem, monitor));
    }
    auto bulk = problem.renewed ? std::make_shared<Bulk>(problem, monitor)
                                : std::make_shared<Bulk>(std::make_shared<const Problem>(problem), monitor);
    choice.unknowns = bulk->system().variables().trailing();
    choice.condensation = predict_condensed(*bulk, choice.parts.per_step);
    choice.iteration = predict_iterated(iterated_size(*bulk));
    choice.factor_entries = bulk->superelements().size().entries;
    choice.monolithic = predict_monolithic_bytes(*bulk);
    choose(choice);
    if (options.reduction == "condensed")
        force(Realisation::condensed, choice.condensed() ? "option reduction = condensed"
                                                         : "option reduction = condensed, although " + choice.reason);
    if (choice.condensed()) return of_condensed(std::move(design), problem, std::move(bulk));
    AssembledBodies assembled = std::move(*bulk).release();
    bulk.reset();  // its analysis is of another order of elimination
    return of_iterated(std::move(design), problem, std::make_unique<Iterated>(problem, std::move(assembled), monitor));
}

}  // namespace

Design design_operator(const Problem& problem, Monitor& monitor) {
    Design design = chosen(problem, monitor);
    if (problem.options.kinematics == "corotational")
        for (ReductionCost* cost : {&design.choice.condensation, &design.choice.iteration})
            cost->step += turned_setups * cost->setup;
    const Realisation first = design.choice.realisation;
    prefer_what_fits(design.choice);
    if (design.choice.realisation != first) {
        design = Design(std::move(design.choice));  // its matrices go before FETI makes others
        design = of_feti(std::move(design), problem, monitor);
    }
    if (design.choice.realisation == Realisation::feti && !design.choice.forced)
        monitor.log(1, text("FETI is used because nothing else fits: ", design.choice.reason));
    design.refusal = does_not_fit(design.choice);
    const double bytes = design.choice.own().bytes, limit = design.choice.memory.bytes;
    if (design.refusal.empty() && bytes > limit)
        monitor.log(1, text("the analysis is predicted to take ", mebibytes(bytes), ", but there are ",
                            mebibytes(limit), " (", design.choice.memory.what, "): it may not fit"));
    return design;
}

std::unique_ptr<JumpOperator> build_operator(Design& design, const Problem& problem, Monitor& monitor) {
    if (!design.refusal.empty()) fail(DELAM_ERROR_MEMORY, design.refusal);
    if (design.op != nullptr) return std::move(design.op);
    if (design.bulk == nullptr) return std::make_unique<Feti>(problem, monitor);
    const std::int64_t before = design.shared ? design.bulk->factorisations() : 0;
    if (!design.shared) design.bulk->condense(monitor);
    return std::make_unique<Condensed>(design.bulk, problem, monitor, before);
}

}  // namespace delam
