// SPDX-License-Identifier: BSD-3-Clause
// The engine on PETSc against a dense direct solution: this program plays the library's core. Run it with mpirun on 1,
// 2, 4 ranks. Options of PETSc choose the preconditioner. With the word `lose` rank 0 fails in the middle of a step
// that all ranks share; with `late` the last rank's task fails while the others work long (faults.py).
#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdlib>
#include <stdexcept>
#include <string>
#include <thread>

#include "delam/petsc.h"
#include "engine_client.hpp"

namespace {

using namespace verify;

delam_experimental_engine given;  // the engine that delam_petsc_attach passes on
Values recovered;                 // the combination of kept answers that delam_petsc_recover is for
int failures = 0;
// The default preconditioner is exact when it is new; PETSC_OPTIONS chooses others.
const bool direct = std::getenv("PETSC_OPTIONS") == nullptr;

void expect(bool good, const char* what, double number, double bound) {
    if (!good) {
        ++failures;
        std::printf("    FAILED %s: %.3g (bound %.3g)\n", what, number, bound);
    }
}

void small(const char* what, double number, double bound) { expect(number <= bound, what, number, bound); }

template <class A, class B>
double difference(const A& a, const B& b, double at_least = 0.0) {
    long double worst = 0, size = at_least;
    for (std::size_t i = 0; i < b.size(); ++i) {
        worst = std::max(worst, std::abs(static_cast<long double>(a[i]) - static_cast<long double>(b[i])));
        size = std::max(size, std::abs(static_cast<long double>(b[i])));
    }
    return size > 0 ? static_cast<double>(worst / size) : static_cast<double>(worst);
}

std::int32_t never(void*) { return 0; }
std::int32_t always(void*) { return 1; }

struct Case {
    Layers layers;
    std::int64_t hidden = 0;
    delam_petsc* petsc = nullptr;
    std::vector<Strip> strips;  // of all ranks, for the reference
};

// Springs of all pairs: k along the normal, k/2 along the others; pairs in [from, to) have none.
std::vector<Acting::Entry> springs(const Case& c, const Variables& v, double k, std::int64_t from, std::int64_t to) {
    std::vector<Acting::Entry> entries;
    const double area = c.layers.length * (c.layers.dimension == 3 ? c.layers.width : 1.0);
    const double weight = area / static_cast<double>(v.pairs);
    for (std::int64_t p = 0; p < v.pairs; ++p)
        for (std::int64_t i = 0; i < v.dimension && (p < from || p >= to); ++i)
            entries.push_back({v.dimension * p + i, v.dimension * p + i, (i == 0 ? 1.0 : 0.5) * k * weight});
    return entries;
}

DenseReference reference(const Case& c, const Variables& v) {
    const std::int64_t dofs = (c.layers.nodes() + 1) * c.layers.dimension, d = c.layers.dimension;
    std::vector<Wide> k(at(dofs), Wide(at(dofs), 0));
    for (const Strip& s : c.strips)
        for (std::size_t r = 0; r + 1 < s.row_starts.size(); ++r)
            for (std::int64_t e = s.row_starts[r]; e < s.row_starts[r + 1]; ++e) {
                const std::int64_t col = s.columns[at(e)], row = static_cast<std::int64_t>(r);
                k[at(s.nodes[at(row / d)] * d + row % d)][at(s.nodes[at(col / d)] * d + col % d)] += s.values[at(e)];
            }
    return DenseReference(dofs, v.view(), std::move(k));
}

// The bounds: of a solve at tolerance 1e-12, and of rounding in the worst of these scenes.
void compare(const char* name, const EngineClient& client, const DenseReference& dense, const Acting& acting,
             const Answered& a, std::int64_t place) {
    if (a.status != DELAM_OK || a.raw.converged == 0 || a.raw.definite == 0) {
        expect(false, name, a.status, 0.0);
        std::printf("    status %d converged %d definite %d: %s\n", a.status, a.raw.converged, a.raw.definite,
                    client.message());
        return;
    }
    const Expected e = dense.solve(acting);
    Values weights(client.kept(), 0.0), u, f;
    weights[at(place)] = 1.0;
    expect(client.recover(weights, u, f) == DELAM_OK, "recover", 1.0, 0.0);
    Wide known_u(e.u.begin(), e.u.begin() + static_cast<std::ptrdiff_t>(u.size()));
    Wide known_f(e.force.begin(), e.force.begin() + static_cast<std::ptrdiff_t>(f.size()));
    const double forces = static_cast<double>(std::abs(
        *std::max_element(known_f.begin(), known_f.end(), [](auto x, auto y) { return std::abs(x) < std::abs(y); })));
    const double energy = std::abs(a.products[at(place)] / static_cast<double>(e.stored) - 1.0);
    const double values = difference(a.values, e.values), balance = difference(a.balance, e.balance, forces);
    const double moved = difference(u, known_u), force = difference(f, known_f);
    const double work = difference(a.work, e.work), lifted = difference(a.lifted, e.lifted);
    std::printf("  %-34s its %3d  energy %.0e  values %.0e  u %.0e  Ku %.0e  balance %.0e  least %.2g\n", name,
                static_cast<int>(a.raw.iterations), energy, values, moved, force, balance, a.raw.least);
    small("energy", energy, 1e-7);
    small("values", values, 1e-6);
    small("displacement", moved, 1e-6);
    small("K u", force, 1e-6);
    small("balance", balance, 1e-6);
    small("work", work, 1e-6);
    small("lifted", lifted, 1e-6);
    small("norm", a.raw.norm, 1e-5 * a.raw.size);
    const double stored = static_cast<double>(e.stored);
    double coupled = 0.0;
    for (const auto& c : acting.couplings)
        coupled += std::abs(static_cast<double>(e.values[at(c.row)] * e.values[at(c.column)]) * c.value);
    small("size", std::abs(a.raw.size / std::sqrt(std::abs(stored) + coupled) - 1.0), 1e-6);
}

// The ranks keep a state, moved along x: only nodes of the mesh are known to move. Without delam_petsc_recover nobody
// knows its eigenstrains.
void keep_on_ranks(const Case& c, const EngineClient& client, const Values& weights, const Values& u) {
    Values moved(u.size(), 0.0), own(u.size() + at(c.layers.dimension * (c.hidden + 1)));
    for (std::size_t i = 0; i < moved.size(); i += at(c.layers.dimension)) moved[i] = 0.5;
    const std::int32_t kept = client.keep(weights, &moved);
    expect(kept == (c.hidden > 0 ? DELAM_ERROR_PROBLEM : DELAM_OK), "motions of nodes beyond the mesh", kept, 0.0);
    if (c.hidden > 0) moved.assign(moved.size(), 0.0);
    if (c.hidden > 0) expect(client.keep(weights, nullptr) == DELAM_OK, "keep", 1.0, 0.0);
    std::int64_t rows = 0, columns = 0, count = 0;
    std::vector<std::int64_t> nodes(own.size());
    require(delam_petsc_part_nodes(c.petsc, static_cast<std::int64_t>(nodes.size()), nodes.data(), nullptr, &count),
            "nodes");
    require(delam_petsc_part_field(c.petsc, "displacement", static_cast<std::int64_t>(own.size()), own.data(), &rows,
                                   &columns),
            "displacement");
    double worst = 0.0, largest = 0.0;
    for (std::int64_t i = 0; i < rows * columns; ++i) {
        const std::size_t dof = at(columns * nodes[at(i / columns)] + i % columns);
        if (dof >= u.size()) continue;
        worst = std::max(worst, std::abs(own[at(i)] - u[dof] - moved[dof]));
        largest = std::max(largest, std::abs(u[dof] + moved[dof]));
    }
    expect(rows == count && rows > 0, "rows", static_cast<double>(rows), static_cast<double>(count));
    small("displacement of the ranks", worst, 1e-14 * largest);
    const std::int32_t status = delam_petsc_part_field(c.petsc, "stress", 0, nullptr, &rows, &columns);
    expect(status == DELAM_ERROR_STATE, "stress without eigenstrains", status, DELAM_ERROR_STATE);
    expect(delam_petsc_part_field(c.petsc, "rotation", 0, nullptr, &rows, &columns) == DELAM_OK, "rotation", 1.0, 0.0);
}

// Whatever the core's recovery ends with, and a recovery that fails leaves the ranks what they have.
void recover_by_the_core(const Case& c, const Values& weights) {
    const auto first = [&] {
        std::int64_t rows = 0, columns = 0;
        require(delam_petsc_part_field(c.petsc, "force", 0, nullptr, &rows, &columns), "shape");
        std::vector<double> force(at(rows * columns));
        require(delam_petsc_part_field(c.petsc, "force", rows * columns, force.data(), nullptr, nullptr), "force");
        return force;
    };
    recovered = weights;
    expect(delam_petsc_recover(c.petsc, nullptr) == DELAM_OK, "recover by the core", 0.0, 0.0);
    const std::vector<double> before = first();
    recovered[0] = std::nan("");
    const std::int32_t status = delam_petsc_recover(c.petsc, nullptr);
    expect(status == DELAM_ERROR_NUMERICAL, "a state that is not finite", status, DELAM_ERROR_NUMERICAL);
    const std::string said = delam_petsc_message(c.petsc);
    expect(said.find("cannot be recovered: DELAM_ERROR_NUMERICAL") != std::string::npos, said.c_str(), 0.0, 0.0);
    expect(first() == before, "what the ranks have after it", 0.0, 0.0);
}

// A sequence as an analysis has it: stiffer and stiffer springs, debonding with an old preconditioner, contact,
// constraints.
void sequence(const Case& c, const Variables& v, const EngineClient& client, double k) {
    const DenseReference dense = reference(c, v);
    std::printf(" springs %.0e\n", k);
    for (std::size_t i = 0; i < v.visible.size(); ++i)
        small("diagonal", std::abs(client.diagonal[i] - static_cast<double>(dense.diagonal(i))),
              1e-10 * static_cast<double>(dense.diagonal(i)));
    for (std::size_t p = 0; p < client.load_sizes.size(); ++p) {
        const Wide load = dense.load(p);
        long double largest = 0;
        for (const long double x : load) largest = std::max(largest, std::abs(x));
        small("load size", std::abs(client.load_sizes[p] / static_cast<double>(largest) - 1.0), 1e-10);
    }
    Acting acting;
    acting.theta = {1.0, 0.5};
    acting.couplings = springs(c, v, k, 0, 0);
    Values force(client.visible(), 0.0);
    force[0] = 3.0;
    double cost = 0.0;
    require(client.set(acting), "set");
    require(client.renew(acting.couplings, &cost), "renew");
    expect(cost >= 1.0, "cost", cost, 1.0);
    const double fine = 1e-12;
    compare("bonded", client, dense, acting, client.solve(acting, 0, {}, fine, never), 0);
    Values start(client.kept(), 0.0);
    start[0] = 1.0;
    acting.theta = {2.0, 1.0};
    const Answered twice = client.solve(acting, 1, start, fine, never);
    compare("twice the load, from it", client, dense, acting, twice, 1);
    small("iterations of a multiple", static_cast<double>(twice.raw.iterations), direct ? 2.0 : 12.0);
    small("products", std::abs(2.0 * twice.products[0] / twice.products[1] - 1.0), 1e-7);
    acting.force = force;
    acting.couplings = springs(c, v, k, v.pairs / 2, v.pairs);
    require(client.set(acting), "set");
    start = Values(client.kept(), 0.0);
    start[0] = 0.5;
    start[1] = 0.75;
    // With springs of 1e17 N/m3 the old preconditioner is wrong by a factor of 1e8: to give up is an answer then.
    const Answered old = client.solve(acting, 2, start, fine, never);
    if (direct || old.raw.converged != 0) compare("half debonded, old preconditioner", client, dense, acting, old, 2);
    for (std::int64_t p = v.pairs / 2; p < v.pairs; ++p) acting.fixed.push_back(v.dimension * p);
    require(client.set(acting), "set");
    compare("contact, old preconditioner", client, dense, acting, client.solve(acting, 3, start, fine, never), 3);
    std::vector<Acting::Entry> entries = acting.couplings;
    for (const std::int64_t f : acting.fixed) entries.push_back({f, f, 1e4 * client.diagonal[at(f)]});
    require(client.renew(entries, &cost), "renew");
    compare("contact, new preconditioner", client, dense, acting, client.solve(acting, 4, {}, fine, never), 4);
    // The control DOF is the sum of another visible one and of a number.
    acting.pivots = {v.control};
    acting.masters = {{0, v.control + 1, 0.7}, {0, v.control + 2, -0.2}};
    acting.right = {1e-5};
    entries.push_back({v.control, v.control, 1e3 * client.diagonal[at(v.control)]});
    for (std::int64_t i = 0; i + 1 < v.dimension; ++i) acting.couplings.push_back({i, i + 1, 1e-3 * k * 1e-4});
    for (std::int64_t i = 0; i + 1 < v.dimension; ++i) acting.couplings.push_back({i + 1, i, 1e-3 * k * 1e-4});
    require(client.set(acting), "set");
    require(client.renew(entries, &cost), "renew");
    compare("expressed variable", client, dense, acting, client.solve(acting, 5, start, fine, never), 5);
    Values weights(client.kept(), 0.0), u, f;
    weights[0] = 1.0;
    weights[5] = -2.0;
    expect(client.recover(weights, u, f) == DELAM_OK, "recover", 0.0, 0.0);

    keep_on_ranks(c, client, weights, u);
    recover_by_the_core(c, weights);

    // All visible ones are given: the state between them.
    Acting held;
    held.theta = {1.0, -1.0};
    std::vector<Acting::Entry> stiff;
    for (std::size_t i = 0; i < client.visible(); ++i) {
        const auto place = static_cast<std::int64_t>(i);
        held.pivots.push_back(place);
        held.right.push_back(place < v.control ? 1e-7 * std::sin(static_cast<double>(i)) : 1e-5);
        stiff.push_back({place, place, 1e4 * client.diagonal[i]});
    }
    require(client.set(held), "set");
    require(client.renew(stiff, &cost), "renew");
    compare("all visible given", client, dense, held, client.solve(held, 6, {}, fine, never), 6);

    // A spring that pulls makes the matrix indefinite, and its place empty.
    Acting wrong;
    wrong.theta = {1.0, 1.0};
    wrong.couplings = springs(c, v, -10.0 * k, 0, 0);
    require(client.set(wrong), "set");
    require(client.renew(springs(c, v, k, 0, 0), &cost), "renew");
    const Answered indefinite = client.solve(wrong, 0, {}, fine, never);
    expect(indefinite.status == DELAM_OK && indefinite.raw.definite == 0, "indefinite", indefinite.status, 0.0);
    expect(client.recover(weights, u, f) < 0, "recover from an empty place", 0.0, 0.0);
    wrong.couplings = springs(c, v, k, 0, 0);
    require(client.set(wrong), "set");
    expect(client.solve(wrong, 0, {}, fine, always).status == DELAM_CANCELLED, "cancelled", 0.0, 0.0);
    expect(client.solve(wrong, 99, {}, fine, never).status == DELAM_ERROR_ARGUMENT, "place", 0.0, 0.0);
    wrong.couplings[0].row = 1000000;
    expect(client.set(wrong) == DELAM_ERROR_ARGUMENT && client.message()[0] != '\0', "row", 0.0, 0.0);
}

std::int32_t work(void* user) {
    const Case& c = *static_cast<Case*>(user);
    const Variables v = make_variables(c.layers, c.hidden);
    for (const double k : {1e9, 1e13, 1e17}) {
        const EngineClient client(given, v);
        if (client.status != DELAM_OK) {
            expect(false, client.message(), client.status, 0.0);
            return client.status;
        }
        sequence(c, v, client, k);
    }
    expect(delam_petsc_everywhere(c.petsc, 0, nullptr) == DELAM_OK, "the later task", 1.0, 0.0);
    return DELAM_OK;
}

std::int32_t throws(void*) { throw std::runtime_error("thrown at work"); }

std::int32_t throws_in_task(std::int64_t, const std::uint8_t*, void*) { throw std::runtime_error("thrown in a task"); }

std::int32_t work_of_tasks(void* user) {
    const Case& c = *static_cast<Case*>(user);
    const std::int32_t status = delam_petsc_everywhere(c.petsc, 0, nullptr);
    expect(status == DELAM_ERROR_INTERNAL, "a task that throws", status, DELAM_ERROR_INTERNAL);
    expect(std::string(delam_petsc_message(c.petsc)) == "thrown in a task", "its message", 1.0, 0.0);
    return DELAM_OK;
}

// A failure of one rank in the middle of a step of PETSc, where the others wait for it and cannot know.
std::int32_t throws_in_step(void*) { throw std::runtime_error("thrown in a step"); }

std::int32_t lose(void* user) {
    const Case& c = *static_cast<Case*>(user);
    const Variables v = make_variables(c.layers, c.hidden);
    const EngineClient client(given, v);
    Acting acting;
    acting.theta = {1.0, 0.5};
    acting.couplings = springs(c, v, 1e9, 0, 0);
    double cost = 0.0;
    require(client.set(acting), "set");
    require(client.renew(acting.couplings, &cost), "renew");
    std::printf("a rank is lost now\n");
    std::fflush(stdout);
    const Answered a = client.solve(acting, 0, {}, 1e-12, throws_in_step);
    expect(a.status < 0, "a solve whose callback throws", a.status, -1.0);
    return DELAM_OK;
}

// Longer than a rank that has failed in a step of PETSc waits.
constexpr int long_work = 10;  // s

std::int32_t work_or_fail(std::int64_t size, const std::uint8_t*, void* user) {
    int rank = 0, ranks = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &ranks);
    if (size == 0) return DELAM_OK;
    if (rank + 1 == ranks) {
        delam_petsc_explain(static_cast<Case*>(user)->petsc, "the last rank's disk is full");
        return DELAM_ERROR_FILE;
    }
    std::this_thread::sleep_for(std::chrono::seconds(long_work));
    return DELAM_OK;
}

