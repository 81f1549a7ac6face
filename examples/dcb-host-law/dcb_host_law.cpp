// SPDX-License-Identifier: BSD-3-Clause
//
// A double cantilever beam in space whose interface obeys a law of the host's own, from C++.
//
//     dcb_host_law_cpp [history.csv]        without an argument the history goes to standard output
//
// The scene of dcb_host_law.c. What fails throws, with the library's message.
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <exception>
#include <stdexcept>
#include <utility>
#include <vector>

#include "delam/delam.hpp"

namespace {

constexpr double length = 60e-3;   // m
constexpr double width = 8e-3;     // m
constexpr double height = 1.5e-3;  // of an arm, m
constexpr double notch = 20e-3;    // m
constexpr int steps = 16;

// Traction falls on a straight line, alike in every mode.
struct Bilinear {
    double onset;      // energy at which the traction begins to fall, J/m2
    double toughness;  // J/m2

    // The minimiser of adhesion * driving + dissipated, and its slope by the driving energy.
    delam::AdhesionValue adhesion(double driving) const {
        const double r = toughness / onset;
        if (driving >= onset * r * r) return {0.0, 0.0};
        if (driving <= onset) return {1.0, 0.0};
        const double root = std::sqrt(onset / driving);
        return {(r * root - 1.0) / (r - 1.0), -0.5 * r / (r - 1.0) * root / driving};
    }

    // The energy spent down to an adhesion, and its slopes by adhesion and mixity.
    delam::DissipationValue dissipation(double adhesion) const {
        const double r = toughness / onset;
        const double below = 1.0 + adhesion * (r - 1.0);
        return {toughness - onset * r * r * adhesion / below, -onset * (r / below) * (r / below), 0.0};
    }
};

// Columns of the history, and the library's name for each.
constexpr std::array<std::pair<const char*, const char*>, 9> columns{{
    {"step", "step"},
    {"time", "time"},
    {"load", "load:opening"},
    {"reaction", "reaction:opening"},
    {"stored_bulk", "stored_bulk"},
    {"stored_interface", "stored_interface"},
    {"dissipated", "dissipated"},
    {"work", "work"},
    {"front", "front"},
}};

delam::Law make_law(const delam::Context& context) {
    constexpr Bilinear bilinear{5.0, 250.0};
    delam::Law law(
        context, "bilinear by hand", [=](double, double driving) { return bilinear.adhesion(driving); },
        [=](double, double adhesion) { return bilinear.dissipation(adhesion); });
    law.set("normal_stiffness", 1e13);
    law.set("tangential_stiffness", 1e13);
    return law;
}

// The notch has no adhesion from the start; the pairs at its tip, on the side of the box, are bonded.
void make_notch(delam::Problem& problem) { problem.set_adhesion_box(0, {0.0, 0.0, 0.0}, {notch, width, 2.0 * height}); }

void make_loads(delam::Problem& problem, const delam::Mesh& mesh) {
    const std::int64_t opening = problem.add_pattern("opening", {0.0, 1.0}, {0.0, 1.6e-3});
    const auto right = mesh.find_nodes(-1, {length, 0.0, 0.0}, {length, width, 2.0 * height});
    problem.prescribe_nodes(right, {1.0, 0.0, 0.0});
    problem.prescribe_nodes(right, {0.0, 1.0, 0.0});
    problem.prescribe_nodes(right, {0.0, 0.0, 1.0});
    const auto top = mesh.find_nodes(-1, {0.0, 0.0, 2.0 * height}, {0.0, width, 2.0 * height});
    problem.prescribe_nodes(top, {0.0, 0.0, 1.0}, {opening}, std::vector<double>(top.size(), 0.5));
    const auto bottom = mesh.find_nodes(-1, {0.0, 0.0, 0.0}, {0.0, width, 0.0});
    problem.prescribe_nodes(bottom, {0.0, 0.0, -1.0}, {opening}, std::vector<double>(bottom.size(), 0.5));
}

void write_row(delam::Solver& solver, std::FILE* file) {
    for (std::size_t i = 0; i < columns.size(); ++i) {
        std::fprintf(file, "%s%.17g", i == 0 ? "" : ",", solver.value(columns[i].second) + 0.0);  // no "-0"
    }
    std::fputc('\n', file);
}

void run(std::FILE* file) {
    const delam::Context context;
    auto mesh = delam::Mesh::layers(context, {length, width}, {60, 4}, {height, height}, {2, 2}, DELAM_HEX8);
    mesh.add_interface(0, 1);
    delam::Problem problem(context, mesh);
    problem.set_elastic(-1, 120e9, 0.3);
    problem.set_formulation(-1, "incompatible");
    problem.set_law(0, make_law(context));
    make_notch(problem);
    make_loads(problem, mesh);
    problem.check();

    delam::Solver solver(problem, 0.0);
    for (std::size_t i = 0; i < columns.size(); ++i) std::fprintf(file, "%s%s", i == 0 ? "" : ",", columns[i].first);
    std::fputc('\n', file);
    write_row(solver, file);
    for (int step = 1; step <= steps; ++step) {
        if (solver.advance(static_cast<double>(step) / steps) != delam::Outcome::done)
            throw std::runtime_error(context.message());
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
        std::fprintf(stderr, "dcb_host_law: %s; the history is incomplete\n", error.what());
        status = 1;
    }
    if (std::ferror(file) != 0) status = 1;
    if (std::fclose(file) != 0) status = 1;
    return status;
}
