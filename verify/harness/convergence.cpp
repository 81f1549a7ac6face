// SPDX-License-Identifier: BSD-3-Clause
// Mesh and step refined together: ductile ENF and MMF, with supports and load spread over 2 mm, h and tau in a fixed
// ratio.
#include <algorithm>
#include <cmath>
#include <limits>

#include "march.hpp"
#include "orders.hpp"
#include "table.hpp"

namespace harness {
namespace {

constexpr int instants = 640;  // at which curves are compared
constexpr int places = 480;    // along the bonded length
struct Level {
    double h = 0.0;
    int steps = 0;
    March march;
    std::vector<double> position;
};

// Value at a position, linear between pairs.
double interpolate(const std::vector<double>& x, const std::vector<double>& y, double where) {
    const auto right = static_cast<std::size_t>(std::lower_bound(x.begin(), x.end(), where) - x.begin());
    if (right == 0) return y.front();
    if (right == x.size()) return y.back();
    const double part = (where - x[right - 1]) / (x[right] - x[right - 1]);
    return y[right - 1] + part * (y[right] - y[right - 1]);
}

std::vector<double> curve(const Level& level, double (*value)(const Record&)) {
    std::vector<double> values;
    for (const Record& r : level.march.steps) values.push_back(value(r));
    return values;
}

// Integral over time of |a - b| divided by that of |b|: a mean relative error.
double distance(const std::vector<double>& a, const std::vector<double>& b) {
    double difference = 0.0;
    double size = 0.0;
    for (int i = 1; i <= instants; ++i) {
        const double part = static_cast<double>(i) / instants;
        difference += std::abs(at(a, part) - at(b, part));
        size += std::abs(at(b, part));
    }
    return difference / size;
}

// Adhesion at all instants and positions, linear in between, [instants][places].
std::vector<double> sample_adhesion(const Level& level, double notch, double length) {
    std::vector<double> samples;
    std::vector<std::vector<double>> rows;
    for (const Record& r : level.march.steps) {
        std::vector<double> row;
        for (int i = 0; i < places; ++i)
            row.push_back(interpolate(level.position, r.adhesion, notch + (length - notch) * (i + 0.5) / places));
        rows.push_back(std::move(row));
    }
    const std::vector<double> intact(places, 1.0);
    for (int t = 1; t <= instants; ++t) {
        const double place = static_cast<double>(t) / instants * level.steps;
        const auto right = std::min(rows.size() - 1, static_cast<std::size_t>(std::max(0.0, std::ceil(place) - 1.0)));
        const double part = place - static_cast<double>(right);
        const std::vector<double>& before = right == 0 ? intact : rows[right - 1];
        for (std::size_t i = 0; i < places; ++i) samples.push_back(before[i] + part * (rows[right][i] - before[i]));
    }
    return samples;
}

// Mean of |a - b| over bonded length and time: the L1(0,T; L1) norm divided by T and the length.
double mean_difference(const std::vector<double>& a, const std::vector<double>& b) {
    double sum = 0.0;
    for (std::size_t i = 0; i < a.size(); ++i) sum += std::abs(a[i] - b[i]);
    return sum / static_cast<double>(a.size());
}

struct Quantity {
    const char* name;
    double (*value)(const Record&);
};
constexpr Quantity quantities[] = {
    {"stored_bulk", [](const Record& r) { return r.stored_bulk; }},
    {"stored_interface", [](const Record& r) { return r.stored_interface; }},
    {"dissipated", [](const Record& r) { return r.dissipated; }},
    {"work", [](const Record& r) { return r.work; }},
    {"reaction", [](const Record& r) { return r.reaction; }},
};

void add_rows(Table& table, const std::string& specimen, const std::string& element, const std::string& rule,
              const char* quantity, const std::vector<Level>& levels, const std::vector<double>& errors,
              const std::vector<double>& changes, const std::vector<double>& finals) {
    std::vector<double> sizes, so_far, steps_between, values;
    for (std::size_t i = 0; i < levels.size(); ++i) {
        sizes.push_back(levels[i].h);
        so_far.push_back(errors[i]);
        values.push_back(finals[i]);
        const bool last = i + 1 == levels.size();
        if (i > 0) steps_between.push_back(changes[i]);
        // Differences of successive levels decrease like the errors; for a constant ratio of sizes their order is that
        // of the method.
        const double order_change =
            i > 1 ? std::log(steps_between[i - 2] / steps_between[i - 1]) / std::log(sizes[i - 2] / sizes[i - 1]) : nan;
        const double order_final = order_of_values(sizes, values);
        table.rows.push_back({specimen, element, rule, quantity, levels[i].h * 1e3, levels[i].steps,
                              last ? Cell("finest") : Cell(errors[i]), last ? nan : order_of_errors(sizes, so_far),
                              i > 0 ? changes[i] : nan, order_change, finals[i], order_final,
                              std::isfinite(order_final) ? richardson(sizes, values, order_final) : nan});
    }
}

}  // namespace

Table convergence(const Options& options) {
    Table table;
    table.name = "convergence";
    table.note =
        "Ductile specimens, 2 mm patch supports and load, 6 mm, local solution; h and tau halved together. error: "
        "distance to the finest level, over "
        "that level's own size: L1 in time (adhesion: mean over time and bonded run of the difference, absolute); its "
        "order from the row before "
        "flatters near the finest level. change: the same distance to the row before; order_change: from two changes, "
        "not flattered. final: value at the "
        "end of the loading (adhesion: mean); order_final and richardson: from three of them. Rows that are not "
        "asymptotic are kept.";
    table.columns = {"specimen",    "element", "mixity",       "quantity", "h_mm",        "steps",     "error",
                     "order_error", "change",  "order_change", "final",    "order_final", "richardson"};
    std::vector<std::pair<double, int>> levels_asked = {
        {3e-3, 20}, {1.5e-3, 40}, {0.75e-3, 80}, {0.375e-3, 160}, {0.1875e-3, 320}};
    for (const char* specimen : {"enf-ductile", "mmf-ductile"}) {
        if (!options.wants(specimen)) continue;
        for (const char* element : {"quad4", "quad4-incompatible"}) {
            for (const char* rule : {"frozen", "converged"}) {
                if (options.quick && element[5] != '\0' && rule[0] == 'c') continue;
                std::vector<Level> levels;
                std::string refused;
                for (const auto& [h, steps] : levels_asked) {
                    if ((options.quick && h < 0.7e-3) || h < options.finest || !refused.empty()) continue;
                    progress(std::string("convergence: ") + specimen + ", " + element + ", " + rule + ", h " +
                             std::to_string(h));
                    reference::Flexure data = reference::find_flexure(specimen);
                    data.h = h;
                    data.patch = 2e-3;
                    data.element = element;
                    Choice choice;
                    choice.texts.emplace_back("mixity_rule", rule);
                    Level level{h, steps, run(data, steps, choice, true), reference::make_flexure(data).position};
                    refused = level.march.refused;
                    levels.push_back(std::move(level));
                }
                if (!refused.empty() || levels.empty()) {
                    table.rows.push_back({specimen, element, rule, skipped(refused)});
                    while (table.rows.back().size() < table.columns.size()) table.rows.back().push_back("-");
                    continue;
                }
                const std::size_t n = levels.size();
                for (const Quantity& q : quantities) {
                    std::vector<std::vector<double>> curves;
                    for (const Level& level : levels) curves.push_back(curve(level, q.value));
                    std::vector<double> errors, changes, finals;
                    for (std::size_t i = 0; i < n; ++i) {
                        errors.push_back(distance(curves[i], curves[n - 1]));
                        changes.push_back(i > 0 ? distance(curves[i - 1], curves[i]) : nan);
                        finals.push_back(curves[i].back());
                    }
                    add_rows(table, specimen, element, rule, q.name, levels, errors, changes, finals);
                }
                std::vector<std::vector<double>> fields;
                const reference::Flexure data;
                for (const Level& level : levels) fields.push_back(sample_adhesion(level, data.notch, data.length));
                std::vector<double> errors, changes, finals;
                for (std::size_t i = 0; i < n; ++i) {
                    errors.push_back(mean_difference(fields[i], fields[n - 1]));
                    changes.push_back(i > 0 ? mean_difference(fields[i - 1], fields[i]) : nan);
                    double sum = 0.0;
                    for (std::size_t j = fields[i].size() - places; j < fields[i].size(); ++j)
                        sum += fields[i][j] / places;
                    finals.push_back(sum);
                }
                add_rows(table, specimen, element, rule, "adhesion", levels, errors, changes, finals);
            }
        }
    }
    return table;
}

}  // namespace harness