std::int32_t late(void* user) {
    const Case& c = *static_cast<Case*>(user);
    const std::uint8_t byte = 1;
    const std::int32_t status = delam_petsc_everywhere(c.petsc, 1, &byte);
    expect(status == DELAM_ERROR_FILE, "a task that fails on one rank", status, DELAM_ERROR_FILE);
    expect(std::string(delam_petsc_message(c.petsc)) == "the last rank's disk is full", "its message", 1.0, 0.0);
    expect(delam_petsc_everywhere(c.petsc, 0, nullptr) == DELAM_OK, "the next task", 1.0, 0.0);
    return DELAM_OK;
}

void run_case(Layers layers, std::int64_t hidden, delam_petsc_work_callback job = work) {
    int rank = 0, size = 1;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    if (rank == 0)
        std::printf("%dD, %d hidden nodes, %d ranks\n", static_cast<int>(layers.dimension), static_cast<int>(hidden),
                    size);
    Case c{layers, hidden, nullptr, {}};
    const auto cut = [&](int r) { return layers.along * r / size; };
    for (int r = 0; r < size; ++r) {
        c.strips.push_back(make_strip(layers, cut(r), cut(r + 1)));
        move_hidden(layers, hidden, c.strips.back().nodes);
    }
    const auto good = [&](std::int32_t status) {
        if (status != DELAM_OK) std::printf("rank %d: %d %s\n", rank, status, delam_petsc_message(c.petsc));
        failures += status == DELAM_OK ? 0 : 1;
    };
    good(delam_petsc_create(MPI_COMM_WORLD, &c.petsc));
    const Strip& mine = c.strips[at(rank)];
    // An argument that is wrong on one rank only is refused on all.
    const std::int64_t twice[2] = {1, 1};
    const bool wrong = rank == size - 1;
    expect(delam_petsc_set_part(c.petsc, 2, wrong ? 2 : 0, twice, nullptr, nullptr, nullptr, nullptr) < 0, "refusal",
           0.0, 0.0);
    good(delam_petsc_set_part(c.petsc, static_cast<std::int32_t>(layers.dimension),
                              static_cast<std::int64_t>(mine.nodes.size()), mine.nodes.data(), mine.coordinates.data(),
                              mine.row_starts.data(), mine.columns.data(), mine.values.data()));
    int problem = 0;  // a stand-in: this program's own function receives it
    good(delam_petsc_attach(c.petsc, rank == 0 ? reinterpret_cast<delam_problem*>(&problem) : nullptr));
    good(delam_petsc_set_task(c.petsc, throws_in_task, &c));
    good(delam_petsc_run(c.petsc, work_of_tasks, &c));
    good(delam_petsc_set_task(c.petsc, work_or_fail, &c));  // in the place of the one that throws
    good(delam_petsc_run(c.petsc, job, &c));
    const std::int32_t thrown = delam_petsc_run(c.petsc, throws, nullptr);
    expect(thrown == DELAM_ERROR_INTERNAL && std::string(delam_petsc_message(c.petsc)) == "thrown at work", "thrown",
           thrown, 0.0);
    for (const char* key : {"solves", "iterations", "renewals", "factor_entries", "factor_flops", "memory_mb_max",
                            "bytes_sent_max", "messages_max"}) {
        double value = -1.0;
        good(delam_petsc_value(c.petsc, key, &value));
        if (rank == 0) std::printf("  %s %.6g", key, value);
    }
    if (rank == 0) std::printf("\n");
    double none = 0.0;
    expect(delam_petsc_value(c.petsc, "nothing", &none) == DELAM_ERROR_ARGUMENT, "unknown key", none, 0.0);
    const std::string agreed = delam_petsc_message(c.petsc);
    expect(agreed.find("nothing") != std::string::npos, "the same text on all ranks", 1.0, 0.0);
    if (wrong) expect(delam_petsc_explain(c.petsc, nullptr) == DELAM_ERROR_ARGUMENT, "explain nothing", 1.0, 0.0);
    const bool own = agreed != delam_petsc_message(c.petsc);
    expect(own == wrong, "the text of a call of one rank alone is on that rank only", own ? 1.0 : 0.0, 0.0);
    delam_petsc_destroy(&c.petsc);
    if (rank == 0) given.release(given.user);
}

}  // namespace

