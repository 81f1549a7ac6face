// SPDX-License-Identifier: BSD-3-Clause
//
// The end-notched flexure test with a ductile interface (Zeman, Kruzik, Gruber, PANM 15, 2010), from C++.
//
//     enf_cpp [history.csv]        without an argument the history goes to standard output
//
// The scene of enf.c. What fails throws, with the library's message.
#include <array>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <utility>
#include <vector>

#include "delam/delam.hpp"

namespace {

constexpr double length = 120e-3;  // span, m
constexpr double height = 3e-3;    // of an arm, m
constexpr double notch = 30e-3;    // m
constexpr int steps = 40;

// Columns of the history, and the library's name for each.
constexpr std::array<std::pair<const char*, const char*>, 19> columns{{
    {"step", "step"},
    {"time", "time"},
    {"load", "load:load"},
    {"reaction", "reaction:load"},
    {"stored_bulk", "stored_bulk"},
    {"stored_interface", "stored_interface"},
    {"dissipated", "dissipated"},
    {"stored_interface_slides", "stored_interface_linear"},
    {"dissipated_slides", "dissipated_linear"},
    {"work", "work"},
    {"lower", "lower"},
    {"increment", "increment"},
    {"upper", "upper"},
    {"increment_lower", "increment_lower"},
    {"am_iterations", "am_iterations"},
    {"linear_iterations", "linear_iterations"},
    {"contact_pairs", "contact_pairs"},
    {"debonded_length", "debonded_length"},
    {"backtracks", "backtracks"},
}};

delam::Law make_law(const delam::Context& context) {
    delam::Law law(context, "piecewise-linear");
    law.set("normal_stiffness", 125e9);
    law.set("tangential_stiffness", 125e9);
    law.set("normal_onset", 100.0);
    law.set("tangential_onset", 100.0);
    law.set("normal_toughness", 250.0);
    law.set("tangential_toughness", 250.0);
    for (const char* key : {"onset_exponent_1", "onset_exponent_2", "toughness_exponent_1", "toughness_exponent_2"}) {
        law.set(key, 2.0);
    }
    return law;
}

// The notch has no adhesion from the start; the pair at its tip, on the side of the box, is bonded.
void make_notch(delam::Problem& problem) { problem.set_adhesion_box(0, {0.0, 0.0}, {notch, 2.0 * height}); }

// The one node of a body at a place.
std::int64_t node_at(const delam::Mesh& mesh, std::int32_t body, double x, double y) {
    const auto found = mesh.find_nodes(body, {x, y}, {x, y});
    if (found.size() != 1) throw std::runtime_error("one node was expected at a support or load");
    return found[0];
}

void make_loads(delam::Problem& problem, const delam::Mesh& mesh) {
    const std::int64_t left = node_at(mesh, 0, 0.0, 0.0);
    const std::int64_t right = node_at(mesh, 0, length, 0.0);
    const std::int64_t top = node_at(mesh, 1, 0.5 * length, 2.0 * height);
    const std::int64_t load = problem.add_pattern("load", {0.0, 2.0}, {0.0, 6e-3});
    problem.prescribe_nodes({left}, {0.0, 1.0});
    problem.prescribe_nodes({right}, {1.0, 0.0});
    problem.prescribe_nodes({right}, {0.0, 1.0});
    problem.prescribe_nodes({top}, {0.0, -1.0}, {load}, {1.0});
}

void write_row(delam::Solver& solver, std::FILE* file) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::fprintf(file, "%s%.17g", i == 0 ? "" : ",", solver.value(columns[i].second) + 0.0);  // no "-0"
    }
    std::fputc('\n', file);
}

void run(std::FILE* file) {
    delam::Context context;
    // What the library warns of (level 1) reaches the log alone; errors are exceptions.
    context.on_log([](std::int32_t level, std::string_view text) {
        if (level == 1) std::fprintf(stderr, "enf: %.*s\n", static_cast<int>(text.size()), text.data());
    });
    auto mesh = delam::Mesh::layers(context, {length}, {240}, {height, height}, {6, 6}, DELAM_QUAD4);
    mesh.add_interface(0, 1);
    delam::Problem problem(context, mesh);
    problem.set_plane("plane-strain");
    problem.set_elastic(-1, 75e9, 0.3);
    problem.set_law(0, make_law(context));
    make_notch(problem);
    make_loads(problem, mesh);
    problem.check();

    delam::Solver solver(problem, 0.0);
    for (std::size_t i = 0; i < columns.size(); ++i) std::fprintf(file, "%s%s", i == 0 ? "" : ",", columns[i].first);
    std::fputc('\n', file);
    write_row(solver, file);
    for (int step = 1; step <= steps; ++step) {
        if (solver.advance(2.0 * step / steps) != delam::Outcome::done) throw std::runtime_error(context.message());
        solver.commit();
        write_row(solver, file);
    }
}

}  // namespace

int main(int argc, char** argv) {
    std::FILE* file = argc > 1 ? std::fopen(argv[1], "w") : stdout;
    if (file == nullptr) {
        std::perror(argv[1]);
        return 1;
    }
    int status = 0;
    try {
        run(file);
    } catch (const std::exception& error) {
        std::fprintf(stderr, "enf: %s; the history is incomplete\n", error.what());
        status = 1;
    }
    if (std::ferror(file) != 0) status = 1;
    if (std::fclose(file) != 0) status = 1;
    return status;
}
