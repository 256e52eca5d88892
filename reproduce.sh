#!/usr/bin/env bash
# Runs the main job: renders the scenes, synthesises novel views, measures them and writes the report.
# Arguments go to `plenolab reproduce`, e.g. ./reproduce.sh altmeier-fig-31
set -euo pipefail
cd "$(dirname "$0")"

preset=${PLENOLAB_PRESET:-release}
scripts/build.sh "$preset" plenolab
exec "build/$preset/bin/plenolab" reproduce "$@"
