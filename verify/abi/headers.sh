#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# headers.sh CC CXX FOLDER: every header of FOLDER/delam compiles alone as C99, C11 and C++17 without a warning. 77: no
# such compiler.
set -euo pipefail
cc=$1
cxx=$2
folder=$3
for compiler in "$cc" "$cxx"; do
    if ! command -v "$compiler" >/dev/null; then
        printf 'skipped: %s is not there\n' "$compiler"
        exit 77
    fi
done
strict=(-Wall -Wextra -Wpedantic -Werror -fsyntax-only -I "$folder")
status=0
for header in "$folder"/delam/*.h; do
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
exit $status
