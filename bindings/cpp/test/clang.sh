#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# clang.sh FOLDER INCLUDE [all]: no warning of clang in the header delam.hpp alone, C++17, and in the tests, which take all headers, one as
# C++17, one as C++20; with `all` (the long tier) in each header alone and in each test, C++17 and C++20.
folder=$1
include=$2
if ! command -v clang++ >/dev/null; then
    echo "skipped: clang is not installed"
    exit 77
fi
check() {
    clang++ -x c++ -std=c++"$1" -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I"$include" \
        -I"$folder/include" -fsyntax-only "$2" || exit 1
}
if [ "$3" = all ]; then
    for file in "$folder"/include/delam/*.hpp "$folder"/include/delam/cpp/*.hpp "$folder"/test/*.cpp; do
        check 17 "$file"
        check 20 "$file"
    done
else
    check 17 "$folder/include/delam/delam.hpp"
    check 17 "$folder/test/test_host_hpp.cpp"
    check 20 "$folder/test/test_delam_hpp.cpp"
fi
echo "no warning"
