#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Hosts find the installation with pkg-config; the one in Fortran compiles the installed sources of the modules. Those in
# C++ and Fortran with the word "whole" alone (the long tier); consumer_cmake builds them in the quick one.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
PKG_CONFIG_PATH=$(dirname "$(find "$STAGE" -name delam.pc)")
export PKG_CONFIG_PATH
found=$(pkg-config --modversion delam)
[[ $found == "$VERSION" ]] || fail "delam.pc has version $found, expected $VERSION"
read -ra flags <<<"$(pkg-config --cflags delam)"
read -ra links <<<"$(pkg-config --libs delam) -Wl,-rpath,$(pkg-config --variable=libdir delam)"
cd "$work" || exit

quietly "$CC" -std=c99 "${flags[@]}" "$SOURCE/examples/enf/enf.c" -o enf_c "${links[@]}"
same_history ./enf_c
if [[ ${1:-} == whole ]] && has cpp; then
    quietly "$CXX" -std=c++17 "${flags[@]}" "$SOURCE/examples/enf/enf.cpp" -o enf_cpp "${links[@]}"
    same_history ./enf_cpp
fi
read -ra fortran <<<"$(pkg-config --variable=fortransources delam)"
last=$(pkg-config --variable=fortrandir delam)/delam.f90
[[ ${fortran[-1]} == "$last" ]] || fail "the last source is ${fortran[-1]}, expected $last"
for file in "${fortran[@]}"; do
    [[ -f $file ]] || fail "no $file"
done
if [[ ${1:-} != whole ]]; then
    exit 0
elif [[ -n ${FC:-} ]]; then
    quietly "$FC" "${fortran[@]}" "$SOURCE/examples/enf/enf.f90" -o enf_fortran "${links[@]}"
    same_history ./enf_fortran
else
    skip "the host in Fortran was left out: no Fortran compiler was found; the others ran"
fi
