// SPDX-License-Identifier: BSD-3-Clause
// All values and fields of an analysis, bit by bit, for tests that require the same digits.
#pragma once

#include "../unit/same_bits.hpp"
#include "enf.hpp"
#include "support.hpp"

namespace cases {

struct Bits {
    std::vector<double> values;
    std::vector<std::vector<double>> fields;
};

inline constexpr const char* all_fields[] = {"displacement", "stress", "jump",    "traction",
                                             "adhesion",     "mixity", "contact", "reaction"};

inline Bits read_bits(const reference::Solver& solver) {
    Bits bits{solver.values(), {}};
    // Counts over the solver's lifetime are not part of its state.
    for (std::size_t i = 0; i < bits.values.size(); ++i) {
        const std::string name = delam_solver_value_name(solver.get(), static_cast<std::int64_t>(i));
        if (name == "bulk_factorisations" || name == "field_recoveries") bits.values[i] = 0.0;
    }
    for (const char* key : all_fields) bits.fields.push_back(solver.field(key));
    return bits;
}

inline void expect_same(const reference::Solver& solver, const Bits& a, const Bits& b, const std::string& where) {
    for (std::size_t i = 0; i < a.values.size() && i < b.values.size(); ++i) {
        if (delam::same_bits(a.values[i], b.values[i])) continue;
        char line[200];
        std::snprintf(line, sizeof line, "%s: %s is %.17g or %.17g", where.c_str(),
                      delam_solver_value_name(solver.get(), static_cast<std::int64_t>(i)), a.values[i], b.values[i]);
        throw std::runtime_error(line);
    }
    expect(a.values.size() == b.values.size(), where + ": other values");
    for (std::size_t f = 0; f < a.fields.size(); ++f) {
        expect(delam::same_bits(a.fields[f], b.fields[f]), where + ": field " + all_fields[f] + " differs");
    }
}

// Coarse ductile ENF that is damaged within a few steps.
inline reference::Scene small_enf(std::int64_t subdomains = 4) {
    Enf e;
    e.h = 1e-3;
    e.subdomains = subdomains;
    return make_enf(e);
}
inline constexpr int small_steps = 16;
inline double small_time(int step) { return enf_time(step, small_steps); }

inline void walk(reference::Solver& solver, int first, int last) {
    for (int k = first; k <= last; ++k) {
        solver.step(small_time(k));
        solver.commit();
    }
}

}  // namespace cases
