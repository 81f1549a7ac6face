#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# test_planted.sh SOURCE_FOLDER LIBRARY [quick]: a gate that lets nothing through is only seen at a break. Each check gets
# altered copies of the header, of a small library made from it, or of the contract, and must fail with a message that
# names the place. With `quick` one break for each script. 77: none failed, but some were left out because their tool is
# missing.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$1
library=$2
tier=${3:-all}
python=/usr/bin/python3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
failures=0
checks=0
left_out=()
declare -A seen=()

# refused MESSAGE COMMAND...: must fail and say MESSAGE (an extended regular expression).
refused() {
    local message=$1 status=0 said
    shift
    said=$("$@" 2>&1) || status=$?
    checks=$((checks + 1))
    if ((status == 0)); then
        printf 'passed, but must fail (%s): %s\n' "$message" "$*"
        failures=$((failures + 1))
    elif ! grep -qE -- "$message" <<<"$said"; then
        printf 'failed without saying "%s": %s\n%s\n' "$message" "$*" "$said"
        failures=$((failures + 1))
    fi
}
accepted() {
    local status=0 said
    said=$("$@" 2>&1) || status=$?
    checks=$((checks + 1))
    if ((status != 0)); then
        printf 'must pass: %s\n%s\n' "$*" "$said"
        failures=$((failures + 1))
    fi
}
# wanted KIND: in the quick tier true for the first of each kind alone.
wanted() {
    [[ $tier == all || -z ${seen[$1]:-} ]] || return
    seen[$1]=yes
}

# A header of the house, small.
mkdir -p "$work/sound/delam"
cat >"$work/sound/delam/delam.h" <<'HEADER'
/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELAM_DELAM_H
#define DELAM_DELAM_H
#include <stdint.h>
#if defined(__GNUC__)
#define DELAM_API __attribute__((visibility("default")))
#else
#define DELAM_API
#endif
#ifdef __cplusplus
extern "C" {
#endif
#define DELAM_ABI 1             /* of the interface */
#define DELAM_ERROR_ARGUMENT -1 /* a NULL */
typedef struct delam_law delam_law; /* how an interface holds together */
/* Told of each value, with its name.
 * [unit value L finite; null user; owns name static; status cancelled; thread call's; since 0.2] */
typedef int32_t (*delam_watch_callback)(double value, const char *name, void *user);
/* Makes a law of a kind.
 * [null none; owns out caller; status only argument, memory; thread any; since 0.1] */
DELAM_API int32_t delam_law_create(const char *kind, delam_law **out);
/* Tractions at count jumps: jump, traction [count][2].
 * [unit jump L finite, traction F/L2; null traction; status argument; source NOBODY 1900; since 0.1] */
DELAM_API int32_t delam_law_respond(const delam_law *law, int64_t count, const double *jump, double *traction);
/* Calls back for each value that is computed from now on.
 * [null watch, user; owns watch and user: the host; status usual; since 0.2] */
DELAM_API int32_t delam_law_watch(delam_law *law, delam_watch_callback watch, void *user);
#ifdef __cplusplus
}
#endif
#endif
HEADER
cat >"$work/sound/law.c" <<'CODE'
#include "delam/delam.h"
struct delam_law { int32_t kind; };
DELAM_API int32_t delam_law_create(const char *kind, delam_law **out) {
    return kind != 0 && out != 0 ? 0 : DELAM_ERROR_ARGUMENT;
}
DELAM_API int32_t delam_law_respond(const delam_law *law, int64_t count, const double *jump, double *traction) {
    return law != 0 && count > 0 && jump != traction ? 0 : DELAM_ERROR_ARGUMENT;
}
DELAM_API int32_t delam_law_watch(delam_law *law, delam_watch_callback watch, void *user) {
    return law != 0 && watch != 0 ? watch(1.0, "value", user) : 0;
}
CODE
printf 'delam_law_create 0.1\ndelam_law_respond 0.1\ndelam_law_watch 0.2\n' >"$work/sound/symbols.txt"
cp "$root/src/capi/delam.map" "$work/sound/delam.map"

# planted NAME: a fresh copy to break. make NAME [OPTIONS]: its library. gate NAME CHECK [OPTIONS].
planted() {
    rm -rf "${work:?}/$1"
    cp -r "$work/sound" "$work/$1"
}
make() {
    local name=$1
    shift
    (cd "$work/$name" && gcc -std=c99 -g -fPIC -shared -fvisibility=hidden -I. law.c -o libdelam.so \
        -Wl,--version-script=delam.map -Wl,-soname,libdelam.so.1 "$@")
}
gate() {
    local name=$1 check=$2
    shift 2
    "$python" "$here/gate.py" "$check" --library "$work/$name/libdelam.so" --header "$work/$name/delam/delam.h" \
        --experimental "$work/$name/delam/experimental.h" --list "$work/$name/symbols.txt" \
        --baseline "$work/sound/delam.abi" --baseline-header "$work/sound/delam/delam.h" "$@"
}
# edit NAME FILE SED: the break; it must have changed something.
edit() {
    local file=$work/$1/$2
    cp "$file" "$file.before"
    sed -i -E "$3" "$file"
    if cmp -s "$file" "$file.before"; then
        printf '%s of %s is unchanged: %s\n' "$2" "$1" "$3"
        failures=$((failures + 1))
    fi
    rm "$file.before"
}
lint() { "$python" "$here/contract_lint.py" "$work/$1/delam/delam.h" "$work/$1/symbols.txt"; }

