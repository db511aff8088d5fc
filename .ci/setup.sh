# shellcheck shell=sh
# Sourced by scenes/render.sh and tests/run.sh: packages and builds. $root is the repository.

# need PACKAGE...: installs by apt-get the packages that are not there; without apt, CMake will say what it misses.
need() {
    command -v dpkg-query >/dev/null && command -v apt-get >/dev/null || return 0
    missing=
    for package in "$@"; do
        case $(dpkg-query -W -f '${Status}' "$package" 2>/dev/null) in
            "install ok installed") ;;
            *) missing="$missing $package" ;;
        esac
    done
    [ "$missing" ] || return 0
    as_root=
    if [ "$(id -u)" != 0 ]; then
        command -v sudo >/dev/null || { echo "$0: please install:$missing" >&2; exit 1; }
        as_root=sudo
    fi
    echo "Installing:$missing"
    # shellcheck disable=SC2086   # a list of words
    { $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -o DPkg::Lock::Timeout=300 update &&
      $as_root env DEBIAN_FRONTEND=noninteractive apt-get -q -y -o DPkg::Lock::Timeout=300 --no-install-recommends \
          install $missing; } </dev/null
}

# build FOLDER TARGET [CMAKE-ARGUMENT...]
build() {
    folder=$1 target=$2
    shift 2
    cmake -S "${root:?}" -B "$folder" "$@" >"$folder.log" 2>&1 || { cat "$folder.log" >&2; exit 1; }
    rm -f "$folder.log"
    cmake --build "$folder" --target "$target" --parallel "$(nproc)"
}
