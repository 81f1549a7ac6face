// SPDX-License-Identifier: BSD-3-Clause
#include "law/law.hpp"

#include <algorithm>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/numbers.hpp"
#include "capi/handle/handles.hpp"
#include "law/admissible.hpp"
#include "law/law_parameters.hpp"
#include "law/respond.hpp"

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

void create(const delam_context& context, Softening shape, delam_law** out) {
    auto law = std::make_unique<delam_law>();
    law->context = context.context;
    law->core = std::make_shared<Law>();
    law->core->softening = std::move(shape);
    *out = law.release();
}

// The parameter of this name and type, if the law's kind and criterion have it.
const LawParameter& require_parameter(const Law& law, const std::string& key, const std::string& type) {
    const LawParameter* found = find_parameter(law, key);
    if (found != nullptr && found->type == type) return *found;
    if (found != nullptr) {
        const std::string own = found->type;
        fail(DELAM_ERROR_ARGUMENT, "law parameter '", key, "' is a ",
             own == "real"   ? "number: use delam_law_set"
             : own == "text" ? "text: use delam_law_set_text"
                             : "table: use delam_law_set_table");
    }
    const std::string known = known_parameters(law, type);
    for (const LawParameter& p : law_parameters()) {
        if (key != p.key || type != p.type) continue;
        if (((p.kinds >> law.softening.index()) & 1u) != 0)
            fail(DELAM_ERROR_ARGUMENT, "law parameter '", key, "' does not belong to criterion ",
                 name_of(p.of_onset ? law.criterion_of_onset() : law.criterion), "; known are ", known);
        fail(DELAM_ERROR_ARGUMENT, "law parameter '", key, "' does not belong to kind ", law.kind().name,
             "; known are ", known.empty() ? "none" : known);
    }
    fail(DELAM_ERROR_ARGUMENT, "law parameter '", key, "' is not known; known are ", known.empty() ? "none" : known);
}

// Parameter `index` of a kind, all its criteria taken together; nullptr: there is none.
const LawParameter* parameter_of(const char* kind, std::int64_t index) {
    for (std::size_t k = 0; k < law_kinds.size() && kind != nullptr && index >= 0; ++k) {
        if (std::strcmp(kind, law_kinds[k].name) != 0) continue;
        for (const LawParameter& p : law_parameters())
            if (((p.kinds >> k) & 1u) != 0 && index-- == 0) return &p;
    }
    return nullptr;
}

}  // namespace

int32_t delam_law_create(delam_context* context, const char* kind, delam_law** out) {
    if (out != nullptr) *out = nullptr;
    return guard(context, [&] {
        require_pointer(out, "out");
        require_pointer(kind, "kind");
        Softening shape;
        if (!softening_of(kind, shape)) {
            std::string known;
            for (const LawKind& each : law_kinds) known += (known.empty() ? "" : ", ") + std::string(each.name);
            fail(DELAM_ERROR_ARGUMENT, "kind = '", kind, "' is not known; known are ", known);
        }
        if (std::holds_alternative<HostSoftening>(shape))
            fail(DELAM_ERROR_ARGUMENT, "kind = 'host' needs callbacks: use delam_law_create_host");
        create(*context, std::move(shape), out);
    });
}

int32_t delam_law_create_host(delam_context* context, const char* name, delam_adhesion_callback adhesion,
                              delam_dissipation_callback dissipation, void* user, delam_law** out) {
    if (out != nullptr) *out = nullptr;
    return guard(context, [&] {
        require_pointer(out, "out");
        require_pointer(name, "name");
        if (*name == '\0') fail(DELAM_ERROR_ARGUMENT, "name is empty");
        if (adhesion == nullptr) fail(DELAM_ERROR_ARGUMENT, "adhesion is NULL");
        if (dissipation == nullptr) fail(DELAM_ERROR_ARGUMENT, "dissipation is NULL");
        create(*context, HostSoftening{name, adhesion, dissipation, user}, out);
    });
}

int32_t delam_law_set(delam_law* law, const char* key, double value) {
    return guard(law, [&] {
        require_pointer(key, "key");
        const LawParameter& parameter = require_parameter(*law->core, key, "real");
        if (!parameter.range.allows(value))
            fail(DELAM_ERROR_ARGUMENT, "law parameter '", key, "' = ", value, " must be ", parameter.range.words);
        Law changed = *law->core;
        set_parameter(changed, key, value);
        *law->core = std::move(changed);
    });
}

