#!/usr/bin/env bash
# Sets the version of the project: in CMakeLists.txt, from which all that is built takes it, and in the files of package
# managers that have to repeat it. Without a version it compares these with CMakeLists.txt, and fails where one differs.
# Usage: set_version.sh [X.Y.Z]
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
number='[0-9]+\.[0-9]+\.[0-9]+'
# A file, and what stands before the version in the first of its lines that has one.
places=(
  'CMakeLists.txt project\(kinesphere VERSION '
  'CITATION.cff version: '
  'packaging/debian/changelog kinesphere \('
  'browser/package/package.json   "version": "'
  'browser/viewer/package.json   "version": "'
  'rust/Cargo.toml version = "'
)
# The files that tools have written: the version stands below the name.
locks=(browser/package/package-lock.json browser/viewer/package-lock.json rust/Cargo.lock)

if [[ $# -gt 0 ]]; then
  if [[ $# -gt 1 || ! $1 =~ ^$number$ ]]; then echo "set_version: usage: set_version.sh [X.Y.Z]" >&2 && exit 2; fi
  for place in "${places[@]}"; do sed -E -i "0,/^(${place#* })$number/s//\1$1/" "${place%% *}"; done
  for lock in "${locks[@]}"; do sed -E -i "/\"kinesphere(-viewer)?\"/{n;s/$number/$1/}" "$lock"; done
fi

version=$(sed -nE "s/^project\(kinesphere VERSION ($number).*/\1/p" CMakeLists.txt)
for place in "${places[@]}"; do
  if [[ $(sed -nE "s/^${place#* }($number).*/\1/p" "${place%% *}" | head -n 1) != "$version" ]]; then
    echo "set_version: ${place%% *}: its version is not $version, that of CMakeLists.txt" >&2 && exit 1
  fi
done
for lock in "${locks[@]}"; do
  if [[ $(sed -nE "/\"kinesphere(-viewer)?\"/{n;s/.*\"($number)\".*/\1/p}" "$lock" | sort -u) != "$version" ]]; then
    echo "set_version: $lock: its version is not $version, that of CMakeLists.txt" >&2 && exit 1
  fi
done
