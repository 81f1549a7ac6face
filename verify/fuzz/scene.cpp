// SPDX-License-Identifier: BSD-3-Clause
// The text of a scene file, and after a line "== mesh.inp" that of a mesh: read, built, checked and factored as by
// `delam check`. A bad scene must end in the program's own failure with a message, and in nothing else. Scenes that
// need Gmsh's files or generators are skipped, because Gmsh is not ours to test, and so are scenes that merely take
// long.
#include <cstdio>
#include <cstdlib>
#include <string>
#include <string_view>

#include "contract.hpp"
#include "folder.hpp"
#include "model/build.hpp"
#include "model/notes.hpp"
#include "result/closing/resolution.hpp"
#include "result/history/history.hpp"
#include "scene/read_scene.hpp"
#include "scene/scene.hpp"
#include "scene/table/scene_text.hpp"
#include "text/error.hpp"

namespace {

using fuzz::expect;

// More time steps or cells than this are legitimate work and only take time.
constexpr std::int64_t most_steps = 1000;
constexpr double most_cells = 100;

bool is_work(std::string_view text) {
    const auto parsed = [&]() -> toml::table {
        try {
            return cli::parsed_text(text, {}, "");
        } catch (const toml::parse_error&) {
            return {};
        } catch (const cli::SceneFailure&) {
            return {};
        }
    }();
    if (parsed["mesh"]["generator"] || parsed["time"]["steps"].value_or(std::int64_t{0}) > most_steps) return true;
    const std::string file = parsed["mesh"]["file"].value_or(std::string());
    return !file.empty() && file != "mesh.inp";
}

bool is_work(const cli::Scene& scene) {
    double cells = 0.0;
    if (scene.mesh)
        for (const cli::CellBlock& block : scene.mesh->blocks) cells += static_cast<double>(block.bodies.size());
    for (const cli::Layer& layer : scene.layers) cells += scene.mesh ? 0.0 : static_cast<double>(layer.divisions);
    for (const std::int64_t divisions : scene.geometry.divisions) cells *= static_cast<double>(divisions);
    return cells > most_cells;
}

void check(const std::string& file) {
    const cli::Scene scene = cli::read_scene(file, {});
    if (is_work(scene)) return;
    const cli::Model model = cli::build(cli::new_context(), scene);
    bool converged = true;
    const cli::Solver solver = cli::new_solver(model, scene, nullptr, converged);
    const cli::History history(model, scene);
    expect(!history.header().empty(), "a history has a header", "history");
    (void)history.row(solver.get());
    (void)cli::process_zones(model);
    (void)cli::notes_of(scene);
    (void)cli::warnings_of(model, scene);
    expect(*delam_solver_plan(solver.get()) != '\0', "a plan", "delam_solver_plan");
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    static const fuzz::Folder folder;
    const std::string_view all(reinterpret_cast<const char*>(data), size);
    constexpr std::string_view mark = "\n== mesh.inp\n";
    const std::size_t at = all.find(mark);
    const std::string_view text = all.substr(0, at);
    if (is_work(text)) return 0;
    folder.write("mesh.inp", at == std::string_view::npos ? std::string_view() : all.substr(at + mark.size()));
    try {
        check(folder.write("scene.toml", text));
    } catch (const cli::Failure& failure) {
        const std::string_view said = failure.what();
        expect(!said.empty(), "a failure has a text", "scene");
        // These are the words of call(); a scene may contain them, too.
        for (const char* status : {"(DELAM_ERROR_INTERNAL)", "(DELAM_ERROR_HANDLE)"})
            expect(failure.code() != cli::exit_numerical || !said.ends_with(status), "no defect within",
                   failure.what());
    } catch (const std::bad_alloc&) {
    } catch (const std::exception& e) {
        std::fprintf(stderr, "%s\n", e.what());
        expect(false, "a scene fails by the program's own failure", e.what());
    }
    return 0;
}
