// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>

#include "table.hpp"

int main(int argc, char** argv) {
    harness::Options options;
    const char* name = nullptr;
    bool understood = true;
    for (int i = 1; i < argc; ++i) {
        if (std::strcmp(argv[i], "--json") == 0) {
            options.json = true;
        } else if (std::strcmp(argv[i], "--quick") == 0) {
            options.quick = true;
        } else if (std::strcmp(argv[i], "--finest") == 0 && i + 1 < argc) {
            options.finest = 1e-3 * std::strtod(argv[++i], nullptr);
            understood = understood && options.finest > 0.0;
        } else if (std::strcmp(argv[i], "--scene") == 0 && i + 1 < argc) {
            options.scene = argv[++i];
        } else if (std::strcmp(argv[i], "--set") == 0 && i + 1 < argc) {
            options.settings.emplace_back(argv[++i]);
        } else if (std::strcmp(argv[i], "--subject") == 0 && i + 1 < argc) {
            options.subjects.insert(argv[++i]);
        } else if (std::strcmp(argv[i], "--specimen") == 0 && i + 1 < argc) {
            options.specimen = argv[++i];
        } else if (name == nullptr && argv[i][0] != '-') {
            name = argv[i];
        } else {
            understood = false;
        }
    }
    const struct {
        const char* name;
        harness::Table (*make)(const harness::Options&);
    } tables[] = {{"balance", harness::balance},           {"feti-direct", harness::feti_direct},
                  {"energetic", harness::energetic},       {"jump-instant", harness::jump_instant},
#ifdef DELAM_SCENE_FILES
                  {"scene-direct", harness::scene_direct},
#endif
                  {"stability", harness::stability},       {"sets", harness::sets}};
    for (const auto& table : tables) {
        if (!understood || name == nullptr || std::strcmp(name, table.name) != 0) continue;
        try {
            const harness::Table result = table.make(options);
            options.json ? result.print_json() : result.print_text();
            return 0;
        } catch (const std::exception& e) {
            std::fprintf(stderr, "delam_harness %s: %s\n", name, e.what());
            return 1;
        }
    }
    std::fprintf(stderr,
                 "usage: delam_harness [--json] [--quick] [--finest MM] [--scene FILE [--set KEY=VALUE ...]]\n"
                 "       [--specimen NAME] [--subject NAME]... TABLE\n"
                 "tables: balance, feti-direct, energetic, jump-instant, stability (--subject), sets, scene-direct (of "
                 "--scene)\n");
    return 1;
}
