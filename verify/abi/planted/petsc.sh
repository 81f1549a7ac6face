# SPDX-License-Identifier: BSD-3-Clause
# Breaks of the library on top, a core that loads MPI, old hosts and the reference; ../test_planted.sh sources this.
# shellcheck shell=bash disable=SC2154
# ---- a library on top, with MPI ----
mkdir -p "$work/top/delam"
cp "$work/sound/delam/delam.h" "$work/top/delam"
printf 'typedef struct ompi_communicator_t *MPI_Comm;\ntypedef int MPI_Fint;\nextern struct ompi_communicator_t ompi_mpi_world;\n' \
    >"$work/top/mpi.h"
cat >"$work/top/delam/petsc.h" <<'HEADER'
/* SPDX-License-Identifier: BSD-3-Clause */
#ifndef DELAM_PETSC_H
#define DELAM_PETSC_H
#include <mpi.h>
#include <delam/delam.h>
typedef struct delam_petsc delam_petsc; /* ranks */
/* Makes the ranks of a communicator comm.
 * [null none; owns out caller; status argument; thread MPI's; since 0.1] */
DELAM_API int32_t delam_petsc_create(MPI_Comm comm, delam_petsc **out);
/* What rank 0 does.
 * [null user; status returned; thread call's; since 0.1] */
typedef int32_t (*delam_petsc_work_callback)(void *user);
/* Does work on rank 0, which has the law.
 * [null user; owns work and user: the host, until the call returns; status returned; since 0.1] */
DELAM_API int32_t delam_petsc_run(delam_petsc *petsc, const delam_law *law, delam_petsc_work_callback work, void *user);
#endif
HEADER
cat >"$work/top/top.c" <<'CODE'
#include <delam/petsc.h>
struct delam_petsc { MPI_Comm comm; };
int32_t delam_petsc_create(MPI_Comm comm, delam_petsc **out) {
    return comm != &ompi_mpi_world || out == 0;
}
int32_t delam_petsc_run(delam_petsc *petsc, const delam_law *law, delam_petsc_work_callback work, void *user) {
    return petsc != 0 && law != 0 ? work(user) : 0;
}
CODE
printf 'delam_petsc_create 0.1\ndelam_petsc_run 0.1\n' >"$work/top/symbols.txt"
cp "$root/src/petsc/petsc.map" "$work/top/petsc.map"
cp -r "$work/top" "$work/top.sound"
# on_top NAME: a new copy to break. make_top NAME [OPTIONS]. gate_top NAME CHECK. lint_top NAME. promise_top NAME.
on_top() {
    rm -rf "${work:?}/$1"
    cp -r "$work/top.sound" "$work/$1"
}
make_top() {
    local name=$1
    shift
    (cd "$work/$name" && gcc -std=c99 -g -fPIC -shared -fvisibility=hidden -I. top.c -o libdelam-petsc.so \
        -Wl,--version-script=petsc.map -Wl,-soname,libdelam-petsc.so.1 "$@")
}
gate_top() {
    local name=$1 check=$2
    shift 2
    "$python" "$here/gate.py" "$check" --library "$work/$name/libdelam-petsc.so" --header "$work/$name/delam/petsc.h" \
        --base "$work/$name/delam/delam.h" --list "$work/$name/symbols.txt" --baseline "$work/top.sound/petsc.abi" \
        --baseline-header "$work/top.sound/delam/petsc.h" "$@"
}
lint_top() {
    "$python" "$here/contract_lint.py" "$work/$1/delam/petsc.h" "$work/$1/symbols.txt" --base "$work/$1/delam/delam.h"
}
promise_top() {
    "$python" "$here/promise.py" "$work/$1/delam/petsc.h" --base "$work/$1/delam/delam.h" "${@:2}"
}
make_top top.sound
accepted gate_top top.sound symbols
accepted gate_top top.sound baseline
accepted lint_top top.sound
promise_top top.sound --write >"$work/top.sound/contract.txt"
accepted promise_top top.sound --baseline "$work/top.sound/contract.txt"
on_top top
edit top petsc.map 's/DELAM_PETSC_1/DELAM_1/'
make_top top
refused "^delam_petsc_create: version node 'DELAM_1', expected DELAM_PETSC_1" gate_top top symbols
make_top top -Wl,-soname,libdelam.so.1
refused 'SONAME libdelam.so.1, but DELAM_ABI 1 of the header asks for libdelam-petsc.so.1' gate_top top symbols
if [[ $tier == all ]]; then
    on_top top
    printf 'DELAM_API int32_t delam_petsc_more(void) { return 0; }\n' >>"$work/top/top.c"
    make_top top
    refused '^delam_petsc_more: exported, but no public header declares it' gate_top top symbols
    # top SED MESSAGE COMMAND...
    top() {
        on_top top
        edit top delam/petsc.h "$1"
        refused "${@:2}"
    }
    top 's/delam_petsc_run\(/delam_ranks_run(/' '^delam_ranks_run: names of petsc.h start with delam_petsc_' \
        gate_top top symbols
    refused '^delam_petsc_run: in the baseline, gone from the header' gate_top top baseline
    top 's/MPI_Comm comm/MPI_Fint comm/' "^delam_petsc_create: 'int32_t delam_petsc_create\(MPI_Fint," \
        gate_top top baseline
    top 's/MPI_Comm comm/MPI_Group comm/' "delam_petsc_create: type 'MPI_Group' is none of the interface's types" \
        gate_top top baseline
    top 's/^typedef struct delam_petsc delam_petsc;/&\ntypedef struct delam_part {\n    double x;\n} delam_part;/' \
        'not a form that the header may have: typedef struct delam_part' gate_top top baseline
    top "s/thread MPI's; //" 'delam_petsc_create: thread: missing' lint_top top
    top 's/status argument; thread/status returned; thread/' "delam_petsc_create: status: 'returned' is not known" \
        lint_top top
    top 's/null user; owns work/null none; owns work/' '^delam_petsc_run: null: user may be NULL in the baseline' \
        promise_top top --baseline "$work/top.sound/contract.txt"
    if command -v abidiff >/dev/null; then
        gate_top top.sound abixml >"$work/top.sound/petsc.abi"
        accepted gate_top top.sound abidiff
        on_top top
        edit top delam/petsc.h 's/work, void \*user\)/work, int32_t user)/'
        edit top top.c 's/void \*user\) \{/int32_t user) {/; s/work\(user\)/work(\&user)/'
        make_top top
        refused 'function int32_t delam_petsc_run' gate_top top abidiff
    fi
