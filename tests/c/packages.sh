#!/usr/bin/env bash
# Fails unless cpack makes the Debian packages of the shared library, with nothing but it, and of the files for developers.
# Usage: packages.sh <build folder>
set -euo pipefail

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
cpack --config "$1/CPackConfig.cmake" -B "$work" >"$work/log" 2>&1 || { cat "$work/log"; exit 1; }
files() { dpkg-deb -c "$work/$1"_*.deb | awk '{print $6}' | grep -v '/$'; }
files libkinesphere-c0
[[ $(files libkinesphere-c0 | grep -cv '/libkinesphere-c\.so\.[0-9][.0-9]*$') == 0 ]]
for file in include/kinesphere.h include/kinesphere/world.hpp libkinesphere-c.so pkgconfig/kinesphere-c.pc \
  cmake/kinesphere-c/kinesphere-c-config.cmake; do
  files libkinesphere-dev | grep "/$file\$"
done
dpkg-deb -f "$work"/libkinesphere-dev_*.deb Depends | grep -F 'libkinesphere-c0 (= '
