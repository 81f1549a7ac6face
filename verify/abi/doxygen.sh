#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# doxygen.sh OUTPUT: the reference as HTML into OUTPUT/html. Fails on any warning; 77: no doxygen.
set -euo pipefail
mkdir -p "$1"
DELAM_DOXYGEN_OUTPUT=$(cd "$1" && pwd)
export DELAM_DOXYGEN_OUTPUT
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
if ! command -v doxygen >/dev/null; then
    printf 'skipped: doxygen is not there (Debian: doxygen)\n'
    exit 77
fi
doxygen verify/abi/Doxyfile
test -f "$DELAM_DOXYGEN_OUTPUT/html/delam_8h.html"
test -f "$DELAM_DOXYGEN_OUTPUT/html/petsc_8h.html"
