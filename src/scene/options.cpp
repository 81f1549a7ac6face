// SPDX-License-Identifier: BSD-3-Clause
#include "scene/options.hpp"

#include <array>
#include <cmath>
#include <string_view>
#include <variant>
#include <vector>

#include "base/error.hpp"
#include "delam/delam.h"

namespace delam {
namespace {

using Member = std::variant<double Options::*, std::int64_t Options::*, std::string Options::*>;

// One line of the table: what people read, where the value lives, and the closed (integer) or open (real) interval of
// numbers. The words of a text option are those of its range, parted by " | ".
struct Row {
    OptionInfo info;
    Member member;
    double lower = 0.0;
    double upper = 0.0;
};

constexpr double below = 1e-300;             // makes an end of an open interval a member
constexpr double most = 9007199254740992.0;  // 2^53: beyond it a double no longer holds every whole number

const std::array<Row, 28>& rows() {
    static const std::array<Row, 28> table{{
        {{"damage_tolerance", "real", "-", "1e-5", "0 <= value < 1",
          "alternate minimisation stops when no adhesion changes by more (delta); 0: none at all, or the limit"},
         &Options::damage_tolerance,
         -below,
         1.0},
        {{"minimisation_limit", "integer", "-", "5000", "1 <= value <= 2^53",
          "largest number of alternate minimisation steps in a load step"},
         &Options::minimisation_limit,
         1.0,
         most},
        {{"solution", "text", "-", "local", "local | energetic",
          "solution concept: local, critical points of the incremental problem reached from the state before; "
          "energetic, the lowest state that a "
          "search over fronts and new cracks and the two-sided estimate have found"},
         &Options::solution},
        {{"backtracking", "text", "-", "auto", "auto | off | on",
          "return to earlier steps when the two-sided estimate shows that they were not minimal; auto: on for "
          "energetic solutions"},
         &Options::backtracking},
        {{"backtracking_limit", "integer", "-", "100", "0 <= value <= 2^53",
          "returns to earlier steps within one load step at most"},
         &Options::backtracking_limit,
         0.0,
         most},
        {{"backtracking_depth", "integer", "-", "1000", "1 <= value <= 2^53",
          "committed steps that are kept to return to (each needs the memory of its jumps)"},
         &Options::backtracking_depth,
         1.0,
         most},
        {{"search_limit", "integer", "-", "100000", "0 <= value <= 2^53",
          "states that the search of an energetic step compares at most; search_gap says what it may have missed"},
         &Options::search_limit,
         0.0,
         most},
        {{"search_tolerance", "real", "-", "1e-2", "0 < value <= 1",
          "the search samples front positions until none between two samples can be lower than the best by more, "
          "relative to the larger of "
          "energy and work; a small value compares all"},
         &Options::search_tolerance,
         0.0,
         1.0000000000000002},
        {{"step_control", "text", "-", "fixed", "fixed | adaptive",
          "adaptive: a step that does not converge, or damages something while its two-sided estimate is wider than "
          "step_tolerance, is refused and "
          "halved within; it never grows beyond what the host asks for"},
         &Options::step_control},
        {{"step_tolerance", "real", "-", "1e-2", "0 < value < 1",
          "largest width of the two-sided estimate of an adaptive step, relative to the larger of energy and work"},
         &Options::step_tolerance,
         0.0,
         1.0},
        {{"mixity_step_tolerance", "real", "-", "0", "0 <= value < 1",
          "a step whose mixity_error is larger is refused and halved within; 0: such steps are only warned of"},
         &Options::mixity_step_tolerance,
         -below,
         1.0},
        {{"smallest_step", "real", "-", "1e-4", "0 < value <= 1",
          "shortest step that a refusal may lead to, as a part of the step asked for"},
         &Options::smallest_step,
         0.0,
         1.0000000000000002},
        {{"jump_tolerance", "real", "-", "0", "0 <= value < 1",
          "the instant of a jump is located by bisection to this part of the step; 0: jumps fall on the ends of steps"},
         &Options::jump_tolerance,
         -below,
         1.0},
        {{"jump_size", "real", "pairs", "0.5", "0 < value < 1e9",
          "least change of the debonded length or area that counts as a jump, in mean weights of a pair"},
         &Options::jump_size,
         0.0,
         1e9},
        {{"backtracking_tolerance", "real", "-", "1e-3", "0 < value < 1",
          "relative tolerance of the two-sided energy estimate (eta) beyond which a step counts as violated"},
         &Options::backtracking_tolerance,
         0.0,
         1.0},
        {{"minimisation", "text", "-", "auto", "auto | alternate | accelerated",
          "how a load step is minimised: plain alternate minimisation, or sped up by Newton steps and moves of "
          "unstable pairs to their debonded "
          "branch, each checked by the energy, to the same stopping test; auto: accelerated"},
         &Options::minimisation},
        {{"reduction", "text", "-", "auto", "auto | condensed | feti",
          "how the bodies are reduced to their interfaces: condensed once into a dense operator, or total FETI; auto: "
          "by predicted cost and "
          "memory, feti where subdomains are asked for"},
         &Options::reduction},
        {{"contact", "text", "-", "auto", "auto | always",
          "where pairs are tested for contact: auto leaves out those that cannot close (bonded, or their normal jump "
          "is prescribed); always "
          "tests every pair that is not bonded"},
         &Options::contact},
        {{"mixity", "text", "-", "auto", "auto | always",
          "where the mode mixity is computed: auto leaves it out of laws whose onset and toughness do not depend on it "
          "(their field mixity "
          "is 0); always computes it"},
         &Options::mixity},
        {{"mixity_rule", "text", "-", "frozen", "frozen | converged | variational",
          "whose mixity a step's toughness takes: that of the state before (frozen), that of the step's own solution "
          "as a fixed point, for a pair "
          "that breaks that of the iterate in which it broke (converged), or the energy with f(B(u), zeta) and its "
          "extra traction (variational)"},
         &Options::mixity_rule},
        {{"contact_limit", "integer", "-", "200", "1 <= value <= 2^53",
          "active-set steps of a displacement solve at most, least-index exchanges included"},
         &Options::contact_limit,
         1.0,
         most},
        {{"subdomains", "integer", "-", "0", "0 <= value <= 1000000",
          "subdomains that the bodies are cut into, at least one for each connected part; 0: chosen by size"},
         &Options::subdomains,
         0.0,
         1e6},
        {{"gluing", "text", "-", "orthonormal", "orthonormal | redundant",
          "multipliers where several subdomains meet in a node"},
         &Options::gluing},
        {{"preconditioner", "text", "-", "series", "none | lumped | dirichlet | series",
          "preconditioner of the dual system; series is made for compliant interfaces"},
         &Options::preconditioner},
        {{"scaling", "text", "-", "stiffness", "stiffness | multiplicity",
          "how the preconditioner shares a node out among its subdomains"},
         &Options::scaling},
        {{"linear_tolerance", "real", "-", "1e-13", "0 < value < 1",
          "relative residual at which the projected conjugate gradients stop; where rounding ends them earlier, up to "
          "100 times as much is accepted"},
         &Options::linear_tolerance,
         0.0,
         1.0},
        {{"linear_limit", "integer", "-", "2000", "1 <= value <= 2^53",
          "largest number of conjugate gradient iterations in a linear solve"},
         &Options::linear_limit,
         1.0,
         most},
        {{"threads", "integer", "-", "1", "1 <= value <= 1024",
          "threads of the library's own, within a call: subdomains of FETI side by side; no digit depends on it. Set "
          "BLAS's (delam_blas_threads) to one "
          "where this is more"},
         &Options::threads,
         1.0,
         1024.0},
    }};
    return table;
}

const Row& find(const std::string& key) {
    for (const Row& row : rows()) {
        if (key == row.info.key) return row;
    }
    std::string known;
    for (const Row& row : rows()) known += std::string(known.empty() ? "" : ", ") + row.info.key;
    fail(DELAM_ERROR_ARGUMENT, "option '", key, "' is not known; known are ", known);
}

bool allows(std::string_view range, std::string_view word) {
    while (true) {
        const std::size_t bar = range.find(" | ");
        if (range.substr(0, bar) == word) return true;
        if (bar == std::string_view::npos) return false;
        range.remove_prefix(bar + 3);
    }
}

[[noreturn]] void refuse(const Row& row, const std::string& value) {
    fail(DELAM_ERROR_ARGUMENT, "option '", row.info.key, "' = ", value, " is outside its range: ", row.info.range);
}

}  // namespace

void Options::set_number(const std::string& key, double value) {
    const Row& row = find(key);
    if (const auto* real = std::get_if<double Options::*>(&row.member)) {
        if (!(value > row.lower && value < row.upper)) refuse(row, text(value));
        this->*(*real) = value;
    } else if (const auto* integer = std::get_if<std::int64_t Options::*>(&row.member)) {
        if (!(value >= row.lower && value <= row.upper)) refuse(row, text(value));
        if (value != std::floor(value))
            fail(DELAM_ERROR_ARGUMENT, "option '", key, "' = ", value, " must be a whole number");
        this->*(*integer) = static_cast<std::int64_t>(value);
    } else {
        fail(DELAM_ERROR_ARGUMENT, "option '", key, "' is a text (", row.info.range, "), not a number");
    }
}

void Options::set_text(const std::string& key, const std::string& value) {
    const Row& row = find(key);
    const auto* words = std::get_if<std::string Options::*>(&row.member);
    if (words == nullptr)
        fail(DELAM_ERROR_ARGUMENT, "option '", key, "' is a number (", row.info.range, "), not a text");
    if (value.find(" | ") != std::string::npos || !allows(row.info.range, value)) refuse(row, "'" + value + "'");
    this->*(*words) = value;
}

std::string Options::value_of(const std::string& key) const {
    return std::visit([&](const auto member) { return text(this->*member); }, find(key).member);
}

std::span<const OptionInfo> option_table() {
    static const std::vector<OptionInfo> table = [] {
        std::vector<OptionInfo> list;
        for (const Row& row : rows()) list.push_back(row.info);
        return list;
    }();
    return table;
}

}  // namespace delam
