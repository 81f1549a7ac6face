# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034
# To be sourced: what a bare Debian 12 needs, and how the scripts set it up.

# The library, the command line, the plots and the quick tier of the tests.
DELAM_PACKAGES=(
    g++ gcc gfortran make cmake ninja-build pkg-config git ca-certificates
    libsuitesparse-dev libmetis-dev libopenblas-dev liblapack-dev
    libcli11-dev libtomlplusplus-dev libfmt-dev libhdf5-dev zlib1g-dev nlohmann-json3-dev libgmsh-dev
    libgsl-dev check abigail-tools binutils locales clang clang-format doxygen
    python3 python3-numpy python3-scipy python3-matplotlib python3-h5py python3-venv python3-pip python3-meshio python3-tqdm
    python3-jinja2 python3-jsonschema groff-base fonts-dejavu-core mypy python3-pandas patchelf
)
# VTK for Python, which ParaView's Python brings along and conflicts with.
if [[ $(dpkg-query -W -f='${Status}' python3-paraview 2>/dev/null) != "install ok installed" ]]; then
    DELAM_PACKAGES+=(python3-vtk9)
fi
# libdelam-petsc, delam-mpi and their tests: PETSc (real numbers, with MUMPS and PTScotch), mpicc, mpirun, hosts in Python.
DELAM_MPI_PACKAGES=(libpetsc-real-dev libopenmpi-dev openmpi-bin python3-mpi4py)
# The parser of the Julia files, for the quick tier, and the page of `delam view`. A node from elsewhere has its own npm, which Debian's conflicts with.
DELAM_PARSER_PACKAGES=()
if ! command -v npm >/dev/null; then
    DELAM_PARSER_PACKAGES=(nodejs npm)
fi
# The long tier of the tests.
DELAM_LONG_PACKAGES=(libclang-rt-dev dpkg-dev valgrind paraview python3-paraview python3-getfem
    python3-nbclient python3-ipykernel chromium)

# The site (bindings/site), which the long tier builds as well.
DELAM_SITE_PACKAGES=(python3-sphinx python3-myst-parser python3-breathe furo libjs-mathjax doxygen gmsh
    python3-nbclient python3-ipykernel python3-matplotlib-inline)

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
    local as_root=()
    if ((EUID != 0)); then
        as_root=(sudo)
        if ! command -v sudo >/dev/null || ! { sudo -n true 2>/dev/null || [[ -t 0 ]]; }; then
            printf 'Missing packages. As root:\n    apt-get update && apt-get install --no-install-recommends %s\n' "${missing[*]}" >&2
            return 1
        fi
    fi
    printf 'installing %s\n' "${missing[*]}"
    "${as_root[@]}" apt-get update -q
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -qy --no-install-recommends "${missing[@]}"
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
