#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# usage: tests/hardcases/table.sh BUILD_DIR
# The results of the hard cases that the tests in BUILD_DIR wrote, beside the catalogue: printed, and kept as
# BUILD_DIR/hardcases.md. Fails where a criterion failed, or a case of the catalogue has no result and no reason.
set -euo pipefail

here="$(dirname -- "${BASH_SOURCE[0]}")"
results="${1:?usage: tests/hardcases/table.sh BUILD_DIR}/hardcases.tsv"
table="$1/hardcases.md"
[[ -f $results ]] || { echo "no $results: run the tests first" >&2; exit 1; }

code=0
awk '
  function row(a, b, c, d) { printf "| %s | %s | %s | %s |\n", a, b, c, d }
  FNR == NR { split($0, f, "\t"); rows[f[1]] = rows[f[1]] $0 "\n"; known[f[1]] = 0; next }
  /^#/ || NF == 0 { next }
  {
    if (!headed++) { row("case", "criterion", "measured", "verdict"); row("---", "---", "---", "---") }
    split($0, f, / *\| */)
    id = f[1]; known[id] = 1
    if (f[3] != "-") { row(id, f[2], "does not apply: " f[3], "-"); next }
    lines = split(rows[id], line, "\n")
    tried = 0
    for (i = 1; i < lines; ++i) {
      split(line[i], g, "\t")
      row(id, g[2], g[3], g[4])
      if (g[4] != "skipped") tried = 1
      if (g[4] != "skipped" && g[4] != "pass") bad = 1
    }
    if (!tried) { row(id, f[2], "no result", "FAIL"); bad = 1 }
  }
  END {
    for (id in known) if (!known[id]) { row(id, "not in the catalogue", "", "FAIL"); bad = 1 }
    exit bad
  }' <(sort -u "$results") "$here/catalogue.txt" >"$table" || code=1
cat -- "$table"
exit "$code"
