#!/usr/bin/env bash
# Builds and runs all tests. Arguments go to ctest, e.g. ./test.sh -R synthesis
# PLENOLAB_PRESET=debug ./test.sh runs them under the address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "$0")"

preset=${PLENOLAB_PRESET:-release}
# Some tests read data from outside that is not part of the project; they skip without it.
if [ -z "${PLENOLAB_OUTSIDE_DATA:-}" ] && [ -d ../shared/data ]; then
  export PLENOLAB_OUTSIDE_DATA=$PWD/../shared/data
fi
scripts/build.sh "$preset"
exec ctest --preset "$preset" --parallel 2 "$@"
