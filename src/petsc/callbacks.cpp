// SPDX-License-Identifier: BSD-3-Clause
#include "petsc/callbacks.hpp"

#include "petsc/session.hpp"

namespace delam::petsc {

namespace {

// Session's functions throw only if there is no memory for a message.
template <class Work>
std::int32_t with_session(void* user, Work&& work) noexcept {
    Session* session = static_cast<Link*>(user)->session;
    if (session == nullptr) return DELAM_ERROR_STATE;
    try {
        return work(*session);
    } catch (...) {
        return DELAM_ERROR_MEMORY;
    }
}

std::int32_t prepare(const delam_experimental_variables* variables, double* diagonal, double* load_sizes, void* user) {
    return with_session(user, [&](Session& s) { return s.prepare(variables, diagonal, load_sizes); });
}

std::int32_t set(const delam_experimental_entries* couplings, std::int64_t fixed_count, const std::int64_t* fixed,
                 std::int64_t pivot_count, const std::int64_t* pivots, const delam_experimental_entries* masters,
                 void* user) {
    return with_session(user,
                        [&](Session& s) { return s.set(couplings, fixed_count, fixed, pivot_count, pivots, masters); });
}

std::int32_t renew(const delam_experimental_entries* entries, double* cost, void* user) {
    return with_session(user, [&](Session& s) { return s.renew(entries, cost); });
}

std::int32_t solve(const delam_experimental_request* request, delam_experimental_answer* answer, void* user) {
    return with_session(user, [&](Session& s) { return s.solve(request, answer); });
}

std::int32_t recover(const double* weights, double* displacement, double* force, void* user) {
    return with_session(user, [&](Session& s) { return s.recover(weights, displacement, force); });
}

void release(void* user) { forget_link(static_cast<Link*>(user)); }

const char* message(void* user) {
    const Session* session = static_cast<Link*>(user)->session;
    return session == nullptr ? "the handle of libdelam-petsc has been destroyed" : session->message().c_str();
}

}  // namespace

delam_experimental_engine make_callbacks(Link* link) {
    delam_experimental_engine engine{};
    engine.size = sizeof(delam_experimental_engine);
    engine.kept = KeptStates::count;
    engine.user = link;
    engine.prepare = prepare;
    engine.set = set;
    engine.renew = renew;
    engine.solve = solve;
    engine.recover = recover;
    engine.release = release;
    engine.message = message;
    return engine;
}

}  // namespace delam::petsc
