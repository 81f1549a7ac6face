// SPDX-License-Identifier: BSD-3-Clause
// A sequence of calls of petsc.h in one process (MPI's singleton), on handles that may be NULL or of another kind, with
// arguments that are plausible or hostile. What needs several ranks is tested in verify/petsc.
#include <algorithm>
#include <cstdlib>
#include <limits>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "contract.hpp"
#include "delam/petsc.h"
#include "input.hpp"
#include "small_scene.hpp"

namespace {

using namespace fuzz;

constexpr int calls_at_most = 24;
constexpr Statuses parts = may::argument | may::state;
constexpr Statuses given_cells = may::cancelled | may::argument | may::problem | may::state;
constexpr Statuses scenes = given_cells | may::numerical;
// Statuses that work and tasks return are passed on; so they return only statuses that are listed here.
constexpr Statuses passed = may::argument | may::state | may::internal;

void start_mpi() {
    static const bool started = [] {
        setenv("PETSC_OPTIONS", "-malloc_debug 0", 0);
        int level = 0;
        MPI_Init_thread(nullptr, nullptr, MPI_THREAD_SINGLE, &level);
        std::atexit([] { MPI_Finalize(); });
        return true;
    }();
    static_cast<void>(started);
}

struct World;

// The bytes decide what work and task do, too.
struct Inside {
    World* world;
    Input* in;
};

struct World {
    Host host;
    SmallScene scene;
    delam_solver* solver = nullptr;
    delam_petsc* petsc[2] = {};
    Inside inside{this, nullptr};

