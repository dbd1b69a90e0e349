#!/usr/bin/env bash
# Fails unless the C++ example in README.md is examples/first_contact.cpp, word for word, and what README.md says that
# it prints is what the program given as argument prints.
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
block() { awk -v first="$1" '$0 == "```" && on {exit} on {print} $0 == first {on = 1}' README.md; }
diff <(block '```cpp') examples/first_contact.cpp
printed=$("$1")
diff <(awk '/^prints$/ {near = 1} near && on && $0 == "```" {exit} on {print} near && $0 == "```" {on = 1}' README.md) <(echo "$printed")
