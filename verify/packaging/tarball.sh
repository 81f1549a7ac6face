#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The source tarball of the commit is complete: it configures where there is no network and no git, and knows its
# commit.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
if [[ ! -e $SOURCE/.git ]] || ! commit=$(git -C "$SOURCE" rev-parse HEAD 2>/dev/null); then
    skip "no git, or the sources are not a checkout"
fi
quietly "$CMAKE" --build "$BUILD" --target dist
tar -xzf "$BUILD/delam-$VERSION.tar.gz" -C "$work"
[[ -f $work/delam-$VERSION/LICENSE ]] || fail "the tarball has no delam-$VERSION/LICENSE"

# Without a network where the system lets us, else with proxies that lead nowhere.
alone=(env http_proxy=http://127.0.0.1:9 https_proxy=http://127.0.0.1:9 GIT_CEILING_DIRECTORIES="$work")
if unshare -rn true 2>/dev/null; then
    alone+=(unshare -rn)
fi
quietly "${alone[@]}" "$CMAKE" -S "$work/delam-$VERSION" -B "$work/build" -DCMAKE_BUILD_TYPE=Release \
    -DCMAKE_C_COMPILER="$CC" -DCMAKE_CXX_COMPILER="$CXX" -DDELAM_BUILD_CLI="$(has cli && echo ON || echo OFF)"
quietly "$CMAKE" --build "$work/build" --target delam_commit
grep -q "\"${commit:0:12}\"" "$work/build/generated/delam_commit.h" || fail "the tarball does not know ${commit:0:12}"
printf 'configured without network: %d files\n' "$(find "$work/delam-$VERSION" -type f | wc -l)"
