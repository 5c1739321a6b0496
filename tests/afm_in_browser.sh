#!/bin/bash
# Opens the report of an AFM run in headless Chromium: it must draw its charts and raise no error, offline.
#
# usage: afm_in_browser.sh PULVIS SOURCE_DIR [FOLDER]
#   PULVIS      the program
#   SOURCE_DIR  where scenes/afm lies
#   FOLDER      where to leave report and screenshot; without it they are removed
set -euo pipefail

pulvis=$1
source_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=${3:-$work/run}

browse() {  # browse OPTION...
  timeout 100 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync \
    --user-data-dir="$work/profile" --virtual-time-budget=10000 --enable-logging=stderr \
    --window-size=1200,2300 "$@" "file://$out/report.html"
}

fail() {
  echo "FAILED: $1" >&2
  exit 1
}

"$pulvis" run "$source_dir/scenes/afm/loop-beam-12.5.toml" --overwrite -o "$out" >"$work/out.txt" ||
  fail "the run: $(tail -5 "$work/out.txt")"
browse --dump-dom >"$work/page.html" 2>"$work/log.txt" || fail "chromium: $(tail -3 "$work/log.txt")"
if grep ':CONSOLE' "$work/log.txt"; then fail "the console has messages"; fi
body=$(grep -o '<body[^>]*>' "$work/page.html" | head -1)
[[ $body != *data-error* ]] || fail "$body"
[[ $body == *'data-ready="1"'* && $body == *'data-charts="4"'* ]] || fail "not ready: $body"
drawn=$(grep -o 'class="u-wrap"' "$work/page.html" | wc -l)
[[ $drawn -eq 4 ]] || fail "$drawn charts on the page, not 4"
grep -q 'torsion and lateral bending' "$work/page.html" || fail "no closed form on the page"
browse --screenshot="$out/report.png" >/dev/null 2>&1
echo "ok: afm"