fi

# ---- a core that loads MPI ----
without_mpi() { bash "$here/without_mpi.sh" "$@"; }
accepted without_mpi "$work/sound/libdelam.so"
planted mpi
printf 'int MPI_Init(void);\nint MPI_Init(void) { return 0; }\n' >"$work/mpi/mpi.c"
(cd "$work/mpi" && gcc -shared -fPIC mpi.c -o libmpi.so.40 -Wl,-soname,libmpi.so.40)
make mpi -Wl,--no-as-needed "$work/mpi/libmpi.so.40"
refused '^.*/libdelam.so loads libmpi.so.40' without_mpi "$work/mpi/libdelam.so"
if [[ $tier == all ]]; then
    # Through a library in between; loaded by the program alone; and called without being named.
    (cd "$work/mpi" && gcc -shared -fPIC mpi.c -o libdmumps-5.5.so -Wl,-soname,libdmumps-5.5.so &&
        gcc -shared -fPIC -xc /dev/null -o libbetween.so -Wl,--no-as-needed -L. -l:libdmumps-5.5.so "-Wl,-rpath,$work/mpi")
    make mpi -Wl,--no-as-needed "$work/mpi/libbetween.so"
    refused '^.*/libdelam.so loads .*libdmumps-5.5.so' without_mpi "$work/mpi/libdelam.so"
    printf 'int main(void) { return 0; }\n' >"$work/mpi/main.c"
    (cd "$work/mpi" && gcc main.c -o host -Wl,--no-as-needed -L. -l:libmpi.so.40)
    refused '^.*/host loads libmpi.so.40' without_mpi "$work/sound/libdelam.so" "$work/mpi/host"
    printf 'int MPI_Init(void);\nint delam_inner(void);\nint delam_inner(void) { return MPI_Init(); }\n' >>"$work/mpi/law.c"
    make mpi
    refused '^.*/libdelam.so calls MPI_Init' without_mpi "$work/mpi/libdelam.so"
fi

# ---- a host of another interface ----
if [[ $tier == all ]]; then
    mkdir -p "$work/host/delam"
    cp "$here/baseline/delam/delam.h" "$work/host/delam/delam.h"
    host() {
        gcc -std=c99 -I "$work/host" "$here/host.c" -o "$work/host/host" "$library" -lm \
            -Wl,-rpath,"$(dirname "$library")" && "$work/host/host"
    }
    accepted host
    edit host delam/delam.h 's/DELAM_ABI 1/DELAM_ABI 2/'
    refused 'the library has another DELAM_ABI' host
    edit host delam/delam.h 's/DELAM_QUAD4 2/DELAM_QUAD4 4/'
    refused 'delam_mesh_create_layers.*DELAM_ERROR_ARGUMENT.*cell_type' host
fi

# ---- the reference as HTML ----
if [[ $tier == quick ]]; then
    :
elif command -v doxygen >/dev/null; then
    mkdir -p "$work/doc/src/capi" "$work/doc/verify"
    cp -r "$root/include" "$work/doc/include"
    cp "$root/src/capi/CONTRACT.md" "$work/doc/src/capi"
    cp -r "$here" "$work/doc/verify/abi"
    cp "$work/sound/delam/delam.h" "$work/doc/include/delam/delam.h"
    accepted bash "$work/doc/verify/abi/doxygen.sh" "$work/doc/out"
    sed -i '/Told of each value/{N;s/.*//}' "$work/doc/include/delam/delam.h"
    refused 'delam_watch_callback.* is not documented' bash "$work/doc/verify/abi/doxygen.sh" "$work/doc/out"
else
    left_out+=("that of the reference (Debian: doxygen)")
fi
