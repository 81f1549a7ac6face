#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash verify/abi/update.sh LIBRARY [VERSION] [--break]: remakes symbols.txt and the baseline from today's header and
# LIBRARY.
#   LIBRARY   build/release/lib/libdelam.so, with the debug information of its façade
#   VERSION   written behind functions that are new; default: the project's, major.minor
#   --break   also when something that is promised changes or goes. After a release DELAM_ABI must then be raised.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$here/../..
library=
version=$(sed -n 's/^project(delam VERSION \([0-9]*\.[0-9]*\)\..*/\1/p' "$root/CMakeLists.txt")
breaking=no
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

new=$(mktemp)
trap 'rm -f "$new"' EXIT
{
    printf '# SPDX-License-Identifier: BSD-3-Clause\n'
    printf '# Exported functions, each with the version that brought it. Written by update.sh.\n'
    /usr/bin/python3 - "$here" "$header" "$version" <<'PYTHON'
import os, sys
here, header, version = sys.argv[1:]
sys.path.insert(0, here)
import gate, header as headers
path = os.path.join(here, "symbols.txt")
known = gate.read_list(path) if os.path.exists(path) else {}
for name in sorted(headers.read(header).functions):
    print(name, known.get(name, version))
PYTHON
} >"$new"
cp "$new" "$here/symbols.txt"
mkdir -p "$here/baseline/delam"
# Declarations alone: words may change at any time.
/usr/bin/python3 - "$here" "$header" >"$here/baseline/delam/delam.h" <<'PYTHON'
import re, sys
sys.path.insert(0, sys.argv[1])
import header
text = header.COMMENT.sub("", open(sys.argv[2], encoding="utf-8").read())
print("/* SPDX-License-Identifier: BSD-3-Clause\n"
      " * delam.h of the baseline, without its comments. Written by update.sh. */")
print(re.sub(r"\n\s*\n+", "\n", re.sub(r"[ \t]+$", "", text, flags=re.M)).strip())
PYTHON
/usr/bin/python3 "$here/promise.py" "$header" --write >"$here/baseline/contract.txt"
/usr/bin/python3 "$here/keys.py" "$library" "$header" --write >"$here/baseline/keys.txt"
OPENBLAS_NUM_THREADS=1 /usr/bin/python3 "$here/meanings.py" "$header" "$library" --write >"$new"
cp "$new" "$here/baseline/meanings.txt"
/usr/bin/python3 "$here/gate.py" abixml --header "$header" --library "$library" >"$new"
cp "$new" "$here/baseline/delam.abi"
printf '%s functions in symbols.txt and the baseline\n' "$(grep -vc '^#' "$here/symbols.txt")"
