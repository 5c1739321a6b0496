#!/bin/bash
# Opens reports in headless Chromium and does with them what a reader would do: no message on the console, nothing
# loaded, curves and picture there, and the picture follows frame, field, keys and curve.
#
# usage: report_in_browser.sh TEST_CLI PULVIS SOURCE_DIR [FOLDER]
#   TEST_CLI  the program test_cli, whose report tests write the reports
#   PULVIS       the program, which writes those of a real compaction and of a lever
#   SOURCE_DIR   where scenes/ and tests/report_driver.js lie
#   FOLDER       where to leave the reports and screenshots; without it they are removed
set -euo pipefail

test_cli=$1 pulvis=$2 source_dir=$3
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
reports=${4:-$work/reports}
mkdir -p "$reports"

source "$(dirname "$0")/browser.sh"

# check NAME [QUESTION...]: the report of that folder is driven by report_driver.js and $drivers, until it says $wanted, and each question answered with true
check() {
  local name=$1 body question
  shift
  body=$(body_of "$name" "$reports/$name/report.html" 1200,2000 "${wanted:-driven}" "$source_dir/tests/report_driver.js" "${drivers[@]}")
  [[ $body != *data-error* && $body != *data-driver-error* && $body != *data-violation* ]] || fail "$name: $body"
  [[ $body == *'data-ready="1"'* && $body == *'data-driven="1"'* ]] || fail "$name: not ready: $body"
  [[ $body == *'data-network="0"'* ]] || fail "$name: something was loaded: $body"
  for question in "$@"; do [[ $body == *"data-$question=\"true\""* ]] || fail "$name: not $question: $body"; done
  picture_of "$reports/$name/report.html" 1200,2000 "$reports/$name/report.png"
  echo "ok: $name"
}

drivers=()
everything=(has-curves axes-apart keys-free scrubbed back stepped playing linked curve-zoomed ticks-apart zoomed other-field dark)
particles=("${everything[@]}" tip fit)  # of a plane run

# (Figures for papers are no pages.)
PULVIS_KEEP_REPORTS=$reports "$test_cli" \
  --gtest_filter='ReportTest.*:SpaceReportTest.*-*.HasFiguresForPapers:*.DrawsBondsCracksAndFragments:*.WritesPlottedSeriesAsNumbers' >"$work/tests.txt" ||
  fail "the report tests: $(tail -5 "$work/tests.txt")"
"$pulvis" run "$source_dir/scenes/compaction/regular-25.toml" --threads 1 --set output.frames=8 \
  --set "stage.press.duration=20 us" --set 'stage.press.move[0].displacement=["0 mm", "-0.4 mm"]' \
  --set output.contacts=true --overwrite -o "$reports/compaction" >"$work/compaction.txt" 2>&1 ||
  fail "the compaction: $(tail -3 "$work/compaction.txt")"
"$pulvis" run "$source_dir/scenes/periodic/square.toml" --threads 1 --set output.frames=4 --set 'stage.press.duration="0.1 ms"' \
  --overwrite -o "$reports/cell" >"$work/cell.txt" 2>&1 || fail "the cell: $(tail -3 "$work/cell.txt")"
"$pulvis" run "$source_dir/scenes/afm/calibration-beam.toml" --threads 1 --overwrite -o "$reports/lever" >"$work/run.txt" 2>&1 ||
  fail "the lever: $(tail -3 "$work/run.txt")"

check LoadsNothingFromElsewhere "${particles[@]}" material
check WorksWithoutToolsAndWithoutASummary "${particles[@]}"
check ShowsTheLastFrameOfARunOfOneFrame zoomed other-field
check StaysSmall "${particles[@]}" material
check ShowsLocalDensitiesAndContactsOfEveryFrame "${particles[@]}" contacts
check ShowsBondsCracksAndFragmentsOfEveryFrame "${particles[@]}" bonds
check ShowsThePeriodicCellWithTheParticlesInside "${particles[@]}" contacts
check compaction "${particles[@]}" unmeasured material contacts whole near-zero-off named
check cell "${particles[@]}" cell-first pulled unslid damped readable uncovered
mapfile -t unlinked < <(printf '%s\n' "${everything[@]}" | grep -vx linked)  # stiffnesses are no samples of a run
check lever "${unlinked[@]}" named
check ShowsTheCurvesOfARunWithoutFrames has-curves

