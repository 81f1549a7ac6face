#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The source tarball of the commit builds where there is no network and no git: the library and the host of examples/enf,
# whose history is that of the build folder's and of examples/reference.csv.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
[[ -n ${REFERENCE:-} ]] || skip "the host of examples/enf is not built"
unpack_tarball
if [[ $cut_off == yes ]]; then
    printf 'network: none\n'
else
    printf 'network: not cut off, the system does not allow it (unshare -rn); proxies lead nowhere\n'
fi
quietly "${alone[@]}" "$CMAKE" -S "$work/delam-$VERSION" -B "$work/build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" -DDELAM_BUILD_CLI=OFF -DDELAM_BUILD_TESTS=OFF
quietly "${alone[@]}" "$CMAKE" --build "$work/build" --target delam example_enf
loaded=$(ldd "$work/build/bin/enf" | sed -n 's/.*libdelam\.so[^ ]* => \([^ ]*\).*/\1/p')
[[ $loaded == "$work/build"/* ]] || fail "the host loads '$loaded', not the library of the tarball"
/usr/bin/python3 "$SOURCE/verify/cases/same_history.py" --scene enf "$REFERENCE" "$work/build/bin/enf"
