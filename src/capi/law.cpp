// SPDX-License-Identifier: BSD-3-Clause
#include "interface/law.hpp"

#include <cmath>
#include <string>

#include "capi/handles.hpp"

namespace {

using namespace delam;

void require_fraction(const double* values, std::int64_t count, const char* name) {
    require_array(values, count, name);
    for (std::int64_t i = 0; i < count; ++i) {
        if (!(values[i] >= 0.0 && values[i] <= 1.0)) {
            fail(DELAM_ERROR_ARGUMENT, name, "[", i, "] = ", values[i], " is outside 0 .. 1");
        }
    }
}

}  // namespace

int32_t delam_law_create(delam_context* context, const char* kind, delam_law** out) {
    if (out != nullptr) *out = nullptr;
    return guard(context, [&] {
        require_pointer(out, "out");
        require_pointer(kind, "kind");
        if (std::string(kind) != "piecewise-linear") {
            fail(DELAM_ERROR_ARGUMENT, "kind = '", kind, "' is not known; known is piecewise-linear");
        }
        auto law = std::make_unique<delam_law>();
        law->context = context->context;
        law->core = std::make_shared<Law>();
        *out = law.release();
    });
}

int32_t delam_law_set(delam_law* law, const char* key, double value) {
    return guard(law, [&] {
        require_pointer(key, "key");
        const bool zero = Law::may_be_zero(key);
        if (!(zero ? value >= 0.0 : value > 0.0) || !std::isfinite(value)) {
            // A wrong key is told before a wrong value.
            if (Law probe; probe.set(key, 1.0)) {
                fail(DELAM_ERROR_ARGUMENT, "law parameter '", key, "' = ", value, " must be finite and ", zero ? ">= 0" : "> 0");
            }
        }
        Law changed = *law->core;
        if (!changed.set(key, value)) {
            fail(DELAM_ERROR_ARGUMENT, "law parameter '", key,
                 "' is not known; known are normal_stiffness, tangential_stiffness, "
                 "normal_onset, tangential_onset, normal_toughness, tangential_toughness, onset_exponent_1, "
                 "onset_exponent_2, "
                 "toughness_exponent_1, toughness_exponent_2, gradient");
        }
        *law->core = changed;
    });
}

int32_t delam_law_check(const delam_law* law) {
    return guard(law, [&] { law->core->validate(); });
}

int32_t delam_law_toughness(const delam_law* law, int64_t count, const double* mixity, double* onset,
                            double* toughness) {
    return guard(law, [&] {
        require_count(count, "count");
        require_fraction(mixity, count, "mixity");
        law->core->validate();
        for (std::int64_t i = 0; i < count; ++i) {
            const Toughness t = law->core->toughness(mixity[i]);
            if (onset != nullptr) onset[i] = t.onset;
            if (toughness != nullptr) toughness[i] = t.total;
        }
    });
}

int32_t delam_law_respond(const delam_law* law, int32_t dimension, int64_t count, const double* jump,
                          const double* mixity, const double* adhesion_old, double* adhesion, double* traction) {
    return guard(law, [&] {
        if (dimension != 2 && dimension != 3) fail(DELAM_ERROR_ARGUMENT, "dimension = ", dimension, ", must be 2 or 3");
        require_count(count, "count");
        require_array(jump, count, "jump");
        require_finite(jump, count * dimension, "jump");
        require_fraction(mixity, count, "mixity");
        require_fraction(adhesion_old, count, "adhesion_old");
        require_array(adhesion, count, "adhesion");
        for (std::int64_t i = 0; i < count; ++i) {
            if (jump[i * dimension] < 0.0) {
                fail(DELAM_ERROR_ARGUMENT, "jump[", i * dimension, "] = ", jump[i * dimension],
                     ": a normal jump must be >= 0 (no penetration)");
            }
        }
        law->core->validate();
        const Law& p = *law->core;
        for (std::int64_t i = 0; i < count; ++i) {
            const double* u = jump + i * dimension;
            double driving = 0.5 * p.normal_stiffness * u[0] * u[0];
            for (std::int32_t d = 1; d < dimension; ++d) driving += 0.5 * p.tangential_stiffness * u[d] * u[d];
            const double zeta = damage_minimiser(p.toughness(mixity[i]), driving, adhesion_old[i]);
            adhesion[i] = zeta;
            for (std::int32_t d = 0; d < dimension && traction != nullptr; ++d) {
                traction[i * dimension + d] = zeta * (d == 0 ? p.normal_stiffness : p.tangential_stiffness) * u[d];
            }
        }
    });
}

void delam_law_destroy(delam_law** law) { destroy(law); }
