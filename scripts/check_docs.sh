#!/usr/bin/env bash
# Fails unless the docs are true:
# - The C++ example of README.md is examples/first_contact.cpp, word for word, and prints the quoted output; so does the
#   main job in docs/program.md, timings aside.
# - The three examples of docs/watch.md print what follows them, its table counts the alerts of their streams, and
#   make_streams.py makes these streams.
# - Each line of C, Rust and C# in docs/c.md is in an example of its language.
# - Each line of C++ in the guides (docs/games.md, worlds.md, running.md, recipes.md, from-box2d.md, distributed.md) and in
#   docs/lessons is in an example, and examples/sensors.cpp prints its output in docs/worlds.md.
# - Each example that a lesson runs prints what the lesson says.
# - Each mark "proved" or "tested" in docs/guarantee.md names an existing theorem or test, and the tables of
#   proof/README.md have all theorems of proof/.
# - No paragraph of docs/ and README.md is longer than 120 words, and no cell of a table longer than 40; a link counts as
#   its text.
# Usage: check_docs.sh <example first_contact> <example sensors> <program kinesphere>
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
theorems=$(sed -nE 's/^Theorem ([a-z_0-9]+).*/\1/p' proof/*.v | sort)
# A mark with a slash is a test, any other a theorem.
sed 's/⟨/\n⟨/g; s/⟩/\n/g' docs/guarantee.md | grep '^⟨' | grep -oE '`[^`]*`' | tr -d '`' | sort -u | while IFS= read -r name; do
  if [[ $name == */* ]] && [[ -f tests/$name.cpp ]] || grep -qxF -- "$name" <<<"$theorems"; then continue; fi
  echo "docs/guarantee.md: no theorem, and no test, is named $name" >&2
  exit 1
done
diff <(awk -F'|' '!/^\|/ {on = 0} on {print $2} /^\| theorem / {on = 1}' proof/README.md | grep -oE '`[^`]*`' | tr -d '`' | sort) - <<<"$theorems"

awk '
  function words(text, parts) {gsub(/\]\([^)]*\)/, "]", text); return split(text, parts, " ")}
  function too_long(what, count, most) {
    if (count <= most) return
    printf "%s:%d: a %s of %d words: at most %d\n", file, line, what, count, most > "/dev/stderr"
    failed = 1
  }
  function end_paragraph() {too_long("paragraph", words(text), 120); text = ""}
  FNR == 1 {end_paragraph(); in_code = 0}
  /^ *```/ {end_paragraph(); in_code = !in_code; next}
  in_code {next}
  /^ *\|[ -]/ {
    end_paragraph(); file = FILENAME; line = FNR; gsub(/\\\|/, "")
    for (k = split($0, cells, "|"); k > 0; --k) too_long("cell", words(cells[k]), 40)
    next
  }
  /^ *$/ || /^#/ {end_paragraph(); next}
  /^ *([-*]|[0-9]+\.) / {end_paragraph()}
  {if (text == "") {file = FILENAME; line = FNR} text = text " " $0}
  END {end_paragraph(); exit failed}' README.md docs/*.md docs/*/*.md

# The lines of a block in a file after a line that matches a pattern: of the first one, or of the given number.
block_after() {
  awk -v pattern="$2" -v wanted="${3:-1}" '
    $0 ~ pattern {near = 1; next}
    near && /^```/ {if (on && count == wanted) exit; on = !on; count += on; next}
    on && count == wanted {print}' "$1"
}
# The width of the columns depends on the timings too.
untimed() { grep -v '^real' | tr -s ' '; }

diff <(block_after README.md '^## Thirty lines$') examples/first_contact.cpp
printed=$("$1")
diff <(block_after README.md '^prints$') - <<<"$printed"
printed=$("$3" run paper1)
diff <(block_after docs/program.md '^`scripts.run.sh` prints' | untimed) <(untimed <<<"$printed")
printed=$("$2")
diff <(block_after docs/worlds.md '^Sensors see fast bodies') - <<<"$printed"

# The examples of watch print what they are said to print, and count as many alerts.
export PATH=${3%/*}:$PATH
for who in sailor receiver operator; do
  diff <(block_after docs/watch.md "^[*][*]An? $who" 2) <(bash -c "$(block_after docs/watch.md "^[*][*]An? $who")")
done
diff <(grep -A4 '^| stream | options | alerts' docs/watch.md) <(python3 examples/streams/count_alerts.py "$3")
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
python3 examples/streams/make_streams.py "$made"
for stream in "$made"/*; do cmp "$stream" "examples/streams/${stream##*/}"; done

# Each line of C++ in the guides stands in an example.
for page in docs/games.md docs/worlds.md docs/running.md docs/fluids.md docs/grains.md docs/recipes.md docs/from-box2d.md docs/distributed.md docs/lessons/*.md; do
  awk '/^```/ {on = $0 == "```cpp"; next} on && NF {print}' "$page" | while IFS= read -r line; do
    if ! grep -qxF -- "$line" examples/*.cpp; then
      echo "$page: no example has the line: $line" >&2
      exit 1
    fi
  done
done

# Each example of a lesson that has been built here prints the block of text after its command. With any number of
# processes example_distributed prints the same.
for page in docs/lessons/*.md; do
  name=$(sed -nE 's|^.*build/lessons/examples/(example_[a-z_]+)$|\1|p' "$page")
  if [[ -z $name ]]; then echo "$page: runs no example" >&2 && exit 1; fi
  if [[ ! -e ${1%/*}/$name ]]; then continue; fi
  printed=$("${1%/*}/$name")
  diff <(awk '/^```/ {on = $0 == "```text"; next} on' "$page") - <<<"$printed"
done

# Each line of C, Rust and C# in docs/c.md stands in an example.
lines_of() { awk -v fence='```'"$1" '/^```/ {on = $0 == fence; next} on && NF {print}' docs/c.md; }
missing=$({ lines_of c | grep -vxFf <(cat examples/c/*.c examples/c/*/*.c); lines_of rust | grep -vxFf <(cat rust/examples/*.rs)
  lines_of csharp | grep -vxFf <(cat csharp/examples/*.cs); } || true)
if [[ -n $missing ]]; then echo "docs/c.md: no example has the line: $missing" >&2 && exit 1; fi
