#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash examples/run.sh [--list | --dry-run] [NAME ...]: installs, builds, and runs scenes into out/NAME/, with pictures.
#   NAME        examples/NAME/NAME.toml as it is (default: enf),
#   FAMILY-hH   examples/FAMILY/FAMILY.toml with cells of H mm,
#   FAMILY      all of its cell sizes, and pictures that compare them in out/FAMILY/
#   --list      the names, nothing is run
#   --dry-run   the commands, nothing is run
# Exit code 1: all was computed, but some steps did not converge.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=verify/packages.sh
source verify/packages.sh

# Cell sizes of each family, mm.
meshes="1.0 0.75 0.5 0.25 0.1"
declare -A sizes=(
    [enf-ductile]=$meshes
    [enf-brittle-local]=$meshes
    [enf-brittle-energetic]=$meshes
    [enf-modified]="0.1"
    [mmf-ductile]=$meshes
    [mmf-ductile-640]=$meshes
    [mmf-ductile-converged]=$meshes
    [mmf-brittle-energetic]=$meshes
)

# names: all that can be asked for, one a line.
names() {
    local scene family h
    for scene in examples/*/; do
        family=$(basename "$scene")
        if [[ ! -f $scene$family.toml ]]; then
            continue
        fi
        printf '%s\n' "$family"
        for h in ${sizes[$family]:-}; do
            printf '%s-h%s\n' "$family" "$h"
        done
    done
}

# The same for people, a line for each scene; the braces are the shell's.
listing() {
    local scene family
    for scene in examples/*/; do
        family=$(basename "$scene")
        if [[ ${sizes[$family]:-} == *" "* ]]; then
            printf '    %s, %s-h{%s}\n' "$family" "$family" "${sizes[$family]// /,}"
        elif [[ -n ${sizes[$family]:-} ]]; then
            printf '    %s, %s-h%s\n' "$family" "$family" "${sizes[$family]}"
        elif [[ -f $scene$family.toml ]]; then
            printf '    %s\n' "$family"
        fi
    done
}

not_converged=no
dry=no

# step COMMAND...: runs it, or prints it.
step() {
    local status=0
    if [[ $dry == yes ]]; then
        printf '%s\n' "$*"
        return
    fi
    "$@" || status=$?
    # The result is whole; what did not converge is marked in it.
    if [[ $status == 1 && $1 == */delam ]]; then
        not_converged=yes
    elif ((status != 0)); then
        exit "$status"
    fi
}

# scene NAME FAMILY [OPTION...]: one result and its pictures.
scene() {
    local name=$1 family=$2
    shift 2
    printf '\n== %s\n' "$name"
    step build/release/bin/delam run "examples/$family/$family.toml" --out "out/$name" "$@"
    step /usr/bin/python3 bindings/cli/plot/plot.py "out/$name"
    printf 'results: out/%s\n' "$name"
}

sized() {
    scene "$1-h$2" "$1" --set "geometry.h=$2e-3"
}

# run NAME: a known one.
run() {
    local name=$1 family h folders=()
    if [[ -n ${sizes[$name]:-} ]]; then
        for h in ${sizes[$name]}; do
            sized "$name" "$h"
            folders+=("out/$name-h$h")
        done
        if ((${#folders[@]} == 1)); then
            return
        fi
        step /usr/bin/python3 bindings/cli/plot/plot_family.py --out "out/$name" "${folders[@]}"
        printf 'results: out/%s\n' "$name"
        return
    fi
    family=${name%-h*}
    if [[ $family != "$name" && -n ${sizes[$family]:-} ]]; then
        sized "$family" "${name##*-h}"
    else
        scene "$name" "$name"
    fi
}

wanted=()
for word in "$@"; do
    case $word in
        --list)
            names
            exit 0
            ;;
        --dry-run) dry=yes ;;
        -*)
            printf 'unknown option "%s"; known are --list and --dry-run\n' "$word" >&2
            exit 2
            ;;
        *) wanted+=("$word") ;;
    esac
done
if ((${#wanted[@]} == 0)); then
    wanted=(enf)
fi
mapfile -t known < <(names)
for name in "${wanted[@]}"; do
    if [[ " ${known[*]} " != *" $name "* ]]; then
        printf 'unknown scene "%s"; known are\n%s\n' "$name" "$(listing)" >&2
        exit 2
    fi
done

if [[ $dry == no ]]; then
    delam_install "${DELAM_PACKAGES[@]}"
    delam_blas
    cmake --preset release
    cmake --build --preset release --target delam_cli
fi
for name in "${wanted[@]}"; do
    run "$name"
done
if [[ $not_converged == yes ]]; then
    exit 1
fi
