# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# To be sourced by verify/run.sh: counts what passed, failed and was left out, and says so in the last lines.

passed=0
failed=0
failures=()
# Reason: number of tests, and their names.
declare -A left_out=()
declare -A left_out_names=()

# What may be left out, as the beginning of a reason: what Debian 12 does not have, and what a source archive lacks. All
# else has its packages installed by verify/run.sh, so that its absence is a failure.
may_be_left_out=(
    "julia is not installed"
    "no git, or the sources are not a checkout"
    "no .git"
)

# leave_out NAME REASON: counts a test, or a stage, that was not run.
leave_out() {
    left_out[$2]=$((${left_out[$2]:-0} + 1))
    left_out_names[$2]+=" $1"
}

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

# tests FOLDER OPTIONS...: ctest in a build folder; every test counts.
tests() {
    local folder=$1 report=$PWD/$1/ctest.xml line
    shift
    rm -f "$report"
    printf '\n== ctest in %s %s\n' "$folder" "$*"
    ctest --test-dir "$folder" --output-on-failure --no-tests=error --output-junit "$report" "$@" || true
    if [[ ! -f $report ]]; then
        failed=$((failed + 1))
        failures+=("no tests ran in $folder $*")
        return
    fi
    while IFS= read -r line; do
        case $line in
            ran\ *)
                read -r _ ran bad <<<"$line"
                passed=$((passed + ran))
                failed=$((failed + bad))
                ;;
            failed\ *) failures+=("${line#failed } (in $folder)") ;;
            left\ out\ *)
                line=${line#left out }
                leave_out "${line%%: *}" "${line#*: }"
                ;;
        esac
    done < <(/usr/bin/python3 verify/junit.py "$report")
}

# last_lines: what was left out and why, what failed, and the line "N passed, N failed". True if nothing failed.
last_lines() {
    local reason start allowed
    printf '\n'
    for reason in "${!left_out[@]}"; do
        allowed=no
        for start in "${may_be_left_out[@]}"; do
            if [[ $reason == "$start"* ]]; then
                allowed=yes
            fi
        done
        printf '%d left out: %s (%s)\n' "${left_out[$reason]}" "$reason" "${left_out_names[$reason]# }"
        if [[ $allowed == no ]]; then
            failed=$((failed + left_out[$reason]))
            failures+=("${left_out[$reason]} left out although this script installs what they need: $reason")
        fi
    done
    for reason in "${failures[@]}"; do
        printf 'failed: %s\n' "$reason"
    done
    printf '%d passed, %d failed\n' "$passed" "$failed"
    ((failed == 0))
}
