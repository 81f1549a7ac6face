# SPDX-License-Identifier: BSD-3-Clause
# Breaks of keys, sentences and statuses; ../test_planted.sh sources this.
# shellcheck shell=bash disable=SC2154
# ---- keys ----
# A library in front of the real one that says something else of its keys. lying NAME: compiled with -DNAME.
mkdir "$work/keys"
cat >"$work/keys/lying.c" <<'CODE'
#define _GNU_SOURCE
#include <delam/delam.h>
#include <dlfcn.h>
#include <string.h>
#define BEHIND(name) __typeof__(&name) behind = (__typeof__(&name))dlsym(RTLD_NEXT, #name)
#ifdef FEWER_OPTIONS
int64_t delam_option_count(void) { BEHIND(delam_option_count); return behind() - 1; }
#endif
#ifdef CELL
int32_t delam_cell_type_info(int64_t index, const char **name, int32_t *cell_type, int32_t *dimension, int32_t *nodes,
                             int32_t *corners, int32_t *faces, int32_t *face_nodes, int32_t *face_corners) {
    BEHIND(delam_cell_type_info);
    const int32_t status =
        behind(index, name, cell_type, dimension, nodes, corners, faces, face_nodes, face_corners);
    if (strcmp(*name, CELL) == 0) *PLACE = NUMBER;
    return status;
}
#endif
#ifdef OPTION
int32_t delam_option_info(int64_t index, const char **key, const char **type, const char **unit, const char **initial,
                          const char **range, const char **meaning) {
    BEHIND(delam_option_info);
    const int32_t status = behind(index, key, type, unit, initial, range, meaning);
    if (strcmp(*key, OPTION) == 0) *PLACE = TEXT;
    return status;
}
#endif
#ifdef PARAMETER
int32_t delam_law_parameter_info(const char *kind, int64_t index, const char **key, const char **type,
                                 const char **unit, const char **initial, const char **range, const char **meaning) {
    BEHIND(delam_law_parameter_info);
    const int32_t status = behind(kind, index, key, type, unit, initial, range, meaning);
    if (strcmp(*key, PARAMETER) == 0) *PLACE = TEXT;
    return status;
}
#endif
#ifdef FEWER_VALUES
int32_t delam_solver_value_count(const delam_solver *solver, int64_t *count) {
    BEHIND(delam_solver_value_count);
    const int32_t status = behind(solver, count);
    --*count;
    return status;
}
#endif
#ifdef UNRECORDED
int32_t delam_solver_record(delam_solver *solver, const char *key) {
    BEHIND(delam_solver_record);
    int64_t rows = 0, dimension = 0;
    delam_solver_field_shape(solver, "displacement", -1, &rows, &dimension);
    const int here = strcmp(key, UNRECORDED) == 0 && dimension == IN;
    return here ? DELAM_ERROR_ARGUMENT : behind(solver, key);
}
#endif
#ifdef UNKNOWN
int32_t delam_solver_value(delam_solver *solver, const char *key, double *value) {
    BEHIND(delam_solver_value);
    const int32_t status = behind(solver, key, value);
    if (strcmp(key, UNKNOWN) == 0) *value = 0.0 / 0.0;
    return status;
}
#endif
#ifdef FLAT
int32_t delam_solver_field_shape(const delam_solver *solver, const char *key, int64_t part, int64_t *rows,
                                 int64_t *columns) {
    BEHIND(delam_solver_field_shape);
    return strcmp(key, "stress") == 0 ? DELAM_ERROR_ARGUMENT : behind(solver, key, part, rows, columns);
}
#endif
CODE
keys() { "$python" "$here/keys.py" "$@"; }
lying() {
    gcc -std=gnu99 -fPIC -shared -I"$root/include" "$@" "$work/keys/lying.c" -o "$work/keys/liblying.so" \
        -Wl,--no-as-needed "$library" -Wl,-rpath,"$(dirname "$library")" -ldl
    keys "$work/keys/liblying.so" "$root/include/delam/delam.h" "${more[@]}"
}
more=()
accepted lying -DNONE
refused '^option memory_limit: in the baseline, gone' lying -DFEWER_OPTIONS
if [[ $tier == all ]]; then
    refused '^option contact_limit: type real, in the baseline integer' \
        lying '-DOPTION="contact_limit"' -DPLACE=type '-DTEXT="real"'
    refused "^option damage_tolerance: range '0 <= value < 0.1' does not allow all of '0 <= value < 1'" \
        lying '-DOPTION="damage_tolerance"' -DPLACE=range '-DTEXT="0 <= value < 0.1"'
    accepted lying '-DOPTION="damage_tolerance"' -DPLACE=range '-DTEXT="0 <= value <= 1"'
    refused "^option contact: range 'auto' does not allow" lying '-DOPTION="contact"' -DPLACE=range '-DTEXT="auto"'
    accepted lying '-DOPTION="contact"' -DPLACE=range '-DTEXT="auto | always | never"'
    refused "^option threads: default '2', in the baseline '1': run .*update.sh, and name it" \
        lying '-DOPTION="threads"' -DPLACE=initial '-DTEXT="2"'
    more=(--new-defaults)
    accepted lying '-DOPTION="threads"' -DPLACE=initial '-DTEXT="2"'
    refused "^law griffith gradient: default '', .*: it must be given now" \
        lying '-DPARAMETER="gradient"' -DPLACE=initial '-DTEXT=""'
    more=()
    refused '^law trapezoidal normal_stiffness: unit F/L2, in the baseline F/L3' \
        lying '-DPARAMETER="normal_stiffness"' -DPLACE=unit '-DTEXT="F/L2"'
    refused "^law trapezoidal plateau: in the baseline, gone" lying '-DPARAMETER="plateau"' -DPLACE=key '-DTEXT="level"'
    refused '^cell hex8: shape \[9\]\[3\], in the baseline \[8\]\[3\]' lying '-DCELL="hex8"' -DPLACE=nodes -DNUMBER=9
    refused '^cell hex8: number 3, by the header 4' lying '-DCELL="hex8"' -DPLACE=cell_type -DNUMBER=3
    refused '^value reaction:NAME: in the header, delam_solver_value_name does not give it' lying -DFEWER_VALUES
    refused '^value crack_length: is not recorded any more' lying '-DUNRECORDED="crack_length"' -DIN=2
    refused '^value crack_length: is not recorded any more' lying '-DUNRECORDED="crack_length"' -DIN=3
    refused '^value dissipated: is -?nan in 2D' lying '-DUNKNOWN="dissipated"'
    refused '^field stress: shape None, by the header' lying -DFLAT
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
    accepted lying -DNONE
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
