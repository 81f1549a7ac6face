#!/bin/sh
# SPDX-License-Identifier: BSD-3-Clause
# run.sh TEST: one test file; skipped, with a word, where what it needs is missing.
set -eu
if ! /usr/bin/python3 -c 'import jinja2, matplotlib' 2>/dev/null; then
    echo 'skipped: python3-jinja2 or python3-matplotlib is missing'
    exit 77
fi
exec env PYTHONDONTWRITEBYTECODE=1 /usr/bin/python3 "$1"