make sound
accepted gate sound symbols
accepted gate sound baseline
accepted lint sound

# ---- the static library ----
# pack NAME [SOURCE.cpp]: the archive of its objects, made as the library's is. gate_static NAME.
pack() {
    local name=$1
    (cd "$work/$name" && rm -f core.a libdelam.a && gcc -std=c99 -fPIC -fvisibility=hidden -I. -c law.c &&
        g++ -std=c++17 -fPIC -fvisibility=hidden -I. -c inside.cpp && ar rcs core.a law.o inside.o &&
        cmake -DARCHIVE=core.a -DOBJECT=one.o -DSTRIP=OFF -DLD=ld -DNM=nm -DOBJCOPY=objcopy \
            -P "$root/src/package/one_object.cmake" && ar rcs libdelam.a one.o)
}
gate_static() { gate "$1" static --archive "$work/$1/libdelam.a"; }
if [[ $tier == quick ]]; then
    :
elif command -v cmake >/dev/null; then
    # What C++ makes weak, hidden, grouped and unique.
    planted inside
    cat >"$work/inside/inside.cpp" <<'CODE'
#include <stdexcept>
#include <vector>
struct Inside : std::runtime_error { using std::runtime_error::runtime_error; };
inline int counted() { static int count = 0; return ++count; }
template <typename T> struct Names { static inline std::vector<T> all; };
__attribute__((visibility("default"))) inline std::vector<int> shared;
int helper(int a) {
    if (a < 0) throw Inside("negative");
    Names<int>::all.push_back(a);
    shared.push_back(a);
    return counted();
}
CODE
    accepted pack inside
    accepted gate_static inside
    inside() {
        rm -rf "${work:?}/$1"
        cp -r "$work/inside" "$work/$1"
    }
    inside unlisted
    edit unlisted symbols.txt '/watch/d'
    refused '^delam_law_watch: global in .*, but neither in .*symbols.txt nor' gate_static unlisted
    inside gone
    printf 'delam_law_forget 0.1\n' >>"$work/gone/symbols.txt"
    refused '^delam_law_forget: in .*, but not global in' gate_static gone
    inside bare
    (cd "$work/bare" && objcopy --globalize-symbol=_Z6helperi one.o && ar rcs libdelam.a one.o)
    refused '^_Z6helperi: global in' gate_static bare
    inside hidden
    (cd "$work/hidden" && objcopy --localize-symbol=delam_law_watch one.o && ar rcs libdelam.a one.o)
    refused '^delam_law_watch: in .*, but not global in' gate_static hidden
    inside grouped
    (cd "$work/grouped" && ar rcs libdelam.a inside.o)
    refused 'section groups, which a linker exchanges' gate_static grouped
    refused '^shared: global in' gate_static grouped
else
    left_out+=("those of the static library (Debian: cmake)")
fi

# ---- symbols, SONAME, nodes ----
planted missing
edit missing law.c 's/delam_law_watch\(/delam_law_watched(/; s/^DELAM_API (int32_t delam_law_watched)/\1/'
edit missing delam.map 's/global: delam_\*/global: delam_law_create; delam_law_respond/'
make missing
refused '^delam_law_watch: declared, but the library does not export it' gate missing symbols

if [[ $tier == all ]]; then
    planted extra
    printf 'DELAM_API int32_t delam_more(void);\nDELAM_API int32_t delam_more(void) { return 0; }\n' >>"$work/extra/law.c"
    make extra
    refused '^delam_more: exported, but no public header declares it' gate extra symbols

    planted leak
    printf '__attribute__((visibility("default"))) int helper(void);\nint helper(void) { return 0; }\n' >>"$work/leak/law.c"
    edit leak delam.map 's/local: \*;/local: none;/; s/global: delam_\*/global: delam_*; helper/'
    make leak
    refused '^helper: exported, but no public header' gate leak symbols

    planted unlisted
    edit unlisted symbols.txt '/watch/d'
    make unlisted
    refused '^delam_law_watch: not in .*symbols.txt' gate unlisted symbols

    planted gone
    printf 'delam_law_forget 0.1\n' >>"$work/gone/symbols.txt"
    make gone
    refused '^delam_law_forget: since 0.1 in .*does not declare it any more' gate gone symbols
    edit gone symbols.txt 's/forget 0.1/forget soon/'
    refused 'expected a name and a version' gate gone symbols

    planted soname
    make soname -Wl,-soname,libdelam.so.2
    refused 'SONAME libdelam.so.2, but DELAM_ABI 1' gate soname symbols
    planted abi
    edit abi delam/delam.h 's/DELAM_ABI 1/DELAM_ABI 2/'
    make abi
    refused 'SONAME libdelam.so.1, but DELAM_ABI 2' gate abi symbols

    planted node
    edit node delam.map 's/^DELAM_1 /DELAM_0 /'
    make node
    refused "^delam_law_create: version node 'DELAM_0', expected DELAM_1" gate node symbols
    planted bare
    printf '{ global: delam_*; local: *; };\n' >"$work/bare/delam.map"
    make bare
    refused "^delam_law_create: version node '', expected DELAM_1" gate bare symbols

    planted experimental
    cat >"$work/experimental/delam/experimental.h" <<'HEADER'
