// SPDX-License-Identifier: BSD-3-Clause
// The options of a problem: typed, by key, with default, range and meaning in one table.
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace delam {

struct Options {
    // minimisation
    double damage_tolerance = 1e-5;             // delta
    std::int64_t minimisation_limit = 5000;     // alternate minimisation steps
    double backtracking_tolerance = 1e-3;       // eta: relative tolerance of the two-sided estimate that is reported
    std::string minimisation = "auto";          // auto | alternate | accelerated
    // mechanics
    std::string reduction = "auto";             // auto | condensed | feti
    // what may be left out where it cannot matter
    std::string contact = "auto";               // auto | always
    std::string mixity = "auto";                // auto | always
    std::string mixity_rule = "frozen";         // frozen | converged | variational
    // contact
    std::int64_t contact_limit = 200;           // primal-dual active-set steps before the fallback
    // FETI
    std::int64_t subdomains = 0;                // 0: chosen
    std::string gluing = "orthonormal";         // orthonormal | redundant
    std::string preconditioner = "series";      // none | lumped | dirichlet | series
    std::string scaling = "stiffness";          // stiffness | multiplicity
    double linear_tolerance = 1e-13;
    std::int64_t linear_limit = 2000;

    void set_number(const std::string& key, double value);
    void set_text(const std::string& key, const std::string& value);
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
