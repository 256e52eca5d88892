#!/usr/bin/env bash
# Keeps the small part of a full run under version control: scripts/publish.sh [RUN_FOLDER]
# Tables, plots, sentences and run.json go to results/published; images and the report itself stay behind.
set -euo pipefail
cd "$(dirname "$0")/.."

run=${1:-results/reproduce}
target=results/published
if [ ! -f "$run/run.json" ]; then
  echo "$run holds no run.json: run ./reproduce.sh first" >&2
  exit 1
fi
rm -rf "$target"
mkdir -p "$target"
cp "$run/run.json" "$target/"
for item in "$run"/*/; do
  name=$(basename "$item")
  mkdir -p "$target/$name"
  find "$item" -maxdepth 1 \( -name '*.svg' -o -name '*.csv' -o -name 'text.md' \) ! -name '*-dark.svg' -size -200k \
    -exec cp {} "$target/$name/" \;
done
du -sh "$target"