#ifndef DELAM_EXPERIMENTAL_H
#define DELAM_EXPERIMENTAL_H
#include <delam/delam.h>
DELAM_API int32_t delam_experimental_guess(const delam_law *law);
#endif
HEADER
    printf '#include "delam/experimental.h"\nint32_t delam_experimental_guess(const delam_law *a) { return a != 0; }\n' \
        >>"$work/experimental/law.c"
    make experimental
    accepted gate experimental symbols
    edit experimental delam.map '/EXPERIMENTAL/d'
    make experimental
    refused "delam_experimental_guess: version node 'DELAM_1', expected DELAM_EXPERIMENTAL" gate experimental symbols
    edit experimental delam/experimental.h 's/experimental_guess/law_guess/'
    refused 'delam_law_guess: names of the experimental header start with delam_experimental_' gate experimental symbols

    planted visible
    printf 'namespace delam { int inner(int a) { return a + 1; } }\n' >"$work/visible/inner.cpp"
    g++ -c -fPIC "$work/visible/inner.cpp" -o "$work/visible/inner.o"
    ar rc "$work/visible/libcore.a" "$work/visible/inner.o"
    make visible
    refused '^_ZN5delam5innerEi: visible outside its file' gate visible symbols --archive "$work/visible/libcore.a"
    g++ -c -fPIC -fvisibility=hidden "$work/visible/inner.cpp" -o "$work/visible/inner.o"
    ar rc "$work/visible/libcore.a" "$work/visible/inner.o"
    accepted gate visible symbols --archive "$work/visible/libcore.a"

    planted gpl
    printf 'int cholmod_l_sdmult(void);\nint delam_inner(void);\nint delam_inner(void) { return cholmod_l_sdmult(); }\n' \
        >>"$work/gpl/law.c"
    make gpl
    refused '^cholmod_l_sdmult: a function of CHOLMOD' gate gpl symbols --cholmod
fi

# ---- the header against the baseline's ----
planted signature
edit signature delam/delam.h 's/int64_t count, const double \*jump/int32_t count, const double *jump/'
refused "^delam_law_respond: 'int32_t delam_law_respond\(const delam_law\*, int32_t," gate signature baseline
if [[ $tier == all ]]; then
    planted const
    edit const delam/delam.h 's/, const double \*jump/, double *jump/'
    refused "^delam_law_respond: .*in the baseline .*const double\*" gate const baseline
    planted callback
    edit callback delam/delam.h 's/\(double value, /(float64_t value, /'
    refused "type 'float64_t' is none of the interface's types" gate callback baseline
    planted callback
    edit callback delam/delam.h 's/\(double value, const char \*name, void \*user\)/(void *user, double value)/'
    refused "^delam_watch_callback: 'int32_t delam_watch_callback\(void\*, double\)'" gate callback baseline
    planted constant
    edit constant delam/delam.h 's/ARGUMENT -1/ARGUMENT -2/'
    refused '^DELAM_ERROR_ARGUMENT: -2, in the baseline -1' gate constant baseline
    planted removed
    edit removed delam/delam.h '/delam_law_watch\(/d'
    refused '^delam_law_watch: in the baseline, gone from the header' gate removed baseline
    planted unprotected
    edit unprotected delam/delam.h \
        's|^/\* Calls back|/* A sum.\n * [status -; thread any; since 0.2] */\nDELAM_API int64_t delam_sum(void);\n&|'
    printf 'delam_sum 0.2\n' >>"$work/unprotected/symbols.txt"
    refused '^delam_sum: listed, but not in the baseline' gate unprotected baseline
fi

