#!/usr/bin/env bash
# Makes the packages of the last commit, and uses each where nothing but it is installed.
# Usage: packages.sh [--into FOLDER] [debian | wheel | crate | nuget]...
#   --into FOLDER   keeps the packages there
#   debian          libkinesphere-c0, libkinesphere-dev, kinesphere, python3-kinesphere: without a complaint of lintian,
#                   installed into a bare Debian (as root, by debootstrap)
#   wheel           Python's source distribution, and the wheel made of it, which needs nothing but libc, libstdc++ and
#                   NumPy
#   crate, nuget    for Rust and C#, around the shared library of the C interface
# The npm package is made and tested by browser/test/run.sh.
set -euo pipefail

root=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
"$root/scripts/setup.sh" packages
work=$(mktemp -d)
into=$work/packages
# Debian's, for which its packages are.
python=${PYTHON:-/usr/bin/python3}
if [[ ${1:-} == --into ]]; then into=$(realpath -m "$2") && shift 2; fi
trap '! mountpoint -q "$work/bare/proc" || umount "$work/bare/proc"; rm -rf "$work"' EXIT
mkdir -p "$into"
quietly() { "$@" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }; }
fail() { echo "packages: $*" >&2 && exit 1; }
git -C "$root" archive --prefix=kinesphere/ HEAD | tar -x -C "$work"
sources=$work/kinesphere

# The hash of the first scene of the README.
readonly hash=7c2535f36c736ba4
readonly ten_lines='
import kinesphere as ks
motion = ks.Ballistic([(0, 0, 0), (4, 0, 0)], [(1, 0, 0), (0, 0, 0)])
world = ks.World()
world.add_motion(motion, radii=0.5)
assert abs(world.advance(9.0, motion).time - 3.0) < 1e-6'

