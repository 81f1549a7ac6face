#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash verify/run.sh [--with-slice | --all]: installs, builds, runs the quick tier of the tests, then the unit tests, the
# light cases and the fuzzer's corpus under AddressSanitizer and UBSan, then judges the quick part of the verification
# report (out/report-quick, without pages).
#   --with-slice   also one slice of the long tier: the one whose last pass is oldest (verify/slices.sh)
#   --all          also all slices
# bash verify/run.sh --slice K: builds and runs slice K of the long tier alone; --slices lists them.
# bash verify/run.sh --report [--quick] [--only ID|CHAPTER ...] [--resume] [--accept] [--jobs N]: builds and writes the
# verification report into out/report (report/README.md) instead; exit code 1 if a case failed. --resume goes on with a
# report that was interrupted; exit code 2 if that was another report.
# Ends with a line for each reason for which tests were left out, a line for each failure, and "N passed, N failed"; exit
# code 0 only without failures. What this script installs and a test still misses is a failure.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=verify/packages.sh
source verify/packages.sh
# shellcheck source=verify/tally.sh
source verify/tally.sh
# shellcheck source=verify/stages.sh
source verify/stages.sh
# shellcheck source=verify/slices.sh
source verify/slices.sh

usage() {
    sed -n '3,/^set -/s/^# \{0,1\}//p' verify/run.sh >&2
    exit 2
}

began=${DELAM_BEGAN:-$(date +%s)}
quick=yes
chosen=()
case "${1:-} $#" in
    " 0") ;;
    "--all 1") mapfile -t chosen < <(seq 1 "$slices") ;;
    "--with-slice 1") chosen=(next) ;;
    "--slice 2")
        quick=no
        if [[ ! $2 =~ ^[0-9]+$ ]] || (($2 < 1 || $2 > slices)); then
            printf 'slice %s: 1 to %d are known\n' "$2" "$slices" >&2
            exit 2
        fi
        chosen=("$2")
        ;;
    "--slices 1")
        list_slices
        exit 0
        ;;
    "--report "*) quick=no ;;
    *) usage ;;
esac

delam_install "${DELAM_PACKAGES[@]}" "${DELAM_TEST_PACKAGES[@]}"
delam_blas
export OPENBLAS_NUM_THREADS=1

if [[ ${1:-} == --report ]]; then
    shift
    build_release
    exec /usr/bin/python3 verify/report/make.py --build build/release --out out/report "$@"
fi

check "build release" build_release
built=$( ((failed == 0)) && printf yes || printf no)
if [[ $built == yes && $quick == yes ]]; then
    # One more than there are cores: some tests wait, for times of files or for other processes.
    tests build/release "-j$(($(nproc) + 1))" --label-exclude long
    sanitized
    quick_report
fi
if [[ $built == yes ]]; then
    for k in "${chosen[@]}"; do
        if [[ $k == next ]]; then
            run_next_slice "$began"
        else
            run_slice "$k"
        fi
    done
fi
last_lines
