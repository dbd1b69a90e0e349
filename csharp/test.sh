#!/usr/bin/env bash
# Compiles the C# library with mono, and tests it; its examples print what those in C print.
# Usage: test.sh <folder of libkinesphere-c.so> <build folder> <file with the hash of the shared scene>
#   <game loop in C> <monitor in C>
set -euo pipefail

hash=$3 game_loop=$4 monitor=$5 work=$2/csharp
export LD_LIBRARY_PATH=$1
source=$(realpath "$(dirname "${BASH_SOURCE[0]}")")
mkdir -p "$work"
mcs -unsafe -warnaserror -target:library -out:"$work/Kinesphere.dll" "$source"/src/*.cs
compile() { mcs -warnaserror -r:"$work/Kinesphere.dll" -r:System.Core -out:"$work/$2.exe" "$source/$1/$2.cs"; }
compile examples FirstContact
compile examples GameLoop
compile examples Tower
compile test SharedScene
diff <(mono "$work/FirstContact.exe") <("${game_loop%/*}/example_c_first_contact")
diff <(mono "$work/GameLoop.exe") <("$game_loop")
diff <(mono "$work/Tower.exe") <("$monitor")
"$source/../tests/c/has_hash.sh" "$hash" mono "$work/SharedScene.exe"
