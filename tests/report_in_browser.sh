#!/bin/bash
# Opens reports in headless Chromium and does with them what a reader would do: no message on the console, nothing
# loaded, curves and picture there, and the picture follows frame, field, keys and curve.
#
# usage: report_in_browser.sh TEST_SCENES PULVIS SOURCE_DIR [FOLDER]
#   TEST_SCENES  the program test_scenes, whose report tests write the reports
#   PULVIS       the program, which writes those of a real compaction and of a lever
#   SOURCE_DIR   where scenes/ and tests/report_driver.js lie
#   FOLDER       where to leave the reports and screenshots; without it they are removed
set -euo pipefail

test_scenes=$1 pulvis=$2 source_dir=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
reports=${4:-$work/reports}
mkdir -p "$reports"

source "$(dirname "$0")/browser.sh"

# check NAME [QUESTION...]: the report of that folder is driven, and each question answered with true
check() {
  local name=$1 body question
  shift
  body=$(body_of "$name" "$reports/$name/report.html" 1200,2000 driven "$source_dir/tests/report_driver.js")
  [[ $body != *data-error* && $body != *data-driver-error* && $body != *data-violation* ]] || fail "$name: $body"
  [[ $body == *'data-ready="1"'* && $body == *'data-driven="1"'* ]] || fail "$name: not ready: $body"
  [[ $body == *'data-network="0"'* ]] || fail "$name: something was loaded: $body"
  for question in "$@"; do [[ $body == *"data-$question=\"true\""* ]] || fail "$name: not $question: $body"; done
  picture_of "$reports/$name/report.html" 1200,2000 "$reports/$name/report.png"
  echo "ok: $name"
}

everything=(has-curves scrubbed back stepped playing linked curve-zoomed zoomed other-field dark)

PULVIS_KEEP_REPORTS=$reports "$test_scenes" --gtest_filter='ReportTest.*' >"$work/tests.txt" ||
  fail "the report tests: $(tail -5 "$work/tests.txt")"
"$pulvis" run "$source_dir/scenes/compaction/regular-25.toml" --threads 1 --set output.frames=8 \
  --set "stage.press.duration=20 us" --set 'stage.press.move[0].displacement=["0 mm", "-0.4 mm"]' \
  --set output.contacts=true --overwrite -o "$reports/compaction" >"$work/run.txt" 2>&1 ||
  fail "the compaction: $(tail -3 "$work/run.txt")"
"$pulvis" run "$source_dir/scenes/afm/calibration-beam.toml" --threads 1 --overwrite -o "$reports/lever" >"$work/run.txt" 2>&1 ||
  fail "the lever: $(tail -3 "$work/run.txt")"

check LoadsNothingFromElsewhere "${everything[@]}"
check WorksWithoutToolsAndWithoutASummary "${everything[@]}"
check ShowsTheLastFrameOfARunOfOneFrame zoomed other-field
check StaysSmall "${everything[@]}"
check ShowsLocalDensitiesAndContactsOfEveryFrame "${everything[@]}" contacts
check compaction "${everything[@]}" contacts
check lever "${everything[@]}"
check ShowsTheCurvesOfARunWithoutFrames has-curves

"$pulvis" report "$reports/compaction" "$reports/StaysSmall" -o "$work/comparison.html" >/dev/null || fail "report A B"
body=$(body_of comparison "$work/comparison.html" 1200,2000 ready)
[[ $body == *'data-ready="1"'* && $body == *'data-views="2"'* ]] || fail "comparison: $body"
[[ $body =~ data-lines=\"([0-9]+)\" && ${BASH_REMATCH[1]} -ge 4 ]] || fail "comparison: too few curves: $body"
echo "ok: comparison"

body=$(body_of phone "$reports/compaction/report.html" 500,900 ready)
[[ $body == *'data-ready="1"'* && $body != *data-error* ]] || fail "phone width: $body"
echo "ok: phone width"
