#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The target `uninstall` removes what was installed and leaves what was there before.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
keep_manifests
mkdir -p "$work/prefix/lib" "$work/prefix/share/delam" "$work/destination"
touch "$work/prefix/lib/other.so" "$work/prefix/share/delam/mine.txt"
script=$SOURCE/src/package/uninstall.cmake
if "$CMAKE" -DBUILD="$BUILD" -P "$script" >"$work/log" 2>&1; then
    fail "uninstalled without a manifest"
fi
grep -q 'has no install_manifest' "$work/log" || fail "no word of the missing manifest"
quietly "$CMAKE" --install "$BUILD" --prefix "$work/prefix"
[[ -e $work/prefix/include/delam/delam.h ]] || fail "nothing was installed"
if has static && [[ -z $(find "$work/prefix" -name libdelam.a) ]]; then
    fail "no libdelam.a was installed"
fi
quietly "$CMAKE" --build "$BUILD" --target uninstall
left=$(cd "$work/prefix" && find . ! -type d | sort)
[[ $left == $'./lib/other.so\n./share/delam/mine.txt' ]] || fail "left behind: $left"
[[ ! -d $work/prefix/include/delam ]] || fail "an empty folder include/delam is left"

export DESTDIR=$work/destination
quietly "$CMAKE" --install "$BUILD" --prefix /opt/delam
[[ -e $DESTDIR/opt/delam/include/delam/delam.h ]] || fail "nothing was installed below DESTDIR"
quietly "$CMAKE" -DBUILD="$BUILD" -P "$script"
left=$(find "$DESTDIR" ! -type d)
[[ -z $left ]] || fail "left behind: $left"
printf 'nothing left, nothing else removed\n'
