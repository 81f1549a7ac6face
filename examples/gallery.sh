#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash examples/gallery.sh [--all | --no-run] [NAME ...]: runs scenes (examples/run.sh), writes the page of each (delam
# view) and out/gallery/index.html, with a picture of each and a link to its page.
#   NAME       as for run.sh, with a size where a family has several (default: those that take seconds)
#   --all      all scenes, of the families the coarsest mesh: half an hour
#   --no-run   the results that are in out/ already, of these scenes or of any
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

quick=(enf 4enf mmb enf-3d dcb-3d dcb-abaqus dcb-alfano dcb-double fibre laminate-thermal enf-ductile-h1.0
    enf-brittle-local-h1.0 enf-brittle-energetic-h1.0 mmf-ductile-h1.0 mmf-brittle-energetic-h1.0)

# all: every scene once; of a family the size that run.sh lists first.
all() {
    local name families=" "
    for name in $(bash examples/run.sh --list); do
        if [[ $name != *-h[0-9]* ]]; then
            # Its sizes follow, where it has some.
            families+="$name "
            continue
        fi
        if [[ $families == *" ${name%-h*} "* ]]; then
            families=${families/" ${name%-h*} "/" $name "}
        fi
    done
    printf '%s\n' "$families"
}

run=yes
names=()
for word in "$@"; do
    case $word in
        --all) read -ra names <<<"$(all)" ;;
        --no-run) run=no ;;
        -h | --help)
            sed -n '3,/^set -/s/^# \{0,1\}//p' examples/gallery.sh
            exit 0
            ;;
        -*)
            printf 'unknown option "%s"; known are --all and --no-run\n' "$word" >&2
            exit 2
            ;;
        *) names+=("$word") ;;
    esac
done
if ((${#names[@]} == 0)); then
    names=("${quick[@]}")
    if [[ $run == no ]]; then
        names=()
        for folder in out/*/result.json; do
            names+=("$(basename "$(dirname "$folder")")")
        done
    fi
fi

if [[ $run == yes ]]; then
    # Exit code 1: steps did not converge, which the page says.
    bash examples/run.sh "${names[@]}" || (($? == 1))
fi
folders=()
for name in "${names[@]}"; do
    if [[ -f out/$name/result.json ]]; then
        build/release/bin/delam view "out/$name"
        folders+=("out/$name")
    else
        printf 'out/%s has no result; it is left out\n' "$name" >&2
    fi
done
/usr/bin/python3 examples/gallery.py out/gallery "${folders[@]}"
