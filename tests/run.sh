#!/bin/sh
# All tests from nothing: installs what is missing (Debian), builds, runs them.
#   tests/run.sh [--asan | --tsan] [--clang] [switches of ctest]
#     --asan    with the address and undefined-behaviour sanitizers      --tsan    with the thread sanitizer
#     --clang   by clang instead of gcc
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
# shellcheck source=.ci/setup.sh
. "$root/.ci/setup.sh"

sanitize='' type=Release suffix=''
while :; do
    case ${1-} in
        --asan) sanitize=address,undefined,float-cast-overflow type=Debug suffix=$suffix-asan ;;
        --tsan) sanitize=thread type=Debug suffix=$suffix-tsan ;;
        --clang) export CC=clang suffix="$suffix-clang" ;;
        *) break ;;
    esac
    shift
done

need gcc libc6-dev make cmake python3 libpng-dev libcjson-dev libcmocka-dev libgmp-dev libflint-dev libflint-arb-dev povray povray-includes povray-examples
[ "${CC-}" != clang ] || need clang libclang-rt-dev
build "$root/build$suffix" all -DCMAKE_BUILD_TYPE=$type -DCMAKE_C_FLAGS_DEBUG='-O1 -g' -DTRIMRAY_SANITIZE=$sanitize \
    -DTRIMRAY_TESTS=ON
cd "$root/build$suffix"
exec ctest --output-on-failure --timeout 900 --parallel "$(nproc)" "$@"
