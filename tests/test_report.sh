#!/bin/sh
# trimray report: its files, its numbers against theory, what it does without povray, with bad scenes and when interrupted.
#   test_report.sh TRIMRAY
set -u
# shellcheck source=tests/program.sh
. "$(dirname "$0")/program.sh"
cd "$work" || exit 1

has() { grep -qF -- "$2" "$1" || fail "$1 does not have: $2"; }

# column NAME CONDITION: the values of a column of r/report.csv where an awk condition holds; fields by name: $field["method"].
column() {
    awk -F, -v name="$1" 'NR == 1 { for (i = 1; i <= NF; i++) field[$i] = i; next } { gsub(/"/, "", $1) } '"$2"' {
        print $field[name] }' r/report.csv
}

test=a_quick_report_of_two_scenes
begun=$(date +%s)
run report "$scenes/teapot.pov" "$scenes/goblet.pov" --quick --runs 1 +W128 -o r
seconds=$(($(date +%s) - begun))
ends_with 0
for file in r/report.csv r/report.json r/index.html r/goblet-depth_p99-total_seconds.svg; do exists $file; done
[ $seconds -le 60 ] || fail "it took $seconds seconds"
command -v povray >/dev/null || says "povray is not installed"
[ -z "$(find r -name '*.part*' -o -name '*.hits' -o -name '*.log')" ] || fail "it leaves files lying about: $(ls r)"

# Depth errors go with h², triangles with 1/h²: log against log the slope is -1. Least squares, of three settings at least.
test=depth_errors_of_meshes_fall_as_theory_has_it
for scene in teapot goblet; do
    column pieces '$1 == "'$scene'" && $field["method"] == "mesh"' >pieces
    column depth_median '$1 == "'$scene'" && $field["method"] == "mesh"' >depths
    paste pieces depths | awk '{ x = log($1); y = log($2); n++; sx += x; sy += y; sxx += x * x; sxy += x * y }
        END { slope = (n * sxy - sx * sy) / (n * sxx - sx * sx); print n, slope; exit !(n >= 3 && slope < -.85 && slope > -1.15) }' \
        >slope || fail "$scene: settings and slope are $(cat slope)"
    echo "$scene: triangles at $(cut -d' ' -f1 slope) chord errors, slope $(cut -d' ' -f2 slope)"
done

# 2^-40 of the size: distances are some ten times the size, and rays may graze.
test=method_certain_is_at_machine_precision
for name in depth_median depth_p99 depth_largest; do
    column $name '$field["method"] == "certain"' | awk '!($1 <= 2^-40) { bad = 1 } END { exit bad || NR < 4 }' ||
        fail "$name: $(column $name '$field["method"] == "certain"' | tr '\n' ' ')"
done
for name in missed false other picture_over; do
    column $name '$field["method"] == "certain"' | awk '$1 != 0 { bad = 1 } END { exit bad || NR < 4 }' ||
        fail "$name: $(column $name '$field["method"] == "certain"' | tr '\n' ' ')"
done

test=times_add_up
for name in parse_seconds prepare_seconds trace_seconds write_seconds total_seconds; do column $name 1 >$name; done
paste parse_seconds prepare_seconds trace_seconds write_seconds total_seconds | awk '
    { d = $1 + $2 + $3 + $4 - $5; if (d < 0) d = -d; if (!(d <= 1e-6 + 1e-6 * $5)) { bad = 1; print } } END { exit bad || NR < 8 }' >wrong ||
    fail "$(cat wrong)"

test=csv_and_json_agree
python3 - <<'PY' >err 2>&1 || fail "$(cat err)"
import csv, json
rows, report = list(csv.DictReader(open('r/report.csv'))), json.load(open('r/report.json'))
assert len(rows) == len(report['samples']) > 10, (len(rows), len(report['samples']))
names = [c['name'] for c in report['columns']]
assert all(c['meaning'] for c in report['columns'])
for row, sample in zip(rows, report['samples']):
    assert list(row) == ['scene', 'method', 'knob', *names, 'failure']
    for name in names:
        assert (sample[name] is None and row[name] == '') or abs(float(row[name]) - sample[name]) <= 1e-14 * abs(sample[name]), name
PY

test=the_same_command_measures_nothing_again
cp r/measured.jsonl before
run report "$scenes/teapot.pov" "$scenes/goblet.pov" --quick --runs 1 +W128 -o r
ends_with 0
head -c "$(wc -c <before)" r/measured.jsonl | cmp -s - before || fail "what was measured is not kept"

test=without_povray_it_says_so
mkdir empty
PATH_BEFORE=$PATH
PATH=$work/empty "$trimray" report "$scenes/goblet.pov" --quick --runs 1 +W48 -o without >out 2>err
status=$?
ends_with 0; says "povray is not installed"; has without/index.html "povray is not installed"
grep -q ',povray,' without/report.csv && fail "there are numbers of POV-Ray"

test=one_scene_that_fails_does_not_stop_the_others
echo 'sphere { 0, 1 pigment { rgb 1 } }' >none.pov
echo 'sphere { 0, }' >wrong.pov
PATH=$work/empty "$trimray" report nowhere.pov none.pov wrong.pov "$scenes/goblet.pov" --quick --runs 1 +W48 -o some >out 2>err
status=$?
ends_with 1; says "nowhere.pov"; says "wrong.pov:1:"; says "no NURBS surface"
for file in some/report.json some/index.html; do has $file "cannot read nowhere.pov"; has $file "wrong.pov:1:"; done
[ "$(grep -c '^"goblet"' some/report.csv)" -ge 5 ] || fail "the goblet was not measured"

test=a_folder_that_cannot_be_written_is_refused_at_once
for folder in none.pov no/where /proc/report; do
    run report "$scenes/goblet.pov" --quick -o $folder
    ends_with 3; says "cannot write $folder"
done
run report "$scenes/goblet.pov"
ends_with 2; says "-o FOLDER"

test=an_interrupted_report_keeps_what_it_has_and_goes_on
export PATH="$PATH_BEFORE"
"$trimray" report "$scenes/goblet.pov" --runs 2 +W64 -o long >out 2>err &
report=$!
for _ in $(seq 600); do
    [ -f long/measured.jsonl ] && [ "$(wc -l <long/measured.jsonl)" -ge 2 ] && break
    sleep .1
done
kill -INT $report
wait $report
status=$?
ends_with 130; says "interrupted"; exists long/index.html
cp long/measured.jsonl before
"$trimray" report "$scenes/goblet.pov" --runs 2 +W64 -o long >out 2>err &
report=$!
for _ in $(seq 600); do
    [ "$(wc -l <long/measured.jsonl)" -gt "$(wc -l <before)" ] && break
    sleep .1
done
kill -TERM $report
wait $report
status=$?
ends_with 130
head -c "$(wc -c <before)" long/measured.jsonl | cmp -s - before || fail "what was measured is not kept"
[ -z "$(sed 's/.*"key"://' long/measured.jsonl | sort | uniq -d)" ] || fail "something was measured twice"

end_of_tests
