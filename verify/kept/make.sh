#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash make.sh BUILD FOLDER: makes the data of FOLDER with the program, the library and the header of a build folder,
# from FOLDER/scenes and FOLDER/hosts/*.c. Everything runs inside FOLDER, so that the data have no path of this machine.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
build=$(cd "$1" && pwd)
source=$(sed -n 's/^CMAKE_HOME_DIRECTORY:INTERNAL=//p' "$build/CMakeCache.txt")
cd "$2"
export PATH=$build/bin:$PATH LD_LIBRARY_PATH=$build/lib OPENBLAS_NUM_THREADS=1
whole=ductile               # this result keeps all of its files
interrupted="mixed returns" # these are also interrupted, in step 8

rm -rf results interrupted
for scene in scenes/*; do
    name=$(basename "${scene%.*}")
    delam run "$scene" --out "results/$name" >/dev/null
    [[ $name == "$whole" ]] || rm -f "results/$name"/{fields.h5,fields.xdmf,state.bin}
done
for name in $interrupted; do
    until /usr/bin/python3 "$here/interrupt.py" 8 delam run "scenes/$name.toml" --out "interrupted/$name"; do
        rm -rf "interrupted/$name"
    done
    find "interrupted/$name" -maxdepth 1 -type f -delete # what --resume needs is in running
done
for file in hosts/*.c; do
    host=${file%.c}
    gcc -std=c99 -O2 -s -o "$host" "$file" -I"$source/include" -L"$build/lib" -ldelam -lm
    "$host" >"$host.csv"
    "$host" save "$host.state" >/dev/null
done
delam --version
du -sh .
