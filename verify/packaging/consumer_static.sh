#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Hosts linked with the installed archive, by CMake and by pkg-config, the linker being that of C: they run without
# libdelam.so, their errors come as statuses, and names of theirs may be those of the library's inside. Hosts in C++ and
# Fortran with the word "whole" alone (the long tier).
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
has static || skip "DELAM_STATIC is OFF"
project=$SOURCE/verify/packaging/consumer_static
enf=$SOURCE/examples/enf

# alone PROGRAM: it does not load the library.
alone() {
    if ldd "$1" | grep libdelam; then
        fail "$1 needs the shared library"
    fi
}

quietly "$CMAKE" -S "$project" -B "$work/consumer" -DCMAKE_PREFIX_PATH="$STAGE" -DCMAKE_C_COMPILER="$CC" \
    -DEXAMPLES="$enf" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
quietly "$CMAKE" --build "$work/consumer"
alone "$work/consumer/enf_c"
same_numbers "$work/consumer/enf_c"
alone "$work/consumer/refused"
"$work/consumer/refused"

PKG_CONFIG_PATH=$(dirname "$(find "$STAGE" -name delam.pc)")
export PKG_CONFIG_PATH
read -ra flags <<<"$(pkg-config --static --cflags delam)"
read -ra links <<<"$(pkg-config --static --libs delam)"
printf 'pkg-config --static: %s\n' "${links[*]//$STAGE/PREFIX}"
# Some compilers tell the linker --as-needed by themselves; others do not.
links=(-Wl,--no-as-needed "${links[@]}")
if pkg-config --libs delam | grep -E 'cholmod|metis|blas|stdc|\.a( |$)'; then
    fail "hosts of the shared library are told of what is inside"
fi
cd "$work" || exit
quietly "$CC" -std=c99 "${flags[@]}" "$enf/enf.c" -o enf_c "${links[@]}"
alone ./enf_c
same_numbers ./enf_c
if [[ ${1:-} == whole ]] && has cpp; then
    quietly "$CXX" -std=c++17 "${flags[@]}" "$enf/enf.cpp" -o enf_cpp "${links[@]}"
    alone ./enf_cpp
    same_numbers ./enf_cpp
fi
if [[ ${1:-} == whole && -n ${FC:-} ]]; then
    read -ra modules <<<"$(pkg-config --variable=fortransources delam)"
    quietly "$FC" "${modules[@]}" "$enf/enf.f90" -o enf_fortran "${links[@]}"
    alone ./enf_fortran
    same_numbers ./enf_fortran
fi

# A host with functions of its own under every name of the C++ inside; whoever calls one of them is at an end.
nm --defined-only "$BUILD/libdelam_core.a" | awk '$2 ~ /^[A-Zu]$/ && $3 ~ /5delam/ {print $3}' | sort -u >names
count=$(wc -l <names)
((count > 500)) || fail "only $count names inside were found"
awk 'BEGIN {print "#include <stdlib.h>"}
    {printf "void host_%d(void) __asm__(\"%s\");\nvoid host_%d(void) { abort(); }\n", NR, $1, NR}' names >names.c
quietly "$CC" -c names.c -o names.o
if ld -r names.o --whole-archive "$BUILD/libdelam_core.a" -o both.o 2>"$work/log"; then
    fail "the names of the host are not those of the objects: nothing is tested"
fi
grep -q 'multiple definition' "$work/log" || fail "no word of names defined twice: $(head -3 "$work/log")"
for source in "$enf/enf.c" "$project/refused.c"; do
    program=./$(basename "$source" .c)_names
    quietly "$CC" -std=c99 "${flags[@]}" "$source" names.o -o "$program" "${links[@]}"
    alone "$program"
done
same_numbers ./enf_names
./refused_names
printf '%d names of the inside taken by the host\n' "$count"
[[ ${1:-} != whole || -n ${FC:-} ]] || skip "the host in Fortran was left out: no Fortran compiler was found; the others ran"
