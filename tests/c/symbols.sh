#!/usr/bin/env bash
# Fails unless the shared library exports the functions of kinesphere.h, as c/kinesphere-c.map lists them, and nothing
# else. A function that a released library had must stay.
# Usage: symbols.sh <shared library>
set -euo pipefail

source=$(realpath "$(dirname "${BASH_SOURCE[0]}")/../..")
listed=$(sed -nE 's/^ +(ks_[a-z0-9_]+);$/\1/p' "$source/c/kinesphere-c.map")
declared=$(tr '\n' ' ' <"$source/include/kinesphere.h" | grep -oE 'KS_API (KS_MUST_CHECK )?[a-z0-9_ ]+[ *]+ks_[a-z0-9_]+\(' |
  sed -E 's/.*(ks_[a-z0-9_]+)\($/\1/' | sort)
exported=$(nm -D --defined-only "$1" | sed -nE 's/.* [TDBRWVu] ([^@]*).*/\1/p' | sort)
diff <(echo "$listed") <(echo "$declared")
diff <(echo "$listed") <(echo "$exported")
echo "$(wc -l <<<"$exported") functions"
