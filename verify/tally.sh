# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# To be sourced by verify/run.sh: counts what passed, failed and was left out, and says so in the last lines.

passed=0
failed=0
failures=()
# Reason: number of tests, and their names.
declare -A left_out=()
declare -A left_out_names=()

# Reasons that begin so are no failure: Debian 12 has no Julia, a source archive no .git, another processor cannot run the
# kept programs, a run may have no time for its slice. verify/run.sh installs what all others need.
may_be_left_out=(
    "julia is not installed"
    "no git, or the sources are not a checkout"
    "no history of git"
    "the kept programs are of Linux on x86-64"
    "no time was left for a slice of the long tier"
)

# fail WHAT: counts a failure.
fail() {
    failed=$((failed + 1))
    failures+=("$1")
}

# leave_out NAME REASON: counts a test or a slice that was not run, as a failure unless the reason is known.
leave_out() {
    local start
    left_out[$2]=$((${left_out[$2]:-0} + 1))
    left_out_names[$2]+=" $1"
    for start in "${may_be_left_out[@]}"; do
        if [[ $2 == "$start"* ]]; then
            return
        fi
    done
    fail "$1, which is left out although this script installs what it needs: $2"
}

# check WHAT COMMAND...: one command that passes or fails.
check() {
    local what=$1
    shift
    printf '\n== %s\n' "$what"
    if "$@" </dev/null; then
        passed=$((passed + 1))
    else
        fail "$what"
    fi
}

# tests FOLDER OPTIONS...: ctest in a build folder; every test counts.
tests() {
    local folder=$1 report=$PWD/$1/ctest.xml outcome line status=0 before=$failed ran=0 bad=0
    shift
    rm -f "$report"
    printf '\n== ctest in %s %s\n' "$folder" "$*"
    ctest --test-dir "$folder" --output-on-failure --no-tests=error --output-junit "$report" "$@" </dev/null || status=$?
    if ! outcome=$(PYTHONUTF8=1 /usr/bin/python3 verify/junit.py "$report"); then
        fail "ctest in $folder $*: its outcome cannot be read"
        return
    fi
    while IFS= read -r line; do
        case $line in
            ran\ *)
                read -r _ ran bad <<<"$line"
                passed=$((passed + ran))
                ;;
            failed\ *) fail "${line#failed } (in $folder)" ;;
            left\ out\ *)
                line=${line#left out }
                leave_out "${line%%: *}" "${line#*: }"
                ;;
        esac
    done <<<"$outcome"
    # No test was found, or ctest itself failed.
    if ((status != 0 && failed == before)); then
        fail "ctest in $folder $* ends with $status"
    fi
}

# last_lines: what was left out and why, what failed, and the line "N passed, N failed". True if nothing failed.
last_lines() {
    local line
    printf '\n'
    for line in "${!left_out[@]}"; do
        printf '%d left out: %s (%s)\n' "${left_out[$line]}" "$line" "${left_out_names[$line]# }"
    done
    for line in "${failures[@]}"; do
        printf 'failed: %s\n' "$line"
    done
    printf '%d passed, %d failed\n' "$passed" "$failed"
    ((failed == 0))
}