int32_t delam_law_set_text(delam_law* law, const char* key, const char* value) {
    return guard(law, [&] {
        require_pointer(key, "key");
        require_pointer(value, "value");
        const LawParameter& parameter = require_parameter(*law->core, key, "text");
        Criterion criterion;
        if (!criterion_of(value, criterion))
            fail(DELAM_ERROR_ARGUMENT, key, " = '", value, "' is not known; known are ", parameter.range.words);
        if (key == std::string("criterion"))
            law->core->set_criterion(criterion);
        else
            law->core->set_onset_criterion(criterion);
    });
}

int32_t delam_law_set_table(delam_law* law, int64_t count, const double* xi, const double* s) {
    return guard(law, [&] {
        require_parameter(*law->core, "softening", "table");
        require_count(count, "count", 2);
        require_array(xi, count, "xi");
        require_array(s, count, "s");
        const auto size = index(count);
        std::visit(
            [&](auto& shape) {
                if constexpr (requires { shape.set_table({xi, size}, {s, size}); })
                    shape.set_table({xi, size}, {s, size});
            },
            law->core->softening);
    });
}

int64_t delam_law_parameter_count(const char* kind) {
    std::int64_t count = 0;
    while (parameter_of(kind, count) != nullptr) ++count;
    return count;
}

int32_t delam_law_parameter_info(const char* kind, int64_t index, const char** key, const char** type,
                                 const char** unit, const char** initial, const char** range, const char** meaning) {
    const LawParameter* p = parameter_of(kind, index);
    if (p == nullptr) return DELAM_ERROR_ARGUMENT;
    if (key != nullptr) *key = p->key;
    if (type != nullptr) *type = p->type;
    if (unit != nullptr) *unit = p->unit;
    if (initial != nullptr) *initial = p->initial;
    if (range != nullptr) *range = p->range.words;
    if (meaning != nullptr) *meaning = p->meaning;
    return DELAM_OK;
}

int32_t delam_law_parameter_bounds(const char* kind, int64_t index, double* lower, double* upper, int32_t* lower_open,
                                   int32_t* upper_open) {
    const LawParameter* p = parameter_of(kind, index);
    if (p == nullptr) return DELAM_ERROR_ARGUMENT;
    if (lower != nullptr) *lower = p->range.lower;
    if (upper != nullptr) *upper = p->range.upper;
    if (lower_open != nullptr) *lower_open = p->range.lower_open ? 1 : 0;
    if (upper_open != nullptr) *upper_open = p->range.upper_open ? 1 : 0;
    return DELAM_OK;
}

int64_t delam_law_kind_count(void) { return static_cast<std::int64_t>(law_kinds.size()); }

int32_t delam_law_kind_info(int64_t index, const char** kind, const char** meaning, int32_t* hosted) {
    if (index < 0 || index >= delam_law_kind_count()) return DELAM_ERROR_ARGUMENT;
    const LawKind& found = law_kinds[delam::index(index)];
    if (kind != nullptr) *kind = found.name;
    if (meaning != nullptr) *meaning = found.meaning;
    if (hosted != nullptr) *hosted = found.toughnesses == Toughnesses::none ? 1 : 0;
    return DELAM_OK;
}

int32_t delam_law_check(const delam_law* law) {
    return guard(law, [&] { validate(*law->core); });
}

int32_t delam_law_toughness(const delam_law* law, int64_t count, const double* mixity, double* onset,
                            double* toughness) {
    return guard(law, [&] {
        require_count(count, "count");
        require_fraction(mixity, count, "mixity");
        require_apart(onset, "onset", count, toughness, "toughness", count);
        validate(*law->core);
        std::vector<Toughness> found;  // an output may be the input array
        found.reserve(index(count));
        for (std::int64_t i = 0; i < count; ++i) found.push_back(law->core->toughness(mixity[i]));
        for (std::int64_t i = 0; i < count; ++i) {
            if (onset != nullptr) onset[i] = found[index(i)].onset;
            if (toughness != nullptr) toughness[i] = found[index(i)].total;
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
        require_apart(adhesion, "adhesion", count, traction, "traction", count * dimension);
        validate(*law->core);
        const Law& p = *law->core;
        std::vector<double> zetas(index(count)), pulls(index(traction != nullptr ? count * dimension : 0));
        for (std::int64_t i = 0; i < count; ++i) {
            const double* u = jump + i * dimension;
            const PointResponse at = respond(p, {u, index(dimension)}, mixity[i], adhesion_old[i]);
            zetas[index(i)] = at.adhesion;
            if (traction != nullptr) std::copy_n(at.traction.begin(), dimension, pulls.begin() + i * dimension);
        }
        // All inputs have been read: an output may lie in their place.
        std::copy(zetas.begin(), zetas.end(), adhesion);
        if (traction != nullptr) std::copy(pulls.begin(), pulls.end(), traction);
    });
}

void delam_law_destroy(delam_law** law) { destroy(law); }
