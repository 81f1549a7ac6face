#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# clang.sh FOLDER INCLUDE: each header alone and the tests without a warning of clang, in C++17 and C++20.
folder=$1
include=$2
if ! command -v clang++ >/dev/null; then
    echo "skipped: clang is not installed"
    exit 77
fi
for standard in 17 20; do
    for file in "$folder"/include/delam/*.hpp "$folder"/include/delam/cpp/*.hpp "$folder"/test/*.cpp; do
        clang++ -x c++ -std=c++$standard -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Werror -I"$include" \
            -I"$folder/include" -fsyntax-only "$file" || exit 1
    done
done
echo "no warning"
