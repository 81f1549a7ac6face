// SPDX-License-Identifier: BSD-3-Clause
#include "mesh/gmsh/gmsh_module.hpp"

#include <cstring>

#include <dlfcn.h>

namespace cli {

const GmshModule& gmsh_module(const Place& place) {
    static const GmshModule* loaded = nullptr;
    if (loaded != nullptr) return *loaded;
    const auto failure = [&place](const std::string& why) {
        return SceneFailure(place,
                            "this needs Gmsh, and the program's module " DELAM_GMSH_MODULE " cannot be used: " + why);
    };
    void* library = dlopen(DELAM_GMSH_MODULE, RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr)
        throw failure(dlerror() + std::string("; a build has it where Gmsh's library is (Debian: libgmsh-dev)"));
    void* symbol = dlsym(library, "delam_gmsh_module");
    if (symbol == nullptr) throw failure(dlerror());
    const auto* module = static_cast<const GmshModule*>(symbol);
    if (std::strcmp(module->version, DELAM_PROGRAM_VERSION) != 0)
        throw failure(std::string("found version ") + module->version + ", expected " DELAM_PROGRAM_VERSION);
    loaded = module;
    return *loaded;
}

}  // namespace cli
