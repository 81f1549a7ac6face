#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash verify/fuzz/run.sh [SECONDS [FOLDER [TARGET...]]]: builds the library and the targets with clang, libFuzzer,
# AddressSanitizer and UBSan in FOLDER (build/fuzz), replays corpus and regressions, then fuzzes each target for SECONDS
# (600), starting from its corpus. What is found is kept in FOLDER/found/TARGET, new inputs in FOLDER/corpus/TARGET.
#   --limited    without AddressSanitizer, which needs more of both, and instead with a stack of 512 kB and an address
#                space of 3 GB; in build/fuzz_limited
#   --minimise   afterwards: the committed corpus becomes the smallest inputs that cover the same (libFuzzer -merge=1)
# Exit code 1 when a target fails, 77 when clang or its libFuzzer is missing.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(cd "$here/../.." && pwd)
minimise=no
sanitizers=address,undefined
default=$root/build/fuzz
while [[ ${1:-} == --* ]]; do
    case $1 in
    --minimise) minimise=yes ;;
    --limited)
        sanitizers=undefined
        default=$root/build/fuzz_limited
        ;;
    *)
        printf '%s: --minimise and --limited are known\n' "$1" >&2
        exit 2
        ;;
    esac
    shift
done
seconds=${1:-600}
folder=${2:-$default}
shift $(($# < 2 ? $# : 2))
targets=("$@")
if ((${#targets[@]} == 0)); then
    targets=(api_sequence scene mesh_inp saved_state mesh_arrays)
    if pkg-config --exists PETSc && command -v mpicxx >/dev/null; then
        targets+=(petsc_calls)
    fi
fi

probe='extern "C" int LLVMFuzzerTestOneInput(const char*, unsigned long) { return 0; }'
if ! command -v clang++ >/dev/null || ! printf '%s' "$probe" |
    clang++ -x c++ - -fsanitize=fuzzer,address -o /dev/null 2>/dev/null; then
    printf 'skipped: clang with libFuzzer is needed (Debian: clang)\n'
    exit 77
fi
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
flags="-O1 -g1 -D_GLIBCXX_ASSERTIONS -fsanitize-ignorelist=$here/third_party.txt"
cmake -S "$root" -B "$folder" -G Ninja -DCMAKE_C_COMPILER=clang -DCMAKE_CXX_COMPILER=clang++ -DCMAKE_BUILD_TYPE=None \
    -DCMAKE_C_FLAGS="-O1 -g" -DCMAKE_CXX_FLAGS="$flags" -DDELAM_SANITIZE=fuzzer-no-link,$sanitizers \
    -DDELAM_FUZZ=ON -DDELAM_UNITY=ON -DDELAM_BUILD_EXAMPLES=OFF >/dev/null
cmake --build "$folder" --target "${targets[@]/#/fuzz_}" -- -k 0
/usr/bin/python3 "$here/scene_dictionary.py" "$root/bindings/cli/SCENE.md" >"$folder/scene.dictionary"

# Allocations that are asked for and refused are a status, not the end.
export UBSAN_OPTIONS=print_stacktrace=1
export OPENBLAS_NUM_THREADS=1
# Open MPI as root, alone (verify/petsc/environment.txt).
export OMP_NUM_THREADS=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
# What a machine that is shared gave: seconds on the clock, and of the processor.
TIMEFORMAT='%R s, of the processor %U s and %S s for the system'
if [[ $sanitizers == undefined ]]; then
    ulimit -s 512
    ulimit -v 3000000
fi
failed=()
for target in "${targets[@]}"; do
    program=$(find "$folder" -name "fuzz_$target" -type f -perm -u+x | head -n 1)
    longest=400
    kept=45
    options=()
    if [[ $target == scene || $target == mesh_inp ]]; then
        longest=4000
        options=(-dict="$folder/scene.dictionary")
    elif [[ $target == api_sequence ]]; then
        kept=80
    elif [[ $target == saved_state ]]; then
        kept=20
    fi
    leaks=1
    if [[ $target == petsc_calls ]]; then
        leaks=0 # MPI and PETSc keep what they have until they end
    fi
    export ASAN_OPTIONS=allocator_may_return_null=1:max_allocation_size_mb=1024:detect_leaks=$leaks
    found=$folder/found/$target
    grown=$folder/corpus/$target
    committed=()
    for kind in corpus regressions; do
        if [[ -d $here/$kind/$target ]]; then
            committed+=("$here/$kind/$target")
        fi
    done
    mkdir -p "$found" "$grown"
    printf '\n== %s, %s s\n' "$target" "$seconds"
    # All of the committed inputs run first, also those that add nothing.
    if ! { mapfile -d '' -t inputs < <(find "${committed[@]}" -type f -print0) &&
        "$program" -timeout=60 -rss_limit_mb=3000 "${inputs[@]}" >"$folder/$target.replay" 2>&1 &&
        time "$program" -max_total_time="$seconds" -timeout=60 -rss_limit_mb=3000 -malloc_limit_mb=1500 -len_control=0 \
            -max_len=$longest -artifact_prefix="$found/" -print_final_stats=1 "${options[@]}" \
            "$grown" "${committed[@]}" >"$folder/$target.log" 2>&1; }; then
        failed+=("$target")
        tail -n 40 "$folder/$target.replay" "$folder/$target.log" 2>/dev/null || true
    fi
    grep -E 'cov: ' "$folder/$target.log" | tail -n 1 || true
    grep -E '^stat::number_of_executed_units|^stat::average_exec_per_sec' "$folder/$target.log" || true
    if [[ $minimise == yes ]]; then
        merged=$folder/merged/$target
        control=$folder/$target.control
        rm -rf "$merged" "$control"
        mkdir -p "$merged"
        "$program" -merge=1 -merge_control_file="$control" -timeout=60 -rss_limit_mb=3000 "$merged" "$grown" \
            "${committed[@]}" >"$folder/$target.merge" 2>&1
        /usr/bin/python3 "$here/choose.py" "$control" "$kept" >"$folder/$target.chosen"
        rm -rf "$merged"
        mkdir -p "$merged"
        xargs -d '\n' cp -t "$merged" <"$folder/$target.chosen"
        rm -rf "${here:?}/corpus/$target"
        mkdir -p "$here/corpus"
        mv "$merged" "$here/corpus/$target"
    fi
done
if ((${#failed[@]} > 0)); then
    printf '\nfailed: %s\n' "${failed[*]}"
    exit 1
fi
printf '\nall targets ran without a finding\n'
