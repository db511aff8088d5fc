#!/bin/sh
# The stress program's own keeping of books, and that it can say "missed".
#   test_stress.sh STRESS
set -u
stress=$1
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cd "$work" || exit 1
n_failed=0

fail() {
    n_failed=$((n_failed + 1))
    echo "FAILED: $*" >&2
}

few="--family graze --rays 60 --surface-rays 20 --hits --knobs"
# The columns that do not depend on how fast the machine is.
counts() { cut -d '|' -f 2-12 "$1"; }
same_counts() {
    counts "$1" >a
    counts "$2" >b
    cmp -s a b || fail "$3"
}

$stress $few --rounds 3 >whole 2>err || fail "three rounds end with $?"

$stress $few --rounds 3 --jobs 2 >shared 2>err
same_counts whole shared "two jobs make another table than one"

$stress $few --rounds 1 --log log >first 2>err
head -c 700 log >begun         # some parts, and a torn line
$stress $few --rounds 3 --log begun >continued 2>err
same_counts whole continued "a run that was interrupted ends with another table"

$stress $few --rounds 2 --seed 2 --log rest >second 2>err
$stress --sum log rest --knobs --hits >summed || fail "the sum ends with $?"
same_counts whole summed "two runs sum up to another table than the whole"

$stress $few --rays 61 --log log >other 2>err && fail "a log is mixed with rays that were shot otherwise"

# Newton's method from a guess misses what rays graze: the judge sees it, and each failure can be shot again alone.
mkdir failures
$stress $few --of paper --failures failures >paper 2>err
awk -F '|' '/paper/ { n += $8 } END { exit n == 0 }' paper || fail "the judge sees no miss"
for f in failures/*missed*; do
    again=$(sed -n "1s|/\* stress \(.*\) \*/|\1|p" "$f")
    sed 1,2d "$f" >was
    eval "$stress $again --of paper" | sed 1,2d >is
    cmp -s was is || fail "$f is another ray when it is shot again"
    sed -n 2p "$f" | grep -q missed || fail "$f is no miss"
done

# Surfaces squeezed by 1e8: a ray that was missed once, and one whose simple root was taken for part of a tangency.
for ray in "3002 5783" "3001 143"; do
    set -- $ray
    $stress --family aspect --knob 1e8 --seed "$1" --rays 8000 --surface-rays 1000 --ray "$2" --hits >needle
    sed -n 2p needle | grep -Eq ': (right|in the band);' || fail "seed $1, ray $2: $(sed -n 2p needle)"
done

exit $n_failed
