# SPDX-License-Identifier: BSD-3-Clause
# Breaks of the library, its symbols and its header; ../test_planted.sh sources this.
# shellcheck shell=bash disable=SC2154
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
# built NAME FILE SED MESSAGE [OPTION ...]: the library with one change.
built() {
    planted "$1"
    edit "$1" "$2" "$3"
    make "$1" "${@:5}"
    refused "$4" gate "$1" symbols
}
planted missing
edit missing law.c 's/delam_law_watch\(/delam_law_watched(/; s/^DELAM_API (int32_t delam_law_watched)/\1/'
built missing delam.map 's/global: delam_\*/global: delam_law_create; delam_law_respond/' \
    '^delam_law_watch: declared, but the library does not export it'

if [[ $tier == all ]]; then
    built extra law.c '$a DELAM_API int32_t delam_more(void);\nDELAM_API int32_t delam_more(void) { return 0; }' \
        '^delam_more: exported, but no public header declares it'
    planted leak
    printf '__attribute__((visibility("default"))) int helper(void);\nint helper(void) { return 0; }\n' >>"$work/leak/law.c"
    edit leak delam.map 's/local: \*;/local: none;/; s/global: delam_\*/global: delam_*; helper/'
    make leak
    refused '^helper: exported, but no public header' gate leak symbols
    built unlisted symbols.txt '/watch/d' '^delam_law_watch: not in .*symbols.txt'
    built gone symbols.txt '$a delam_law_forget 0.1' '^delam_law_forget: since 0.1 in .*does not declare it any more'
    built gone symbols.txt '$a delam_law_forget soon' 'expected a name and a version'
    planted soname
    make soname -Wl,-soname,libdelam.so.2
    refused 'SONAME libdelam.so.2, but DELAM_ABI 1' gate soname symbols
    built abi delam/delam.h 's/DELAM_ABI 1/DELAM_ABI 2/' 'SONAME libdelam.so.1, but DELAM_ABI 2'
    built node delam.map 's/^DELAM_1 /DELAM_0 /' "^delam_law_create: version node 'DELAM_0', expected DELAM_1"
    built bare delam.map '1s/.*/{ global: delam_*; local: *; };/; 2,$d' \
        "^delam_law_create: version node '', expected DELAM_1"

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

# ---- the header against the baseline's, and forms that it may not have ----
# changed SED MESSAGE
changed() {
    wanted changed || return 0
    planted changed
    edit changed delam/delam.h "$1"
    refused "$2" gate changed baseline
}
handle='s/^typedef struct delam_law delam_law;/&\n'
changed 's/int64_t count, const double \*jump/int32_t count, const double *jump/' \
    "^delam_law_respond: 'int32_t delam_law_respond\(const delam_law\*, int32_t,"
changed 's/, const double \*jump/, double *jump/' "^delam_law_respond: .*in the baseline .*const double\*"
changed 's/\(double value, const char \*name, void \*user\)/(void *user, double value)/' \
    "^delam_watch_callback: 'int32_t delam_watch_callback\(void\*, double\)'"
changed 's/ARGUMENT -1/ARGUMENT -2/' '^DELAM_ERROR_ARGUMENT: -2, in the baseline -1'
changed '/delam_law_watch\(/d' '^delam_law_watch: in the baseline, gone from the header'
changed 's/\(double value, /(float64_t value, /' "type 'float64_t' is none of the interface's types"
changed "${handle}typedef struct delam_point { double x; } dot;/" \
    'not a form that the header may have: typedef struct delam_point'
changed "${handle}enum delam_kind { delam_kind_one };/" 'not a form that the header may have: enum delam_kind'
changed 's/int64_t count, const double \*jump/long count, const double *jump/' \
    "type 'long' is none of the interface's types"
changed 's/int64_t count, const double \*jump/int64_t count, const double jump[2]/' "'const double jump\[2\]' needs a type"
changed 's/const delam_law \*law, int64_t/delam_law law, int64_t/' "type 'delam_law' is none of the interface's types"
changed 's/int64_t count, const double \*jump/MPI_Comm count, const double *jump/' \
    "type 'MPI_Comm' is none of the interface's types"
changed 's/^#define DELAM_ABI 1/&\n#define DELAM_TRY(call) (call)/' 'a macro with arguments: #define DELAM_TRY'
changed 's/^#define DELAM_ABI 1/&\n#define DELAM_BITS (1 << 3)/' 'no integer constant: #define DELAM_BITS'
changed '/delam_law_watch\(/s/;$//' 'not a form that the header may have: DELAM_API int32_t delam_law_watch'
if [[ $tier == all ]]; then
    planted unprotected
    edit unprotected delam/delam.h \
        's|^/\* Calls back|/* A sum.\n * [status -; thread any; since 0.2] */\nDELAM_API int64_t delam_sum(void);\n&|'
    printf 'delam_sum 0.2\n' >>"$work/unprotected/symbols.txt"
    refused '^delam_sum: listed, but not in the baseline' gate unprotected baseline
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
    local language edit_
    while IFS='|' read -r language edit_; do
        planted alone
        edit alone delam/delam.h "$edit_"
        refused "delam/delam.h: not $language for $([[ $language == c99 ]] && echo "$cc" || echo "$cxx")" \
            bash "$here/headers.sh" "$1" "$2" "$work/alone"
    done <<'BREAKS'
c99|s/^#define DELAM_ABI 1/&\nusing delam_real = double;/
c\+\+17|s/const char \*kind, delam_law \*\*out/const char *template, delam_law **out/
c99|/#include <stdint.h>/d
c99|s/^typedef struct delam_law delam_law;/&\n&/
BREAKS
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
