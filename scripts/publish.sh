#!/usr/bin/env bash
# Keeps the small part of a full run under version control: scripts/publish.sh [RUN_FOLDER]
# Tables, plots, sentences, run.json and the pictures of the README go to results/published; the report and all other
# images stay behind.
set -euo pipefail
cd "$(dirname "$0")/.."

run=${1:-results/reproduce}
target=results/published
if [ ! -f "$run/run.json" ]; then
  echo "$run holds no run.json: run ./reproduce.sh first" >&2
  exit 1
fi
if [ "$(realpath "$run")" = "$(realpath -m "$target")" ]; then
  echo "$run is where results are published to: name the folder of a run" >&2
  exit 1
fi

fresh=$(mktemp -d results/.published-XXXXXX)
trap 'rm -rf "$fresh"' EXIT
cp "$run/run.json" "$fresh/"
for item in "$run"/*/; do
  name=$(basename "$item")
  mkdir -p "$fresh/$name"
  find "$item" -maxdepth 1 \( -name '*.svg' -o -name '*.csv' -o -name 'text.md' \) ! -name '*-dark.svg' -size -200k \
    -exec cp {} "$fresh/$name/" \;
done
mkdir "$fresh/images"
for scene in cellar boats; do
  cp "$run/synthesis-quality/$scene"-{ground-truth,synthesised,difference,visibility}.png "$fresh/images/"
done
rm -rf "$target"
mv "$fresh" "$target"
chmod 755 "$target"
du -sh "$target"
