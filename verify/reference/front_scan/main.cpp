// SPDX-License-Identifier: BSD-3-Clause
// delam_front_scan: the exhaustive scan of fronts (../fronts.hpp) over the load steps of a flexure specimen, as CSV or
// JSON.
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

#include "fronts.hpp"

namespace {

struct Call {
    reference::Flexure data = reference::find_flexure("enf-brittle");
    std::string specimen = "enf-brittle";
    int steps = 40;
    reference::MixityRule rule = reference::MixityRule::frozen;
    bool json = false, fronts = false;
};

constexpr const char* usage =
    "usage: delam_front_scan [--specimen enf-brittle | mmf-brittle | ...] [--h MM] [--patch MM] [--notch MM] [--load "
    "MM] [--steps N]\n"
    "                        [--element quad4 | quad4-incompatible | quad8] [--mixity pure | frozen | converged] "
    "[--fronts] [--json]\n"
    "Prints step, load, front and energies of the state of least stored + dissipated energy, per metre of width.\n"
    "--fronts: the energies of all fronts at a load of 1 mm instead, with the mixity of the pair at the front.\n";

Call parse(int argc, char** argv) {
    Call call;
    double h = 1.0, patch = 0.0, notch = 30.0, load = 6.0;
    std::string element = "quad4";
    const auto number = [](const std::string& key, const char* text, double above) {
        char* end = nullptr;
        const double value = std::strtod(text, &end);
        if (end == text || *end != '\0' || !(value >= above))
            throw reference::Failure(0, key + ": '" + text + "' is not a number >= " + std::to_string(above));
        return value;
    };
    for (int i = 1; i < argc; ++i) {
        const std::string key = argv[i];
        if (key == "--json" || key == "--fronts") {
            (key == "--json" ? call.json : call.fronts) = true;
            continue;
        }
        if (i + 1 == argc) throw reference::Failure(0, key + ": unknown, or without its value\n" + usage);
        const char* value = argv[++i];
        if (key == "--specimen")
            call.specimen = value;
        else if (key == "--element")
            element = value;
        else if (key == "--mixity")
            call.rule = reference::find_rule(value);
        else if (key == "--h")
            h = number(key, value, 1e-3);
        else if (key == "--patch")
            patch = number(key, value, 0.0);
        else if (key == "--notch")
            notch = number(key, value, 0.0);
        else if (key == "--load")
            load = number(key, value, 1e-9);
        else if (key == "--steps")
            call.steps = static_cast<int>(number(key, value, 1.0));
        else
            throw reference::Failure(0, key + ": unknown\n" + usage);
    }
    call.data = reference::find_flexure(call.specimen);
    call.data.h = 1e-3 * h;
    call.data.patch = 1e-3 * patch;
    call.data.notch = 1e-3 * notch;
    call.data.final_load = 1e-3 * load;
    call.data.element = element;
    return call;
}

// Rows of numbers under their names.
void print(const Call& call, const std::vector<const char*>& columns, const std::vector<std::vector<double>>& rows) {
    if (call.json)
        std::printf(
            "{\"specimen\": \"%s\", \"element\": \"%s\", \"h_m\": %.17g, \"patch_m\": %.17g, \"mixity\": \"%s\", "
            "\"commit\": \"%s\",\n \"columns\": [",
            call.specimen.c_str(), call.data.element.c_str(), call.data.h, call.data.patch,
            reference::rule_name(call.rule), delam_commit());
    for (std::size_t c = 0; c < columns.size(); ++c)
        std::printf(call.json ? "%s\"%s\"" : "%s%s", c == 0 ? "" : call.json ? ", " : ",", columns[c]);
    std::printf(call.json ? "],\n \"rows\": [" : "\n");
    for (std::size_t r = 0; r < rows.size(); ++r) {
        if (call.json) std::printf("%s\n  [", r == 0 ? "" : ",");
        for (std::size_t c = 0; c < rows[r].size(); ++c)
            std::printf("%s%.17g", c == 0 ? "" : call.json ? ", " : ",", rows[r][c]);
        std::printf(call.json ? "]" : "\n");
    }
    if (call.json) std::printf("]}\n");
}

void run(const Call& call) {
    const reference::Fronts fronts(call.data);
    std::vector<std::vector<double>> rows;
    if (call.fronts) {
        for (std::size_t f = 0; f < fronts.list().size(); ++f) {
            const reference::Front& front = fronts.list()[f];
            rows.push_back({fronts.position(f), fronts.stored(f, 1e-3), fronts.dissipated(0, f, call.rule),
                            front.mixity[front.first_intact]});
        }
        print(call, {"a", "stored", "dissipated", "mixity"}, rows);
        return;
    }
    std::vector<double> loads;
    for (int k = 1; k <= call.steps; ++k) loads.push_back(call.data.final_load * k / call.steps);
    for (const reference::ScanStep& s : fronts.scan(loads, call.rule))
        rows.push_back(
            {static_cast<double>(s.step), s.load, fronts.position(s.front), s.stored, s.dissipated, s.total()});
    print(call, {"step", "load", "a", "stored", "dissipated", "total"}, rows);
}

}  // namespace

int main(int argc, char** argv) {
    try {
        run(parse(argc, argv));
        return 0;
    } catch (const std::exception& e) {
        std::fprintf(stderr, "delam_front_scan: %s\n", e.what());
        return 1;
    }
}
