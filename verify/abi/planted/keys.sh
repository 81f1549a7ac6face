# SPDX-License-Identifier: BSD-3-Clause
# Breaks of keys, sentences and statuses; ../test_planted.sh sources this.
# shellcheck shell=bash disable=SC2154
# ---- keys ----
keys() { "$python" "$here/keys.py" "$@"; }
lying() { "$python" "$here/planted/lying.py" "$@" -- "$library" "$root/include/delam/delam.h" "${more[@]}"; }
more=()
accepted lying
refused '^option memory_limit: in the baseline, gone' lying fewer option_count
if [[ $tier == all ]]; then
    refused '^option contact_limit: type real, in the baseline integer' \
        lying turn option_info key contact_limit type 'real'
    refused "^option damage_tolerance: range '0 <= value < 0.1' does not allow all of '0 <= value < 1'" \
        lying turn option_info key damage_tolerance range '0 <= value < 0.1'
    accepted lying turn option_info key damage_tolerance range '0 <= value <= 1'
    refused "^option contact: range 'auto' does not allow" lying turn option_info key contact range 'auto'
    accepted lying turn option_info key contact range 'auto | always | never'
    refused "^option threads: default '2', in the baseline '1': run .*update.sh, and name it" \
        lying turn option_info key threads initial '2'
    more=(--new-defaults)
    accepted lying turn option_info key threads initial '2'
    refused "^law griffith gradient: default '', .*: it must be given now" \
        lying turn law_parameter_info key gradient initial ''
    more=()
    refused '^law trapezoidal normal_stiffness: unit F/L2, in the baseline F/L3' \
        lying turn law_parameter_info key normal_stiffness unit 'F/L2'
    refused "^law trapezoidal plateau: in the baseline, gone" lying turn law_parameter_info key plateau key 'level'
    refused '^cell hex8: shape \[9\]\[3\], in the baseline \[8\]\[3\]' lying turn cell_type_info name hex8 nodes 9
    refused '^cell hex8: number 3, by the header 4' lying turn cell_type_info name hex8 cell_type 3
    refused '^value reaction:NAME: in the header, delam_solver_value_name does not give it' lying fewer solver_value_count
    refused '^value crack_length: is not recorded any more' lying refuse solver_record crack_length 2
    refused '^value crack_length: is not recorded any more' lying refuse solver_record crack_length 3
    refused '^value dissipated: is -?nan in 2D' lying turn solver_value key dissipated value nan
    refused '^field stress: shape None, by the header' lying refuse solver_field_shape stress 2 3
fi

# table SED MESSAGE: another table in the header.
table() {
    wanted table || return 0
    rm -rf "$work/table"
    mkdir "$work/table"
    cp "$root/include/delam/delam.h" "$here/baseline/keys.txt" "$work/table"
    edit table delam.h "$1"
    refused "$2" keys "$library" "$work/table/delam.h"
}
table '/^ \*   released  /d' '^value released: in the baseline, gone'
table '/^ \*   released  /d' '^value released: delam_solver_value_name gives it, the table'
table 's/^( \*   rotation_max +)rad/\1-  /' '^value rotation_max: unit 1, in the baseline rad'
table 's/^( \*   stress +)\[cells\]\[4 or 6\]/\1[cells][6]/' '^field stress: shape \[cells\]\[6\], in the baseline'
table '/^ \*   traction +\[pairs\]/d' '^field traction: in the baseline, gone'
table 's/^( \*   energy_release_rate +)F\/L /\1F   /' \
    "^value energy_release_rate:I: is .*: not the unit 'F' of the header"
table 's/^( \*   jump +\[pairs\]\[dimension\] +)L /\1F /' "^field jump: is .*: not the unit 'F' of the header"
table 's/"mean-dilatation"/"mean-pressure"/' "^text delam_problem_set_formulation: range .* does not allow all of"
table 's/"mean-dilatation"/"mean-pressure"/' \
    "^text delam_problem_set_formulation: 'mean-pressure' of the header is refused"
if [[ $tier == all ]]; then
    # New keys are free.
    sed -i '/^option contact;/d; /^value released;/d' "$work/table/keys.txt"
    more=(--baseline "$work/table/keys.txt")
    accepted lying
fi

# ---- sentences about order, and statuses that are listed ----
# real FILE EXPRESSION: copies of the real headers, one of them changed.
real() {
    rm -rf "$work/real"
    cp -r "$root/include" "$work/real"
    edit real "delam/$1" "$2"
}
sentences() { "$python" "$here/sentences.py" "$@"; }
real delam.h 's/^(\/\* Returns the product version), /\1 only once, /'
refused "^delam_version: 'Returns the product version only once.*neither a row nor another test" \
    sentences "$work/real/delam/delam.h"
real delam.h 's/null none; status argument; since 0.1\] \*\/$/null none; status argument, file; since 0.1] *\//'
refused '^delam_law_set: file: no row of provoked.py gives this status' \
    "$python" "$here/provoked.py" "$library" "$work/real/delam/delam.h"
if [[ $tier == all ]]; then
    real delam.h 's/restores the number afterwards/sets the number afterwards/'
    refused "^delam_blas_threads: 'restores the number afterwards': no such sentence" \
        sentences "$work/real/delam/delam.h"
    real petsc.h 's/^(\/\* Writes a number), /\1 until then, /'
    refused '^delam_petsc_value: .*neither a row nor another test' \
        sentences "$work/real/delam/petsc.h" --base "$work/real/delam/delam.h"
    petsc_library=$(dirname "$library")/libdelam-petsc.so
    if [[ -f $petsc_library ]] && "$python" -c 'import mpi4py' 2>/dev/null; then
        real petsc.h 's/unit value of key; null none; status argument, state/&, file/'
        refused '^delam_petsc_value: file: no row of provoked_petsc.py gives this status' "$python" \
            "$here/provoked_petsc.py" "$library" "$work/real/delam/delam.h" "$petsc_library" "$work/real/delam/petsc.h"
    else
        left_out+=("that of the statuses of libdelam-petsc (Debian: python3-mpi4py)")
    fi
fi
