#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bundle.sh [--check] WORK: bundles the page of `delam view` into view.html beside this script, with the packages of
# package-lock.json, which npm fetches into the folder WORK once.
#   --check   writes nothing here: exit code 1 if view.html is not what its sources give, 77 where the packages cannot
#             be had
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
check=no
if [[ ${1:-} == --check ]]; then
    check=yes
    shift
fi
if (($# != 1)); then
    sed -n '3,/^set -/s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 2
fi

# absent WHY: the packages cannot be had.
absent() {
    printf 'skipped: %s\n' "$1" >&2
    exit 77
}

mkdir -p "$1"
work=$(cd "$1" && pwd)
node=$(command -v node || command -v nodejs) || absent "node is not there (Debian: nodejs)"
# The packages stay until others are pinned.
if ! cmp -s "$here/package-lock.json" "$work/fetched.json"; then
    command -v npm >/dev/null || absent "npm is not there (Debian: npm)"
    rm -f "$work/fetched.json"
    cp "$here/package.json" "$here/package-lock.json" "$work/"
    if ! (cd "$work" && npm ci --ignore-scripts --legacy-peer-deps --no-audit --no-fund --fetch-retries=1 --fetch-timeout=60000) \
        >"$work/npm.log" 2>&1; then
        cat "$work/npm.log" >&2
        if grep -q EINTEGRITY "$work/npm.log"; then
            printf 'npm: the packages are not those of package-lock.json\n' >&2
            exit 1
        fi
        absent "npm could not fetch its packages"
    fi
    cp "$here/package-lock.json" "$work/fetched.json"
fi

"$node" "$here/bundle.mjs" "$work" "$work/view.html"
if [[ $check == no ]]; then
    cp "$work/view.html" "$here/view.html"
elif ! cmp "$work/view.html" "$here/view.html"; then
    printf 'view.html is not what its sources give: bash bindings/cli/view/bundle.sh out/view bundles it anew\n' >&2
    exit 1
fi
