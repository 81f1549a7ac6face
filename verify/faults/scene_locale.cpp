// SPDX-License-Identifier: BSD-3-Clause
// fault_scene_locale SCENE_FILE ... LOCALE: the files must give the same problems under that locale and under C.
#include <clocale>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <locale>

#include "host.hpp"
#include "scene_file.hpp"

namespace {

faults::Transcript read(const char* path) {
    faults::Transcript found;
    const reference::SceneFile file = reference::read_scene_file(path, {"solver.damage_tolerance=1.5e-7"});
    char hash[17] = "";
    faults::expect(delam_problem_hash(file.scene.problem(), hash) == DELAM_OK, "delam_problem_hash");
    found.add("hash", hash, sizeof hash);
    found.add("nodes", file.scene.nodes());
    found.add("times", file.times);
    return found;
}

}  // namespace

int main(int argc, char** argv) {
    try {
        const char* name = argv[argc - 1];
        for (int i = 1; i + 1 < argc; ++i) {
            const faults::Transcript calm = read(argv[i]);
            faults::expect(std::setlocale(LC_ALL, name) != nullptr, std::string("locale ") + name);
            const std::locale before = std::locale::global(std::locale(name));
            char number[16];
            std::snprintf(number, sizeof number, "%.1f", 0.5);
            faults::expect(std::strcmp(number, "0,5") == 0, std::string("the locale writes ") + number);
            const std::string difference = calm.difference(read(argv[i]));
            std::locale::global(before);
            std::setlocale(LC_ALL, "C");
            faults::expect(difference.empty(), std::string(argv[i]) + ": " + difference);
            std::printf("%s: the same problem\n", argv[i]);
        }
    } catch (const std::exception& e) {
        std::printf("failed: %s\n", e.what());
        return EXIT_FAILURE;
    }
    return EXIT_SUCCESS;
}
