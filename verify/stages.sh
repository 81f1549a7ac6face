# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# To be sourced by verify/run.sh: the stages of the suite, each a build and what runs on it.

# build PRESET OPTIONS...: configures and builds.
build() {
    local preset=$1
    shift
    cmake --preset "$preset" "$@" && cmake --build --preset "$preset"
}

# build_release: all of it; what this script has installed packages for must be found.
build_release() {
    build release -DDELAM_BUILD_TESTS=ON -DDELAM_STATIC=ON -DDELAM_PETSC=ON -DDELAM_GMSH=ON
}

# The unit tests, the light cases and the fuzzer's corpus with sanitizers. These checks of UBSan more than double the
# time of the build; a slice of the long tier makes them (sanitized_whole). AddressSanitizer reports what null,
# object-size and pointer-overflow would find when the access happens. The programs of the tests are those of the
# release build, linked with the instrumented library.
sanitized() {
    check "build with sanitizers" build asan -DDELAM_BUILD_CLI=OFF -DDELAM_BUILD_EXAMPLES=OFF -DDELAM_UNITY=ON \
        -DDELAM_PETSC=OFF -DDELAM_SANITIZE_LESS=alignment,null,object-size,vptr,pointer-overflow \
        "-DDELAM_TEST_OBJECTS=$PWD/build/release"
    if [[ -f build/asan/verify/CTestTestfile.cmake ]]; then
        CK_FORK=no tests build/asan -j2 --label-regex '^sanitized$'
    fi
}

# The same with every check, and with the tests compiled for it.
sanitized_whole() {
    check "build with every check of the sanitizers" build_sanitized_whole
    if [[ -f build/ubsan/verify/CTestTestfile.cmake ]]; then
        CK_FORK=no tests build/ubsan -j2 --label-regex '^sanitized$'
    fi
}

build_sanitized_whole() {
    cmake --preset asan -B build/ubsan -DDELAM_BUILD_CLI=OFF -DDELAM_BUILD_EXAMPLES=OFF -DDELAM_UNITY=ON \
        -DDELAM_PETSC=OFF -DDELAM_SANITIZE_LESS= -DDELAM_TEST_OBJECTS= &&
        cmake --build build/ubsan --target delam_sanitized
}

quick_report() {
    check "quick report" /usr/bin/python3 verify/report/make.py --build build/release --out out/report-quick --quick --no-pages
}

each_file_alone() {
    check "each file by itself" /usr/bin/python3 verify/style/alone.py build/release
}

# BLAS with threads of its own is not instrumented: one thread each.
threads_checked() {
    OMP_THREAD_LIMIT=1 CK_FORK=no CK_DEFAULT_TIMEOUT=0 TSAN_OPTIONS="suppressions=$PWD/verify/faults/tsan.supp" "$@"
}

thread_sanitizer() {
    check "build with the thread sanitizer" build tsan -DDELAM_BUILD_CLI=OFF -DDELAM_BUILD_EXAMPLES=OFF -DDELAM_PETSC=OFF
    check "thread sanitizer, 8 islands" threads_checked build/tsan/verify/fault_threads 4
    check "thread sanitizer, the library's own threads" threads_checked build/tsan/verify/case_test_host_march
    check "thread sanitizer, cancel from another thread" threads_checked build/tsan/verify/case_test_threads_host
}

clang() {
    check "clang without warnings" build clang
}

# valgrind does not know AVX-512.
memory_checked() {
    OPENBLAS_CORETYPE=Haswell CK_FORK=no CK_DEFAULT_TIMEOUT=0 valgrind --quiet --error-exitcode=9 --leak-check=full \
        --errors-for-leak-kinds=definite "$1"
}

# valgrind PART PARTS: every PARTS-th of the unit tests and two cases, from number PART on.
valgrind_part() {
    local program count=0
    for program in build/release/verify/unit_test_* build/release/verify/case_test_{capi,single_pair}; do
        # test_choose counts what is allocated, which valgrind takes out of its hands.
        if [[ ! -x $program || ! -f $program || $program == *test_long_* || $program == *test_choose ]]; then
            continue
        fi
        if ((count++ % $2 == $1 - 1)); then
            check "valgrind $(basename "$program")" memory_checked "$program"
        fi
    done
}
