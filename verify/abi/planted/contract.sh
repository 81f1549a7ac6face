# SPDX-License-Identifier: BSD-3-Clause
# Breaks of the lines in brackets; ../test_planted.sh sources this.
# shellcheck shell=bash disable=SC2154
# ---- the contract ----
# gap SED MESSAGE
gap() {
    wanted gap || return 0
    planted contract
    edit contract delam/delam.h "$1"
    refused "$2" lint contract
}
gap '/Makes a law of a kind/,/memory; thread any/d' 'delam_law_create: no comment directly above'
gap 's/ \* \[null none; owns out caller.*\] \*\//  *\//' 'delam_law_create: no line in brackets'
gap 's/Makes a law of a kind\./kind:/' 'delam_law_create: what: the comment does not say'
gap 's/a law of a kind/a law/' 'delam_law_create: what: parameter kind is not named'
gap 's/jump, traction \[count\]\[2\]/jump, traction/' 'delam_law_respond: shape: jump has no'
gap 's/unit jump L finite, traction/unit traction/' 'delam_law_respond: unit: none for jump'
gap 's/jump L finite,/jump L,/' 'delam_law_respond: unit: jump has no range'
gap 's/value L finite;/value L;/' 'delam_watch_callback: unit: value has no range'
gap 's/traction F\/L2/traction Pa/' "delam_law_respond: unit: 'traction Pa' is not"
gap 's/null traction; //' 'delam_law_respond: null: missing; which of jump, traction'
gap 's/null traction; /null count; /' 'delam_law_respond: null: count is not a pointer'
gap 's/owns out caller; //' 'delam_law_create: owns: missing'
gap 's/owns watch and user: the host; //' 'delam_law_watch: owns: missing'
gap 's/status argument; //' 'delam_law_respond: status: missing'
gap 's/status argument; /status arguments; /' "delam_law_respond: status: 'arguments' is not known"
gap 's/status argument; /status -; /' "delam_law_respond: status: '-', but the function returns one"
gap 's/thread any; //' 'delam_law_create: thread: missing'
gap 's/source NOBODY 1900; //' 'delam_law_respond: source: missing'
gap 's/source NOBODY 1900; since 0.1/source NOBODY 1900/' 'delam_law_respond: since: missing'
gap 's/since 0.2/since 0.1/' 'delam_law_watch: since: 0.1, but 0.2 in the list'
gap 's/since 0.2/since then/' "delam_law_watch: since: 'then' is not a version"
gap 's/status usual; since/sometimes maybe; since/' "delam_law_watch: 'sometimes' is not a field"
gap '/Told of each value/{N;s/.*//}' 'delam_watch_callback: no comment directly above'
gap 's/ \* \[unit value L finite; .*\] \*\//  *\//' 'delam_watch_callback: no line in brackets'
gap 's/Told of each value, with its name/value, name/' 'delam_watch_callback: what: the comment does not say'
gap 's/, with its name//; s/owns name static/owns it static/' 'delam_watch_callback: what: parameter name is not named'
gap 's/unit value L finite; //' 'delam_watch_callback: unit: none for value'
gap 's/null user; owns name/owns name/' 'delam_watch_callback: null: missing; which of name, user'
gap 's/owns name static; //' 'delam_watch_callback: owns: missing'
gap 's/status cancelled; //' 'delam_watch_callback: status: missing'
gap 's/status cancelled; /status -; /' "delam_watch_callback: status: '-', but the callback returns one"
gap 's/status cancelled; /status stopped; /' "delam_watch_callback: status: 'stopped' is not known"
gap 's/^typedef int32_t \(\*delam_watch/typedef void (*delam_watch/' \
    'delam_watch_callback: status: the callback returns void'
gap "s/thread call's; //" 'delam_watch_callback: thread: missing'
gap "s/thread call's; since 0.2/thread call's/" 'delam_watch_callback: since: missing'
# Structs, outside the promise alone. struct_gap SED MESSAGE: the sound one after SED.
planted struct
cat >"$work/struct/delam/experimental.h" <<'HEADER'
#ifndef DELAM_EXPERIMENTAL_H
#define DELAM_EXPERIMENTAL_H
#include <delam/delam.h>
/* Points of a law. jump [count]. watch(value, user) is told of each. */
typedef struct delam_experimental_points {
    int64_t count;
    const double *jump;
    int32_t (*watch)(double value,
                     void *user);
    double most;
} delam_experimental_points;

