#!/usr/bin/env bash
# Shows that check_layers.sh fails on a tree that breaks a rule.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
tree=$(mktemp -d)
trap 'rm -rf "$tree"' EXIT
mkdir -p "$tree"/{include,support,apps,examples,src/core,src/screen/line,src/screen/point}
expect_failure() {
  if "$here/check_layers.sh" "$tree" >/dev/null 2>&1; then
    echo "check_layers_test: a broken rule passed: $1" >&2
    exit 1
  fi
}
"$here/check_layers.sh" "$tree" >/dev/null
echo '#include "screen/point/point.h"' >"$tree/src/screen/line/line.cpp"
expect_failure 'an estimator includes another'
echo '#include "support/image.h"' >"$tree/src/screen/line/line.cpp"
expect_failure 'the library includes support'
echo '#include "view/geometry.h"' >"$tree/src/core/a.cpp"
: >"$tree/src/screen/line/line.cpp"
expect_failure 'core includes view'
