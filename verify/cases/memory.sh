#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# memory.sh PROGRAM [ARGUMENT ...]: runs it under valgrind; neither a wrong access nor a leak.
if ! command -v valgrind >/dev/null; then
    echo "skipped: valgrind is not installed"
    exit 77
fi
# valgrind does not know AVX-512.
OPENBLAS_CORETYPE=Haswell OPENBLAS_NUM_THREADS=1 exec valgrind --quiet --error-exitcode=9 --leak-check=full \
    --errors-for-leak-kinds=definite,indirect "$@"
