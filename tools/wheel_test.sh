#!/usr/bin/env bash
# Makes a wheel of a build folder and runs the Python tests in a fresh environment that has it:
# wheel_test.sh BUILD
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
OBSCURA_BUILD_FOLDER=$(realpath "$1")
export OBSCURA_BUILD_FOLDER
# What setuptools leaves beside setup.py belongs elsewhere.
mkdir -p "$folder/source/bindings"
cp -r bindings/python "$folder/source/bindings/"
cp -r include "$folder/source/"
/usr/bin/python3 -m pip wheel --quiet --no-build-isolation --no-deps --no-index \
  --wheel-dir "$folder/wheels" "$folder/source/bindings/python"
# NumPy and pytest are Debian's.
/usr/bin/python3 -m venv --system-site-packages "$folder/venv"
"$folder/venv/bin/pip" install --quiet --no-index --no-deps "$folder"/wheels/obscura-*.whl
cp -r bindings/python/tests "$folder/tests"
cd "$folder"
env -u PYTHONPATH venv/bin/python -c '
import obscura, sys
assert obscura.__file__.startswith(sys.prefix), obscura.__file__
print(obscura.__version__, obscura.__file__)'
env -u PYTHONPATH venv/bin/python -m pytest -q -p no:cacheprovider tests
ls -l "$folder"/wheels | awk 'NR > 1 { printf "wheel: %.1f MB\n", $5 / 1e6 }'
