#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash examples/run.sh [NAME ...]: installs, builds, and runs scenes examples/NAME/NAME.toml (enf) into out/NAME/, with pictures.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=verify/packages.sh
source verify/packages.sh

known=()
for scene in examples/*/; do
    name=$(basename "$scene")
    if [[ -f $scene$name.toml ]]; then
        known+=("$name")
    fi
done
names=("$@")
if ((${#names[@]} == 0)); then
    names=(enf)
fi
for name in "${names[@]}"; do
    if [[ " ${known[*]} " != *" $name "* ]]; then
        printf 'unknown scene "%s"; known are: %s\n' "$name" "${known[*]}" >&2
        exit 2
    fi
done

delam_install "${DELAM_PACKAGES[@]}"
delam_blas
cmake --preset release
cmake --build --preset release --target delam_cli
for name in "${names[@]}"; do
    printf '\n== %s\n' "$name"
    build/release/bin/delam run "examples/$name/$name.toml" --out "out/$name"
    /usr/bin/python3 bindings/cli/plot/plot.py "out/$name"
    printf 'results: out/%s\n' "$name"
done
