# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash
# To be sourced by verify/run.sh: the stages of the suite, each a build and what runs on it.

# build PRESET OPTIONS...: configures and builds.
build() {
    local preset=$1
    shift
    cmake --preset "$preset" "$@" && cmake --build --preset "$preset"
}

# build_release: builds everything; what verify/run.sh has installed packages for must be found.
build_release() {
    build release -DDELAM_BUILD_TESTS=ON -DDELAM_STATIC=ON -DDELAM_PETSC=ON -DDELAM_GMSH=ON -DDELAM_BUILD_FORTRAN=ON
}

# What builds with sanitizers have in common.
sanitized_build=(-DDELAM_BUILD_TESTS=ON -DDELAM_BUILD_CLI=OFF -DDELAM_BUILD_EXAMPLES=OFF -DDELAM_PETSC=OFF -DDELAM_UNITY=ON)

# sanitized: runs the unit tests, the light cases and the fuzzer's corpus with sanitizers, in the programs of the release
# build, linked with the instrumented library. Five checks of UBSan, which more than double the time of the build, belong
# to sanitized_whole; AddressSanitizer reports what three of them would find when the access happens.
sanitized() {
    check "build with sanitizers" build asan "${sanitized_build[@]}" \
        -DDELAM_SANITIZE_LESS=alignment,null,object-size,vptr,pointer-overflow "-DDELAM_TEST_OBJECTS=$PWD/build/release"
    CK_FORK=no tests build/asan -j2 --label-regex '^sanitized$'
}

# sanitized_whole: runs the same with every check, also in the programs of the tests.
sanitized_whole() {
    check "build with every check of the sanitizers" build_sanitized_whole
    CK_FORK=no tests build/ubsan -j2 --label-regex '^sanitized$'
}

build_sanitized_whole() {
    cmake --preset asan -B build/ubsan "${sanitized_build[@]}" -DDELAM_SANITIZE_LESS= -DDELAM_TEST_OBJECTS= &&
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
    check "build with the thread sanitizer" build tsan "${sanitized_build[@]}"
    check "thread sanitizer, 8 islands" threads_checked build/tsan/verify/fault_threads 4
    check "thread sanitizer, the library's own threads" threads_checked build/tsan/verify/case_test_host_analysis
    check "thread sanitizer, cancel from another thread" threads_checked build/tsan/verify/case_test_threads_host
}

clang() {
    check "clang without warnings" build clang -DDELAM_BUILD_TESTS=ON
}
