#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# bash bindings/site/site.sh: installs what is missing, builds, and makes the site: build/release/site/html/index.html.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
# shellcheck source=verify/packages.sh
source verify/packages.sh
delam_install "${DELAM_PACKAGES[@]}" "${DELAM_TEST_PACKAGES[@]}" "${DELAM_SITE_PACKAGES[@]}"
delam_blas
cmake --preset release -DDELAM_BUILD_TESTS=ON
cmake --build --preset release --target site
