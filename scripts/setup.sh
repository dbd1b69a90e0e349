#!/usr/bin/env bash
# Installs the Debian packages that are missing here. Where none is, it does nothing, without network.
# Usage: setup.sh run | program | mpi | mpich | browser | python | research | prove | docs | test | windows | packages | all | coverage
set -euo pipefail

packages=(g++ cmake ninja-build libhwy-dev libcli11-dev libfmt-dev nlohmann-json3-dev zlib1g-dev)
# For the commands beside those for scenes.
if [[ ${1:-} != run ]]; then packages+=(libsimdjson-dev libgeographiclib-dev libexpat1-dev libnats-dev); fi
mpi=(libopenmpi-dev openmpi-bin libtrilinos-zoltan-dev)
browser=(emscripten nodejs)
# Node.js's own package brings npm.
if ! command -v npm >/dev/null; then browser+=(npm); fi
python=(python3-dev python3-pip python3-venv python3-setuptools python3-wheel python3-skbuild pybind11-dev python3-numpy)
python_testing=(python3-pytest python3-sgp4 python3-pandas python3-matplotlib python3-scipy mypy black)
proving=(coq libcoq-flocq)
# For the clients of the C interface in Rust, which may have come without Debian, and C#.
clients=(mono-mcs mono-runtime)
if ! command -v cargo >/dev/null; then clients+=(rustc cargo); fi
documenting=(mkdocs mkdocs-material doxygen doxygen-awesome-css)
testing=("${mpi[@]}" "${documenting[@]}" "${python[@]}" "${python_testing[@]}" "${clients[@]}" libcpp-httplib-dev libgtest-dev libtbb-dev nats-server librapidcheck-dev clang libclang-rt-dev clang-format clang-tidy pkg-config valgrind xz-utils)
# For Windows, cross-compiled and run under Wine.
windows=(g++-mingw-w64-x86-64-posix wine wine64 googletest dpkg-dev)
# For packages that people install.
packaging=(debhelper dh-python lintian debootstrap help2man python3-build nuget binutils)
case ${1:-} in
  run | program) ;;
  mpi) packages+=("${mpi[@]}") ;;
  mpich) packages+=(mpich libmpich-dev libgtest-dev librapidcheck-dev libcpp-httplib-dev nats-server) ;;
  browser) packages+=("${browser[@]}") ;;
  python) packages+=("${python[@]}") ;;
  research) packages+=(gnuplot-nox libbullet-dev libfcl-dev libgtest-dev librapidcheck-dev clang clang-format clang-tidy black) ;;
  test) packages+=("${testing[@]}") ;;
  windows) packages=(g++ cmake ninja-build "${windows[@]}") ;;
  all) packages+=("${testing[@]}" "${browser[@]}" chromium "${proving[@]}" "${packaging[@]}") ;;
  packages) packages+=("${packaging[@]}" "${python[@]}" "${clients[@]}") ;;
  docs) packages+=("${documenting[@]}" "${python[@]}") ;;
  prove) packages=("${proving[@]}" g++ libgtest-dev) ;;
  coverage) packages+=("${testing[@]}" gcovr) ;;
  *) echo "setup: usage: setup.sh run | program | mpi | mpich | browser | python | research | prove | docs | test | windows | packages | all | coverage" >&2 && exit 2 ;;
esac

if ! command -v apt-get >/dev/null; then
  echo "setup: no apt-get here, so nothing was installed; needed are: ${packages[*]}" >&2
  exit 0
fi

installed=$(dpkg-query -W -f='${db:Status-Status} ${binary:Package}\n' | sed -n 's/^installed \([^:]*\).*/\1/p')
missing=$(comm -23 <(printf '%s\n' "${packages[@]}" | sort) <(sort -u <<<"$installed"))
if [[ -z $missing ]]; then exit 0; fi
# From here on a list of words.
read -r -d '' -a missing <<<"$missing" || true

become_root=()
if [[ $(id -u) != 0 ]]; then
  if ! command -v sudo >/dev/null; then
    echo "setup: there is no sudo; as root, run: apt-get install ${missing[*]}" >&2
    exit 1
  fi
  become_root=(sudo)
fi

log=$(mktemp)
trap 'rm -f "$log"' EXIT
apt() {
  "${become_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get -q -y "$@" </dev/null >"$log" 2>&1 && return
  cat "$log" >&2
  return 1
}

echo "setup: installing ${missing[*]}"
apt update || { sleep 5 && apt update; }
apt install --no-install-recommends "${missing[@]}"
