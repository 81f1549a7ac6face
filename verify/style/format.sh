#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# The layout of our C and C++ is what clang-format 14 makes of it (.clang-format, include/.clang-format).
# Exit code 77 (skipped) where that version is not there; --fix formats the files instead.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."

mode=(--dry-run -Werror)
if [[ ${1:-} == --fix ]]; then
    mode=(-i)
fi
tool=""
for name in clang-format-14 clang-format; do
    if command -v "$name" >/dev/null && "$name" --version | grep -q 'version 14\.'; then
        tool=$name
        break
    fi
done
if [[ -z $tool ]]; then
    printf 'clang-format 14 was not found\n'
    exit 77
fi
# The baselines are headers as they were released. A tree without git (a tarball) has nothing but its own files.
sources() {
    if git rev-parse --is-inside-work-tree >/dev/null 2>&1; then
        git ls-files -z --cached --others --exclude-standard -- "$@" ':!verify/abi/baseline'
    else
        local pattern
        for pattern in "$@"; do
            find include src bindings verify examples -name "$pattern" -not -path 'verify/abi/baseline/*' -print0
        done
    fi
}
# One line for each file that differs.
check() {
    local listed
    listed=$(xargs -0 -r "$tool" "$@" "${mode[@]}" 2>&1 | grep -oE '^[^: ]+' | sort -u) || true
    if [[ -n $listed ]]; then
        printf 'not formatted: %s\n' $listed
        return 1
    fi
}
failed=0
sources '*.cpp' '*.hpp' | check || failed=1
sources '*.c' '*.h' | check --style=file:include/.clang-format || failed=1
exit "$failed"
