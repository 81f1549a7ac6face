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

# planted NAME: a new copy to break. make NAME [OPTIONS]: its library. gate NAME CHECK [OPTIONS].
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

for part in library contract keys petsc; do
    # shellcheck source=/dev/null
    source "$here/planted/$part.sh"
done

printf '%d planted checks, %d failures\n' "$checks" "$failures"
((failures == 0)) || exit 1
if ((${#left_out[@]} > 0)); then
    printf 'skipped, planted breaks left out: %s\n' "${left_out[@]}"
    exit 77
fi
