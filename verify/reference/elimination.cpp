// SPDX-License-Identifier: BSD-3-Clause
#include "elimination.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace reference {
namespace {

// Smaller coefficients of unit-sized rows are left over from cancellation.
constexpr double negligible = 1e-12;
// Among pivots of comparable size a displacement is eliminated before a jump.
constexpr double comparable = 0.1;

}  // namespace

Elimination::Elimination(std::vector<bool> is_jump) : is_jump_(std::move(is_jump)), pivot_of_(is_jump_.size(), -1) {}

Elimination::Outcome Elimination::add(const Affine& row, double right) {
    std::map<std::int64_t, double> terms;
    double constant = row.constant;
    double row_size = 0.0;
    double value_size = std::abs(right) + std::abs(constant);
    for (const auto& [variable, coefficient] : row.terms) {
        terms[variable] += coefficient;
        row_size = std::max(row_size, std::abs(coefficient));
    }
    // A solved variable refers only to variables that were free when it was solved, so this terminates.
    for (bool again = true; again;) {
        again = false;
        for (auto it = terms.begin(); it != terms.end(); ++it) {
            const std::int64_t pivot = pivot_of_[static_cast<std::size_t>(it->first)];
            if (pivot < 0) continue;
            const double factor = it->second;
            terms.erase(it);
            const Affine& known = solved_[static_cast<std::size_t>(pivot)];
            for (const auto& [variable, coefficient] : known.terms) terms[variable] += factor * coefficient;
            constant += factor * known.constant;
            value_size += std::abs(factor * known.constant);
            again = true;
            break;
        }
    }
    std::erase_if(terms, [&](const auto& term) { return std::abs(term.second) <= negligible * row_size; });
    if (terms.empty()) {
        return std::abs(constant - right) <= negligible * value_size ? Outcome::redundant : Outcome::contradictory;
    }

    double largest = 0.0;
    for (const auto& term : terms) largest = std::max(largest, std::abs(term.second));
    std::int64_t chosen = -1;
    double best = 0.0;
    for (const auto& [variable, coefficient] : terms) {
        const double merit = std::abs(coefficient) * (is_jump_[static_cast<std::size_t>(variable)] ? comparable : 1.0);
        if (merit > best) {
            best = merit;
            chosen = variable;
        }
    }
    const double pivot = terms[chosen];
    Affine solved;
    solved.constant = (right - constant) / pivot;
    for (const auto& [variable, coefficient] : terms) {
        if (variable != chosen) solved.terms.emplace_back(variable, -coefficient / pivot);
    }
    pivot_of_[static_cast<std::size_t>(chosen)] = static_cast<std::int64_t>(solved_.size());
    variable_.push_back(chosen);
    solved_.push_back(std::move(solved));
    return Outcome::added;
}

void Elimination::close() {
    number_.assign(pivot_of_.size(), -1);
    free_ = 0;
    for (std::size_t i = 0; i < number_.size(); ++i) {
        if (pivot_of_[i] < 0) number_[i] = static_cast<std::int64_t>(free_++);
    }
    // The last solution refers to free variables only; going backwards, every solution refers to final ones.
    for (std::size_t k = solved_.size(); k-- > 0;) {
        std::map<std::int64_t, double> terms;
        double constant = solved_[k].constant;
        for (const auto& [variable, coefficient] : solved_[k].terms) {
            const std::int64_t pivot = pivot_of_[static_cast<std::size_t>(variable)];
            if (pivot < 0) {
                terms[variable] += coefficient;
                continue;
            }
            const Affine& known = solved_[static_cast<std::size_t>(pivot)];
            for (const auto& [v, c] : known.terms) terms[v] += coefficient * c;
            constant += coefficient * known.constant;
        }
        solved_[k].terms.assign(terms.begin(), terms.end());
        solved_[k].constant = constant;
    }
}

Affine Elimination::expand(const Affine& row) const {
    Affine result;
    result.constant = row.constant;
    const auto add_term = [&](std::int64_t variable, double coefficient) {
        const std::int64_t number = number_[static_cast<std::size_t>(variable)];
        for (auto& term : result.terms) {
            if (term.first == number) {
                term.second += coefficient;
                return;
            }
        }
        result.terms.emplace_back(number, coefficient);
    };
    for (const auto& [variable, coefficient] : row.terms) {
        const std::int64_t pivot = pivot_of_[static_cast<std::size_t>(variable)];
        if (pivot < 0) {
            add_term(variable, coefficient);
            continue;
        }
        const Affine& known = solved_[static_cast<std::size_t>(pivot)];
        for (const auto& [v, c] : known.terms) add_term(v, coefficient * c);
        result.constant += coefficient * known.constant;
    }
    std::erase_if(result.terms, [](const auto& term) { return std::abs(term.second) <= negligible; });
    return result;
}

}  // namespace reference
