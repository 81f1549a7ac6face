#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The source tarball of the commit is complete: it configures where there is no network and no git, and knows its
# commit.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
unpack_tarball
[[ -f $work/delam-$VERSION/LICENSE ]] || fail "the tarball has no delam-$VERSION/LICENSE"

quietly "${alone[@]}" "$CMAKE" -S "$work/delam-$VERSION" -B "$work/build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" -DDELAM_BUILD_CLI="$(has cli && echo ON || echo OFF)"
quietly "$CMAKE" --build "$work/build" --target delam_commit
grep -q "\"${commit:0:12}\"" "$work/build/generated/delam_commit.h" || fail "the tarball does not know ${commit:0:12}"
printf 'configured without git, network cut off: %s; %d files\n' "$cut_off" "$(find "$work/delam-$VERSION" -type f | wc -l)"
