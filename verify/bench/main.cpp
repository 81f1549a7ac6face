// SPDX-License-Identifier: BSD-3-Clause
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>

#include "child.hpp"
#include "machine.hpp"
#include "tables.hpp"

namespace {

constexpr const char* usage =
    "usage: delam_bench [--json FILE] [--quick] [--scene NAME]... [--repeat N] [--cap SECONDS] [--threads N]... "
    "analysis | precision | methods | growth | energetic\n"
    "       delam_bench [--json FILE] [--repeat N] [--cap SECONDS] --scene FILE... [--set KEY=VALUE]... scene-file\n"
    "       delam_bench [--json FILE] [--repeat N] --scene FILE... [--set KEY=VALUE]... side-by-side\n"
    "       delam_bench [--json FILE] [--repeat N] [--cap SECONDS] --scene FILE [--set KEY=VALUE]... [--size "
    "KEY=VALUE]... size\n";

}  // namespace

int main(int argc, char** argv) {
    if (argc > 2 && std::strcmp(argv[1], "--child") == 0) {
        std::printf("%s\n", bench::run_child_task({argv + 2, argv + argc}).dump().c_str());
        return 0;
    }
    bench::Settings settings;
    std::string file;
    std::string table;
    bool understood = true;
    for (int i = 1; i < argc; ++i) {
        const std::string word = argv[i];
        const auto next = [&] {
            understood = understood && i + 1 < argc;
            return i + 1 < argc ? std::string(argv[++i]) : std::string();
        };
        if (word == "--json") {
            file = next();
        } else if (word == "--quick") {
            settings.quick = true;
        } else if (word == "--scene") {
            settings.scenes.push_back(next());
        } else if (word == "--set") {
            settings.settings.push_back(next());
        } else if (word == "--size") {
            settings.sizes.push_back(next());
        } else if (word == "--repeat") {
            settings.repeat = std::atoi(next().c_str());
        } else if (word == "--cap") {
            settings.cap = std::strtod(next().c_str(), nullptr);
        } else if (word == "--threads") {
            settings.threads.push_back(std::atoi(next().c_str()));
        } else if (table.empty() && word[0] != '-') {
            table = word;
        } else {
            understood = false;
        }
    }
    const struct {
        const char* name;
        bench::Json (*make)(const bench::Settings&);
    } tables[] = {{"analysis", bench::analysis_table},         {"precision", bench::precision_table},
                  {"methods", bench::methods_table},           {"growth", bench::growth_table},
#ifdef DELAM_SCENE_FILES
                  {"scene-file", bench::scene_file_table},     {"size", bench::size_table},
                  {"side-by-side", bench::side_by_side_table},
#endif
                  {"energetic", bench::energetic_table}};
    for (const auto& t : tables) {
        if (!understood || table != t.name) continue;
        try {
            bench::Json result;
            result["table"] = table;
            std::string command = argv[0];
            for (int i = 1; i < argc; ++i) command += std::string(" ") + argv[i];
            result["command"] = command;
            result["machine"] = bench::machine();
            const auto& m = result["machine"];
            std::printf("%s: libdelam %s (%s), %s, %s cores, BLAS kernels %s\n\n", t.name,
                        m["version"].get<std::string>().c_str(), m["commit"].get<std::string>().c_str(),
                        m["processor"].get<std::string>().c_str(), m["cores"].dump().c_str(),
                        m["blas_core"].get<std::string>().c_str());
            result["result"] = t.make(settings);
            if (!file.empty()) {
                std::ofstream out(file);
                out << result.dump(1) << '\n';
                if (!out) throw std::runtime_error("cannot write " + file);
            }
            return 0;
        } catch (const std::exception& e) {
            std::fprintf(stderr, "delam_bench %s: %s\n", t.name, e.what());
            return 1;
        }
    }
    std::fputs(usage, stderr);
    return 1;
}
