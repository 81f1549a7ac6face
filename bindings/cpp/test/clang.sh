#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# clang.sh FOLDER INCLUDE [all]: no warning of clang in each header alone, C++17, and in the tests, which take all headers, C++17 and
# C++20; with `all` (the long tier) in each header alone in C++20, too.
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
for file in "$folder"/include/delam/*.hpp "$folder"/include/delam/cpp/*.hpp; do
    check 17 "$file"
    if [ "$3" = all ]; then
        check 20 "$file"
    fi
done
for file in "$folder"/test/*.cpp; do
    check 17 "$file"
    check 20 "$file"
done
echo "no warning"
