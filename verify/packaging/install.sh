#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Installs the build folder into a temporary prefix and moves it: nothing there may remember where it was made.
# shellcheck source=verify/packaging/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"
keep_manifests
rm -rf "$STAGE" "$STAGE.first"
quietly "$CMAKE" --install "$BUILD" --prefix "$STAGE.first"
mv "$STAGE.first" "$STAGE"
if grep -rIl -e "$STAGE.first" -e "$BUILD" -e "$SOURCE" "$STAGE"; then
    fail "these files name the place where they were made"
fi
if has cli; then
    "$STAGE/bin/delam" --version
fi
find "$STAGE" -type f | wc -l
