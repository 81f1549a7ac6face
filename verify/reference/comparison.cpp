// SPDX-License-Identifier: BSD-3-Clause
#include "comparison.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace reference {
namespace {

double difference(const std::vector<double>& a, const std::vector<double>& b) {
    if (a.size() != b.size()) throw Failure(0, "compared fields differ in length");
    double worst = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) {
        const double miss = std::abs(a[i] - b[i]);
        worst = std::isnan(miss) ? std::numeric_limits<double>::infinity() : std::max(worst, miss);
    }
    const double scale = largest(b);
    return worst == 0.0 ? 0.0 : (scale > 0.0 ? worst / scale : std::numeric_limits<double>::infinity());
}

}  // namespace

double Comparison::worst() const {
    return std::max({jump, traction, displacement, reaction, stored_bulk, stored_interface});
}

std::string Comparison::text() const {
    char line[300];
    std::snprintf(
        line, sizeof line,
        "jump %.1e, traction %.1e, displacement %.1e, reaction %.1e, stored bulk %.1e, stored interface %.1e, "
        "contacts that differ %d",
        jump, traction, displacement, reaction, stored_bulk, stored_interface, contacts);
    return line;
}

Comparison compare(const Solver& solver, const State& reference, const Exported& exported, double contact_tolerance) {
    const auto d = static_cast<std::size_t>(exported.dimension);
    const auto jump = solver.field("jump");
    const auto traction = solver.field("traction");
    const auto contact = solver.field("contact");
    Comparison result;
    result.jump = difference(jump, reference.jump);
    result.traction = difference(traction, reference.traction);
    result.displacement = difference(solver.field("displacement"), reference.displacement);
    std::vector<double> pattern;
    for (std::size_t p = 0; p < exported.patterns; ++p) {
        const char* name = delam_problem_pattern_name(solver.scene().problem(), static_cast<std::int64_t>(p));
        if (name == nullptr) throw Failure(0, "pattern without a name");
        pattern.push_back(solver.value(std::string("reaction:") + name));
    }
    result.reaction = difference(pattern, reference.pattern);
    result.stored_bulk = difference({solver.value("stored_bulk")}, {reference.stored_bulk});
    result.stored_interface = difference({solver.value("stored_interface")}, {reference.stored_interface});

    const double jump_size = largest(reference.jump);
    const double traction_size = largest(reference.traction);
    for (std::size_t p = 0; p < contact.size(); ++p) {
        if ((contact[p] != 0.0) == reference.contact[p]) continue;
        const double gap = std::max(jump[p * d], reference.jump[p * d]);
        const double pressure = -std::min(traction[p * d], reference.traction[p * d]);
        if (gap > contact_tolerance * jump_size || pressure > contact_tolerance * traction_size) ++result.contacts;
    }
    return result;
}

}  // namespace reference
