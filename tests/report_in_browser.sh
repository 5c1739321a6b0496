#!/bin/bash
# Opens reports in headless Chromium: they must draw their picture and raise no error, offline.
#
# usage: report_in_browser.sh TEST_SCENES [FOLDER]
#   TEST_SCENES  the program test_scenes, whose report tests write the reports
#   FOLDER       where to leave the reports and screenshots; without it they are removed
set -euo pipefail

test_scenes=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
reports=${2:-$work/reports}
mkdir -p "$reports"

browse() {  # browse REPORT OPTION...
  local report=$1
  shift
  timeout 100 chromium --headless --no-sandbox --disable-gpu --disable-quic --no-first-run \
    --disable-background-networking --disable-component-update --disable-sync \
    --user-data-dir="$work/profile" --virtual-time-budget=10000 --enable-logging=stderr \
    --window-size=1200,2000 "$@" "file://$report"
}

fail() {
  echo "FAILED: $1" >&2
  exit 1
}

check() {  # check NAME QUADS: the report of one test, and how many quads its picture has
  local report=$reports/$1/report.html page=$work/page.html log=$work/log.txt
  browse "$report" --dump-dom >"$page" 2>"$log" || fail "$1: chromium: $(tail -3 "$log")"
  if grep ':CONSOLE' "$log"; then fail "$1: the console has messages"; fi
  local body
  body=$(grep -o '<body[^>]*>' "$page" | head -1)
  [[ $body != *data-error* ]] || fail "$1: $body"
  [[ $body == *'data-ready="1"'* ]] || fail "$1: not ready: $body"
  [[ $body == *"data-drawn-quads=\"$2\""* ]] || fail "$1: not $2 quads drawn: $body"
  browse "$report" --screenshot="$reports/$1/report.png" >/dev/null 2>&1
  /usr/bin/python3 - "$reports/$1/report.png" <<'PYTHON' || fail "$1: no picture on the page"
import sys
from matplotlib.image import imread
pixels = (imread(sys.argv[1])[:, :, :3] * 255).round().astype(int)
assert len({tuple(p) for p in pixels.reshape(-1, 3)[::7]}) > 200, "no field of many colours"
PYTHON
  echo "ok: $1"
}

PULVIS_KEEP_REPORTS=$reports "$test_scenes" --gtest_filter='ReportTest.*' >"$work/tests.txt" ||
  fail "the report tests: $(tail -5 "$work/tests.txt")"
check LoadsNothingFromElsewhere 2304
check WorksWithoutToolsAndWithoutASummary 2304
check ShowsTheLastFrameOfARunOfOneFrame 2304
check StaysSmall 14400
check ShowsLocalDensitiesAndContactsOfTheLastFrame 2304
