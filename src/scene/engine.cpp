// SPDX-License-Identifier: BSD-3-Clause
#include "scene/engine.hpp"

#include "base/error.hpp"

namespace delam {

Engine::Engine(const delam_experimental_engine& functions) : functions_(functions) {
    const auto size = static_cast<std::int64_t>(sizeof(delam_experimental_engine));
    if (functions.size != size)
        fail(DELAM_ERROR_ARGUMENT, "engine: size = ", functions.size, ", allowed: ", size,
             " (sizeof(delam_experimental_engine) of this library)");
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
    const bool known = status == DELAM_CANCELLED || (status < 0 && status >= DELAM_ERROR_FILE);
    fail(known ? status : DELAM_ERROR_NUMERICAL, "engine: ", what, ": ",
         said != nullptr && *said != '\0' ? said : text("status ", status).c_str());
}

}  // namespace delam
