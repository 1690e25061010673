#!/usr/bin/env bash
# Builds the recipes for Bullet and Box2D, which Debian's packages libbullet-dev and libbox2d-dev carry, and judges a step
# of each: check.sh LCPLAB [FOLDER]. Many sweeps must be accepted, few rejected.
set -euo pipefail
lcplab=$(realpath "$1") here=$(realpath "$(dirname "$0")")
mkdir -p "${2:-.}" && cd "${2:-.}"
c++ -std=c++11 -O1 -Wall "$here/bullet.cpp" $(pkg-config --cflags --libs bullet) -o bullet
c++ -std=c++11 -O1 -Wall "$here/box2d.cpp" -lbox2d -o box2d

# verdict TOLERANCE EXIT PROGRAM STEPS SWEEPS
verdict() {
    "./$3" "$4" "$5"
    local code=0
    "$lcplab" judge frame.json frame.x.json --tolerance "$1" >"$3.txt" || code=$?
    echo "$3, $5 sweeps: $(sed -n 2p "$3.txt")"
    [ "$code" = "$2" ] || { echo "expected exit code $2, not $code" && exit 1; }
}
verdict 1e-4 0 bullet 30 1000
verdict 1e-4 1 bullet 30 10
verdict 1e-5 0 box2d 20 500
verdict 1e-5 1 box2d 20 4