std::int32_t delam_experimental_problem_set_engine(delam_problem*, const delam_experimental_engine* engine) {
    given = *engine;
    return DELAM_OK;
}

std::int32_t delam_experimental_solver_eigenstrains(delam_solver*, std::int64_t, std::int32_t*, double*,
                                                    std::int64_t* count) {
    *count = 0;
    return DELAM_OK;
}

std::int32_t delam_experimental_solver_recover(delam_solver*) {
    return given.recover(recovered.data(), nullptr, nullptr, given.user);
}

int main(int argc, char** argv) {
    MPI_Init(&argc, &argv);
    Layers flat, solid;
    solid.dimension = 3;
    solid.along = 4;
    solid.across = 2;
    const std::string word = argc > 1 ? argv[1] : "";
    if (word == "lose") {
        run_case(flat, 0, lose);
    } else if (word == "late") {
        run_case(flat, 0, late);
    } else {
        run_case(flat, 0);
        run_case(flat, 5);
        run_case(solid, 0);
    }
    int all = 0;
    MPI_Allreduce(&failures, &all, 1, MPI_INT, MPI_SUM, MPI_COMM_WORLD);
    int rank = 0;
    MPI_Comm_rank(MPI_COMM_WORLD, &rank);
    if (rank == 0) std::printf("%d failures\n", all);
    MPI_Finalize();
    return all == 0 ? 0 : 1;
}
