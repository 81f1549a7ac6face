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

# same_history PROGRAM: it runs with the installed library, and same_numbers.
same_history() {
    local loaded
    loaded=$(ldd "$1" | sed -n 's/.*libdelam\.so[^ ]* => \([^ ]*\).*/\1/p')
    [[ $loaded == "$STAGE"/* ]] || fail "$1 loads '$loaded', not the library in $STAGE"
    same_numbers "$1"
}

# same_numbers PROGRAM: it writes the history of the build folder's host.
same_numbers() {
    if [[ -n ${REFERENCE:-} ]]; then
        /usr/bin/python3 "$SOURCE/verify/cases/same_history.py" "$REFERENCE" "$1"
    else
        "$1" "$work/history.csv"
    fi
}

# unpack_tarball: the source tarball of the commit, made anew, in $work/delam-$VERSION; `alone` in front of a command then
# runs it without git and without a network where the system lets us (cut_off=yes), else with proxies that lead nowhere.
unpack_tarball() {
    if [[ ! -e $SOURCE/.git ]] || ! commit=$(git -C "$SOURCE" rev-parse HEAD 2>/dev/null); then
        skip "no git, or the sources are not a checkout"
    fi
    quietly "$CMAKE" --build "$BUILD" --target dist
    tar -xzf "$BUILD/delam-$VERSION.tar.gz" -C "$work"
    alone=(env http_proxy=http://127.0.0.1:9 https_proxy=http://127.0.0.1:9 GIT_CEILING_DIRECTORIES="$work")
    cut_off=no
    if unshare -rn true 2>/dev/null; then
        alone+=(unshare -rn)
        cut_off=yes
    fi
}
