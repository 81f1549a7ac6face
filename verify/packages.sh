# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# To be sourced: what a bare Debian 12 needs, and how the scripts set it up.

# examples/run.sh: the program with its pictures, its page and its studies.
DELAM_PACKAGES=(
    g++ cmake ninja-build pkg-config
    libsuitesparse-dev libmetis-dev libopenblas-dev
    libcli11-dev libtomlplusplus-dev libfmt-dev libhdf5-dev zlib1g-dev nlohmann-json3-dev
    python3 python3-numpy python3-scipy python3-matplotlib python3-h5py
)
# Gmsh's library, which examples/run.sh installs for scenes that read a mesh of Gmsh or generate a cell (0.35 GB more).
DELAM_GMSH_PACKAGES=(libgmsh-dev)
# verify/run.sh: the bindings, libdelam-petsc (real numbers, with MUMPS and PTScotch) with its hosts in Python, and the
# quick tier of the tests.
DELAM_TEST_PACKAGES=(
    "${DELAM_GMSH_PACKAGES[@]}" gcc gfortran make git ca-certificates
    libgsl-dev check abigail-tools binutils locales clang clang-format doxygen patchelf groff-base
    python3-venv python3-pip python3-meshio python3-tqdm python3-jinja2 python3-jsonschema python3-pandas python3-cvxopt mypy
    python3-pyflakes
    libpetsc-real-dev libopenmpi-dev openmpi-bin python3-mpi4py
)
# VTK for Python, which ParaView's Python brings along and conflicts with.
if [[ $(dpkg-query -W -f='${Status}' python3-paraview 2>/dev/null) != "install ok installed" ]]; then
    DELAM_TEST_PACKAGES+=(python3-vtk9)
fi
# Node parses the Julia files and checks the page of `delam view`. A node from elsewhere has its own npm, which
# Debian's conflicts with.
if ! command -v npm >/dev/null; then
    DELAM_TEST_PACKAGES+=(nodejs npm)
fi
# The site (bindings/site).
DELAM_SITE_PACKAGES=(python3-sphinx python3-myst-parser python3-breathe furo libjs-mathjax doxygen gmsh
    python3-nbclient python3-ipykernel python3-matplotlib-inline)
# Slices of the long tier need these beside the quick tier (verify/slices.sh); by their number.
declare -A DELAM_SLICE_PACKAGES=(
    [2]="${DELAM_SITE_PACKAGES[*]} valgrind chromium paraview python3-paraview python3-getfem"
    [3]="valgrind dpkg-dev file"
    [10]="valgrind"
    [12]="valgrind"
    [13]="valgrind"
    [14]="valgrind"
    [17]="libclang-rt-dev"
)

# delam_install PACKAGE...: installs what is missing, as root or through sudo; else prints the command and fails.
delam_install() {
    local package missing=()
    for package in "$@"; do
        if [[ $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) != "install ok installed" ]]; then
            missing+=("$package")
        fi
    done
    if ((${#missing[@]} == 0)); then
        return 0
    fi
    if ! command -v apt-get >/dev/null; then
        printf 'This script installs packages of Debian 12, and apt-get is not here. Missing, by their names there: %s\n' \
            "${missing[*]}" >&2
        return 1
    fi
    local as_root=()
    if ((EUID != 0)); then
        as_root=(sudo)
        if ! command -v sudo >/dev/null || ! { sudo -n true 2>/dev/null || [[ -t 0 ]]; }; then
            printf 'Missing packages. As root:\n    apt-get update && apt-get install --no-install-recommends %s\n' "${missing[*]}" >&2
            return 1
        fi
    fi
    printf 'installing %s\n' "${missing[*]}"
    # Packages that an interruption has left half configured come first: apt-get refuses to go on without.
    if [[ -n $(dpkg --audit) ]]; then
        "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive dpkg --configure -a
    fi
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends \
        -o DPkg::Lock::Timeout=600 "${missing[@]}"
}

# OpenBLAS 0.3.21 takes recent Intel processors for a Prescott and runs at a third of the speed; name the kernels instead.
delam_blas() {
    if [[ -z ${OPENBLAS_CORETYPE:-} && -r /proc/cpuinfo ]]; then
        if grep -qw avx512f /proc/cpuinfo; then
            export OPENBLAS_CORETYPE=SkylakeX
        elif grep -qw avx2 /proc/cpuinfo; then
            export OPENBLAS_CORETYPE=Haswell
        fi
    fi
    printf 'OPENBLAS_CORETYPE=%s\n' "${OPENBLAS_CORETYPE:-chosen by OpenBLAS}"
}
