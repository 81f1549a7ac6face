// SPDX-License-Identifier: BSD-3-Clause
#include "result/history/concept.hpp"

#include <string_view>

#include "text/number.hpp"

namespace cli {

namespace {

template <class Read>
Concept concept_by(const Read& read) {
    Concept out;
    for (const char* key : {"solution", "mixity_rule", "backtracking", "backtracking_tolerance", "jump_tolerance",
                            "step_control", "mixity_step_tolerance"})
        if (const char* value = read(key)) out.emplace_back(key, value);
    return out;
}

}  // namespace

Concept concept_of(const delam_problem* problem) {
    return concept_by([problem](const char* key) { return delam_problem_option(problem, key); });
}

Concept concept_of(const delam_solver* solver) {
    return concept_by([solver](const char* key) { return delam_solver_option(solver, key); });
}

std::string concept_text(const Concept& named) {
    std::string out;
    for (const auto& [key, value] : named) out.append(out.empty() ? "" : ", ").append(key).append(" = ").append(value);
    return out;
}

std::string option_text(const delam_solver* solver, const char* key) {
    const char* value = delam_solver_option(solver, key);
    return value != nullptr ? value : "";
}

double option_number(const delam_solver* solver, const char* key) { return number_in(option_text(solver, key)); }

std::vector<std::pair<std::string, std::variant<double, std::string>>> options_of(const delam_solver* solver) {
    std::vector<std::pair<std::string, std::variant<double, std::string>>> out;
    for (std::int64_t i = 0; i < delam_option_count(); ++i) {
        const char* key = "";
        const char* type = "";
        delam_option_info(i, &key, &type, nullptr, nullptr, nullptr, nullptr);
        const char* value = delam_solver_option(solver, key);
        if (value == nullptr) continue;
        if (std::string_view(type) == "text")
            out.emplace_back(key, std::string(value));
        else
            out.emplace_back(key, number_in(value));
    }
    return out;
}

}  // namespace cli
