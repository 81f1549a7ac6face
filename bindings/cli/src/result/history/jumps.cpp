// SPDX-License-Identifier: BSD-3-Clause
#include "result/history/jumps.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <fmt/format.h>

#include "model/library/call.hpp"
#include "result/history/concept.hpp"
#include "result/history/history.hpp"
#include "scene/units/labels.hpp"
#include "text/say.hpp"

namespace cli {

namespace {

constexpr std::size_t most_lines = 10;

// Returns the factor as the library does: linear between the times, constant before the first and after the last.
double factor_at(const PatternData& pattern, double time) {
    const auto after = std::upper_bound(pattern.times.begin(), pattern.times.end(), time);
    if (after == pattern.times.begin()) return pattern.values.front();
    if (after == pattern.times.end()) return pattern.values.back();
    const auto i = static_cast<std::size_t>(after - pattern.times.begin());
    // Halves, for times as far apart as doubles allow.
    const double s = (0.5 * time - 0.5 * pattern.times[i - 1]) / (0.5 * pattern.times[i] - 0.5 * pattern.times[i - 1]);
    return (1.0 - s) * pattern.values[i - 1] + s * pattern.values[i];
}

// A cell of a table of comma-separated values (RFC 4180).
std::string csv_cell(const std::string& text) {
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string out = "\"";
    for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    return out + "\"";
}

// Jumps are located to this part of their load, unless steps are fixed or the load hardly rises while they go on.
constexpr double located = 3e-3;

bool spread(const Jump& jump, std::size_t pattern) {
    const double before = jump.loads_before[pattern], after = jump.loads[pattern];
    return std::abs(after - before) > located * std::max(std::abs(before), std::abs(after));
}

// "at time 0.5 (load 1.6 mm)" or "between time 0.4 and 0.5 (load 1.5 mm to 1.6 mm)"; with several patterns "(load_press
// 1.6 mm, load_side 2)".
std::string instant_text(const Jump& jump, const Scene& scene) {
    bool over_time = false;
    std::string loads;
    for (std::size_t p = 0; p < jump.loads.size(); ++p) {
        loads += fmt::format("{}{} ", p == 0 ? " (" : ", ", load_title(scene, p));
        if (p < jump.loads_before.size() && spread(jump, p)) {
            over_time = true;
            loads += load_text(jump.loads_before[p], scene, p) + " to ";
        }
        loads += load_text(jump.loads[p], scene, p);
    }
    if (!loads.empty()) loads += ")";
    return over_time ? fmt::format("between time {:.6g} and {:.6g}{}", jump.before, jump.time, loads)
                     : fmt::format("at time {:.6g}{}", jump.time, loads);
}

constexpr double worth_telling = 0.02;  // relative change of a reaction

// ", reaction 27.6 to 16.5 N/mm".
std::string reactions_text(const Jump& jump, const Scene& scene) {
    std::string out;
    for (std::size_t p = 0; p < jump.loads.size(); ++p) {
        const double before = jump.reaction_before[p], after = jump.reaction_after[p];
        if (std::abs(after - before) > worth_telling * std::abs(before))
            out += fmt::format(", {} {}", reaction_title(scene, p), reaction_text(before, after, scene, p));
    }
    return out;
}

}  // namespace

std::vector<Jump> jumps_of(const Model& model, const delam_solver* solver, const Scene& scene) {
    std::int64_t count = 0;
    call(model.context.get(), delam_solver_jump_count(solver, &count), std::string("number of jumps"));
    std::vector<Jump> out;
    for (std::int64_t i = 0; i < count; ++i) {
        Jump jump;
        call(model.context.get(),
             delam_solver_jump(solver, i, &jump.step, &jump.before, &jump.time, &jump.stored, &jump.dissipated,
                               &jump.released, &jump.debonded, &jump.interface, &jump.first, &jump.last),
             fmt::format("jump {}", i));
        for (const PatternData& pattern : scene.patterns) {
            jump.loads_before.push_back(factor_at(pattern, jump.before) + 0.0);  // turns -0 into 0
            jump.loads.push_back(factor_at(pattern, jump.time) + 0.0);
        }
        const std::size_t patterns = pattern_count(model);
        jump.reaction_before.resize(patterns);
        jump.reaction_after.resize(patterns);
        call(model.context.get(),
             delam_solver_jump_reactions(solver, i, static_cast<std::int64_t>(patterns), jump.reaction_before.data(),
                                         jump.reaction_after.data()),
             fmt::format("reactions of jump {}", i));
        jump.reaction_before.resize(jump.loads.size());
        jump.reaction_after.resize(jump.loads.size());
        const auto interface = static_cast<std::size_t>(jump.interface);
        if (jump.interface >= 0 && interface < model.interfaces.size()) jump.name = model.interfaces[interface].name;
        out.push_back(std::move(jump));
    }
    return out;
}

bool writes_jumps(const std::vector<Jump>& jumps, const delam_solver* solver) {
    return !jumps.empty() || option_number(solver, "jump_tolerance") > 0;
}

std::string jumps_text(const std::vector<Jump>& jumps, const Scene& scene) {
    std::string out = "step,before,time,stored,dissipated,released,debonded,interface,first_pair,last_pair";
    if (scene.patterns.empty()) out += ",load";
    for (const char* value : {"load", "reaction_before", "reaction_after"})
        for (std::size_t p = 0; p < scene.patterns.size(); ++p) out += "," + title_of(value, scene, p);
    out += ",name\n";
    for (const Jump& jump : jumps) {
        out += fmt::format("{},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{:.17g},{},{},{}", jump.step, jump.before,
                           jump.time, jump.stored, jump.dissipated, jump.released, jump.debonded, jump.interface,
                           jump.first, jump.last);
        if (jump.loads.empty()) out += ",0";
        for (const auto* values : {&jump.loads, &jump.reaction_before, &jump.reaction_after})
            for (const double value : *values) out += fmt::format(",{:.17g}", value);
        out += "," + csv_cell(jump.name) + "\n";
    }
    return out;
}

std::vector<Jump> largest_jumps(const std::vector<Jump>& jumps) {
    std::vector<std::size_t> order(jumps.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return jumps[a].released > jumps[b].released; });
    order.resize(std::min(order.size(), most_lines));
    std::sort(order.begin(), order.end());
    std::vector<Jump> out;
    for (const std::size_t i : order) out.push_back(jumps[i]);
    return out;
}

