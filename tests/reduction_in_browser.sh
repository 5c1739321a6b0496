#!/bin/bash
# Opens the reports of all reductions in headless Chromium: they must draw their charts and raise no error, offline;
# of the wedge calibration, figures and lines must be those of the loops.
#
# usage: reduction_in_browser.sh PULVIS SOURCE_DIR [FOLDER]
#   PULVIS      the program
#   SOURCE_DIR  where scenes/lab lies
#   FOLDER      where to leave report and screenshot; without it they are removed
set -euo pipefail

pulvis=$1
source_dir=$2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
out=${3:-$work/reduced}

source "$(dirname "$0")/browser.sh"

mkdir "$work/sim"
cat >"$work/sim/history.csv" <<'CSV'
time [s],tool/target/position_x [m],tool/target/force_x [N],tool/target/force_y [N]
0,0,0,-100
1,0.001,18,-100
2,0.02,19,-100
CSV
"$pulvis" reduce "$source_dir/scenes/lab/reduce.toml" --simulation "$work/sim" --overwrite -o "$out" \
  >"$work/out.txt" || fail "the reduction: $(tail -5 "$work/out.txt")"
body=$(body_of reduction "$out/report.html" 1200,2300 ready)
[[ $body != *data-error* ]] || fail "$body"
[[ $body == *'data-ready="1"'* && $body == *'data-charts="5"'* ]] || fail "not ready: $body"
drawn=$(grep -o 'class="plot"' "$work/page.html" | wc -l)
[[ $drawn -eq 5 ]] || fail "$drawn charts on the page, not 5"
grep -q 'simulation sim' "$work/page.html" || fail "the simulation is not on the page"
grep -q '<th scope="row">mean of the runs</th>' "$work/page.html" || fail "no mean of the runs"
picture_of "$out/report.html" 1200,2300 "$out/report.png"
echo "ok: reduction"

wedge=$out/wedge
"$pulvis" reduce "$source_dir/scenes/lab/wedge.toml" --overwrite -o "$wedge" >"$work/out.txt" ||
  fail "the wedge calibration: $(tail -5 "$work/out.txt")"
body=$(body_of wedge "$wedge/report.html" 1200,2000 ready)
[[ $body != *data-error* ]] || fail "$body"
[[ $body == *'data-ready="1"'* && $body == *'data-charts="2"'* ]] || fail "not ready: $body"
/usr/bin/python3 "$(dirname "$0")/wedge_page.py" "$work/page.html" "$source_dir/scenes/lab/wedge-truth.json" ||
  fail "the page of the wedge calibration"
picture_of "$wedge/report.html" 1200,2000 "$wedge/report.png"
echo "ok: wedge calibration"

volts=$out/volts
"$pulvis" reduce "$source_dir/scenes/lab/volts.toml" --overwrite -o "$volts" >"$work/out.txt" ||
  fail "from volts to friction: $(tail -5 "$work/out.txt")"
body=$(body_of volts "$volts/report.html" 1200,3600 ready)
[[ $body != *data-error* ]] || fail "$body"
[[ $body == *'data-ready="1"'* && $body == *'data-charts="7"'* ]] || fail "not ready: $body"
/usr/bin/python3 "$(dirname "$0")/volts_page.py" "$work/page.html" "$volts/summary.json" ||
  fail "the page from volts to friction"
picture_of "$volts/report.html" 1200,3600 "$volts/report.png"
echo "ok: from volts to friction"
press=$out/press
"$pulvis" reduce "$source_dir/scenes/lab/press.toml" --overwrite -o "$press" >"$work/out.txt" ||
  fail "the compressions: $(tail -5 "$work/out.txt")"
body=$(body_of press "$press/report.html" 1200,2600 ready)
[[ $body != *data-error* ]] || fail "$body"
[[ $body == *'data-ready="1"'* && $body == *'data-charts="4"'* ]] || fail "not ready: $body"
grep -q '<td>Heckel</td><td>yield pressure</td><td>420' "$work/page.html" || fail "no yield pressure on the page"
picture_of "$press/report.html" 1200,2600 "$press/report.png"
echo "ok: compressions"

die=$out/die
"$pulvis" reduce "$source_dir/scenes/lab/die.toml" --overwrite -o "$die" >"$work/out.txt" ||
  fail "the instrumented die: $(tail -5 "$work/out.txt")"
body=$(body_of die "$die/report.html" 1200,2000 ready)
[[ $body != *data-error* ]] || fail "$body"
[[ $body == *'data-ready="1"'* && $body == *'data-charts="3"'* ]] || fail "not ready: $body"
picture_of "$die/report.html" 1200,2000 "$die/report.png"
echo "ok: instrumented die"

matrix=$out/matrix
"$pulvis" reduce "$source_dir/scenes/lab/matrix.toml" --overwrite -o "$matrix" >"$work/out.txt" ||
  fail "the matrix of conditions: $(tail -5 "$work/out.txt")"
body=$(body_of matrix "$matrix/report.html" 1200,2600 ready)
[[ $body != *data-error* ]] || fail "$body"
[[ $body == *'data-ready="1"'* && $body == *'data-charts="3"'* ]] || fail "not ready: $body"
grep -q '<th scope="row">interactions</th>' "$work/page.html" || fail "no interactions on the page"
grep -q '>transverse</text>' "$work/page.html" || fail "the effects do not name their levels"
picture_of "$matrix/report.html" 1200,2600 "$matrix/report.png"
echo "ok: matrix of conditions"

for page in "$out" "$wedge" "$volts" "$press" "$die" "$matrix"; do
  body=$(body_of narrow "$page/report.html" 500,900 within "$(dirname "$0")/width_driver.js")
  [[ $body == *'data-within="1"'* ]] || fail "narrow ${page##*/}: $body"
done
echo "ok: narrow screen"
