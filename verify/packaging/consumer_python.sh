#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The Python package, installed by pip without network, finds the installation through pkg-config.
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
/usr/bin/python3 -c 'import pip, numpy' 2>/dev/null || skip "pip or numpy is not installed"
PKG_CONFIG_PATH=$(dirname "$(find "$STAGE" -name delam.pc)")
export PKG_CONFIG_PATH PYTHONPATH=$work/site PYTHONDONTWRITEBYTECODE=1 OPENBLAS_NUM_THREADS=1
unset DELAM_LIBRARY LD_LIBRARY_PATH

quietly /usr/bin/python3 -m pip install --no-index --no-deps --target "$work/site" "$SOURCE/bindings/python"
cd "$work"
loaded=$(/usr/bin/python3 -c 'import delam; print(delam.library_location())')
# A library in the loader's own paths goes first, by its name alone.
if [[ $loaded != /* ]]; then
    skip "a libdelam that the loader finds goes before the one in $STAGE"
fi
[[ $(realpath "$loaded") == "$(realpath "$STAGE")"/* ]] || fail "the package loads '$loaded', not the library in $STAGE"
if [[ -n ${REFERENCE:-} ]]; then
    /usr/bin/python3 "$SOURCE/verify/cases/same_history.py" "$REFERENCE" /usr/bin/python3 "$SOURCE/examples/enf/enf.py"
else
    /usr/bin/python3 "$SOURCE/examples/enf/enf.py" history.csv
fi
