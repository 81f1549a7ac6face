#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash enf_host.sh ENF DELAM SCENE: the C host and the command line write the same history of the scene enf, byte for
# byte; the command line's has further columns behind.
set -euo pipefail
enf=$1
delam=$2
scene=$3

# One thread and one set of kernels for both: only then are equal bytes a claim about the hosts.
export OPENBLAS_NUM_THREADS=1
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

"$enf" "$folder/enf.csv"
"$delam" run "$scene" --out "$folder/out" >"$folder/delam.log" 2>&1 || {
    cat "$folder/delam.log"
    exit 1
}
rows=$(wc -l <"$folder/enf.csv")
if ((rows != 42)); then
    printf '%s wrote %d lines, expected a title and steps 0 to 40\n' "$enf" "$rows"
    exit 1
fi
columns=$(head -n 1 "$folder/enf.csv" | tr ',' '\n' | wc -l)
cut -d , -f "1-$columns" "$folder/out/history.csv" >"$folder/delam.csv"
if ! cmp "$folder/enf.csv" "$folder/delam.csv"; then
    diff "$folder/enf.csv" "$folder/delam.csv" | head -n 6
    exit 1
fi
printf '%d equal lines\n' "$rows"
