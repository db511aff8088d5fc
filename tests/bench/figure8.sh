#!/bin/sh
# The table of [MCFS00] Figure 8 for our scenes of the same kinds and counts, by `method paper`, beside the paper's figures.
#   tests/bench/figure8.sh TRIMRAY [METHOD]         prints Markdown; one thread, 512 x 512
set -eu
trimray=$1
method=${2-paper}
scenes=$(cd "$(dirname "$0")/../../scenes" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT

# name  the paper's: surfaces trims BV light-BV tests us-a-test hits% reported%
paper='teapot 32 0 12642506 6542330 431620 21.7 85.1 27.7
teapot_solid 10 5 10861260 5098600 642511 18.9 71.3 30.5
spoon 3 0 3265298 902120 155118 22.0 51.2 14.0
pencil 17 9 3439462 1714142 475934 17.4 47.7 7.7
goblet 1 0 3756604 1638038 320622 18.6 70.7 31.2
crank1a 20 18 23818532 6669190 2287689 17.2 65.1 9.2
crank 73 64 14716416 3334258 1306480 15.9 41.6 7.9
allblade 351 0 47701788 17060564 2340071 18.6 56.4 19.0'

echo "| scene | | surfaces | trims | rays | BV intersections | light BV intersections | NURBS tests | µs a test | hits | reported | iterations a test |"
echo "|---|---|---:|---:|---:|---:|---:|---:|---:|---:|---:|---:|"
echo "$paper" | while read -r name surfaces trims bv light tests us hits reported; do
    "$trimray" "$scenes/$name.pov" -F +W512 +H512 +WT1 --method "$method" --stats "$work/$name.json"
    awk -v name="$name" -v method="$method" '
        { gsub(/[",:]/, " "); value[$1] = $2 }
        END {
            n = value["nurbs_tests"]
            printf "| %s | trimray, %s | %d | %d | %d | %d | %d | %d | %.2f | %.1f %% | %.1f %% | %.2f |\n", name, method,
                value["surfaces"], value["trims"], value["rays"], value["bv_intersections"], value["light_bv_intersections"], n,
                1e6 * value["nurbs_seconds"] / n, 100 * value["nurbs_hits"] / n, 100 * value["reported_hits"] / n,
                value["newton_iterations"] / n
        }' "$work/$name.json"
    echo "| | paper | $surfaces | $trims | 262144 | $bv | $light | $tests | $us | $hits % | $reported % | |"
done
