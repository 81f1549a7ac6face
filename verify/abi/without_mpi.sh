#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# without_mpi.sh LIBRARY [PROGRAM...]: neither libdelam nor a program that links it loads a library of MPI, PETSc or MUMPS,
# directly or by what it links; and libdelam calls no function of them.
set -euo pipefail
libraries='lib(mpi|mpich|open-rte|open-pal|pmix|petsc|([sdcz]|p)?mumps|mpiseq|seq|pord|scalapack|ptscotch|delam-petsc)'
library=$1
status=0
for file in "$@"; do
    # Also those that are not found.
    if ! loaded=$(LC_ALL=C ldd "$file" | awk '{print $1}'); then
        printf '%s: ldd does not read it\n' "$file"
        exit 1
    fi
    while read -r name; do
        printf '%s loads %s\n' "$file" "$name"
        status=1
    done < <(grep -E "^(.*/)?$libraries([_.-]|[0-9])" <<<"$loaded")
done
while read -r name; do
    printf '%s calls %s\n' "$library" "$name"
    status=1
done < <(nm -D --undefined-only "$library" | awk '{print $NF}' |
    grep -E '^(P?MPI_|ompi_|Petsc|(Mat|Vec|KSP|PC|IS)[A-Z]|[sdcz]mumps_)')
if ((status == 0)); then
    printf 'no library of MPI among those that %d files load\n' "$#"
fi
exit $status
