#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A project elsewhere finds the installation with find_package and builds hosts in C, C++ and Fortran.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
project=$SOURCE/verify/packaging/consumer
options=(-DCMAKE_PREFIX_PATH="$STAGE" -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX"
    -DEXAMPLES="$SOURCE/examples/enf" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF)
parts=()
if has cpp; then
    parts+=(cpp)
fi
if has fortran; then
    parts+=(fortran)
    options+=(-DCMAKE_Fortran_COMPILER="$FC")
fi
quietly "$CMAKE" -S "$project" -B "$work/consumer" "${options[@]}" -DPARTS="$(IFS=';'; printf '%s' "${parts[*]}")"
quietly "$CMAKE" --build "$work/consumer"
for part in c "${parts[@]}"; do
    same_history "$work/consumer/enf_$part"
done

# What is not there is refused by name.
if "$CMAKE" -S "$project" -B "$work/other" "${options[@]}" -DPARTS=cobol >"$work/log" 2>&1; then
    fail "a component that does not exist was found"
fi
if ! grep -q "component 'cobol' is not installed" "$work/log"; then
    cat "$work/log"
    fail "no word of the missing component"
fi
if "$CMAKE" -S "$project" -B "$work/later" "${options[@]}" -DPARTS= -DWANTED=99.0 >"$work/log" 2>&1; then
    fail "version 99 was found"
fi
has fortran || skip "the host in Fortran was left out: the build folder has no Fortran modules; the others ran"
