// SPDX-License-Identifier: BSD-3-Clause
// The options of a problem: typed, by key, with default, range and meaning in one table.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace delam {

struct Options {
    // solution concept
    std::string solution = "local";          // local | energetic
    std::string backtracking = "auto";       // auto | off | on
    std::int64_t backtracking_limit = 100;   // returns to earlier steps in one step
    std::int64_t backtracking_depth = 1000;  // steps that are kept to return to
    std::int64_t search_limit = 100000;      // candidates of a search
    double search_tolerance = 1e-2;          // of what a search may leave between its samples
    // step control
    std::string step_control = "fixed";  // fixed | adaptive
    double step_tolerance = 1e-2;        // of the two-sided estimate's band, adaptive steps
    double mixity_step_tolerance = 0.0;  // 0: off
    double smallest_step = 1e-4;         // of the step asked for
    double jump_tolerance = 0.0;         // 0: jumps are not located
    double jump_size = 0.5;              // least jump that is located, in pairs
    // minimisation
    double damage_tolerance = 1e-5;          // delta
    std::int64_t minimisation_limit = 5000;  // alternate minimisation steps
    double backtracking_tolerance = 1e-3;    // eta: relative tolerance of the two-sided estimate that is reported
    std::string minimisation = "auto";       // auto | alternate | accelerated
    // mechanics
    std::string reduction = "auto";  // auto | condensed | feti
    // what may be left out where it cannot matter
    std::string contact = "auto";        // auto | always
    std::string mixity = "auto";         // auto | always
    std::string mixity_rule = "frozen";  // frozen | converged | variational
    // contact
    std::int64_t contact_limit = 200;  // primal-dual active-set steps before the fallback
    // FETI
    std::int64_t subdomains = 0;            // 0: chosen
    std::string gluing = "orthonormal";     // orthonormal | redundant
    std::string preconditioner = "series";  // none | lumped | dirichlet | series
    std::string scaling = "stiffness";      // stiffness | multiplicity
    double linear_tolerance = 1e-13;
    std::int64_t linear_limit = 2000;

    // effort; no digit depends on it, so it is not hashed
    std::int64_t threads = 1;  // of the library's own

    void set_number(const std::string& key, double value);
    void set_text(const std::string& key, const std::string& value);
    // As people write it.
    std::string value_of(const std::string& key) const;
};

struct OptionInfo {
    const char* key;
    const char* type;
    const char* unit;
    const char* initial;
    const char* range;
    const char* meaning;
};
std::span<const OptionInfo> option_table();

}  // namespace delam
