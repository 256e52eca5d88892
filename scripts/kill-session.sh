#!/usr/bin/env bash
# Kills a running session after random events, the given number of times (default 200), and checks each time that every
# acknowledged event is there, the database is sound, and the resumed session ends as an uninterrupted one does:
# scripts/kill-session.sh [KILLS]
set -euo pipefail
cd "$(dirname "$0")/.."

preset=${PLENOLAB_PRESET:-release}
scripts/build.sh "$preset" plenolab test_experiments
PLENOLAB_KILLS=${1:-200} "build/$preset/bin/test_experiments" --gtest_filter='KilledSession.*'
