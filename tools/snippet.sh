#!/usr/bin/env bash
# Takes C++ out of the pages, so that the tests compile it.
# usage: tools/snippet.sh PAGE NAME FOLDER   writes the block after <!-- compiled: NAME --> as
#                                            FOLDER/NAME_includes.inc and FOLDER/NAME.inc
#        tools/snippet.sh --check PAGE...    every ```cpp block has such a marker
set -euo pipefail
if [ "$1" = --check ]; then
  shift
  awk 'FNR == 1 { before = "" }
    /^```cpp/ && before !~ /^<!-- compiled: [a-z_]+ -->$/ {
      print FILENAME ":" FNR ": no <!-- compiled: NAME --> above the block"; bad = 1 }
    { before = $0 }
    END { exit bad }' "$@"
  exit
fi
page=$1 name=$2 folder=$3
mkdir -p "$folder"
block=$(awk -v marker="<!-- compiled: $name -->" '
  /^```/ && inside { exit }
  inside { print }
  /^```cpp/ && before == marker { inside = 1 }
  { before = $0 }' "$page")
if [ -z "$block" ]; then
  echo "snippet.sh: no C++ after <!-- compiled: $name --> in $page" >&2
  exit 1
fi
grep '^#include' <<<"$block" >"$folder/${name}_includes.inc" || true
grep -v '^#include' <<<"$block" >"$folder/$name.inc"
