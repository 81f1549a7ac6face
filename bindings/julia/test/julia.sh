#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# julia.sh PACKAGE FILE [ARGUMENT ...]: a file of Julia with the package at hand; exit code 77 where there is no Julia.
package=$1
shift
if ! command -v julia >/dev/null 2>&1; then
    echo "skipped: julia is not installed; the package is parsed and compared with the header only"
    exit 77
fi
exec julia --startup-file=no --project="$package" "$@"
