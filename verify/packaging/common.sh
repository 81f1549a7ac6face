# SPDX-License-Identifier: BSD-3-Clause
# shellcheck shell=bash disable=SC2034,SC2154
# To be sourced by the tests here; CMakeLists.txt sets BUILD, SOURCE, STAGE, PARTS and the tools.
set -euo pipefail
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

fail() {
    printf '%s\n' "$*" >&2
    exit 1
}

skip() {
    printf 'skipped: %s\n' "$*"
    exit 77
}

has() {
    [[ ,$PARTS, == *,$1,* ]]
}

# quietly COMMAND...: its output only when it fails.
quietly() {
    "$@" >"$work/log" 2>&1 || {
        cat "$work/log" >&2
        fail "failed: $*"
    }
}

# keep_manifests, give_back_manifests: the build folder's own record of what its user has installed.
keep_manifests() {
    mkdir -p "$work/manifests"
    find "$BUILD" -maxdepth 1 -name 'install_manifest*.txt' -exec mv {} "$work/manifests" \;
    trap give_back_manifests EXIT
}

give_back_manifests() {
    rm -f "$BUILD"/install_manifest*.txt
    find "$work/manifests" -name 'install_manifest*.txt' -exec mv {} "$BUILD" \;
    rm -rf "$work"
}

# same_history PROGRAM: it runs with the installed library and writes the history of the build folder's host.
same_history() {
    local loaded
    loaded=$(ldd "$1" | sed -n 's/.*libdelam\.so[^ ]* => \([^ ]*\).*/\1/p')
    [[ $loaded == "$STAGE"/* ]] || fail "$1 loads '$loaded', not the library in $STAGE"
    if [[ -n ${REFERENCE:-} ]]; then
        /usr/bin/python3 "$SOURCE/verify/cases/same_history.py" "$REFERENCE" "$1"
    else
        "$1" "$work/history.csv"
    fi
}