# Particles in three dimensions: turned, cut, asked; and 100 particles of 448 elements open fast enough.
drivers=("$source_dir/tests/space_driver.js") wanted=spaced
in_space=("${everything[@]}" fit material turned looked tip-in-space cut cut-told tip-in-section sliced uncut edged network-in-space layers tools-hidden labels)
check ShowsParticlesInABox "${in_space[@]}"
drivers=() wanted=driven
check StandsInAComparison "${everything[@]}" fit material
check ShowsBondsCracksAndFragmentsInSpace "${everything[@]}" fit material bonds contacts
grep -q '0\.14 mm²' "$work/page.html" || fail "cracks in space: no area of 7 bonds of 0.02 mm²"
body=$(body_of "in space" "$reports/StaysBelowAQuarterOfItsLimitWithAQuarterOfTheFrames/report.html" 1200,2000 ready)
[[ $body =~ data-ready-in=\"([0-9]+)\" && ${BASH_REMATCH[1]} -le 10000 ]] || fail "in space: not ready in 10 s: $body"
picture_of "$reports/StaysBelowAQuarterOfItsLimitWithAQuarterOfTheFrames/report.html" 1200,2000 "$reports/in-space.png"
echo "ok: 100 particles of 448 elements, $(du -h "$reports/StaysBelowAQuarterOfItsLimitWithAQuarterOfTheFrames/report.html" | cut -f1) with 10 frames, ready in ${BASH_REMATCH[1]} ms"
body=$(body_of "comparison in space" "$reports/StandsInAComparison/comparison.html" 1200,2000 ready)
[[ $body == *'data-ready="1"'* && $body == *'data-views="2"'* && $body != *data-error* ]] || fail "comparison in space: $body"
echo "ok: comparison in space"

# What to do about a value beyond its limit: the page has the words of the terminal.
advice=$(sed -n 's/^warning: hourglass energy [0-9.]*% (limit 3%): //p' "$work/compaction.txt")
[[ -n $advice ]] || fail "the terminal does not say what to do: $(tail -5 "$work/compaction.txt")"
body_of quality "$reports/compaction/report.html" 1200,2000 ready >/dev/null
grep -qF "What to do: $advice." "$work/page.html" || fail "the page does not say what to do: $advice"
echo "ok: what to do about a value beyond its limit"

# Nothing is cut off on paper, and nothing is dark there.
browse "$reports/compaction/report.html" 1200,2000 --virtual-time-budget=10000 --no-pdf-header-footer \
  --print-to-pdf="$reports/compaction/report.pdf" >/dev/null 2>&1
[[ $(head -c 5 "$reports/compaction/report.pdf") == %PDF- ]] || fail "the page does not print"
pages=$(grep -ac '/Type */Page\b' "$reports/compaction/report.pdf")
[[ $pages -ge 2 && $pages -le 9 ]] || fail "the page prints on $pages pages"
echo "ok: printed on $pages pages"

"$pulvis" report "$reports/compaction" "$reports/StaysSmall" -o "$work/comparison.html" >/dev/null || fail "report A B"
body=$(body_of comparison "$work/comparison.html" 1200,2000 ready)
[[ $body == *'data-ready="1"'* && $body == *'data-views="2"'* ]] || fail "comparison: $body"
[[ $body =~ data-lines=\"([0-9]+)\" && ${BASH_REMATCH[1]} -ge 4 ]] || fail "comparison: too few curves: $body"
echo "ok: comparison"

# Side by side with itself every curve is there twice, also where the other run shows its forces turned over; and
# density maps of different runs have the same two ends.
"$pulvis" run "$source_dir/scenes/compaction/regular-25.toml" --threads 1 --set output.frames=2 \
  --set "stage.press.duration=20 us" --set 'stage.press.move[0].displacement=["0 mm", "-0.8 mm"]' \
  --set "output.density_cells=[4, 4]" --overwrite -o "$work/dense" >"$work/run.txt" 2>&1 ||
  fail "the denser compaction: $(tail -3 "$work/run.txt")"
cp -r "$work/dense" "$work/turned"
/usr/bin/python3 - "$work/turned/run.h5" <<'PYTHON'
import sys

import h5py

with h5py.File(sys.argv[1], "r+") as file:
    for tool in file["history/tool"].values():
        for name in tool:
            if name.startswith("force_"):
                tool[name][...] = -tool[name][...]
                del tool[name].attrs["xxh3"]
    for frame in file["frames"].values():
        frame["local_density"][...] = 0.9 * frame["local_density"][...]
        del frame["local_density"].attrs["xxh3"]
PYTHON
# A law that does not describe the curve is not drawn, and the page says so; nor is the transmission at light loads.
cp -r "$work/dense" "$work/poor"
/usr/bin/python3 - "$work/poor/summary.json" <<'PYTHON'
import json
import sys

with open(sys.argv[1], encoding="utf-8") as file:
    summary = json.load(file)
for law in summary["fits"]["laws"]:
    law["r_squared"] = 0.02 if law["law"] == "heckel" else 0.99
with open(sys.argv[1], "w", encoding="utf-8") as file:
    json.dump(summary, file)
PYTHON
"$pulvis" report "$work/poor" -o "$work/poor.html" >/dev/null || fail "report of a poor law"
cat >"$work/light_driver.js" <<'JS'
(async () => {
  const run = await Run.load(JSON.parse(document.getElementById("head").textContent));
  const load = run.values("stress/axial_top"), ratio = run.values("stress/transmission"), most = largest(load);
  while (!document.body.dataset.ready) await new Promise(done => setTimeout(done, 20));  // the page has its charts
  const light = [...ratio].filter((_, i) => load[i] <= 0.05 * most), heavy = [...ratio].filter((_, i) => load[i] > 0.05 * most);
  document.body.dataset.light = heavy.length && heavy.some(Number.isFinite) && light.every(Number.isNaN) ? "1" : `${light} ${heavy}`;
})();
JS
body=$(body_of "poor law" "$work/poor.html" 1200,2000 light "$work/light_driver.js")
[[ $body == *'data-light="1"'* ]] || fail "transmission at light loads: $body"
grep -q 'Heckel: not drawn, R² is below 0.9' "$work/page.html" || fail "a poor law is not told"
/usr/bin/python3 - "$work/page.html" <<'PYTHON' || fail "a poor law is drawn"
import re
import sys
chart = re.search(r"fitted laws</h2>.*?</section>", open(sys.argv[1], encoding="utf-8").read(), re.S)[0]
assert "Cooper" in chart and "Heckel" not in chart.replace("Heckel: not drawn", "")
PYTHON
echo "ok: poor laws and light loads"

curves_of() {  # RUN...: how many curves their comparison has
  "$pulvis" report "$@" -o "$work/pair.html" >/dev/null || fail "report $*"
  body=$(body_of pair "$work/pair.html" 1200,2000 ready)
  [[ $body == *'data-ready="1"'* && $body =~ data-lines=\"([0-9]+)\" ]] || fail "pair: $body"
  curves=${BASH_REMATCH[1]}
}
curves_of "$work/dense" "$work/dense"
same=$curves
for table in quality laws transmission; do  # those of the single reports, a row for each run
  rows=$(/usr/bin/python3 - "$work/page.html" "$table" <<'PYTHON'
import re
import sys
text = open(sys.argv[1], encoding="utf-8").read()
table = re.search(rf'<table id="{sys.argv[2]}"[^>]*>.*?</table>', text, re.S)[0]
print(len(re.findall("<tr", table.split("<tbody>")[1])))
PYTHON
)
  [[ $rows -ge 2 ]] || fail "comparison: $rows rows in the table $table"
done
curves_of "$work/dense" "$work/turned"
[[ $curves -eq $same ]] || fail "of $same curves $curves are left where signs differ"
mapfile -t scales < <(grep -o 'data-scale="[0-9][^"]*"' "$work/page.html")
[[ ${#scales[@]} -eq 2 && ${scales[0]} == "${scales[1]}" ]] || fail "density maps of different ranges: ${scales[*]}"
echo "ok: comparison of runs of other signs and densities"

"$pulvis" run "$source_dir/scenes/afm/calibration-beam.toml" --threads 1 --set "lever.thickness=3 um" --overwrite \
  -o "$reports/thick-lever" >"$work/run.txt" 2>&1 || fail "the thick lever: $(tail -3 "$work/run.txt")"
"$pulvis" report "$reports/lever" "$reports/thick-lever" "$reports/compaction" -o "$reports/levers.html" >/dev/null ||
  fail "report of levers"
body=$(body_of levers "$reports/levers.html" 1200,2000 ready)
[[ $body == *'data-ready="1"'* && $body == *'data-views="3"'* ]] || fail "levers: $body"
[[ $(grep -o '<h2>Stiffness compared with closed forms: ' "$work/page.html" | wc -l) -eq 2 ]] || fail "levers: not both calibrations"
[[ $(grep -o 'data-drawn="' "$work/page.html" | wc -l) -eq 3 ]] || fail "levers: a picture is missing"
grep -q 'Lever, under a force along the lever' "$work/page.html" || fail "levers: not told what a calibration shows"
grep -q 'Lever, [0-9.]* actions completed' "$work/page.html" && fail "levers: a calibration has no actions"
picture_of "$reports/levers.html" 1200,2000 "$reports/levers.png"
echo "ok: comparison of levers"

# A raster: both ways in the page, their ranges those of run.h5, levelled as the figures are; and the same as fields.
"$pulvis" run "$source_dir/tests/keys/scenes/raster.toml" --threads 1 --overwrite -o "$reports/raster" >"$work/run.txt" 2>&1 ||
  fail "the raster: $(tail -3 "$work/run.txt")"
"$pulvis" figure "$reports/raster" --format gsf -o "$work/fields" >/dev/null || fail "the fields of the raster"
"$pulvis" figure "$reports/raster" --format gsf --level plane -o "$work/fields" >/dev/null || fail "its levelled fields"
body=$(body_of raster "$reports/raster/report.html" 1200,2400 levelled "$(dirname "$0")/raster_driver.js")
[[ $body == *'data-levelled="1"'* && $body != *data-error* ]] || fail "raster: $body"
/usr/bin/python3 "$(dirname "$0")/raster_page.py" "$source_dir" "$work/page.html" "$reports/raster/run.h5" "$work/fields" ||
  fail "the images of the raster"
picture_of "$reports/raster/report.html" 1200,2400 "$reports/raster.png"
body=$(body_of "narrow raster" "$reports/raster/report.html" 500,900 within "$(dirname "$0")/width_driver.js")
[[ $body == *'data-within="1"'* ]] || fail "narrow raster: $body"
echo "ok: images of a raster"

# A loop and a force curve: what goes there and what comes back are lines of their own, the tables have one unit a column,
# and forces can be read in nN.
for named in "plane Friction loop" "jkr Force curve"; do
  scene=${named%% *}
  "$pulvis" run "$source_dir/tests/keys/scenes/$scene.toml" --threads 1 --overwrite -o "$reports/$scene" >"$work/run.txt" 2>&1 ||
    fail "$scene: $(tail -3 "$work/run.txt")"
  body=$(body_of "$scene" "$reports/$scene/report.html" 1000,2400 probed "$(dirname "$0")/probe_driver.js")
  [[ $body == *"data-probed=\"${named#* }\""* && $body != *data-error* ]] || fail "$scene: $body"
done
echo "ok: loop and force curve"

# Side by side: scripts of one page share their names, and a run of one kind has not what a panel of another expects.
for pair in "plane jkr" "plane thick-lever" "jkr compaction" "compaction ShowsParticlesInABox" \
            "ShowsBondsCracksAndFragmentsInSpace ShowsBondsCracksAndFragmentsOfEveryFrame"; do
  "$pulvis" report "$reports/${pair% *}" "$reports/${pair#* }" -o "$work/pair.html" >/dev/null || fail "report of $pair"
  body=$(body_of "$pair" "$work/pair.html" 1200,2000 ready)
  [[ $body == *'data-ready="1"'* && $body == *'data-views="2"'* && $body != *data-error* ]] || fail "$pair: $body"
done
# The last of them: cracks have an area in space and a length in the plane, and fragments come in one panel each.
for title in "Bonds: crack area" "Bonds: crack length" "Sizes of the fragments"; do
  grep -q "<h2>$title: " "$work/page.html" || fail "comparison of bonds: no $title"
done
grep -q 'of the sphere of equal volume' "$work/page.html" && grep -q 'of the circle of equal area' "$work/page.html" ||
  fail "comparison of bonds: sizes of fragments"
echo "ok: comparison of unlike runs"

# One run with -o: its report, elsewhere.
"$pulvis" report "$reports/jkr" -o "$work/alone.html" >/dev/null || fail "report of one run with -o"
body=$(body_of alone "$work/alone.html" 1200,2000 ready)
[[ $body == *'data-ready="1"'* ]] && grep -q '<h2>Force curves' "$work/page.html" || fail "one run with -o: $body"
echo "ok: report of one run elsewhere"

# A run that was killed has no outcome and no summary: the page says so, and explains only the signs that it shows.
mkdir "$work/killed"
cp "$reports/compaction/run.h5" "$work/killed"
/usr/bin/python3 -c 'import h5py, sys; del h5py.File(sys.argv[1], "r+").attrs["outcome"]' "$work/killed/run.h5"
"$pulvis" report "$work/killed" >/dev/null || fail "report of a killed run"
body=$(body_of killed "$work/killed/report.html" 1200,2000 ready)
[[ $body == *'data-ready="1"'* ]] || fail "killed: $body"
grep -q 'The run has not ended: it is still running, or was killed' "$work/page.html" || fail "killed: not told"
grep -q '>at the end<' "$work/page.html" && fail "killed: told as if it were at its end"
grep -q 'compression &gt; 0' "$work/page.html" && fail "killed: signs of forces that are not shown"
echo "ok: report of a killed run"

# The panel that docs/extending.md gives as an example, put where a panel's file would be read.
/usr/bin/python3 - "$source_dir/docs/extending.md" "$reports/compaction/report.html" >"$work/panel.html" <<'PYTHON'
import re
import sys

docs, page = (open(name, encoding="utf-8").read() for name in sys.argv[1:])
(example,) = re.findall(r"```js\n(.*?)```", docs, re.S)
before, after = page.split("main().catch(fail);")
print(before + example.replace('"use strict";', "") + "main().catch(fail);" + after)
PYTHON
body=$(body_of panel "$work/panel.html" 1200,2000 ready)
[[ $body == *'data-ready="1"'* && $body != *data-error* ]] || fail "panel of the docs: $body"
grep -q '<h2>Time step</h2>' "$work/page.html" || fail "the panel of the docs is not on the page"
echo "ok: panel of docs/extending.md"

body=$(body_of phone "$reports/compaction/report.html" 500,900 ready)
[[ $body == *'data-ready="1"'* && $body != *data-error* ]] || fail "phone width: $body"
echo "ok: phone width"
