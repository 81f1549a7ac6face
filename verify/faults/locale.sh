#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# locale.sh NAME PROGRAM [ARGUMENT ...]: makes the locale NAME.UTF-8 in the working directory, whether the machine has
# it or not, and runs PROGRAM ARGUMENT ... NAME.UTF-8 with it.
name=$1
shift
if ! command -v localedef >/dev/null || ! [ -e "/usr/share/i18n/locales/$name" ]; then
    echo "skipped: needs localedef and the sources of locale $name (package locales)"
    exit 77
fi
mkdir -p locales
if ! [ -d "locales/$name.UTF-8" ]; then
    # Made elsewhere and moved in one step: tests that run at the same time want the same one, and none may see half of it.
    making=$(mktemp -d "locales/$name.XXXXXX")
    localedef --no-archive -i "$name" -f UTF-8 "$making/$name.UTF-8" || exit 1
    mv -T "$making/$name.UTF-8" "locales/$name.UTF-8" 2>/dev/null || [ -d "locales/$name.UTF-8" ] || exit 1
    rm -rf "$making"
fi
LOCPATH=$PWD/locales exec "$@" "$name.UTF-8"
