#!/usr/bin/env bash
# Writes manual pages and completions as they lie under share/, made by the command itself.
# usage: manual.sh COMMAND FOLDER
set -euo pipefail
command=$1 folder=$2
rm -rf "$folder"
mkdir -p "$folder"/man/man1 "$folder"/bash-completion/completions \
  "$folder"/zsh/vendor-completions "$folder"/fish/vendor_completions.d
"$command" manual >"$folder/man/man1/obscura.1"
for name in $("$command" manual | sed -n 's/^\.BR obscura\\-\([a-z]*\) (1).*/\1/p'); do
  "$command" manual "$name" >"$folder/man/man1/obscura-$name.1"
done
gzip -9n "$folder"/man/man1/*.1
"$command" completions bash >"$folder/bash-completion/completions/obscura"
"$command" completions zsh >"$folder/zsh/vendor-completions/_obscura"
"$command" completions fish >"$folder/fish/vendor_completions.d/obscura.fish"