std::vector<std::string> jump_lines(const std::vector<Jump>& jumps, const Scene& scene, double work) {
    const auto sum = [](const std::vector<Jump>& of, double Jump::*member) {
        return std::accumulate(of.begin(), of.end(), 0.0, [&](double all, const Jump& j) { return all + j.*member; });
    };
    const std::vector<Jump> shown = largest_jumps(jumps);
    std::vector<std::string> out;
    for (const Jump& jump : shown) {
        const std::string grown = jump.first < 0 ? "no interface changed"
                                                 : fmt::format("interface \"{}\" debonded by {}", jump.name,
                                                               extent_text(jump.debonded, scene));
        out.push_back(fmt::format("jump {}: {}, {} released{}", instant_text(jump, scene), grown,
                                  energy_text(jump.released, scene, work), reactions_text(jump, scene)));
    }
    if (shown.size() < jumps.size())
        out.push_back(fmt::format("{} debonded by {} and released {} in all (jumps.csv)",
                                  counted(static_cast<std::int64_t>(jumps.size() - shown.size()), "smaller jump"),
                                  extent_text(sum(jumps, &Jump::debonded) - sum(shown, &Jump::debonded), scene),
                                  energy_text(sum(jumps, &Jump::released) - sum(shown, &Jump::released), scene, work)));
    return out;
}

}  // namespace cli
