# shellcheck shell=bash
# Sourced by the `run` of peers: builds a peer's drivers once, and says what it lacks.
# Needs `here`, the peer's own folder.
# shellcheck disable=SC2154,SC2034  # `here` comes from there, and `built` goes there
peer=$(basename "$here")
repository=$(cd "$here/../../.." && pwd)
timing=$repository/selector/bench/speed/timing.h

# The peer does not have this: fails with status 3 unless VALUE is one of CHOICES.
# usage: require_choice WHAT VALUE CHOICES...
require_choice() {
  local what=$1 value=$2 choice
  shift 2
  for choice in "$@"; do
    if [[ $value == "$choice" ]]; then return; fi
  done
  echo "$peer: does not have $what '$value'; it has $*" >&2
  exit 3
}

missing_package() {
  echo "$peer: needs the Debian package $1" >&2
  exit 4
}

# Whether the compiler finds a header. usage: has_header HEADER
has_header() {
  echo "#include <$1>" | g++ -E -x c++ - >/dev/null 2>&1
}

# What -march=native means here: instruction sets and the compiler's version.
machine_macros() {
  g++ -march=native -dM -E -x c++ - </dev/null
}

# Bits of the machine's vectors; the same choice as in lanes.h.
vector_bits() {
  local macros
  macros=$(machine_macros)
  case $macros in
    *__AVX512F__*) echo 512 ;;
    *__AVX__*) echo 256 ;;
    *) echo 128 ;;
  esac
}

# Runs the script's function `build` in a fresh folder unless that was done before for this machine
# and these sources, and sets `built` to the folder. It gets its name when everything is in it: a
# build that was interrupted is never taken for a whole one.
# usage: build_once BUILD_FOLDER NAME
build_once() {
  local fingerprint partial
  fingerprint=$(
    { machine_macros; cat "$here"/* "$here"/../*.{h,sh} "$timing"; } | sha256sum | cut -c1-16
  )
  built=$1/$peer-$2-$fingerprint
  if [[ -d $built ]]; then return; fi
  mkdir -p "$1"
  partial=$(mktemp -d "$built.XXXXXX")
  # shellcheck disable=SC2064  # of this folder: the variable is gone at the exit
  trap "rm -rf '$partial'" EXIT
  (cd "$partial" && build >&2)
  # Another run may have been quicker.
  mv -T "$partial" "$built" 2>/dev/null || [[ -d $built ]]
}

command -v g++ >/dev/null || missing_package g++
# The last two are those that kernels of elastogen have: they save moves of spilled values.
driver_flags=(-std=c++20 -O3 -march=native -ffast-math -DNDEBUG -I "$repository"
  -flive-range-shrinkage -frename-registers)
if [[ $(uname -m) == x86_64 ]]; then driver_flags+=("-mprefer-vector-width=$(vector_bits)"); fi
