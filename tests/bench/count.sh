#!/bin/sh
# Instructions per ray of the runs of count.c, by callgrind, against those recorded in counts.txt: 5 % more fails.
#   count.sh COUNT [--record]
# Status 77 (skipped): no valgrind, or the record was made with another compiler or kind of build, whose counts say nothing.
set -eu
count=$1
record=$(dirname "$0")/counts.txt
command -v valgrind >/dev/null || { echo "no valgrind"; exit 77; }
built=$("$count" --built)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# NAME: prints instructions per ray.
measure() {
    valgrind --tool=callgrind --toggle-collect=counted_pass --callgrind-out-file="$work/out" "$count" "$1" \
        >"$work/rays" 2>"$work/err" || { cat "$work/err" >&2; exit 1; }
    awk -v rays="$(cat "$work/rays")" '/^(summary|totals):/ { n = $2 } END { printf "%.0f\n", n / rays }' "$work/out"
}

if [ "${2-}" = --record ]; then
    {
        echo "# Instructions per ray, by tests/bench/count.sh COUNT --record"
        echo "built $built"
        for run in $("$count"); do echo "$run $(measure "$run")"; done
    } >"$work/new"
    cp "$work/new" "$record"
    cat "$record"
    exit 0
fi

[ -r "$record" ] || { echo "nothing is recorded"; exit 77; }
recorded=$(sed -n 's/^built //p' "$record")
[ "$recorded" = "$built" ] || { echo "recorded with $recorded, this is $built"; exit 77; }
status=0
for run in $("$count"); do
    old=$(sed -n "s/^$run //p" "$record")
    new=$(measure "$run")
    verdict=$(awk -v old="${old:-0}" -v new="$new" 'BEGIN {
        if (new > 1.05 * old) print "SLOWER: mend it, or say why and record anew"
        else if (new < 0.95 * old) print "faster: record it"
        else print "the same" }')
    echo "$run: $new instructions a ray, recorded ${old:-none}: $verdict"
    case $verdict in SLOWER*) status=1 ;; esac
done
exit $status