# ---- forms that the header may not have ----
if [[ $tier == all ]]; then
    planted form
    edit form delam/delam.h 's/^typedef struct delam_law delam_law;/&\ntypedef struct delam_point { double x; } dot;/'
    refused 'not a form that the header may have: typedef struct delam_point' gate form baseline
    planted form
    edit form delam/delam.h 's/^typedef struct delam_law delam_law;/&\nenum delam_kind { delam_kind_one };/'
    refused 'not a form that the header may have: enum delam_kind' gate form baseline
    planted form
    edit form delam/delam.h 's/int64_t count, const double \*jump/long count, const double *jump/'
    refused "type 'long' is none of the interface's types" gate form baseline
    planted form
    edit form delam/delam.h 's/^#define DELAM_ABI 1/&\n#define DELAM_TRY(call) (call)/'
    refused 'a macro with arguments: #define DELAM_TRY' gate form baseline
fi

# ---- abidiff: a library that was compiled from something else than the baseline ----
if command -v abidiff >/dev/null; then
    gate sound abixml >"$work/sound/delam.abi"
    accepted gate sound abidiff
    planted type
    edit type delam/delam.h 's/int64_t count, const double \*jump/int32_t count, const double *jump/'
    edit type law.c 's/int64_t count/int32_t count/'
    make type
    refused 'function int32_t delam_law_respond.*' gate type abidiff
    if [[ $tier == all ]]; then
        refused 'type size changed from 64 to 32' gate type abidiff
        planted result
        edit result delam/delam.h 's/int32_t (delam_law_create)/int64_t \1/'
        edit result law.c 's/int32_t (delam_law_create)/int64_t \1/'
        make result
        refused 'return type changed' gate result abidiff
        planted pointer
        edit pointer delam/delam.h 's/\(\*delam_watch_callback\)\(double/(*delam_watch_callback)(int64_t/'
        edit pointer law.c 's/watch\(1.0/watch(1/'
        make pointer
        refused 'delam_law_watch' gate pointer abidiff
        refused 'abidiff ended with 12' gate missing abidiff
        accepted gate extra abidiff
        accepted gate experimental abidiff
        refused 'SONAME changed' gate soname abidiff
        strip --strip-debug -o "$work/type/stripped.so" "$work/type/libdelam.so"
        mv "$work/type/stripped.so" "$work/type/libdelam.so"
        refused 'no debug information' gate type abidiff
    fi
else
    left_out+=("those of abidiff (Debian: abigail-tools)")
fi

