# For tests of the program from outside: a folder for what they write, and what they say of a run. To be read by a script
# whose first argument is the program and whose last command is end_of_tests; each test begins with test=NAME.
# shellcheck shell=sh disable=SC2034,SC2154
trimray=$(cd "$(dirname "$1")" && pwd)/$(basename "$1")
tests=$(cd "$(dirname "$0")" && pwd)
scenes=$(cd "$tests/../scenes" && pwd)
work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
n_failed=0

# Runs the program; its status is in $status, what it says in the files out and err.
run() { "$trimray" "$@" >"$work/out" 2>"$work/err"; status=$?; }

fail() {
    n_failed=$((n_failed + 1))
    echo "FAILED: $test: $*" >&2
    sed 's/^/    stderr: /' "$work/err" >&2
}

ends_with() { [ "$status" = "$1" ] || fail "exit status $status, not $1"; }
says() { grep -qF -- "$1" "$work/err" || fail "does not say: $1"; }
prints() { grep -qF -- "$1" "$work/out" || fail "does not print: $1"; }
exists() { [ -s "$1" ] || fail "no file $1"; }

end_of_tests() {
    [ $n_failed = 0 ] && exit 0
    echo "$n_failed checks failed" >&2
    exit 1
}
