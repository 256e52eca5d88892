#!/usr/bin/env bash
# Installs what is missing, then configures and builds one preset: scripts/build.sh PRESET [TARGET...]
# The first build takes some minutes on two cores; later ones compile only what changed.
set -euo pipefail
cd "$(dirname "$0")/.."

preset=$1
shift
scripts/install-packages.sh packages.txt
export CCACHE_BASEDIR=$PWD
if ! log=$(cmake --preset "$preset" 2>&1); then
  printf '%s\n' "$log" >&2
  exit 1
fi
ninja -C "build/$preset" "$@" >&2
