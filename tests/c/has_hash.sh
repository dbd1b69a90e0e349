#!/usr/bin/env bash
# Fails unless a program prints the expected hash, on each of its lines.
# Usage: has_hash.sh <file with the hash> <command>...
set -euo pipefail

expected=$(<"$1")
printed=$("${@:2}")
echo "$printed"
[[ $(sort -u <<<"$printed") == "$expected" ]] || { echo "has_hash: $expected was expected" >&2 && exit 1; }
