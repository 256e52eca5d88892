#!/usr/bin/env bash
# Fuzzes every parser of outside data for the given number of seconds each, two at a time: scripts/fuzz.sh SECONDS
# A finding is written to build/fuzz/findings and fails the run.
set -euo pipefail
cd "$(dirname "$0")/.."

seconds=${1:-60}
scripts/build.sh fuzz fuzzers
findings=build/fuzz/findings
mkdir -p "$findings"

fuzz_one() {
  local program=$1 seconds=$2 findings=$3
  local name=${program##*/fuzz_}
  local corpus
  corpus=$(mktemp -d)
  if ! "$program" -max_total_time="$seconds" -timeout=10 -rss_limit_mb=2048 -artifact_prefix="$findings/$name-" \
      "$corpus" "tests/fuzz/corpus/$name" > "build/fuzz/$name.log" 2>&1; then
    tail -n 40 "build/fuzz/$name.log"
    echo "fuzz_$name: FAILED, see $findings"
    return 1
  fi
  echo "fuzz_$name: $(grep -oE 'Done [0-9]+ runs' "build/fuzz/$name.log"), no finding"
  rm -rf "$corpus"
}
export -f fuzz_one
printf '%s\0' build/fuzz/bin/fuzz_* | xargs -0 -P 2 -I{} bash -c 'fuzz_one "$@"' _ {} "$seconds" "$findings"
