// SPDX-License-Identifier: BSD-3-Clause
// Information about the library: version, options, parameters of laws. Hosts include delam/delam.hpp.
#ifndef DELAM_CPP_DESCRIPTION_HPP
#define DELAM_CPP_DESCRIPTION_HPP

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "delam/cpp/argument.hpp"
#include "delam/cpp/shared.hpp"
#include "delam/cpp/status.hpp"
#include "delam/delam.h"

namespace delam {

inline std::string version() { return delam_version(); }
inline std::string commit() { return delam_commit(); }
// Threads of the linear algebra of this process; 0: unknown.
inline std::int32_t blas_threads() { return delam_blas_threads(); }

// An option of problems, or a parameter of a law.
struct Description {
    std::string key, type, unit, initial, range, meaning;
};

namespace detail {

template <class Ask>
std::vector<Description> describe(std::int64_t count, Ask&& ask) {
    std::vector<Description> all;
    for (std::int64_t i = 0; i < count; ++i) {
        std::array<const char*, 6> texts{};
        const auto status = ask(i, texts);
        if (status != DELAM_OK) throw Error(status, "a description that was counted is not there");
        all.push_back({copy(texts[0]), copy(texts[1]), copy(texts[2]), copy(texts[3]), copy(texts[4]), copy(texts[5])});
    }
    return all;
}

}  // namespace detail

inline std::vector<Description> options() {
    return detail::describe(delam_option_count(), [](std::int64_t i, std::array<const char*, 6>& t) {
        return delam_option_info(i, &t[0], &t[1], &t[2], &t[3], &t[4], &t[5]);
    });
}
// For all criteria together; empty for an unknown kind.
inline std::vector<Description> law_parameters(Text kind) {
    return detail::describe(
        delam_law_parameter_count(kind.get()), [kind](std::int64_t i, std::array<const char*, 6>& t) {
            return delam_law_parameter_info(kind.get(), i, &t[0], &t[1], &t[2], &t[3], &t[4], &t[5]);
        });
}

struct LawKind {
    std::string kind, meaning;
    bool hosted;  // made by Law::host
};
inline std::vector<LawKind> law_kinds() {
    std::vector<LawKind> all;
    for (std::int64_t i = 0; i < delam_law_kind_count(); ++i) {
        const char* kind = nullptr;
        const char* meaning = nullptr;
        std::int32_t hosted = 0;
        const auto status = delam_law_kind_info(i, &kind, &meaning, &hosted);
        if (status != DELAM_OK) throw Error(status, "a kind of law that was counted is not there");
        all.push_back({detail::copy(kind), detail::copy(meaning), hosted != 0});
    }
    return all;
}

// Where open, the bound itself is outside. Infinite: there is no bound, numbers are finite.
struct Bounds {
    double lower, upper;
    bool lower_open, upper_open;
};
// Of the parameters that law_parameters(kind) lists, in its order; a text has none.
inline std::vector<Bounds> law_bounds(Text kind) {
    std::vector<Bounds> all;
    for (std::int64_t i = 0; i < delam_law_parameter_count(kind.get()); ++i) {
        double lower = 0.0, upper = 0.0;
        std::int32_t lower_open = 0, upper_open = 0;
        const auto status = delam_law_parameter_bounds(kind.get(), i, &lower, &upper, &lower_open, &upper_open);
        if (status != DELAM_OK) throw Error(status, "bounds of a parameter that was counted are not there");
        all.push_back({lower, upper, lower_open != 0, upper_open != 0});
    }
    return all;
}

}  // namespace delam

#endif
