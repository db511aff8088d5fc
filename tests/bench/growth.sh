#!/bin/sh
# How rays, preparation and memory grow with the surfaces, and with the trim pieces: two plots beside each other.
#   growth.sh BENCH.md... > growth.svg      from the tables "All models" of bench (any rows field-N, trims-N)
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
# shellcheck source=.ci/setup.sh
. "$root/.ci/setup.sh"
need gnuplot-nox >&2
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# N, camera, random and shadow rays (millions a second), preparation (s), memory (GB), by N. `certain` alone has a number of
# surfaces in its second column and of leaves in its third.
rows() {
    awk -F'|' -v kind="$1" '
        $2 ~ "^ " kind "-[0-9]+ $" && $3 ~ /^ [0-9]+ $/ && $4 ~ /^ [0-9]+ $/ {
            n = $2; gsub(/[^0-9]/, "", n)
            print n, $7 + 0, $8 + 0, $9 + 0, $5 / 1e3, $6 / 1e3
        }' "$2" | sort -n -u -k1,1
}
cat "$@" >"$work/all.md"
rows field "$work/all.md" >"$work/field"
rows trims "$work/all.md" >"$work/trims"

gnuplot <<END
set terminal svg size 900, 440 font "sans-serif, 12"
set multiplot layout 1, 2
set logscale xy
set format x "10^{%T}"
set format y "10^{%T}"
set key below samplen 2
set grid
do for [kind in "field trims"] {
    set xlabel kind eq "field" ? "surfaces" : "trim pieces"
    file = "$work/" . kind
    plot file using 1:2 with linespoints title "camera, 10^6 rays/s", \
         file using 1:3 with linespoints title "random, 10^6 rays/s", \
         file using 1:4 with linespoints title "shadow, 10^6 rays/s", \
         file using 1:5 with linespoints dashtype 2 title "preparation, s", \
         file using 1:6 with linespoints dashtype 3 title "memory, GB"
}
END
