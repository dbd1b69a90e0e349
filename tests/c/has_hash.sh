#!/usr/bin/env bash
# Fails unless a program prints the expected hashes, each on one line or several, and nothing else.
# Usage: has_hash.sh <file with the hashes, sorted> <command>...
set -euo pipefail

expected=$(<"$1")
printed=$("${@:2}")
echo "$printed"
[[ $(sort -u <<<"$printed") == "$expected" ]] || { echo "has_hash: $expected was expected" >&2 && exit 1; }