debian() {
  cp -r "$sources/packaging/debian" "$sources/debian"
  (cd "$sources" && quietly dpkg-buildpackage --no-sign --build=binary)
  rm -r "$sources/debian"
  # Nothing has been uploaded to Debian, and no address of the authors is known.
  lintian --allow-root --fail-on error,warning \
    --suppress-tags initial-upload-closes-no-bugs,bogus-mail-host,bogus-mail-host-in-debian-changelog "$work"/*.changes
  cp "$work"/*.deb "$into"
  if [[ $(id -u) != 0 ]]; then echo "debian: not installed into a bare Debian, as that needs root" && return; fi
  local bare=$work/bare
  quietly debootstrap --variant=minbase bookworm "$bare"
  cp "$work"/*.deb "$bare"
  mount -t proc proc "$bare/proc"
  quietly chroot "$bare" env DEBIAN_FRONTEND=noninteractive sh -c 'rm -f /*dbgsym*.deb && apt-get -q -y update &&
    apt-get -q -y install --no-install-recommends /*.deb gcc libc6-dev pkg-config man-db'
  chroot "$bare" kinesphere run paper1 | grep "$hash"
  chroot "$bare" python3 -c "$ten_lines"
  for manual in kinesphere kinesphere-watch; do
    chroot "$bare" man "$manual" | grep -q 'alerts' || fail "there is no manual $manual"
  done
  cp "$sources/examples/c/first_contact.c" "$bare"
  chroot "$bare" sh -c 'cc /first_contact.c $(pkg-config --cflags --libs kinesphere-c) -lm -o /first_contact && /first_contact'
}

# Builds the C library, with Highway's beside it.
c_library() {
  if [[ -d $work/native ]]; then return; fi
  quietly cmake -G Ninja -S "$sources" -B "$work/build" -DCMAKE_BUILD_TYPE=Release -DKINESPHERE_BUILD_C=ON
  quietly cmake --build "$work/build" --target kinesphere_c
  mkdir "$work/native"
  cp -L "$work"/build/c/libkinesphere-c.so "$work/native"
  cp -L "$work"/build/c/libkinesphere-c.so.? "$work/native"
}

wheel() {
  local dist=$work/dist files=$work/wheel_files
  quietly env -C "$sources/python" "$python" -m build --no-isolation --skip-dependency-check --outdir "$dist" .
  "$python" -m zipfile -e "$dist"/*.whl "$files"
  # What auditwheel asks of a manylinux wheel: no library that a system may lack, no newer glibc than this one's.
  local needed
  needed=$(objdump -p "$files"/kinesphere/*.so* | sed -n 's/ *NEEDED *//p' | sort -u |
    grep -vE '^(libstdc\+\+\.so\.6|libgcc_s\.so\.1|libm\.so\.6|libc\.so\.6|ld-linux-.*|libhwy\.so.*)$' || true)
  if [[ $needed ]]; then fail "the wheel needs $needed"; fi
  local glibc
  glibc=$(objdump -T "$files"/kinesphere/*.so* | grep -oE 'GLIBC_[0-9.]+' | sort -uV | tail -n 1)
  echo "the wheel needs ${glibc/_/ } or later"
  # A virtual environment that sees NumPy and no Highway.
  "$python" -m venv --system-site-packages --without-pip "$work/venv"
  quietly "$work/venv/bin/python" -m pip --isolated install --no-index --no-deps "$dist"/*.whl
  "$work/venv/bin/python" -c "$ten_lines"
  LD_DEBUG=libs "$work/venv/bin/python" -c 'import kinesphere' 2>&1 | grep -q 'calling init: .*kinesphere/libhwy' ||
    fail "the wheel does not use its own libhwy"
  cp "$dist"/* "$into"
}

crate() {
  c_library
  export KINESPHERE_LIB_DIR=$work/native CARGO_TARGET_DIR=$work/target
  (cd "$sources/rust" && quietly cargo package --offline --no-verify)
  local project=$work/crate
  mkdir -p "$project/src"
  tar -x -C "$project" -f "$work"/target/package/kinesphere-*.crate
  cat >"$project/Cargo.toml" <<EOF
[package]
name = "user"
version = "0.1.0"
edition = "2021"
[dependencies]
kinesphere = { path = "$(basename "$project"/kinesphere-*)" }
EOF
  cp "$sources/rust/examples/game_loop.rs" "$project/src/main.rs"
  (cd "$project" && RUSTFLAGS="-C link-arg=-Wl,-rpath,$KINESPHERE_LIB_DIR" cargo run --offline --quiet)
  cp "$work"/target/package/*.crate "$into"
}

nuget_package() {
  c_library
  local project=$work/nuget
  mkdir "$project"
  quietly mcs -target:library -unsafe -doc:"$project/Kinesphere.xml" -out:"$project/Kinesphere.dll" "$sources"/csharp/src/*.cs
  quietly nuget pack "$sources/csharp/Kinesphere.nuspec" -BasePath "$work" -OutputDirectory "$into" \
    -Version "$(sed -nE 's/^project\(kinesphere VERSION ([0-9.]+).*/\1/p' "$sources/CMakeLists.txt")" -NoPackageAnalysis
  (cd "$project" && quietly nuget install Kinesphere -Source "$into" -OutputDirectory installed)
  local library=("$project"/installed/Kinesphere.*/lib/net45/Kinesphere.dll)
  cp "${library[0]}" "$project/installed"
  mcs -r:"$project/installed/Kinesphere.dll" -out:"$project/installed/FirstContact.exe" "$sources/csharp/examples/FirstContact.cs"
  LD_LIBRARY_PATH=$(echo "$project"/installed/Kinesphere.*/runtimes/linux-x64/native) mono "$project/installed/FirstContact.exe"
}

if [[ $# == 0 ]]; then set -- debian wheel crate nuget; fi
for package; do
  case $package in
    debian | wheel | crate) "$package" ;;
    nuget) nuget_package ;;
    *) fail "expected debian, wheel, crate or nuget, but got $package" ;;
  esac
  echo "packages: $package is good"
done
