#!/bin/sh
# The benchmark from nothing: installs what is missing (Debian), builds a release, runs all on one core, prints Markdown.
#   tests/bench/run.sh [--long] [switches of bench: see bench.c]
# The short form takes some minutes. Peers whose packages are not there are left out; so is POV-Ray.
set -eu
root=$(cd "$(dirname "$0")/../.." && pwd)
# shellcheck source=.ci/setup.sh
. "$root/.ci/setup.sh"

scenes='teapot still_life'
case " $* " in *' --long '*) scenes='teapot still_life mechanical goblet spoon pencil crank' ;; esac

{
    need gcc g++ libc6-dev make cmake python3 libpng-dev libcjson-dev libcmocka-dev libgmp-dev libembree-dev libsisl-dev \
        libocct-modeling-algorithms-dev povray povray-includes
    build "$root/build-bench" bench -DCMAKE_BUILD_TYPE=Release -DTRIMRAY_TESTS=ON
    build "$root/build-bench" trimray
} >&2

one_core() { if command -v taskset >/dev/null; then taskset -c 0 "$@"; else "$@"; fi; }

echo "# Benchmark"
echo
echo "$(git -C "$root" describe --always --dirty 2>/dev/null || echo 'no revision'), $(date -u +%F), one core of" \
    "$(sed -n 's/^model name[^:]*: //p' /proc/cpuinfo | head -1)." \
    "Times are the processor's; rays/s the median of five passes."
one_core "$root/build-bench/tests/bench/bench" "$@"
command -v povray >/dev/null || exit 0
echo
echo "### Whole processes, 1024 x 1024, one thread"
echo
# shellcheck disable=SC2046,SC2086   # lists of words
one_core python3 "$root/tests/bench/process.py" "$root/build-bench/trimray" $(printf "$root/scenes/%s.pov " $scenes)