# ---- the header alone, for each compiler ----
# alone CC CXX
alone() {
    local cc=$1 cxx=${2//+/\\+}
    accepted bash "$here/headers.sh" "$1" "$2" "$work/sound"
    planted cpp
    edit cpp delam/delam.h 's/^#define DELAM_ABI 1/&\nusing delam_real = double;/'
    refused "delam/delam.h: not c99 for $cc" bash "$here/headers.sh" "$1" "$2" "$work/cpp"
    planted cpp
    edit cpp delam/delam.h 's/const char \*kind, delam_law \*\*out/const char *template, delam_law **out/'
    refused "delam/delam.h: not c\\+\\+17 for $cxx" bash "$here/headers.sh" "$1" "$2" "$work/cpp"
    planted bare_c
    edit bare_c delam/delam.h '/#include <stdint.h>/d'
    refused "delam/delam.h: not c99 for $cc" bash "$here/headers.sh" "$1" "$2" "$work/bare_c"
    planted young
    edit young delam/delam.h 's/^typedef struct delam_law delam_law;/&\n&/'
    refused "delam/delam.h: not c99 for $cc" bash "$here/headers.sh" "$1" "$2" "$work/young"
}
if [[ $tier == all ]]; then
    alone gcc g++
    if command -v clang >/dev/null && command -v clang++ >/dev/null; then
        alone clang clang++
    else
        left_out+=("those of the headers under clang (Debian: clang)")
    fi
    status=0
    bash "$here/headers.sh" no-such-cc no-such-c++ "$work/sound" >/dev/null || status=$?
    if ((status != 77)); then
        printf 'a compiler that is not there must be skipped with 77, not %d\n' "$status"
        failures=$((failures + 1))
    fi
fi

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

# ---- keys ----
# A library in front of the real one that says something else of its keys. lying NAME: compiled with -DNAME.
mkdir "$work/keys"
cat >"$work/keys/lying.c" <<'CODE'
#define _GNU_SOURCE
#include <delam/delam.h>
#include <dlfcn.h>
#include <string.h>
#define BEHIND(name) __typeof__(&name) behind = (__typeof__(&name))dlsym(RTLD_NEXT, #name)
#ifdef FEWER_OPTIONS
int64_t delam_option_count(void) { BEHIND(delam_option_count); return behind() - 1; }
#endif
#ifdef CELL
int32_t delam_cell_type_info(int64_t index, const char **name, int32_t *cell_type, int32_t *dimension, int32_t *nodes,
                             int32_t *corners, int32_t *faces, int32_t *face_nodes, int32_t *face_corners) {
    BEHIND(delam_cell_type_info);
    const int32_t status =
        behind(index, name, cell_type, dimension, nodes, corners, faces, face_nodes, face_corners);
    if (strcmp(*name, CELL) == 0) *PLACE = NUMBER;
    return status;
}
#endif
#ifdef OPTION
int32_t delam_option_info(int64_t index, const char **key, const char **type, const char **unit, const char **initial,
                          const char **range, const char **meaning) {
    BEHIND(delam_option_info);
    const int32_t status = behind(index, key, type, unit, initial, range, meaning);
    if (strcmp(*key, OPTION) == 0) *PLACE = TEXT;
    return status;
}
#endif
#ifdef PARAMETER
int32_t delam_law_parameter_info(const char *kind, int64_t index, const char **key, const char **type,
                                 const char **unit, const char **initial, const char **range, const char **meaning) {
    BEHIND(delam_law_parameter_info);
    const int32_t status = behind(kind, index, key, type, unit, initial, range, meaning);
    if (strcmp(*key, PARAMETER) == 0) *PLACE = TEXT;
    return status;
}
#endif
#ifdef FEWER_VALUES
int32_t delam_solver_value_count(const delam_solver *solver, int64_t *count) {
    BEHIND(delam_solver_value_count);
    const int32_t status = behind(solver, count);
    --*count;
    return status;
}
#endif
#ifdef UNRECORDED
int32_t delam_solver_record(delam_solver *solver, const char *key) {
    BEHIND(delam_solver_record);
    int64_t rows = 0, dimension = 0;
    delam_solver_field_shape(solver, "displacement", -1, &rows, &dimension);
    const int here = strcmp(key, UNRECORDED) == 0 && dimension == IN;
    return here ? DELAM_ERROR_ARGUMENT : behind(solver, key);
}
#endif
#ifdef UNKNOWN
int32_t delam_solver_value(delam_solver *solver, const char *key, double *value) {
    BEHIND(delam_solver_value);
    const int32_t status = behind(solver, key, value);
    if (strcmp(key, UNKNOWN) == 0) *value = 0.0 / 0.0;
    return status;
}
#endif
#ifdef FLAT
int32_t delam_solver_field_shape(const delam_solver *solver, const char *key, int64_t part, int64_t *rows,
                                 int64_t *columns) {
    BEHIND(delam_solver_field_shape);
    return strcmp(key, "stress") == 0 ? DELAM_ERROR_ARGUMENT : behind(solver, key, part, rows, columns);
}
#endif
CODE
keys() { "$python" "$here/keys.py" "$@"; }
lying() {
    gcc -std=gnu99 -fPIC -shared -I"$root/include" "$@" "$work/keys/lying.c" -o "$work/keys/liblying.so" \
        -Wl,--no-as-needed "$library" -Wl,-rpath,"$(dirname "$library")" -ldl
    keys "$work/keys/liblying.so" "$root/include/delam/delam.h" "${more[@]}"
}
more=()
accepted lying -DNONE
refused '^option memory_limit: in the baseline, gone' lying -DFEWER_OPTIONS
if [[ $tier == all ]]; then
    refused '^option contact_limit: type real, in the baseline integer' \
        lying '-DOPTION="contact_limit"' -DPLACE=type '-DTEXT="real"'
    refused "^option damage_tolerance: range '0 <= value < 0.1' does not allow all of '0 <= value < 1'" \
        lying '-DOPTION="damage_tolerance"' -DPLACE=range '-DTEXT="0 <= value < 0.1"'
    accepted lying '-DOPTION="damage_tolerance"' -DPLACE=range '-DTEXT="0 <= value <= 1"'
    refused "^option contact: range 'auto' does not allow" lying '-DOPTION="contact"' -DPLACE=range '-DTEXT="auto"'
    accepted lying '-DOPTION="contact"' -DPLACE=range '-DTEXT="auto | always | never"'
    refused "^option threads: default '2', in the baseline '1': run .*update.sh, and name it" \
        lying '-DOPTION="threads"' -DPLACE=initial '-DTEXT="2"'
    more=(--new-defaults)
    accepted lying '-DOPTION="threads"' -DPLACE=initial '-DTEXT="2"'
    refused "^law griffith gradient: default '', .*: it must be given now" \
        lying '-DPARAMETER="gradient"' -DPLACE=initial '-DTEXT=""'
    more=()
    refused '^law trapezoidal normal_stiffness: unit F/L2, in the baseline F/L3' \
        lying '-DPARAMETER="normal_stiffness"' -DPLACE=unit '-DTEXT="F/L2"'
    refused "^law trapezoidal plateau: in the baseline, gone" lying '-DPARAMETER="plateau"' -DPLACE=key '-DTEXT="level"'
    refused '^cell hex8: shape \[9\]\[3\], in the baseline \[8\]\[3\]' lying '-DCELL="hex8"' -DPLACE=nodes -DNUMBER=9
    refused '^cell hex8: number 3, by the header 4' lying '-DCELL="hex8"' -DPLACE=cell_type -DNUMBER=3
    refused '^value reaction:NAME: in the header, delam_solver_value_name does not give it' lying -DFEWER_VALUES
    refused '^value crack_length: is not recorded any more' lying '-DUNRECORDED="crack_length"' -DIN=2
    refused '^value crack_length: is not recorded any more' lying '-DUNRECORDED="crack_length"' -DIN=3
    refused '^value dissipated: is -?nan in 2D' lying '-DUNKNOWN="dissipated"'
    refused '^field stress: shape None, by the header' lying -DFLAT
fi

# table SED MESSAGE: another table in the header.
table() {
    wanted table || return 0
    rm -rf "$work/table"
    mkdir "$work/table"
    cp "$root/include/delam/delam.h" "$here/baseline/keys.txt" "$work/table"
    edit table delam.h "$1"
    refused "$2" keys "$library" "$work/table/delam.h"
}
table '/^ \*   released  /d' '^value released: in the baseline, gone'
table '/^ \*   released  /d' '^value released: delam_solver_value_name gives it, the table'
table 's/^( \*   rotation_max +)rad/\1-  /' '^value rotation_max: unit 1, in the baseline rad'
table 's/^( \*   stress +)\[cells\]\[4 or 6\]/\1[cells][6]/' '^field stress: shape \[cells\]\[6\], in the baseline'
table '/^ \*   traction +\[pairs\]/d' '^field traction: in the baseline, gone'
table 's/^( \*   energy_release_rate +)F\/L /\1F   /' \
    "^value energy_release_rate:I: is .*: not the unit 'F' of the header"
table 's/^( \*   jump +\[pairs\]\[dimension\] +)L /\1F /' "^field jump: is .*: not the unit 'F' of the header"
table 's/"mean-dilatation"/"mean-pressure"/' "^text delam_problem_set_formulation: range .* does not allow all of"
table 's/"mean-dilatation"/"mean-pressure"/' \
    "^text delam_problem_set_formulation: 'mean-pressure' of the header is refused"
if [[ $tier == all ]]; then
    # New keys are free.
    sed -i '/^option contact;/d; /^value released;/d' "$work/table/keys.txt"
    more=(--baseline "$work/table/keys.txt")
    accepted lying -DNONE
fi

# ---- sentences about order, and statuses that are listed ----
# real FILE EXPRESSION: copies of the real headers, one of them changed.
real() {
    rm -rf "$work/real"
    cp -r "$root/include" "$work/real"
    edit real "delam/$1" "$2"
}
sentences() { "$python" "$here/sentences.py" "$@"; }
real delam.h 's/^(\/\* Returns the product version), /\1 only once, /'
refused "^delam_version: 'Returns the product version only once.*neither a row nor another test" \
    sentences "$work/real/delam/delam.h"
real delam.h 's/null none; status argument; since 0.1\] \*\/$/null none; status argument, file; since 0.1] *\//'
refused '^delam_law_set: file: no row of provoked.py gives this status' \
    "$python" "$here/provoked.py" "$library" "$work/real/delam/delam.h"
if [[ $tier == all ]]; then
    real delam.h 's/restores the number afterwards/sets the number afterwards/'
    refused "^delam_blas_threads: 'restores the number afterwards': no such sentence" \
        sentences "$work/real/delam/delam.h"
    real petsc.h 's/^(\/\* Writes a number), /\1 until then, /'
    refused '^delam_petsc_value: .*neither a row nor another test' \
        sentences "$work/real/delam/petsc.h" --base "$work/real/delam/delam.h"
    petsc_library=$(dirname "$library")/libdelam-petsc.so
    if [[ -f $petsc_library ]] && "$python" -c 'import mpi4py' 2>/dev/null; then
        real petsc.h 's/unit value of key; null none; status argument, state/&, file/'
        refused '^delam_petsc_value: file: no row of provoked_petsc.py gives this status' "$python" \
            "$here/provoked_petsc.py" "$library" "$work/real/delam/delam.h" "$petsc_library" "$work/real/delam/petsc.h"
    else
        left_out+=("that of the statuses of libdelam-petsc (Debian: python3-mpi4py)")
    fi
fi

# ---- a library on top, with MPI ----
mkdir -p "$work/top/delam"
cp "$work/sound/delam/delam.h" "$work/top/delam"
printf 'typedef struct ompi_communicator_t *MPI_Comm;\ntypedef int MPI_Fint;\nextern struct ompi_communicator_t ompi_mpi_world;\n' \
    >"$work/top/mpi.h"
cat >"$work/top/delam/petsc.h" <<'HEADER'
/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELAM_PETSC_H
#define DELAM_PETSC_H
#include <mpi.h>
#include <delam/delam.h>
typedef struct delam_petsc delam_petsc; /* ranks */
/* Makes the ranks of a communicator comm.
 * [null none; owns out caller; status argument; thread MPI's; since 0.1] */
DELAM_API int32_t delam_petsc_create(MPI_Comm comm, delam_petsc **out);
/* What rank 0 does.
 * [null user; status returned; thread call's; since 0.1] */
typedef int32_t (*delam_petsc_work_callback)(void *user);
/* Does work on rank 0, which has the law.
 * [null user; owns work and user: the host, until the call returns; status returned; since 0.1] */
DELAM_API int32_t delam_petsc_run(delam_petsc *petsc, const delam_law *law, delam_petsc_work_callback work, void *user);
#endif
HEADER
cat >"$work/top/top.c" <<'CODE'
#include <delam/petsc.h>
struct delam_petsc { MPI_Comm comm; };
int32_t delam_petsc_create(MPI_Comm comm, delam_petsc **out) {
    return comm != &ompi_mpi_world || out == 0;
}
int32_t delam_petsc_run(delam_petsc *petsc, const delam_law *law, delam_petsc_work_callback work, void *user) {
    return petsc != 0 && law != 0 ? work(user) : 0;
}
CODE
printf 'delam_petsc_create 0.1\ndelam_petsc_run 0.1\n' >"$work/top/symbols.txt"
cp "$root/src/petsc/petsc.map" "$work/top/petsc.map"
cp -r "$work/top" "$work/top.sound"
# on_top NAME: a fresh copy to break. make_top NAME [OPTIONS]. gate_top NAME CHECK. lint_top NAME. promise_top NAME.
on_top() {
    rm -rf "${work:?}/$1"
    cp -r "$work/top.sound" "$work/$1"
}
make_top() {
    local name=$1
    shift
    (cd "$work/$name" && gcc -std=c99 -g -fPIC -shared -fvisibility=hidden -I. top.c -o libdelam-petsc.so \
        -Wl,--version-script=petsc.map -Wl,-soname,libdelam-petsc.so.1 "$@")
}
gate_top() {
    local name=$1 check=$2
    shift 2
    "$python" "$here/gate.py" "$check" --library "$work/$name/libdelam-petsc.so" --header "$work/$name/delam/petsc.h" \
        --base "$work/$name/delam/delam.h" --list "$work/$name/symbols.txt" --baseline "$work/top.sound/petsc.abi" \
        --baseline-header "$work/top.sound/delam/petsc.h" "$@"
}
lint_top() {
    "$python" "$here/contract_lint.py" "$work/$1/delam/petsc.h" "$work/$1/symbols.txt" --base "$work/$1/delam/delam.h"
}
promise_top() {
    "$python" "$here/promise.py" "$work/$1/delam/petsc.h" --base "$work/$1/delam/delam.h" "${@:2}"
}
make_top top.sound
accepted gate_top top.sound symbols
accepted gate_top top.sound baseline
accepted lint_top top.sound
promise_top top.sound --write >"$work/top.sound/contract.txt"
accepted promise_top top.sound --baseline "$work/top.sound/contract.txt"
on_top top
edit top petsc.map 's/DELAM_PETSC_1/DELAM_1/'
make_top top
refused "^delam_petsc_create: version node 'DELAM_1', expected DELAM_PETSC_1" gate_top top symbols
make_top top -Wl,-soname,libdelam.so.1
refused 'SONAME libdelam.so.1, but DELAM_ABI 1 of the header asks for libdelam-petsc.so.1' gate_top top symbols
if [[ $tier == all ]]; then
    on_top top
    printf 'DELAM_API int32_t delam_petsc_more(void) { return 0; }\n' >>"$work/top/top.c"
    make_top top
    refused '^delam_petsc_more: exported, but no public header declares it' gate_top top symbols
    on_top top
    edit top delam/petsc.h 's/delam_petsc_run\(/delam_ranks_run(/'
    refused '^delam_ranks_run: names of petsc.h start with delam_petsc_' gate_top top symbols
    refused '^delam_petsc_run: in the baseline, gone from the header' gate_top top baseline
    on_top top
    edit top delam/petsc.h 's/MPI_Comm comm/MPI_Fint comm/'
    refused "^delam_petsc_create: 'int32_t delam_petsc_create\(MPI_Fint," gate_top top baseline
    on_top top
    edit top delam/petsc.h 's/MPI_Comm comm/MPI_Group comm/'
    refused "delam_petsc_create: type 'MPI_Group' is none of the interface's types" gate_top top baseline
    on_top top
    edit top delam/petsc.h 's/^typedef struct delam_petsc delam_petsc;/&\ntypedef struct delam_part {\n    double x;\n} delam_part;/'
    refused 'not a form that the header may have: typedef struct delam_part' gate_top top baseline
    on_top top
    edit top delam/petsc.h "s/thread MPI's; //"
    refused 'delam_petsc_create: thread: missing' lint_top top
    on_top top
    edit top delam/petsc.h 's/status argument; thread/status returned; thread/'
    refused "delam_petsc_create: status: 'returned' is not known" lint_top top
    on_top top
    edit top delam/petsc.h 's/null user; owns work/null none; owns work/'
    refused '^delam_petsc_run: null: user may be NULL in the baseline' promise_top top \
        --baseline "$work/top.sound/contract.txt"
    # The core's own header has nothing of MPI.
    planted form
    edit form delam/delam.h 's/int64_t count, const double \*jump/MPI_Comm count, const double *jump/'
    refused "type 'MPI_Comm' is none of the interface's types" gate form baseline
    if command -v abidiff >/dev/null; then
        gate_top top.sound abixml >"$work/top.sound/petsc.abi"
        accepted gate_top top.sound abidiff
        on_top top
        edit top delam/petsc.h 's/work, void \*user\)/work, int32_t user)/'
        edit top top.c 's/void \*user\) \{/int32_t user) {/; s/work\(user\)/work(\&user)/'
        make_top top
        refused 'function int32_t delam_petsc_run' gate_top top abidiff
    fi
fi

# ---- a core that loads MPI ----
without_mpi() { bash "$here/without_mpi.sh" "$@"; }
accepted without_mpi "$work/sound/libdelam.so"
planted mpi
printf 'int MPI_Init(void);\nint MPI_Init(void) { return 0; }\n' >"$work/mpi/mpi.c"
(cd "$work/mpi" && gcc -shared -fPIC mpi.c -o libmpi.so.40 -Wl,-soname,libmpi.so.40)
make mpi -Wl,--no-as-needed "$work/mpi/libmpi.so.40"
refused '^.*/libdelam.so loads libmpi.so.40' without_mpi "$work/mpi/libdelam.so"
if [[ $tier == all ]]; then
    # Through a library in between; loaded by the program alone; and called without being named.
    (cd "$work/mpi" && gcc -shared -fPIC mpi.c -o libdmumps-5.5.so -Wl,-soname,libdmumps-5.5.so &&
        gcc -shared -fPIC -xc /dev/null -o libbetween.so -Wl,--no-as-needed -L. -l:libdmumps-5.5.so "-Wl,-rpath,$work/mpi")
    make mpi -Wl,--no-as-needed "$work/mpi/libbetween.so"
    refused '^.*/libdelam.so loads .*libdmumps-5.5.so' without_mpi "$work/mpi/libdelam.so"
    printf 'int main(void) { return 0; }\n' >"$work/mpi/main.c"
    (cd "$work/mpi" && gcc main.c -o host -Wl,--no-as-needed -L. -l:libmpi.so.40)
    refused '^.*/host loads libmpi.so.40' without_mpi "$work/sound/libdelam.so" "$work/mpi/host"
    printf 'int MPI_Init(void);\nint delam_inner(void);\nint delam_inner(void) { return MPI_Init(); }\n' >>"$work/mpi/law.c"
    make mpi
    refused '^.*/libdelam.so calls MPI_Init' without_mpi "$work/mpi/libdelam.so"
fi

# ---- a host of another interface ----
if [[ $tier == all ]]; then
    mkdir -p "$work/host/delam"
    cp "$here/baseline/delam/delam.h" "$work/host/delam/delam.h"
    host() {
        gcc -std=c99 -I "$work/host" "$here/host.c" -o "$work/host/host" "$library" -lm \
            -Wl,-rpath,"$(dirname "$library")" && "$work/host/host"
    }
    accepted host
    edit host delam/delam.h 's/DELAM_ABI 1/DELAM_ABI 2/'
    refused 'the library has another DELAM_ABI' host
    edit host delam/delam.h 's/DELAM_QUAD4 2/DELAM_QUAD4 4/'
    refused 'delam_mesh_create_layers.*DELAM_ERROR_ARGUMENT.*cell_type' host
fi

# ---- the reference as HTML ----
if [[ $tier == quick ]]; then
    :
elif command -v doxygen >/dev/null; then
    mkdir -p "$work/doc/src/capi" "$work/doc/verify"
    cp -r "$root/include" "$work/doc/include"
    cp "$root/src/capi/CONTRACT.md" "$work/doc/src/capi"
    cp -r "$here" "$work/doc/verify/abi"
    cp "$work/sound/delam/delam.h" "$work/doc/include/delam/delam.h"
    accepted bash "$work/doc/verify/abi/doxygen.sh" "$work/doc/out"
    sed -i '/Told of each value/{N;s/.*//}' "$work/doc/include/delam/delam.h"
    refused 'delam_watch_callback.* is not documented' bash "$work/doc/verify/abi/doxygen.sh" "$work/doc/out"
else
    left_out+=("that of the reference (Debian: doxygen)")
fi

printf '%d planted checks, %d failures\n' "$checks" "$failures"
((failures == 0)) || exit 1
if ((${#left_out[@]} > 0)); then
    printf 'skipped, planted breaks left out: %s\n' "${left_out[@]}"
    exit 77
fi
