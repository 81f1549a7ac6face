#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# A host of delam/petsc.h, by CMake and by pkg-config with mpicc, on two processes; and the installed delam-mpi. Hosts of
# the core are not told of MPI. The host in C++ with the word "whole" alone (the long tier).
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
has petsc || skip "libdelam-petsc was not built"
for tool in mpicc mpirun; do
    command -v $tool >/dev/null || skip "$tool is not installed"
done
project=$SOURCE/verify/packaging/consumer_petsc
ranks=(mpirun -n 2)
set -a
# shellcheck source=verify/petsc/environment.txt
source "$SOURCE/verify/petsc/environment.txt"
set +a

# installed PROGRAM: both libraries are those in $STAGE.
installed() {
    local name loaded
    for name in libdelam libdelam-petsc; do
        loaded=$(ldd "$1" | sed -n "s/.*$name\.so[^ ]* => \([^ ]*\).*/\1/p")
        [[ $(realpath "${loaded:-/}") == "$(realpath "$STAGE")"/* ]] || fail "$1 loads $name from '$loaded', not from $STAGE"
    done
}

# runs PROGRAM: on two processes, with the numbers of one.
runs() {
    local alone together
    installed "$1"
    alone=$("$1" | sed -n 's/^1 ranks: \(reaction [^,]*\),.*/\1/p')
    together=$("${ranks[@]}" "$1" | sed -n 's/^2 ranks: \(reaction [^,]*\),.*/\1/p')
    /usr/bin/python3 - "$alone" "$together" <<'PYTHON' || fail "$1: '$alone' on one process, '$together' on two"
import sys
one, two = (float(text.split()[1]) for text in sys.argv[1:])
sys.exit(not (one > 0 and abs(one - two) <= 1e-6 * one))
PYTHON
    printf '%s: %s\n' "$(basename "$1")" "$together"
}

# by_cmake LANGUAGES
by_cmake() {
    local folder=$work/${1//;/_}
    quietly "$CMAKE" -S "$project" -B "$folder" -DCMAKE_PREFIX_PATH="$STAGE" -DCMAKE_C_COMPILER="$CC" \
        -DCMAKE_CXX_COMPILER="$CXX" -DHOST_LANGUAGES="$1" -DCMAKE_FIND_USE_PACKAGE_REGISTRY=OFF
    quietly "$CMAKE" --build "$folder"
    runs "$folder/ranks"
}
by_cmake C
if [[ ${1:-} == whole ]]; then
    by_cmake CXX
fi

PKG_CONFIG_PATH=$(dirname "$(find "$STAGE" -name delam-petsc.pc)")
export PKG_CONFIG_PATH
found=$(pkg-config --modversion delam-petsc)
[[ $found == "$VERSION" ]] || fail "delam-petsc.pc has version $found, expected $VERSION"
if pkg-config --cflags --libs delam | grep -E 'petsc|mpi'; then
    fail "hosts of the core are told of libdelam-petsc or MPI"
fi
read -ra flags <<<"$(pkg-config --cflags --libs delam-petsc) -Wl,-rpath,$(pkg-config --variable=libdir delam-petsc)"
quietly mpicc -std=c99 "$project/ranks.c" -o "$work/ranks" "${flags[@]}"
runs "$work/ranks"

if has mpi; then
    installed "$STAGE/bin/delam-mpi"
    quietly "${ranks[@]}" "$STAGE/bin/delam-mpi" check "$SOURCE/examples/enf/enf.toml"
    "${ranks[@]}" "$STAGE/bin/delam-mpi" --version
fi
