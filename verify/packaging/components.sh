#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Each component by itself has what it is for and no more; together they are the whole installation.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
keep_manifests

# files COMPONENT: its files below the prefix; library folders of any name are "lib".
files() {
    quietly "$CMAKE" --install "$BUILD" --prefix "$work/$1" --component "$1"
    (cd "$work/$1" && find . -type f -o -type l) | sed -e 's|^\./||' -e 's|^lib/[^/]*-linux-gnu[^/]*/|lib/|' | sort
}

# only COMPONENT PATTERN NEEDED...: every file fits the pattern, and the needed ones are there.
only() {
    local component=$1 pattern=$2 found name
    shift 2
    found=$(files "$component")
    if grep -vE "^($pattern)\$" <<<"$found"; then
        fail "these do not belong to component $component"
    fi
    for name in "$@"; do
        grep -qxF "$name" <<<"$found" || fail "component $component has no $name"
    done
    printf '%s: %d files\n' "$component" "$(wc -l <<<"$found")"
}

only runtime 'lib/libdelam\.so\.[0-9.]+|share/doc/[a-z]+/LICENSE' "lib/libdelam.so.$ABI" "lib/libdelam.so.$VERSION"
headers='include/delam/[a-z_]+\.h'
documents='share/doc/delam/(include|src/[a-z/]+)/[A-Z]+\.md'
belongs="lib/libdelam\.so|$headers|$documents|lib/cmake/delam/delam-(config|targets).*\.cmake|lib/pkgconfig/delam\.pc"
needed=(lib/libdelam.so include/delam/delam.h lib/cmake/delam/delam-config.cmake lib/pkgconfig/delam.pc
    share/doc/delam/src/capi/CONTRACT.md)
if has static; then
    belongs+='|lib/libdelam\.a|lib/cmake/delam/delam-static.*\.cmake|lib/pkgconfig/delam-shared\.pc'
    needed+=(lib/libdelam.a lib/cmake/delam/delam-static.cmake lib/pkgconfig/delam-shared.pc)
fi
only development "$belongs" "${needed[@]}"
# Every document of ours that the header names comes with it.
mapfile -t named < <(grep -oE '(include|src/[a-z_/]+)/[A-Z]+\.md' "$SOURCE/include/delam/delam.h" | sort -u)
((${#named[@]} > 0)) || fail "the header names no source among ours"
for name in "${named[@]}"; do
    [[ -f $work/development/share/doc/delam/$name ]] || fail "component development has no $name, which delam.h names"
done
if has cli; then
    belongs='bin/delam|lib/delam/delam-gmsh\.so|share/delam/((_pictures|specimen|study(/(fitting|measured|scatter|series|specimens))?)/)?[a-z_]+\.py|share/delam/view\.html'
    belongs+='|share/doc/delam/(bindings/cli/([a-z]+/)?([A-Z]+\.md|scene\.schema\.json)|examples/enf/enf\.toml)'
    belongs+='|share/man/man[15]/delam(-scene)?\.[15]|share/bash-completion/completions/delam|share/zsh/site-functions/_delam'
    belongs+='|share/fish/vendor_completions\.d/delam\.fish'
    only cli "$belongs" bin/delam lib/delam/delam-gmsh.so share/delam/plot.py share/delam/_pictures/result.py share/delam/study/fit.py \
        share/delam/specimen/new.py \
        share/doc/delam/bindings/cli/MANUAL.md share/doc/delam/bindings/cli/SCENE.md share/doc/delam/bindings/cli/scene.schema.json \
        share/man/man1/delam.1 share/man/man5/delam-scene.5 share/bash-completion/completions/delam
fi
if has cpp; then
    only cpp 'include/delam/(delam|cpp/[a-z]+)\.hpp|lib/cmake/delam/delam-cpp.*\.cmake' \
        include/delam/delam.hpp include/delam/cpp/solver.hpp
fi
if has petsc; then
    only petsc 'lib/libdelam-petsc\.so\.[0-9.]+' "lib/libdelam-petsc.so.$ABI" "lib/libdelam-petsc.so.$VERSION"
    petsc='include/delam/petsc\.h|lib/libdelam-petsc\.so|lib/cmake/delam/delam-petsc.*\.cmake|lib/pkgconfig/delam-petsc\.pc'
    only petsc_development "$petsc" include/delam/petsc.h lib/libdelam-petsc.so lib/cmake/delam/delam-petsc.cmake \
        lib/pkgconfig/delam-petsc.pc
fi
# Whoever has the core alone is not told of MPI.
if grep -rliE '(^|[^a-z])mpi|petsc' "$work/development/include" "$work/development/lib/pkgconfig" 2>/dev/null ||
    find "$work/development" "$work/runtime" | grep petsc; then
    fail "these files of the core know MPI or libdelam-petsc"
fi
if has mpi; then
    only mpi 'bin/delam-mpi' bin/delam-mpi
fi
if has fortran; then
    built='include/delam/fortran/.*\.mod|lib/libdelam_fortran\.a|lib/cmake/delam/delam-fortran.*\.cmake'
    only fortran "share/delam/fortran/.*\.f90|$built" \
        share/delam/fortran/delam.f90 share/delam/fortran/delam_raw.f90 share/delam/fortran/delam_solvers.f90 \
        lib/libdelam_fortran.a
else
    # The sources serve compilers that were not there when the library was built.
    only fortran 'share/delam/fortran/.*\.f90' share/delam/fortran/delam.f90
fi

quietly "$CMAKE" --install "$BUILD" --prefix "$work/all"
if ! difference=$(diff <(cd "$work/all" && find . ! -type d | sort) \
    <(for component in runtime development cli fortran cpp petsc petsc_development mpi; do
        [[ ! -d $work/$component ]] || (cd "$work/$component" && find . ! -type d)
    done | sort)); then
    fail "the whole (<) and its components (>) differ:"$'\n'"$difference"
fi
# Links of installed documents lead to files that are installed.
links=0
while IFS= read -r found; do
    document=${found%%:*} target=${found#*](}
    [[ $target == http || $target == https ]] && continue
    [[ -e $(dirname "$document")/$target ]] || fail "the installed ${document#"$work/all/"} links to $target, which is not installed"
    links=$((links + 1))
done < <(grep -roE --include='*.md' '\]\([^)#: ]+' "$work/all/share/doc")
((links > 10)) || fail "the installed documents have $links links: at least 10 are expected"
if has cli; then
    place=$("$work/all/bin/delam" --help | grep -oE 'share/doc/[a-z/]+') || fail "delam --help names no documents"
    [[ -f $work/all/$place/SCENE.md ]] || fail "delam --help names $place, where SCENE.md is not"
    # The schema that the installed example names for editors is what the installed program prints.
    example=$work/all/share/doc/delam/examples/enf
    schema=$(sed -n '1s/^#:schema //p' "$example/enf.toml")
    "$work/all/bin/delam" schema | cmp - "$example/$schema" || fail "enf.toml names $schema, which is not the schema of scenes"
fi