    World() = default;
    ~World() {
        for (delam_petsc*& each : petsc) {
            delam_petsc_destroy(&each);
            expect(each == nullptr, "destroyed handles are NULL", "delam_petsc_destroy");
        }
        delam_solver_destroy(&solver);  // its engine has lost the ranks
        destroy(scene);
    }
    World(const World&) = delete;
    World& operator=(const World&) = delete;
};

void settle(const char* call, const delam_petsc* petsc, std::int32_t status, Statuses documented) {
    if (status == DELAM_OK) return;
    const Statuses always = bit(DELAM_ERROR_HANDLE) | bit(DELAM_ERROR_MEMORY);
    const bool listed =
        status >= DELAM_ERROR_FILE && status <= DELAM_LIMIT && ((documented | always) & bit(status)) != 0;
    if (!listed) std::fprintf(stderr, "%s: %d, '%s'\n", call, status, delam_petsc_message(petsc));
    expect(listed, "a status that the comment of the function lists", call);
    const char* message = delam_petsc_message(petsc);
    expect(message != nullptr && *message != '\0', "a message", call);
}

// A graph of some nodes in compressed rows, often a chain of springs, with arrays of just the size that they need.
struct Rows {
    Rows(Input& in, std::int64_t mesh_nodes)
        : dimension(in.seldom() ? static_cast<std::int32_t>(in.hostile_whole()) : 2 + in.flag()) {
        const std::size_t d = dimension == 3 ? 3 : 2, count = static_cast<std::size_t>(in.below(5));
        for (std::size_t i = 0; i < count; ++i) nodes.push_back(static_cast<std::int64_t>(i));
        if (in.seldom()) nodes = in.indices(count, std::max<std::int64_t>(mesh_nodes, 1));
        coordinates = in.reals(count * d);
        for (std::size_t r = 0; r < count * d; ++r) {
            starts.push_back(static_cast<std::int64_t>(columns.size()));
            columns.push_back(static_cast<std::int64_t>(r));
            values.push_back(100.0);
        }
        starts.push_back(static_cast<std::int64_t>(columns.size()));
        if (in.seldom() && !columns.empty()) columns[in.byte() % columns.size()] = in.hostile_whole();
        if (in.seldom() && !values.empty()) values[in.byte() % values.size()] = in.hostile_real();
        if (in.seldom()) {  // never beyond the arrays
            const std::size_t place = in.byte() % starts.size();
            starts[place] = std::min(in.hostile_whole(), static_cast<std::int64_t>(columns.size()));
        }
        node_count = static_cast<std::int64_t>(nodes.size());
        if (in.seldom()) {  // more than there are only where that is refused before the arrays are read
            const std::int64_t said = in.hostile_whole();
            if (said < node_count || said > std::numeric_limits<std::int32_t>::max()) node_count = said;
        }
    }
    std::int32_t dimension;
    std::int64_t node_count = 0;
    std::vector<std::int64_t> nodes, starts, columns;
    std::vector<double> coordinates, values;
};

std::int32_t read_part(Input& in, delam_petsc* petsc) {
    std::int64_t nodes = 0, cells = 0, rows = 0, columns = 0;
    const std::int64_t none = in.seldom() ? in.hostile_whole() : 0;
    std::int32_t status = delam_petsc_part_nodes(petsc, none, nullptr, nullptr, in.seldom() ? nullptr : &nodes);
    settle("delam_petsc_part_nodes", petsc, status, may::argument | may::state);
    std::vector<std::int64_t> node(static_cast<std::size_t>(nodes));
    std::vector<std::int32_t> owned(node.size());
    const auto room = [&](std::int64_t needed) { return in.seldom() ? std::min(in.hostile_whole(), needed) : needed; };
    status = IN_ORDER(delam_petsc_part_nodes, petsc, room(nodes), maybe(in, node), maybe(in, owned), nullptr);
    settle("delam_petsc_part_nodes", petsc, status, may::argument | may::state);
    status = delam_petsc_part_cells(petsc, none, nullptr, &cells);
    settle("delam_petsc_part_cells", petsc, status, may::argument);
    std::vector<std::int64_t> cell(static_cast<std::size_t>(cells));
    status = IN_ORDER(delam_petsc_part_cells, petsc, room(cells), maybe(in, cell), nullptr);
    settle("delam_petsc_part_cells", petsc, status, may::argument);
    static const char* const keys[] = {"displacement", "force", "stress", "rotation"};
    const char* key = in.word(keys);
    const Statuses of_fields = may::argument | may::state;
    status = delam_petsc_part_field(petsc, key, none, nullptr, &rows, in.seldom() ? nullptr : &columns);
    settle("delam_petsc_part_field", petsc, status, of_fields);
    std::vector<double> values(static_cast<std::size_t>(rows * columns));
    status = IN_ORDER(delam_petsc_part_field, petsc, key, room(rows * columns), maybe(in, values), nullptr, nullptr);
    settle("delam_petsc_part_field", petsc, status, of_fields);
    return DELAM_OK;
}

// A status that passes: in a task or in work.
std::int32_t some_status(Input& in) {
    static constexpr std::int32_t statuses[] = {DELAM_OK, DELAM_OK, DELAM_OK, DELAM_ERROR_ARGUMENT, DELAM_ERROR_STATE};
    return statuses[in.below(5)];
}

// Functions that a running call refuses.
void refused_inside(World& world, delam_petsc* petsc) {
    expect(delam_petsc_attach(petsc, world.scene.problem) == DELAM_ERROR_STATE, "refused inside run", "attach");
    expect(delam_petsc_run(
               petsc, [](void*) { return std::int32_t{0}; }, nullptr) == DELAM_ERROR_STATE,
           "refused inside run", "run");
    double value = 0.0;
    expect(delam_petsc_value(petsc, "solves", &value) == DELAM_ERROR_STATE, "refused inside run", "value");
    delam_petsc* same = petsc;
    delam_petsc_destroy(&same);
    expect(same == petsc, "not destroyed inside run", "destroy");
}

struct Running {
    World* world;
    Input* in;
    delam_petsc* petsc;
};

std::int32_t task(std::int64_t size, const std::uint8_t* bytes, void* user) {
    World& world = *static_cast<World*>(user);
    Input& in = *world.inside.in;
    expect(size == 0 || bytes != nullptr, "bytes of the task", "task");
    const delam_petsc* any = world.petsc[0] != nullptr ? world.petsc[0] : world.petsc[1];
    auto* petsc = const_cast<delam_petsc*>(any);
    if (in.flag())
        settle("delam_petsc_explain", petsc, delam_petsc_explain(petsc, in.seldom() ? nullptr : "asked to fail"),
               may::argument);
    if (in.flag()) read_part(in, petsc);
    if (in.seldom()) settle("everywhere in a task", petsc, delam_petsc_everywhere(petsc, 0, nullptr), passed);
    if (in.seldom() && world.solver != nullptr)
        settle("recover in a task", petsc, delam_petsc_recover(petsc, world.solver), may::state);
    return some_status(in);
}

std::int32_t work(void* user) {
    Running& running = *static_cast<Running*>(user);
    World& world = *running.world;
    Input& in = *running.in;
    delam_petsc* petsc = running.petsc;
    constexpr Statuses steps = may::not_converged | may::cancelled | may::limit | may::argument | may::problem |
                               may::state | may::numerical | may::mesh;
    for (int left = 8; left > 0 && !in.empty(); --left) {
        world.host.begin();
        switch (in.below(8)) {
            case 0: {
                delam_solver_destroy(&world.solver);
                const std::int32_t status = delam_solver_create(world.scene.problem, 0.0, &world.solver);
                world.host.settle("delam_solver_create", status, steps & ~may::state);
                break;
            }
            case 1:
            case 2:
                if (world.solver != nullptr) {
                    double time = 0.0;
                    delam_solver_value(world.solver, "time", &time);
                    world.host.begin();
                    world.host.settle("delam_solver_advance", delam_solver_advance(world.solver, time + 0.25),
                                      steps & ~may::mesh);
                }
                break;
            case 3:
                if (world.solver != nullptr) delam_solver_commit(world.solver);
                break;
            case 4:
                settle("delam_petsc_recover", petsc, delam_petsc_recover(petsc, in.seldom() ? nullptr : world.solver),
                       may::cancelled | may::numerical | may::state);
                break;
            case 5: {
                std::vector<std::uint8_t> bytes(static_cast<std::size_t>(in.below(9)));
                const auto size = static_cast<std::int64_t>(bytes.size());
                const std::int64_t said = in.seldom() ? -1 - in.below(200) : size;
                settle("delam_petsc_everywhere", petsc, IN_ORDER(delam_petsc_everywhere, petsc, said, maybe(in, bytes)),
                       passed);
                break;
            }
            case 6:
                read_part(in, petsc);
                break;
            default:
                refused_inside(world, petsc);
        }
    }
    return some_status(in);
}

// One call on a handle that is there, or on one that is not.
void one(World& world, Input& in) {
    const std::size_t slot = in.flag() ? 1 : 0;
    delam_petsc* petsc = world.petsc[slot];
    const delam_mesh* mesh = in.seldom() ? nullptr : world.scene.mesh;
    delam_problem* problem = in.seldom() ? nullptr : world.scene.problem;
    if (in.seldom()) mesh = reinterpret_cast<const delam_mesh*>(world.host.context);
    std::int64_t nodes = 0, cells = 0;
    delam_mesh_size(world.scene.mesh, nullptr, &nodes, &cells, nullptr, nullptr);
    if (petsc == nullptr && in.seldom()) petsc = reinterpret_cast<delam_petsc*>(world.host.context);
    const bool foreign = petsc != world.petsc[slot];
    switch (in.below(14)) {
        case 0: {
            delam_petsc* made = reinterpret_cast<delam_petsc*>(&world);  // must be overwritten
            const MPI_Comm comms[] = {MPI_COMM_SELF, MPI_COMM_WORLD, MPI_COMM_NULL, MPI_Comm{}};
            const std::int32_t status =
                in.flag()
                    ? delam_petsc_create(comms[in.below(4)], &made)
                    : delam_petsc_create_fortran(static_cast<MPI_Fint>(in.flag() ? MPI_Comm_c2f(MPI_COMM_SELF)
                                                                                 : 1000 + in.hostile_whole() % 9000),
                                                 &made);
            expect((status == DELAM_OK) == (made != nullptr), "*out is NULL on error", "delam_petsc_create");
            expect(status == DELAM_OK || status == DELAM_ERROR_ARGUMENT, "status", "delam_petsc_create");
            expect(delam_petsc_create(MPI_COMM_SELF, nullptr) == DELAM_ERROR_ARGUMENT, "no out", "delam_petsc_create");
            expect(delam_petsc_create_fortran(0, nullptr) == DELAM_ERROR_ARGUMENT, "no out",
                   "delam_petsc_create_fortran");
            if (made == nullptr) return;
            delam_petsc_destroy(&world.petsc[slot]);
            world.petsc[slot] = made;
            return;
        }
        case 1: {
            const Rows rows(in, nodes);
            const auto set = in.flag() ? delam_petsc_set_part : delam_petsc_set_rows;
            Rows given = rows;
            const std::int32_t status =
                IN_ORDER(set, petsc, rows.dimension, rows.node_count, maybe(in, given.nodes),
                         in.seldom() ? nullptr : given.coordinates.data(), maybe(in, given.starts),
                         maybe(in, given.columns), maybe(in, given.values));
            settle("delam_petsc_set_part", petsc, status, parts);
            return;
        }
        case 2:
        case 3:
            settle("delam_petsc_take_scene", petsc, delam_petsc_take_scene(petsc, mesh, problem), scenes);
            return;
        case 4: {
            std::vector<std::int32_t> ranks(static_cast<std::size_t>(cells));
            if (in.seldom() && !ranks.empty())
                ranks[in.byte() % ranks.size()] = static_cast<std::int32_t>(in.hostile_whole());
            const std::int64_t said = in.seldom() ? in.hostile_whole() : cells;
            settle("delam_petsc_take_cells", petsc,
                   IN_ORDER(delam_petsc_take_cells, petsc, mesh, problem,
                            said == cells + 0 ? said : -std::abs(said / 2), maybe(in, ranks)),
                   given_cells);
            return;
        }
        case 5: {
            std::vector<std::int64_t> numbers;
            for (std::int64_t n = 0; n < nodes; ++n) numbers.push_back(n);
            if (in.seldom()) numbers = in.indices(static_cast<std::size_t>(nodes), nodes);
            const std::int64_t said = in.seldom() ? in.hostile_whole() : nodes;
            settle("delam_petsc_set_cells", petsc,
                   IN_ORDER(delam_petsc_set_cells, petsc, mesh, problem, said, maybe(in, numbers)), given_cells);
            return;
        }
        case 6:
        case 7:
            settle("delam_petsc_attach", petsc, delam_petsc_attach(petsc, problem), parts);
            return;
        case 8:
            settle("delam_petsc_set_task", petsc, delam_petsc_set_task(petsc, in.seldom() ? nullptr : task, &world),
                   parts);
            return;
        case 9:
            settle("everywhere outside run", petsc, delam_petsc_everywhere(petsc, in.hostile_whole() % 3 - 2, nullptr),
                   passed);
            settle("recover outside run", petsc, delam_petsc_recover(petsc, world.solver), may::state);
            settle("delam_petsc_explain", petsc, delam_petsc_explain(petsc, in.flag() ? nullptr : ""), may::argument);
            return;
        case 10:
            if (!foreign && petsc != nullptr) read_part(in, petsc);
            return;
        case 11: {
            static const char* const keys[] = {"solves",        "iterations",     "renewals",       "factor_entries",
                                               "memory_mb_max", "operations_sum", "bytes_sent_max", "messages_sum"};
            double value = 0.0;
            settle("delam_petsc_value", petsc,
                   IN_ORDER(delam_petsc_value, petsc, in.word(keys), in.seldom() ? nullptr : &value), parts);
            return;
        }
        case 12:
            if (in.seldom()) delam_petsc_destroy(&world.petsc[slot]);
            delam_petsc_destroy(nullptr);
            return;
        default: {
            Running running{&world, &in, petsc};
            settle("delam_petsc_run", petsc, delam_petsc_run(petsc, in.seldom() ? nullptr : work, &running), passed);
        }
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    start_mpi();
    Input in(data, size);
    World world;
    world.inside.in = &in;
    world.scene = small_scene(world.host, in);
    delam_problem_set_text(world.scene.problem, "reduction", "auto");
    delam_problem_set_number(world.scene.problem, "subdomains", 0.0);
    if (in.byte() % 4 != 0) {  // ranks that have the scene
        expect(delam_petsc_create(MPI_COMM_SELF, &world.petsc[0]) == DELAM_OK, "a handle", "delam_petsc_create");
        settle("delam_petsc_take_scene", world.petsc[0],
               delam_petsc_take_scene(world.petsc[0], world.scene.mesh, world.scene.problem), scenes);
        settle("delam_petsc_attach", world.petsc[0], delam_petsc_attach(world.petsc[0], world.scene.problem), parts);
    }
    for (int i = 0; i < calls_at_most && !in.empty(); ++i) one(world, in);
    return 0;
}
