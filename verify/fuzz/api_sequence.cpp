// SPDX-License-Identifier: BSD-3-Clause
// A sequence of calls of the public API over a few handles, some of them NULL or of another kind, with arguments that
// are plausible or hostile and callbacks that cancel and fail. A new function of the header is one more row of `calls`
// (api_calls.hpp).
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <limits>
#include <string>
#include <utility>

#include <unistd.h>

#include "api_calls.hpp"

namespace {

using namespace fuzz;

constexpr int calls_at_most = 40;
constexpr std::int64_t nodes_at_most = 400;

// All functions must refuse NULL and handles of another kind; destroyed handles cannot always be recognised.
template <class T>
void refuse_others(const Call& call, World& world, Input& in) {
    void* other = in.flag() ? nullptr : static_cast<void*>(world.host[0]->context);
    Asked asked{world,
                in,
                *world.host[0],
                static_cast<delam_mesh*>(other),
                static_cast<delam_law*>(other),
                static_cast<delam_problem*>(other),
                static_cast<delam_solver*>(other)};
    world.heard = world.host[0].get();
    (void)call;
    double value = 0.0;
    std::int64_t count = 0;
    expect(delam_mesh_nodes(asked.mesh, 0, &value) == DELAM_ERROR_HANDLE, "foreign handles are refused", "mesh");
    expect(delam_law_check(asked.law) == DELAM_ERROR_HANDLE, "foreign handles are refused", "law");
    expect(delam_problem_check(asked.problem) == DELAM_ERROR_HANDLE, "foreign handles are refused", "problem");
    expect(delam_solver_advance(asked.solver, 1.0) == DELAM_ERROR_HANDLE, "foreign handles are refused", "solver");
    expect(delam_solver_jump_count(asked.solver, &count) == DELAM_ERROR_HANDLE, "foreign handles are refused",
           "solver");
}

// Runs the call, and cancels it if the row before requested that and the call can be cancelled.
std::int32_t run(World& world, const Call& call, const Asked& asked) {
    Host& host = asked.host;
    host.begin();
    if ((call.documented & may::cancelled) != 0) {
        host.cancel_in = std::exchange(world.interrupt_in, -1);
        host.cancel_by_call = world.interrupt_by_call;
    }
    world.wake(true);
    const std::int32_t status = call.make(asked);
    host.cancel_in = -1;
    // Functions whose lists have no status for it say so (experimental.h, "An engine").
    const bool has_one = (call.documented & (may::numerical | may::problem)) != 0;
    host.settle(call.name, status, call.documented | (world.engine_failed() && !has_one ? may::internal : Statuses{0}));
    world.wake(false);
    return status;
}

// One call on one object: checks the returned status, and that errors, cancellations and limits leave the object
// unchanged.
template <class T>
void ask(World& world, Input& in, const Call& call, Shelf<T>& shelf, T* Asked::*member) {
    const auto slot = static_cast<std::size_t>(in.below(slots));
    T* subject = shelf.handle[slot];
    if (subject == nullptr) {
        refuse_others<T>(call, world, in);
        return;
    }
    Host& host = *shelf.host[slot];
    world.heard = &host;
    const std::string before = print_of(subject);
    Asked asked{world, in, host, nullptr, nullptr, nullptr, nullptr};
    asked.*member = subject;
    const std::int32_t status = run(world, call, asked);
    const bool untouched = status < 0 || status == DELAM_CANCELLED || status == DELAM_LIMIT;
    if (untouched && shelf.handle[slot] == subject)
        expect(print_of(subject) == before, "an error leaves the object as it was", call.name);
}

bool too_large(const delam_mesh* mesh) { return sizes_of(mesh).nodes > nodes_at_most; }

void one(World& world, Input& in, const Call& call) {
    switch (call.subject) {
        case Subject::host: {
            Host& host = world.any_host(in);
            world.heard = &host;
            run(world, call, {world, in, host, nullptr, nullptr, nullptr, nullptr});
            break;
        }
        case Subject::mesh:
            ask(world, in, call, world.mesh, &Asked::mesh);
            break;
        case Subject::law:
            ask(world, in, call, world.law, &Asked::law);
            break;
        case Subject::problem:
            ask(world, in, call, world.problem, &Asked::problem);
            break;
        case Subject::solver:
            ask(world, in, call, world.solver, &Asked::solver);
            break;
    }
    for (std::size_t i = 0; i < slots; ++i)
        if (world.mesh.handle[i] != nullptr && too_large(world.mesh.handle[i])) world.mesh.put(i, nullptr, nullptr);
}

// The call that two bytes stand for: the one whose name, hashed with them, gives the largest value. A new row takes its
// share from all others and leaves the meaning of every other number unchanged, so that inputs stay valid.
const Call& call_of(std::uint16_t number) {
    const auto rank = [&](const Call& call) {
        std::uint64_t hash = 14695981039346656037ULL ^ number;
        for (const char* letter = call.name; *letter != '\0'; ++letter)
            hash = (hash ^ static_cast<std::uint8_t>(*letter)) * 1099511628211ULL;
        hash ^= hash >> 29;
        return hash * 0xbf58476d1ce4e5b9ULL;
    };
    return *std::max_element(std::begin(calls), std::end(calls),
                             [&](const Call& a, const Call& b) { return rank(a) < rank(b); });
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    Input in(data, size);
    World world;
    // Most calls on a solver need one, so a scene and its solver usually come first.
    if (in.byte() % 4 != 0) {
        SmallScene scene = small_scene(*world.host[0], in);
        world.mesh.put(0, scene.mesh, world.host[0].get());
        world.law.put(0, scene.law, world.host[0].get());
        world.problem.put(0, scene.problem, world.host[0].get());
        delam_solver* solver = nullptr;
        world.heard = world.host[0].get();
        world.heard->begin();
        const std::int32_t status = delam_solver_create(scene.problem, 0.0, &solver);
        world.heard->settle("delam_solver_create", status,
                            may::not_converged | may::limit | may::argument | may::problem | may::numerical);
        if (solver != nullptr) world.solver.put(0, solver, world.host[0].get());
    }
    const bool trace = std::getenv("FUZZ_TRACE") != nullptr;
    for (int i = 0; i < calls_at_most && !in.empty(); ++i) {
        const Call& call = call_of(in.raw<std::uint16_t>());
        if (trace) std::fprintf(stderr, "%s\n", call.name);
        one(world, in, call);
    }
    ::unlink(file_name().c_str());
    // Contexts may be destroyed before the objects made with them.
    if (in.flag()) world.host[0].reset(), world.host[1].reset();
    return 0;
}
