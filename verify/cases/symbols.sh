#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# symbols.sh LIBRARY HEADER: the shared library exports what the header declares and nothing else, and of CHOLMOD it names only functions of the modules
# under the LGPL (Core, Cholesky, Partition), so that it links with a CHOLMOD built without the GPL ones.
set -euo pipefail
library=$1
header=$2
status=0

declared=$(grep -oE '\bdelam_[a-z_]+\(' "$header" | tr -d '(' | sort -u)
declared=$(for name in $declared; do grep -qE "DELAM_API .*\b$name\(" "$header" && echo "$name"; done)
exported=$(nm -D --defined-only "$library" | awk '$2 == "T" || $2 == "W" || $2 == "D" || $2 == "B" || $2 == "R" {print $3}' | sed 's/@.*//' | sort -u)
if ! difference=$(diff <(echo "$declared") <(echo "$exported")); then
    printf 'declared (<) and exported (>) differ:\n%s\n' "$difference"
    status=1
fi

allowed='cholmod_l_(start|finish|camd|analyze_p|factorize|solve2|free_factor|free_dense)'
foreign=$(nm -D --undefined-only "$library" | awk '{print $2}' | sed 's/@.*//' | grep '^cholmod_' | grep -vxE "$allowed" || true)
if [[ -n $foreign ]]; then
    printf 'functions of CHOLMOD outside the LGPL modules that are known:\n%s\n' "$foreign"
    status=1
fi
printf 'exported %d, of CHOLMOD %d\n' "$(wc -l <<<"$exported")" "$(nm -D --undefined-only "$library" | grep -c ' cholmod_')"
exit $status
