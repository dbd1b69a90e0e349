#!/usr/bin/env bash
# Builds the Python package `kinesphere` as a wheel, from its source distribution, installs it into a clean virtual
# environment, and tests it there: the ten lines of its README, types (mypy, stubtest), tests (pytest), whether the
# pictures of the docs are as the package makes them, and every example.
# Nothing is asked of any network. The interpreter is Debian's, for which its packages are; PYTHON names another.
# Usage: run.sh <build folder with the library, simulation/ and the native program>
set -euo pipefail

build=$(realpath "$1")
python=${PYTHON:-/usr/bin/python3}
source=$(realpath "$(dirname "${BASH_SOURCE[0]}")/..")
work=$build/python
log=$work/log
# ccache depends on the folder of a compilation; pip's own folders change each time.
rm -rf "$work/unpacked" "$work/wheel" "$work/venv" "$work"/kinesphere-*.tar.gz && mkdir -p "$work/wheel" "$work/pictures"
quietly() { "$@" >"$log" 2>&1 || { cat "$log"; exit 1; }; }

# The source distribution has everything that the package is built from.
quietly env -C "$source" "$python" setup.py -q egg_info --egg-base "$work" sdist --dist-dir "$work"
mkdir "$work/unpacked" && tar -xf "$work"/kinesphere-*.tar.gz -C "$work/unpacked" --strip-components=1
# Uses the objects of the library in the build.
export SKBUILD_CONFIGURE_OPTIONS="-DKINESPHERE_BUILD=$build"
quietly "$python" -m pip --isolated wheel --no-build-isolation --no-index --no-deps --wheel-dir "$work/wheel" "$work/unpacked"

# Clean except for the packages of Debian's Python: NumPy and the tools of the tests.
"$python" -m venv --system-site-packages --without-pip "$work/venv"
clean=$work/venv/bin/python
quietly "$clean" -m pip --isolated install --no-index --no-warn-script-location "$work"/wheel/kinesphere-*.whl

cd "$work"
# mypy runs alone, since it needs most of the time. stubtest compares the types with the module as it is.
{
  "$python" -m mypy --config-file "$source/mypy.ini" --cache-dir "$work/mypy" --python-executable "$clean" \
    "$source/kinesphere" "$source/test" "$source/examples" &&
    "$clean" -m mypy.stubtest kinesphere --concise --mypy-config-file "$source/mypy.ini" \
      --allowlist "$source/test/stubtest_allowed.txt" --ignore-unused-allowlist
} >"$work/mypy.log" 2>&1 &
mypy=$!
# Prints the first block of Python in a page: the guide shows it too.
python_of() { awk '/^```python/ {on = 1; next} on && /^```/ {exit} on' "$1"; }
python_of "$source/README.md" >"$work/ten_lines.py"
diff "$work/ten_lines.py" <(python_of "$source/../docs/python.md")
"$clean" "$work/ten_lines.py"
export KINESPHERE_PROGRAM=$build/programs/kinesphere
"$clean" -B -m pytest -q -p no:cacheprovider "$source/test"

# Tests the build with another NumPy, if there is one.
if [[ -n ${KINESPHERE_NUMPY2:-} ]]; then
  PYTHONPATH=$KINESPHERE_NUMPY2 "$clean" -c 'import numpy; assert numpy.__version__.startswith("2."), numpy.__version__'
  PYTHONPATH=$KINESPHERE_NUMPY2 "$clean" -B -m pytest -q -p no:cacheprovider "$source/test"
else
  echo "NumPy 2: skipped, as KINESPHERE_NUMPY2 does not name a folder with one"
fi

"$clean" -m kinesphere.bench --program "$KINESPHERE_PROGRAM" --bodies 2000 --repeats 1

echo "pictures of the docs:"
"$clean" -B "$source/../docs/pictures/make.py" --check

cd "$work/pictures"
for example in gas drones certainty side_by_side alerts vicsek packing traffic drone_show ships; do
  echo "example $example:"
  "$clean" "$source/examples/$example.py"
done
recording=${KINESPHERE_DATA:-$source/../../shared/data}/ucy_students03/ucy_students03_obsmat.txt.gz
if [[ -e $recording ]]; then
  echo "example walkers:"
  "$clean" "$source/examples/walkers.py" "$recording"
else
  echo "example walkers: skipped, as there is no $recording"
fi
echo "example conjunctions:"
catalogue=${KINESPHERE_DATA:-$source/../../shared/data}/tle/catalogue_2026-05-30.tle.gz
if [[ -e $catalogue ]]; then
  "$clean" "$source/examples/conjunctions.py" "$catalogue" --every 40 --hours 3 --distance 30
else
  "$clean" "$source/examples/conjunctions.py" --distance 50 --hours 6
fi
"$clean" "$source/examples/check_conjunctions.py" --distance 50 --hours 6
wait $mypy || { cat "$work/mypy.log"; exit 1; }
cat "$work/mypy.log"