/* Points under one law; those of first and second are smaller than their `most`. */
typedef struct delam_experimental_pair {
    const delam_experimental_points *first;
    delam_experimental_points *second;
    const delam_law *law;
} delam_experimental_pair;
#endif
HEADER
cp "$work/struct/delam/experimental.h" "$work/struct/sound.h"
lint_struct() { "$python" "$here/contract_lint.py" "$work/struct/delam/experimental.h" --promised "$work/struct/delam/delam.h"; }
accepted lint_struct
struct_gap() {
    wanted struct_gap || return 0
    cp "$work/struct/sound.h" "$work/struct/delam/experimental.h"
    edit struct delam/experimental.h "$1"
    refused "$2" lint_struct
}
struct_gap 's/jump \[count\]\. //' 'delam_experimental_points: what: member count is not named'
struct_gap 's/watch\(value, user\)/A host/' 'delam_experimental_points: what: member watch is not named'
struct_gap 's/their `most`/others/' 'delam_experimental_points: what: member most is not named'
struct_gap '/^\/\* Points of a law/d' 'delam_experimental_points: no comment directly above'
struct_gap 's/of each\. \*/of each. \*\/\n\n\/\* Two. \*/' 'delam_experimental_points: what: the comment does not say what the struct is'
struct_gap 's/of each\. \*/of each.\n * [null jump] */' 'delam_experimental_points: a struct has no line in brackets'
struct_gap 's/int64_t count;/long count;/' "experimental.h:5: delam_experimental_points: type 'long' is none of the interface's"
struct_gap 's/const delam_experimental_points \*first/delam_experimental_points first/' \
    "delam_experimental_pair: type 'delam_experimental_points' is none of the interface's"
struct_gap 's/double value,/float value,/' "delam_experimental_points: type 'float' is none of the interface's"
struct_gap 's/int64_t count;/int64_t count[2];/' 'not a member that a struct may have: int64_t count\[2\]'
struct_gap 's/int64_t count;/int64_t count : 3;/' "type 'int64_t count :' is none of the interface's types"
struct_gap 's/int64_t count;/int64_t count; double more;/' "member 'double more' does not begin a line"
struct_gap 's/int64_t count;/int64_t jump;/' 'member jump is there twice'
struct_gap 's/int64_t count;/int64_t count; \/\* how many \*\//' 'comments of a struct stand above it'
struct_gap 's/\} delam_experimental_pair;/} delam_experimental_pairs;/' 'is named delam_experimental_pairs at its end'
struct_gap 's/experimental_pair\b/experimental_points/g' 'delam_experimental_points is declared twice'
gap 's/^typedef struct delam_law delam_law;/typedef struct delam_law {\n    double most;\n} delam_law;/' \
    'not a form that the header may have: typedef struct delam_law \{'
# A status that the façade gives and the header does not list.
planted contract
mkdir "$work/contract/capi"
printf 'int32_t delam_law_respond(const delam_law* law) {\n    if (law == 0) fail(DELAM_ERROR_STATE, "no");\n}\n' \
    >"$work/contract/capi/law.cpp"
refused 'delam_law_respond: status: its lines in src/capi give state, which is not listed' \
    "$python" "$here/contract_lint.py" "$work/contract/delam/delam.h" --sources "$work/contract/capi"

# A row of the table of statuses that lets more pass, and one that no function takes.
printf 'inline constexpr Listed law_respond =\n    Listed::of(DELAM_ERROR_ARGUMENT, DELAM_ERROR_SNAPSHOT);\n' \
    >"$work/contract/capi/listed.hpp"
printf 'int32_t delam_law_respond(const delam_law* law) {\n    return guard(law, listed::law_respond, [] {});\n}\n' \
    >"$work/contract/capi/law.cpp"
refused "delam_law_respond: status: argument.* here, argument, snapshot in the sources' table" \
    "$python" "$here/contract_lint.py" "$work/contract/delam/delam.h" --sources "$work/contract/capi"
