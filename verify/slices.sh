# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# To be sourced by verify/run.sh: the long tier, cut into slices of at most ten minutes on two idle cores, of which each
# run of .ci/run takes one.

slices=17
# Tests of ctest, as a regular expression; each test with the label `long` is in one slice (the test style/slices).
declare -A slice_tests=(
    [1]='^(cli_long_(studies|study_input|many|intervals)|(unit|case)/test_long_.*|case/whole_.*)$'
    [2]='^(cli_(long_(view_browser|coupons|examples|generators)|paraview)|(fortran|cpp|site|python|julia|report)/.*)$'
    [3]='^(ranks/long_faults.*|petsc/.*|example/host_abaqus_memory|packaging/.*)$'
    [4]='^ranks/long_scenes_[1-6]$'
    [5]='^fault/files.*$'
    [6]='^ranks/long_loose.*$'
    [7]='^ranks/long_scenes_whole.*$'
    [8]='^(abi/long_.*)$'
    [9]='^(contact|mesh_error|load_path)/long_.*$'
    [10]='^fault/(long|cancel|memory).*$'
    [12]='^valgrind/unit_test_[a-h].*$'
    [13]='^valgrind/unit_test_[i-l].*$'
    [14]='^valgrind/(unit_test_[m-z]|case_).*$'
    [15]='^constants/.*$'
    [16]='^features/.*$'
    [17]='^fuzz/.*$'
)
# Stages of verify/stages.sh, with their arguments, separated by semicolons.
declare -A slice_stages=(
    [8]='thread_sanitizer; each_file_alone'
    [11]='sanitized_whole'
    [12]='clang'
)
# A run of .ci/run that has taken so long, in s, leaves its slice out: a slice takes up to ten minutes on two idle cores
# and twenty on busy ones, and hosts end a run after 90 minutes. Half of it would leave slices out wherever the quick tier
# meets another program; with twice of it no slice could end.
latest_slice=3000

list_slices() {
    local k
    for ((k = 1; k <= slices; ++k)); do
        printf '%d: %s%s%s\n' "$k" "${slice_stages[$k]:-}" "${slice_stages[$k]:+ ${slice_tests[$k]:+ and }}" \
            "${slice_tests[$k]:+tests ${slice_tests[$k]}}"
    done
}

# run_slice K: installs, and runs stages and tests of a slice; notes the outcome in the record.
run_slice() {
    local k=$1 before=$failed start=$SECONDS stage stages words
    printf '\n== slice %d of %d of the long tier\n' "$k" "$slices"
    read -ra words <<<"${DELAM_SLICE_PACKAGES[$k]:-}"
    if ! delam_install "${words[@]}"; then
        fail "slice $k: packages are missing"
        return
    fi
    IFS=';' read -ra stages <<<"${slice_stages[$k]:-}"
    for stage in "${stages[@]}"; do
        read -ra words <<<"$stage"
        "${words[@]}"
    done
    if [[ -n ${slice_tests[$k]:-} ]]; then
        tests build/release -j2 --label-regex '^long$' --tests-regex "${slice_tests[$k]}"
    fi
    note_slice "$k" "$( ((failed == before)) && printf passed || printf failed)"
    printf 'slice %d took %d s\n' "$k" $((SECONDS - start))
}

# run_next_slice BEGAN: runs the slice whose turn it is, unless it is late: then the run says so, and fails if the run
# before it has left its slice out, too. BEGAN: seconds since 1970 at the beginning of the run.
run_next_slice() {
    local k late=$(($(date +%s) - $1))
    k=$(next_slice)
    if ((late <= latest_slice)); then
        run_slice "$k"
        return
    fi
    leave_out "slice $k" "no time was left for a slice of the long tier: $late s had passed, of at most $latest_slice"
    if left_out_last_time; then
        fail "slice $k: the run before has left out a slice of the long tier as well"
    elif [[ -z $(slice_record) ]]; then
        printf 'nobody keeps a record of slices here: a second time in a row would not be noticed\n'
    fi
    note_slice "$k" left-out
}

# slice_record: prints the file in which runs note when each slice passed; nothing where nobody keeps one (DELAM_KEPT).
slice_record() {
    local record=${DELAM_KEPT:-}/slices
    if [[ -n ${DELAM_KEPT:-} && (-w $record || (! -e $record && -w $DELAM_KEPT)) ]]; then
        printf '%s\n' "$record"
    fi
}

# commits: the number of commits; where the history is not whole, the day of the year.
commits() {
    if [[ $(git rev-parse --is-shallow-repository 2>/dev/null) == false ]]; then
        git rev-list --count HEAD
    else
        date +%-j
    fi
}

# next_slice: prints the slice whose last pass is oldest; with an empty record, or none, one by the number of commits, so
# that each comes by.
next_slice() {
    local record k
    record=$(slice_record)
    if [[ ! -s $record ]]; then
        printf '%d\n' $(($(commits) % slices + 1))
        return
    fi
    for ((k = 1; k <= slices; ++k)); do
        printf '%d %d\n' "$(awk -v k="$k" '$1 == k && $2 == "passed" { last = $3 } END { print last + 0 }' "$record")" "$k"
    done | sort -k1n -k2n | sed -n '1s/.* //p'
}

# note_slice K OUTCOME: passed, failed or left-out, with the time and the commit, in the record.
note_slice() {
    local record
    record=$(slice_record)
    if [[ -n $record ]]; then
        printf '%d %s %d %s\n' "$1" "$2" "$(date +%s)" "$(git rev-parse --short=12 HEAD 2>/dev/null || printf unknown)" \
            >>"$record"
    fi
}

# left_out_last_time: true if the last line of the record says so.
left_out_last_time() {
    local record
    record=$(slice_record)
    [[ -n $record && -f $record && $(tail -n 1 "$record") == *" left-out "* ]]
}
