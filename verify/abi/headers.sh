#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# headers.sh CC CXX FOLDER [mpi]: every header of FOLDER/delam compiles alone as C99, C11 and C++17 without a warning. Those
# that include mpi.h are left out; `mpi`: these alone, with the folders that mpicc names. 77: no such compiler.
set -euo pipefail
cc=$1
cxx=$2
folder=$3
mpi=${4:-}
for compiler in "$cc" "$cxx" ${mpi:+mpicc}; do
    if ! command -v "$compiler" >/dev/null; then
        printf 'skipped: %s is not there\n' "$compiler"
        exit 77
    fi
done
strict=(-Wall -Wextra -Wpedantic -Werror -fsyntax-only -I "$folder")
if [[ $mpi == mpi ]]; then
    mapfile -t places < <(mpicc -show | grep -oE -- '(^| )-I *[^ ]+' | sed -E 's/^ ?-I *//')
    for place in "${places[@]}"; do
        strict+=(-isystem "$place")
    done
fi
status=0
count=0
for header in "$folder"/delam/*.h; do
    includes=
    if grep -q '^#include <mpi\.h>' "$header"; then
        includes=mpi
    fi
    [[ $includes == "$mpi" ]] || continue
    count=$((count + 1))
    name=delam/$(basename "$header")
    for standard in c99 c11; do
        if ! printf '#include <%s>\n' "$name" | "$cc" -x c -std=$standard "${strict[@]}" -Wstrict-prototypes -; then
            printf '%s: not %s for %s\n' "$name" "$standard" "$cc"
            status=1
        fi
    done
    if ! printf '#include <%s>\n' "$name" | "$cxx" -x c++ -std=c++17 "${strict[@]}" -; then
        printf '%s: not c++17 for %s\n' "$name" "$cxx"
        status=1
    fi
done
((count > 0)) || status=1
printf '%d headers\n' "$count"
exit $status
