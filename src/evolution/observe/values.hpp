// SPDX-License-Identifier: BSD-3-Clause
// The scalars of a state by key: one table for the history, the record, the tests and every host.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "evolution/observe/observer.hpp"

namespace delam {

// Work that a value needs.
enum class ValueCost {
    free,     // the state or the solver holds the number
    reads,    // goes over the pairs or the crack fronts of the state
    recovers  // recovers the displacements of the state: a sparse solve
};
// The kind of thing that a value belongs to.
enum class ValueScope {
    whole,      // the whole scene
    interface,  // all interfaces with a law together; KEY:I is that of interface I
    pattern     // one load pattern: KEY:NAME
};

// As hosts read them.
const char* name_of(ValueCost cost);
const char* name_of(ValueScope scope);

struct ValueInfo {
    const char* key;
    const char* alias;  // another name for the key, accepted wherever the key is; "": none
    const char* unit;   // "-": none
    ValueCost cost;
    ValueScope scope;
    const char* meaning;
    const char* unrecorded = nullptr;  // why it is not recorded, in words; null: it can be
};

// Keys in the order of delam_observer_value, those of the patterns last.
std::vector<std::string> value_names(const Problem& problem);
// The row of a key, KEY:I or KEY:NAME, or of its alias; nullptr: no row has this key.
const ValueInfo* find_value(const std::string& key);
// The key itself; of an alias, the key that it stands for.
std::string value_key(const std::string& key);
// Why a value is not recorded, in words; nullptr where it can be.
const char* why_unrecorded(const std::string& key);

// The value that warnings.hpp reports if it is large.
inline constexpr const char* rotation_key = "rotation_max";

struct KeyedValue {
    const char* key;
    double value;
};
// The first value of the energies that is not finite; nothing if all are.
std::optional<KeyedValue> not_finite(const Ledger& ledger);

// Values of a state of the analysis, which need not be the one that is shown. Throws Error(DELAM_ERROR_ARGUMENT) for an
// unknown key.
std::vector<double> values_of(Observer& observer, const State& state, const std::vector<std::string>& keys);
// Returns a value of the state that is shown.
double value(Observer& observer, const std::string& key);

}  // namespace delam
