#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The Debian packages hold what they should, depend on what they need, and work unpacked.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
for tool in dpkg-deb dpkg-shlibdeps; do
    command -v $tool >/dev/null || skip "$tool is not installed"
done
keep_manifests
(cd "$work" && quietly "$CPACK" -G DEB --config "$BUILD/CPackConfig.cmake" -B "$work/out")
packages=("libdelam$ABI" libdelam-dev)
if has cli; then
    packages+=(delam)
fi
if has petsc; then
    packages+=("libdelam-petsc$ABI" libdelam-petsc-dev)
fi
if has mpi; then
    packages+=(delam-mpi)
fi
[[ $(find "$work/out" -maxdepth 1 -name '*.deb' | wc -l) == "${#packages[@]}" ]] ||
    fail "expected ${packages[*]}: $(ls "$work/out")"
for package in "${packages[@]}"; do
    file=$(find "$work/out" -maxdepth 1 -name "${package}_${VERSION}*.deb")
    [[ -n $file ]] || fail "no package $package: $(ls "$work/out")"
    [[ $(dpkg-deb --field "$file" Package) == "$package" ]] || fail "$file is not named $package"
    dpkg-deb --field "$file" Package Version Depends Maintainer
    dpkg-deb --contents "$file" | awk '{print $6}' | grep -v '/$' >"$work/$package.list"
    dpkg-deb --extract "$file" "$work/root"
done

# holds PACKAGE PATTERN; lacks PACKAGE PATTERN
holds() {
    grep -qE "$2" "$work/$1.list" || fail "$1 has nothing like $2"
}
lacks() {
    if grep -E "$2" "$work/$1.list"; then
        fail "$1 has what it should not"
    fi
}
needs() {
    dpkg-deb --field "$(find "$work/out" -maxdepth 1 -name "${1}_${VERSION}*.deb")" Depends
}
depends() {
    needs "$1" | grep -qF "$2" || fail "$1 does not depend on $2"
}
# alone PACKAGE: nothing of MPI is needed.
alone() {
    if needs "$1" | grep -E 'mpi|petsc|mumps'; then
        fail "$1 depends on MPI or PETSc"
    fi
    lacks "$1" 'petsc|mpi'
}
holds "libdelam$ABI" "^\./usr/lib/.*libdelam\.so\.$ABI\$"
holds "libdelam$ABI" '/LICENSE$'
lacks "libdelam$ABI" '\.h$|\.hpp$|\.py$|/bin/|\.a$'
depends "libdelam$ABI" libcholmod
holds libdelam-dev '^\./usr/include/delam/delam\.h$'
holds libdelam-dev 'cmake/delam/delam-config\.cmake$'
holds libdelam-dev 'pkgconfig/delam\.pc$'
holds libdelam-dev 'share/delam/fortran/delam\.f90$'
holds libdelam-dev 'libdelam\.so$'
holds libdelam-dev 'share/doc/.*/CONTRACT\.md$'
lacks libdelam-dev 'libdelam\.so\.|/bin/'
depends libdelam-dev "libdelam$ABI (= $VERSION)"
if has static; then
    holds libdelam-dev '/libdelam\.a$'
    for package in libsuitesparse-dev libmetis-dev libopenblas-dev; do
        depends libdelam-dev $package
    done
    if readelf -SW "$(find "$work/root" -name libdelam.a)" | grep -q '\.debug_info'; then
        fail "the archive in the package has debug information"
    fi
else
    lacks libdelam-dev '/libdelam\.a$'
fi
if has cpp; then
    holds libdelam-dev '^\./usr/include/delam/delam\.hpp$'
    holds libdelam-dev '^\./usr/include/delam/cpp/solver\.hpp$'
fi
if has cli; then
    holds delam '^\./usr/bin/delam$'
    holds delam 'share/doc/delam/bindings/cli/SCENE\.md$'
    holds delam '/delam/delam-gmsh\.so$'
    lacks delam '/include/|libdelam.*\.so'
    depends delam "libdelam$ABI"
    depends delam libgmsh
    "$work/root/usr/bin/delam" --version
    quietly "$work/root/usr/bin/delam" check "$SOURCE/examples/fibre/fibre.toml"
fi
for package in "libdelam$ABI" libdelam-dev; do
    alone "$package"
done
if has cli; then
    alone delam
fi
if has petsc; then
    holds "libdelam-petsc$ABI" "^\./usr/lib/.*libdelam-petsc\.so\.$ABI\$"
    lacks "libdelam-petsc$ABI" '\.h$|/bin/|libdelam\.so|petsc\.so$'
    depends "libdelam-petsc$ABI" "libdelam$ABI (= $VERSION)"
    depends "libdelam-petsc$ABI" libpetsc
    holds libdelam-petsc-dev '^\./usr/include/delam/petsc\.h$'
    holds libdelam-petsc-dev 'cmake/delam/delam-petsc\.cmake$'
    holds libdelam-petsc-dev 'pkgconfig/delam-petsc\.pc$'
    holds libdelam-petsc-dev 'libdelam-petsc\.so$'
    lacks libdelam-petsc-dev 'petsc\.so\.|/bin/|delam\.h$'
    depends libdelam-petsc-dev "libdelam-petsc$ABI (= $VERSION)"
    depends libdelam-petsc-dev "libdelam-dev (= $VERSION)"
    needs libdelam-petsc-dev | grep -qE 'lib(openmpi|mpich)-dev|mpi-default-dev' || fail "libdelam-petsc-dev needs no mpi.h"
fi
if has mpi; then
    holds delam-mpi '^\./usr/bin/delam-mpi$'
    lacks delam-mpi '/include/|/lib/'
    depends delam-mpi "libdelam-petsc$ABI (= $VERSION)"
    depends delam-mpi "delam (= $VERSION)"
    quietly "$work/root/usr/bin/delam-mpi" --version
fi
library=$(find "$work/root/usr/lib" -name "libdelam.so.$ABI")
if readelf -S "$library" | grep -q '\.debug_info'; then
    fail "the library in the package has debug information"
fi
# The history below must come from this library.
export STAGE=$work/root
cd "$work" || exit
quietly "$CC" -std=c99 -I"$work/root/usr/include" "$SOURCE/examples/enf/enf.c" -o enf_c "$library" \
    "-Wl,-rpath,$(dirname "$library")"
same_history ./enf_c
