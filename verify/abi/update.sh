#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash verify/abi/update.sh LIBRARY [VERSION] [--break]: remakes symbols.txt and the baseline from today's header and
# LIBRARY; and symbols_petsc.txt with its part of the baseline where libdelam-petsc.so lies beside it.
#   LIBRARY   build/release/lib/libdelam.so, with the debug information of its façade
#   VERSION   written behind functions that are new; default: the project's, major.minor
#   --break   also when something that is promised changes or goes. After a release DELAM_ABI must then be raised.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
library=
version=$(sed -n 's/^project(delam VERSION \([0-9]*\.[0-9]*\)\..*/\1/p' "$root/CMakeLists.txt")
breaking=no
status=0
for argument in "$@"; do
    case $argument in
        --break) breaking=yes ;;
        [0-9]*.[0-9]*) version=$argument ;;
        *) library=$argument ;;
    esac
done
if [[ -z $library || ! -f $library ]]; then
    printf 'usage: bash verify/abi/update.sh LIBRARY [VERSION] [--break]\n' >&2
    exit 2
fi
header=$root/include/delam/delam.h
petsc=$root/include/delam/petsc.h
petsc_library=$(dirname "$library")/libdelam-petsc.so
on_top=(--base "$header")

if [[ -f $here/baseline/delam.abi && $breaking == no ]]; then
    if ! /usr/bin/python3 "$here/gate.py" baseline --header "$header" ||
        ! /usr/bin/python3 "$here/gate.py" abidiff --header "$header" --library "$library" ||
        ! /usr/bin/python3 "$here/promise.py" "$header" ||
        ! /usr/bin/python3 "$here/keys.py" "$library" "$header" --new-defaults ||
        ! OPENBLAS_NUM_THREADS=1 /usr/bin/python3 "$here/meanings.py" "$header" "$library" --new-defaults; then
        printf 'this breaks hosts that exist. On purpose: --break\n' >&2
        exit 1
    fi
fi

if [[ -f $petsc_library && -f $here/baseline/petsc.abi && $breaking == no ]]; then
    /usr/bin/python3 "$here/gate.py" abidiff --header "$petsc" "${on_top[@]}" --library "$petsc_library" || status=$?
    # 77: built with another MPI than the baseline, which stays as it is.
    if ((status == 77)); then
        petsc_library=
    elif ((status != 0)) || ! /usr/bin/python3 "$here/gate.py" baseline --header "$petsc" "${on_top[@]}" ||
        ! /usr/bin/python3 "$here/promise.py" "$petsc" "${on_top[@]}"; then
        printf 'this breaks hosts of libdelam-petsc that exist. On purpose: --break\n' >&2
        exit 1
    fi
fi

new=$(mktemp)
trap 'rm -f "$new"' EXIT

# list HEADER FILE [BASE]: its functions, for the list of symbols.
list() {
    {
        printf '# SPDX-License-Identifier: BSD-3-Clause\n'
        printf '# Exported functions, each with the version that brought it. Written by update.sh.\n'
        /usr/bin/python3 - "$here" "$version" "$@" <<'PYTHON'
import os, sys
here, version, header, path, *base = sys.argv[1:]
sys.path.insert(0, here)
import gate
known = gate.read_list(path) if os.path.exists(path) else {}
for name in sorted(gate.read_header(header, base[0] if base else None).functions):
    print(name, known.get(name, version))
PYTHON
    } >"$new"
    cp "$new" "$2"
}

# declarations HEADER FILE: these alone, words may change at any time.
declarations() {
    /usr/bin/python3 - "$here" "$1" >"$2" <<'PYTHON'
import os, re, sys
sys.path.insert(0, sys.argv[1])
import header
text = header.COMMENT.sub("", open(sys.argv[2], encoding="utf-8").read())
print("/* SPDX-License-Identifier: BSD-3-Clause\n"
      f" * {os.path.basename(sys.argv[2])} of the baseline, without its comments. Written by update.sh. */")
print(re.sub(r"\n\s*\n+", "\n", re.sub(r"[ \t]+$", "", text, flags=re.M)).strip())
PYTHON
}

mkdir -p "$here/baseline/delam"
list "$header" "$here/symbols.txt"
declarations "$header" "$here/baseline/delam/delam.h"
/usr/bin/python3 "$here/promise.py" "$header" --write >"$here/baseline/contract.txt"
/usr/bin/python3 "$here/keys.py" "$library" "$header" --write >"$here/baseline/keys.txt"
OPENBLAS_NUM_THREADS=1 /usr/bin/python3 "$here/meanings.py" "$header" "$library" --write >"$new"
cp "$new" "$here/baseline/meanings.txt"
/usr/bin/python3 "$here/gate.py" abixml --header "$header" --library "$library" >"$new"
cp "$new" "$here/baseline/delam.abi"
if [[ -f $petsc_library ]]; then
    list "$petsc" "$here/symbols_petsc.txt" "$header"
    declarations "$petsc" "$here/baseline/delam/petsc.h"
    /usr/bin/python3 "$here/promise.py" "$petsc" "${on_top[@]}" --write >"$here/baseline/contract_petsc.txt"
    /usr/bin/python3 "$here/gate.py" abixml --header "$petsc" "${on_top[@]}" --library "$petsc_library" >"$new"
    cp "$new" "$here/baseline/petsc.abi"
    printf '%s functions in symbols_petsc.txt\n' "$(grep -vc '^#' "$here/symbols_petsc.txt")"
else
    printf 'libdelam-petsc: its part of the baseline is left as it is\n'
fi
printf '%s functions in symbols.txt and the baseline\n' "$(grep -vc '^#' "$here/symbols.txt")"
