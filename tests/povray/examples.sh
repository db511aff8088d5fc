#!/bin/sh
# POV-Ray's own example scenes (Debian's package povray-examples), all 396 of them: those that trimray reads are rendered by both
# programs and compared, the others are listed with the first feature that is missing. Takes some minutes.
#   tests/povray/examples.sh BUILD [FOLDER]
#     BUILD     where trimray was built with its tests     FOLDER    /usr/share/doc/povray/examples where not given
# Prints a table in Markdown. To look at the pictures: CROSS_CHECK_KEEP=folder tests/povray/examples.sh BUILD
set -eu
build=${1?the folder where trimray was built}
examples=${2-/usr/share/doc/povray/examples}
[ -d "$examples" ] || { echo "there is no $examples: install povray-examples" >&2; exit 77; }
find "$examples" -name '*.pov' | LC_ALL=C sort | xargs "$build/tests/cross_check" --survey "$build/trimray"
