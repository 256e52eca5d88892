#!/usr/bin/env bash
# Builds and runs all tests. Arguments go to ctest, e.g. ./test.sh -R synthesis
# Some tests read data from outside that is not part of the project, below $PLENOLAB_OUTSIDE_DATA; they skip without it.
# PLENOLAB_PRESET=debug ./test.sh runs them under the address and undefined-behaviour sanitizers.
set -euo pipefail
cd "$(dirname "$0")"

preset=${PLENOLAB_PRESET:-release}
scripts/build.sh "$preset"
exec ctest --preset "$preset" --parallel 2 "$@"
