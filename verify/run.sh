#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash verify/run.sh [--all]: installs, builds, runs the quick tier of the tests, then the unit tests, the light cases
# and the fuzzer's corpus under AddressSanitizer and UBSan, then judges the quick part of the verification report
# (out/report-quick, without pages).
#   --all   also the long tier, every check of UBSan, the whole report, the thread sanitizer, clang 14 without
#           warnings, valgrind on the unit tests and two cases
# bash verify/run.sh --report [--quick] [--only ID|CHAPTER ...] [--resume] [--accept] [--jobs N]: builds and writes the verification report
# into out/report (report/README.md) instead; exit code 1 if a case failed. --resume goes on with a report that was interrupted; exit code 2
# if that was another report.
# Ends with the line "N passed, N failed", after a line for each test that was skipped; exit code 0 only without failures.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
# shellcheck source=verify/packages.sh
source verify/packages.sh

all=no
report=no
case "${1:-}" in
    "") ;;
    --all) all=yes ;;
    --report)
        report=yes
        shift
        ;;
    *)
        printf 'usage: bash verify/run.sh [--all | --report [--quick] [--only ID|CHAPTER ...] [--resume] [--accept] [--jobs N]]\n' >&2
        exit 2
        ;;
esac

passed=0
failed=0
failures=()
skipped=()

# check WHAT COMMAND...: one command that passes or fails.
check() {
    local what=$1
    shift
    printf '\n== %s\n' "$what"
    if "$@"; then
        passed=$((passed + 1))
    else
        failed=$((failed + 1))
        failures+=("$what")
    fi
}

# tests PRESET OPTIONS...: ctest in the build folder of a preset; every test counts.
tests() {
    local folder=build/$1 report total=0 bad=0 left_out=()
    shift
    report=$PWD/$folder/ctest.xml
    rm -f "$report"
    printf '\n== ctest in %s %s\n' "$folder" "$*"
    ctest --test-dir "$folder" --output-on-failure --no-tests=error --output-junit "$report" "$@" || true
    if [[ -f $report ]]; then
        total=$(sed -n 's/^[[:space:]]*tests="\([0-9]*\)".*/\1/p' "$report" | head -n 1)
        bad=$(sed -n 's/^[[:space:]]*failures="\([0-9]*\)".*/\1/p' "$report" | head -n 1)
    fi
    if ((${total:-0} == 0)); then
        failed=$((failed + 1))
        failures+=("no tests ran in $folder")
        return
    fi
    mapfile -t left_out < <(sed -n 's/.*<testcase name="\([^"]*\)".*status="notrun".*/\1/p' "$report")
    skipped+=("${left_out[@]}")
    passed=$((passed + total - bad - ${#left_out[@]}))
    failed=$((failed + bad))
    if ((bad > 0)); then
        failures+=("$bad tests in $folder $*")
    fi
}

build() {
    local preset=$1
    shift
    cmake --preset "$preset" "$@" && cmake --build --preset "$preset"
}

# valgrind does not know AVX-512.
memory_checked() {
    OPENBLAS_CORETYPE=Haswell CK_FORK=no CK_DEFAULT_TIMEOUT=0 valgrind --quiet --error-exitcode=9 --leak-check=full \
        --errors-for-leak-kinds=definite "$1"
}

# BLAS with threads of its own is not instrumented: one thread each.
threads_checked() {
    OMP_THREAD_LIMIT=1 CK_FORK=no CK_DEFAULT_TIMEOUT=0 TSAN_OPTIONS="suppressions=$PWD/verify/faults/tsan.supp" "$@"
}

delam_install "${DELAM_PACKAGES[@]}" "${DELAM_MPI_PACKAGES[@]}" "${DELAM_PARSER_PACKAGES[@]}"
if [[ $all == yes ]]; then
    delam_install "${DELAM_LONG_PACKAGES[@]}" "${DELAM_SITE_PACKAGES[@]}"
fi
delam_blas
export OPENBLAS_NUM_THREADS=1

if [[ $report == yes ]]; then
    build release
    exec /usr/bin/python3 verify/report/make.py --build build/release --out out/report "$@"
fi

# A build from scratch compiles the files of a folder together, and a check then reads each by itself; with --all each is
# compiled by itself.
if [[ $all == yes ]]; then
    whole=(-DDELAM_UNITY=OFF)
    sanitizer=(-DDELAM_UNITY=ON -DDELAM_SANITIZE_LESS= -DDELAM_TEST_OBJECTS=)
else
    whole=(-DDELAM_UNITY=ON)
    # These checks more than double the time of the build; the other tier makes them. AddressSanitizer reports what null,
    # object-size and pointer-overflow would find when the access happens. The programs of the tests are those of the
    # release build, linked with the instrumented library.
    sanitizer=(-DDELAM_UNITY=ON -DDELAM_SANITIZE_LESS=alignment,null,object-size,vptr,pointer-overflow
        "-DDELAM_TEST_OBJECTS=$PWD/build/release")
fi
check "build release" build release -DDELAM_STATIC=ON "${whole[@]}"
if ((failed == 0)); then
    if [[ $all == yes ]]; then
        tests release -j2
    else
        tests release -j2 --label-exclude long
    fi
fi
if [[ $all == no && -f build/release/compile_commands.json ]]; then
    check "each file by itself" /usr/bin/python3 verify/style/alone.py build/release
fi
check "build with sanitizers" build asan -DDELAM_BUILD_CLI=OFF -DDELAM_BUILD_EXAMPLES=OFF "${sanitizer[@]}"
if [[ -f build/asan/verify/CTestTestfile.cmake ]]; then
    CK_FORK=no tests asan -j2 --label-regex '^sanitized$'
fi
if [[ -f build/release/lib/libdelam.so ]]; then
    if [[ $all == yes ]]; then
        check "report" /usr/bin/python3 verify/report/make.py --build build/release --out out/report
    else
        check "quick report" /usr/bin/python3 verify/report/make.py --build build/release --out out/report-quick --quick --no-pages
    fi
fi
if [[ $all == yes ]]; then
    check "build with the thread sanitizer" build tsan -DDELAM_BUILD_CLI=OFF -DDELAM_BUILD_EXAMPLES=OFF
    check "thread sanitizer, 8 islands" threads_checked build/tsan/verify/fault_threads 4
    check "thread sanitizer, the library's own threads" threads_checked build/tsan/verify/case_test_host_march
    check "thread sanitizer, cancel from another thread" threads_checked build/tsan/verify/case_test_threads_host
    check "clang without warnings" build clang
    for program in build/release/verify/unit_test_* build/release/verify/case_test_{capi,single_pair}; do
        # test_choose counts what is allocated, which valgrind takes out of its hands.
        if [[ -x $program && -f $program && $program != *test_long_* && $program != *test_choose ]]; then
            check "valgrind $(basename "$program")" memory_checked "$program"
        fi
    done
fi

printf '\n'
for test in "${skipped[@]}"; do
    printf 'skipped: %s\n' "$test"
done
for failure in "${failures[@]}"; do
    printf 'failed: %s\n' "$failure"
done
printf '%d passed, %d failed\n' "$passed" "$failed"
((failed == 0))