printf 'int32_t delam_law_respond(const delam_law* law) {\n    return guard(law, [] {});\n}\n' \
    >"$work/contract/capi/law.cpp"
refused 'delam_law_respond: the function does not take its row' \
    "$python" "$here/contract_lint.py" "$work/contract/delam/delam.h" --sources "$work/contract/capi"

# A row of the fuzz target that lets less pass.
printf '    {"delam_law_respond", Subject::law, may::state,\n' >"$work/contract/table.cpp"
refused 'delam_law_respond: status: argument' \
    "$python" "$here/contract_lint.py" "$work/contract/delam/delam.h" --fuzzed "$work/contract/table.cpp"

# ---- the lines in brackets against the baseline's ----
# broken SED MESSAGE, kept SED: the header after SED against the lines of the sound one.
"$python" "$here/promise.py" "$work/sound/delam/delam.h" --write >"$work/sound/contract.txt"
promise() { "$python" "$here/promise.py" "$work/$1/delam/delam.h" --baseline "$work/sound/contract.txt"; }
broken() {
    wanted broken || return 0
    planted line
    edit line delam/delam.h "$1"
    refused "$2" promise line
}
kept() {
    wanted kept || return 0
    planted line
    edit line delam/delam.h "$1"
    accepted promise line
}
accepted promise sound
broken '/delam_law_watch\(/d; /Calls back for each/,/status usual; since/d' \
    '^delam_law_watch: in the baseline, gone from the header'
broken 's/null traction; /null none; /' '^delam_law_respond: null: traction may be NULL in the baseline, and no longer'
kept 's/null none; owns out/null kind; owns out/'
broken 's/null user; owns name/null name, user; owns name/' \
    '^delam_watch_callback: null: the host may be given name as NULL'
broken 's/status argument; /status argument, memory, state; /' '^delam_law_respond: status: state is listed'
broken 's/status only argument, memory; /status argument; /' '^delam_law_create: status: handle is listed'
kept 's/status argument; /status usual; /'
broken 's/jump L finite, /jump 1 finite, /' '^delam_law_respond: unit: jump in 1, in the baseline L'
broken 's/unit jump L finite, traction/unit traction/' '^delam_law_respond: unit: none for jump'
broken 's/jump L finite, /jump L >= 0, /' \
    "^delam_law_respond: unit: the range of jump is '>= 0', narrower than 'finite'"
kept 's/traction F\/L2/traction F\/L2 >= 0/'
broken 's/owns out caller; /owns out the context; /' \
    "^delam_law_create: owns: 'out the context', in the baseline 'out caller'"
broken 's/thread any; //' "^delam_law_create: thread: 'nothing', in the baseline 'any'"
broken 's/since 0.2/since 0.1/' "^delam_law_watch: since: '0.1', in the baseline '0.2'"
kept 's/NOBODY 1900/SOMEBODY 1901/'
kept 's|^/\* Calls back|/* A sum.\n * [status -; thread any; since 0.3] */\nDELAM_API int64_t delam_sum(void);\n&|'

# ---- the contract against the library: lines of the header that are not true ----
untrue() {
    wanted untrue || return 0
    rm -rf "$work/untrue"
    mkdir "$work/untrue"
    cp "$root/include/delam/delam.h" "$work/untrue/delam.h"
    edit untrue delam.h "$1"
    refused "$2" "$python" "$here/test_contract.py" "$library" "$work/untrue/delam.h"
}
untrue 's/^ \* \[null bodies; status cancelled, argument, mesh, state/ * [null none; status cancelled, argument, mesh, state/' \
    'delam_mesh_add_cells: bodies NULL: status 0, expected -1'
untrue 's/^ \* \[unit nodes L finite; null none; owns out/ * [unit nodes L finite; null nodes; owns out/' \
    'delam_mesh_create: nodes NULL, as it may be: status -1, expected 0'
untrue 's/^ \* \[unit young F.*status argument/ * [unit young F\/L2, poisson 1; status usual/' \
    'delam_problem_set_elastic: young nan: status -1 is not listed'
untrue 's/^DELAM_API int64_t delam_option_count/DELAM_API int32_t delam_version_number(void);\n&/' \
    "undefined symbol: delam_version_number"
