#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash examples/run.sh [--list | --dry-run] [NAME [OPTION ...] ...]: installs, builds, and runs scenes into out/NAME/,
# with pictures.
#   NAME        examples/NAME/NAME.toml (or NAME.inp, a deck of Abaqus) as it is (default: enf),
#   FAMILY-hH   examples/FAMILY/FAMILY.toml with cells of H mm,
#   FAMILY      all of its cell sizes, and pictures that compare them in out/FAMILY/
#   --list      the names, nothing is run
#   --dry-run   the commands, nothing is run
# An OPTION belongs to the name before it:
#   --set KEY=VALUE  a value instead of the scene file's, may be repeated
#   --out FOLDER     instead of out/NAME/, for a scene of one size; a relative one is in the folder of the call
#   --resume         go on after an interruption
# Exit code 1: all was computed, but some steps did not converge.
set -euo pipefail
from=$PWD
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

# file_of NAME: its scene, or its deck; nothing where the folder has neither.
file_of() {
    local file
    for file in "examples/$1/$1.toml" "examples/$1/$1.inp"; do
        if [[ -f $file ]]; then
            printf '%s\n' "$file"
            return
        fi
    done
}

# needs_gmsh NAME: true if its scene reads a mesh of Gmsh or has it make a cell.
needs_gmsh() {
    local file
    file=$(file_of "$1")
    grep -qE '^generator *=|^file *=.*\.msh"' "${file:-$(file_of "${1%-h*}")}"
}

# names: all that can be asked for, one a line.
names() {
    local scene family h
    for scene in examples/*/; do
        family=$(basename "$scene")
        if [[ -z $(file_of "$family") ]]; then
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
        elif [[ -n $(file_of "$family") ]]; then
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
        printf '%q' "$1"
        printf ' %q' "${@:2}"
        printf '\n'
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

# scene NAME FAMILY FOLDER [OPTION...]: one result and its pictures.
scene() {
    local name=$1 family=$2 folder=$3
    shift 3
    printf '\n== %s\n' "$name"
    step build/release/bin/delam run "$(file_of "$family")" --out "$folder" "$@"
    step /usr/bin/python3 bindings/cli/plot/plot.py "$folder"
    printf 'results: %s\n' "$folder"
}

# sized FAMILY SIZE FOLDER [OPTION...]
sized() {
    scene "$1-h$2" "$1" "$3" --set "geometry.h=$2e-3" "${@:4}"
}

# run NAME FOLDER [OPTION...]: a known name; without a folder (empty) the usual one.
run() {
    local name=$1 folder=$2 family h folders=()
    shift 2
    if [[ -n ${sizes[$name]:-} ]]; then
        for h in ${sizes[$name]}; do
            folders+=("${folder:-out/$name-h$h}")
            sized "$name" "$h" "${folders[-1]}" "$@"
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
        sized "$family" "${name##*-h}" "${folder:-out/$name}" "$@"
    else
        scene "$name" "$name" "${folder:-out/$name}" "$@"
    fi
}

# The options of wanted[i] are options[first[i]] to options[first[i + 1] - 1], and its folder is folders_of[i].
wanted=()
first=()
options=()
folders_of=()
# belongs OPTION: there is a name before it.
belongs() {
    if ((${#wanted[@]} == 0)); then
        printf '%s belongs to a scene: put it after the name of one\n' "$1" >&2
        exit 2
    fi
}
while (($# > 0)); do
    word=$1
    shift
    case $word in
        --list)
            names
            exit 0
            ;;
        --dry-run) dry=yes ;;
        -h | --help)
            sed -n '3,/^set -/s/^# \{0,1\}//p' examples/run.sh
            exit 0
            ;;
        --set | --out)
            belongs "$word"
            if (($# == 0)) || [[ -z $1 || $1 == -* ]]; then
                printf '%s needs a value\n' "$word" >&2
                exit 2
            fi
            if [[ $word == --set && $1 != ?*=* ]]; then
                printf -- '--set %s: KEY=VALUE is expected\n' "$1" >&2
                exit 2
            elif [[ $word == --set ]]; then
                options+=(--set "$1")
            elif [[ ${sizes[${wanted[-1]}]:-} == *" "* ]]; then
                printf '%s has several sizes, each with a folder of its own: --out cannot be used\n' "${wanted[-1]}" >&2
                exit 2
            else
                folder=$1
                if [[ $folder != /* ]]; then
                    folder=$from/$folder
                fi
                if [[ " ${folders_of[*]} " == *" $folder "* ]]; then
                    printf '%s is the folder of two scenes\n' "$1" >&2
                    exit 2
                fi
                folders_of[-1]=$folder
            fi
            shift
            ;;
        --resume)
            belongs "$word"
            options+=(--resume)
            ;;
        -*)
            printf 'unknown option "%s"; known are --list and --dry-run, after a name --set, --out and --resume\n' \
                "$word" >&2
            exit 2
            ;;
        *)
            first+=(${#options[@]})
            wanted+=("$word")
            folders_of+=("")
            ;;
    esac
done
if ((${#wanted[@]} == 0)); then
    wanted=(enf)
    first=(0)
    folders_of=("")
fi
first+=(${#options[@]})
mapfile -t known < <(names)
for name in "${wanted[@]}"; do
    if [[ " ${known[*]} " != *" $name "* ]]; then
        printf 'unknown scene "%s"; known are\n%s\n' "$name" "$(listing)" >&2
        exit 2
    fi
done

if [[ $dry == no ]]; then
    packages=("${DELAM_PACKAGES[@]}")
    for name in "${wanted[@]}"; do
        if needs_gmsh "$name"; then
            packages+=("${DELAM_GMSH_PACKAGES[@]}")
            break
        fi
    done
    delam_install "${packages[@]}"
    delam_blas
    # A first build leaves out the tests, which take packages of their own; a folder that was configured keeps its
    # settings.
    if grep -qs '^DELAM_BUILD_TESTS:' build/release/CMakeCache.txt; then
        cmake --preset release
    else
        cmake --preset release -DDELAM_BUILD_TESTS=OFF
    fi
    cmake --build --preset release --target delam_cli
fi
for i in "${!wanted[@]}"; do
    run "${wanted[i]}" "${folders_of[i]}" "${options[@]:first[i]:first[i + 1] - first[i]}"
done
if [[ $not_converged == yes ]]; then
    exit 1
fi
