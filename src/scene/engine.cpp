// SPDX-License-Identifier: BSD-3-Clause
#include "scene/engine.hpp"

#include "base/error.hpp"

namespace delam {

namespace {

// The size alone is certain if another header was used to compile the host.
delam_experimental_engine copied(const delam_experimental_engine& functions) {
    const auto size = static_cast<std::int64_t>(sizeof(delam_experimental_engine));
    if (functions.size != size)
        fail(DELAM_ERROR_ARGUMENT, "engine: size = ", functions.size, ", allowed: ", size,
             " (sizeof(delam_experimental_engine) of this library)");
    return functions;
}

}  // namespace

Engine::Engine(const delam_experimental_engine& functions) : functions_(copied(functions)) {
    if (functions.kept != kept) fail(DELAM_ERROR_ARGUMENT, "engine: kept = ", functions.kept, ", allowed: ", kept);
    const struct {
        bool there;
        const char* name;
    } all[] = {{functions.prepare != nullptr, "prepare"}, {functions.set != nullptr, "set"},
               {functions.renew != nullptr, "renew"},     {functions.solve != nullptr, "solve"},
               {functions.recover != nullptr, "recover"}, {functions.message != nullptr, "message"}};
    for (const auto& [there, name] : all)
        if (!there) fail(DELAM_ERROR_ARGUMENT, "engine: the function '", name, "' is NULL");
}

Engine::~Engine() {
    if (functions_.release != nullptr) functions_.release(functions_.user);
}

void Engine::require(std::int32_t status, const char* what) const {
    if (status == DELAM_OK) return;
    const char* said = functions_.message(functions_.user);
    const std::string text_of = said != nullptr && *said != '\0' ? said : text("status ", status);
    for (const std::int32_t own : {DELAM_CANCELLED, DELAM_ERROR_ARGUMENT, DELAM_ERROR_PROBLEM, DELAM_ERROR_STATE,
                                   DELAM_ERROR_MEMORY, DELAM_ERROR_NUMERICAL})
        if (status == own) fail(status, "engine: ", what, ": ", text_of);
    fail(DELAM_ERROR_NUMERICAL, "engine: ", what, ": ", text_of, " (it returned ", status,
         "; allowed: 0 and the statuses cancelled, argument, problem, state, memory, numerical)");
}

}  // namespace delam
