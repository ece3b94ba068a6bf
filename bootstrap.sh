#!/bin/bash
# From a fresh Debian 12 to a built elastogen:
#   ./bootstrap.sh build           install what is missing, build build/bin/elastogen
#   ./bootstrap.sh demo [OPTION]   build, then run the mixed beam into out/mixed_beam
#   ./bootstrap.sh test [OPTION]   build everything, run all tests
# Options of demo go to `elastogen run`, those of test to `ctest`.
set -euo pipefail

packages=(
  g++ cmake ninja-build pkg-config
  libginac-dev libcln-dev         # generator
  libeigen3-dev libfmt-dev        # runtime
  libtomlplusplus-dev nlohmann-json3-dev libcli11-dev libvtk9-dev libgmsh-dev
  libsqlite3-dev libsuitesparse-dev libopenblas0-serial gnuplot-nox      # command line
)
test_packages=(
  valgrind libgtest-dev python3-meshio ocl-icd-opencl-dev opencl-clhpp-headers pocl-opencl-icd
  clang libomp-dev                # compiles as well
)

usage() {
  sed -n '2,6s/^# \{0,1\}//p' "$0"
}

fail() {
  echo "error: $*" >&2
  exit 1
}

missing_packages() {
  local package status
  for package in "$@"; do
    status=$(dpkg-query --show --showformat='${db:Status-Status}' "$package" 2>/dev/null || true)
    [ "$status" = installed ] || echo "$package"
  done
}

install_packages() {
  command -v dpkg-query >/dev/null ||
    fail "this script installs Debian packages; elsewhere, provide what docs/dependencies.md" \
      "lists and run: cmake --preset release && cmake --build --preset release"
  local missing
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "these packages are missing, and installing them needs root or sudo:
  apt-get install --no-install-recommends ${missing[*]}"
    as_root=(sudo)
  fi
  echo "installing: ${missing[*]}"
  "${as_root[@]}" apt-get update
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get install --yes --no-install-recommends "${missing[@]}"
}

# build TESTS TARGET...
build() {
  local tests=$1
  shift
  cmake --preset release -DELASTOGEN_TESTS="$tests"
  cmake --build --preset release --target "$@"
}

cd "$(dirname "$(readlink -f "$0")")"
[ $# -ge 1 ] || {
  usage >&2
  exit 2
}
command=$1
shift
case $command in
  build)
    install_packages "${packages[@]}"
    build OFF elastogen
    echo "built: $PWD/build/bin/elastogen (try: build/bin/elastogen --help)"
    ;;
  demo)
    install_packages "${packages[@]}"
    build OFF elastogen
    build/bin/elastogen run scenes/mixed_beam.toml --out out/mixed_beam "$@"
    echo "results: $PWD/out/mixed_beam; look at the .png pictures, or open the .vtu in ParaView"
    ;;
  test)
    install_packages "${packages[@]}" "${test_packages[@]}"
    build ON all
    ctest --preset release --parallel "$(nproc)" "$@"
    ;;
  -h | --help | help)
    usage
    ;;
  *)
    echo "error: unknown command '$command'" >&2
    usage >&2
    exit 2
    ;;
esac
