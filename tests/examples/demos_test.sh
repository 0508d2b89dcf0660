#!/usr/bin/env bash
# Runs the demos for a few steps, without a window and, where there is a display to be had (xvfb-run), in one:
#   demos_test.sh FOLDER_OF_THE_PROGRAMS
set -uo pipefail

programs=$(realpath "$1")
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder" || exit 1
failures=0

fail() {
    failures=$((failures + 1))
    echo "FAILED: $*"
    cat out err
}

# run PROGRAM ARG...: its status must be 0.
run() {
    what=$*
    timeout 100 "$programs/$1" "${@:2}" >out 2>err </dev/null || fail "$what: status $?"
}
prints() { grep -qxE -- "$1" out || fail "$what: does not print '$1'"; }
# picture FILE COLOURS: a PNG file with so many colours at least, in so many bytes.
picture() {
    [ "$(head -c 8 "$1" | od -An -tx1 | tr -d ' \n')" = 89504e470d0a1a0a ] && [ "$(wc -c <"$1")" -gt "$2" ] ||
        fail "$what: no picture in $1"
}

run rain --drops 2000 --steps 150 --picture rain.png --size 320x240
prints "2000 drops: [0-9]+ free, [0-9]+ bouncing or sliding, [1-9][0-9]* resting, 0 wedged"
prints "0 inside the mesh after 150 steps"
picture rain.png 20000
run rain --drops 500 --steps 3 --frames frames --size 160x120
[ "$(ls frames)" = $'frame00000.png\nframe00001.png\nframe00002.png' ] || fail "$what: $(ls frames)"
cmp -s frames/frame00000.png frames/frame00002.png && fail "$what: nothing moves"

# The promise: in one run, pierce keeps its bullets, and the usual floats don't.
run bullets --bullets 300 --steps 240 --picture bullets.png --size 320x240
prints "leaked, pierce: 0"
prints "leaked, plain floats with a skin of 0: [1-9][0-9]*"
picture bullets.png 20000

# Grains in a mesh that turns.
run drum --grains 500 --steps 200 --picture drum.png --size 320x240
prints "0 outside of the drum after 200 steps"
picture drum.png 20000

# A ball that walks is not held up by the seams of the floor, and overlaps nothing: else its status is not 0.
run character --picture character.png --size 320x240
prints "900 steps, [0-9]+ contacts in the last one, no overlap"
prints "speed kept in [1-9][0-9]{2} steps on the flat floor: 100 %"
picture character.png 5000

# refuses PROGRAM ARG...: its status is not 0, and no signal's, and it says why.
refuses() {
    what=$*
    timeout 100 "$programs/$1" "${@:2}" >out 2>err </dev/null
    status=$?
    [ "$status" -gt 0 ] && [ "$status" -lt 124 ] && [ -s err ] || fail "$what: status $status"
}
printf '%s\n' "v 0 0 0" "v 1 0 0" "v 1 1 0" "v 0 1 0" "f 1 2 3" "f 1 3 4" >flat.obj
# A file that a demo would not read is no argument of it.
for demo in bullets drum character; do refuses "$demo" level.obj --no-window --steps 0; done
refuses rain missing.obj --no-window
refuses rain --azimuth nan --no-window --steps 0
refuses bullets --skin nan --no-window --steps 0
refuses lidar --from nan,1,1
refuses visit_view --sides left
refuses pick flat.obj 0 0 1 0 0 down
run pick --help

run lidar --turns 2
prints "131072 of 131072 rays came back, .* million rays a second"
picture range.png 5000
[ "$(wc -c <cloud.ply)" -eq $((131072 * 16 + $(head -n 8 cloud.ply | wc -c))) ] || fail "$what: size of the cloud"
# It goes through the mesh that it is given, of any size.
printf '%s\n' "v 0 0 0" "v .01 0 0" "v 0 .01 0" "v 0 0 .01" "f 1 3 2" "f 1 2 4" "f 1 4 3" "f 2 3 4" >small.obj
run lidar small.obj --turns 1
prints "[1-9][0-9]{4} of 65536 rays came back, .*"

run pick
prints "face 3 at \(0\.45 0\.6 1\), its corner of the largest weight: vertex 7"

# Why a face is hit, and the others are not.
cat >steps.obj <<'MESH'
v 0 0 0
v 4 0 0
v 0 4 0
v 0 0 -2
v 4 0 -2
v 0 4 -2
v 9 9 0
v 9 8 0
v 8 9 0
v 2 0 0
f 1 2 3
f 4 5 6
f 4 6 5
f 7 8 9
f 1 10 2
f 1 2 5
MESH
run visit_view steps.obj --segment 1 1 3 1 1 -5 --obj visit.obj --picture visit.png --size 320x240
prints "first_hit went to [01] of [01] nodes and 1 of 1 clusters of triangles"
prints "it hits face 0 at \(1 1 0\), fraction 0\.375"
prints "on the way to it are the boxes of 0 nodes and 1 clusters"
prints " +1  first hit"
prints " +1  later than the first hit"
prints " +1  passes from the other side"
prints " +2  boxes apart"
prints " +1  zero area"
picture visit.png 5000
[ "$(grep -c '^l' visit.obj)" -eq 19 ] && grep -qx "l 15 16 17 15" visit.obj && grep -qx "g first_hit" visit.obj ||
    fail "$what: lines $(cat visit.obj)"
run visit_view steps.obj --segment 1 1 3 1 1 -5 --sides back --max-fraction 0.5
prints "it hits nothing"
prints " +1  beyond max_fraction"
prints " +2  passes from the other side"
run visit_view flat.obj
prints "it hits face [01] at .*"
run visit_view
prints "it hits face [0-9]+ at .*"
prints "on the way to it are the boxes of [1-9][0-9]* nodes and [1-9][0-9]* clusters"

# Three cars take the same way, and rays that Bullet gets wrong pierce does not: else its status is not 0.
windows=(rain bullets drum character)
if [ -x "$programs/bullet_physics" ]; then
    run bullet_physics --rays 2000 --steps 600 --picture drive.png --size 320x240
    for aim in "past an edge by a hair" "two steps that meet in a vertex"; do
        prints "$aim +2000 .* 0 +0"
        prints "$aim +2000 .*[1-9][0-9]+ .*"
    done
    prints "beside the border, by a hair +2000 +0 +2000 +0 +0 +0"
    prints "through an edge +2000 +[1-9][0-9]+ +0 +0 +0 +0"
    prints "a wheel's ray takes: Bullet [0-9]+ ns, pierce [0-9]+ ns, .*"
    prints "the car drives [1-9][0-9]+\.[0-9] m with [34]\.[0-9] wheels on the ground"
    picture drive.png 10000
    windows+=(bullet_physics)
else
    echo "no bullet_physics: Bullet was not found when the examples were built"
fi

if "$programs/rain" --help | grep -q screenshot && command -v xvfb-run >/dev/null; then
    for demo in "${windows[@]}"; do
        what="$demo in a window"
        timeout 100 xvfb-run -a -s "-screen 0 800x600x24" "$programs/$demo" --steps 20 --screenshot "$demo.window.png" \
            --size 640x480 >out 2>err </dev/null || fail "$what: status $?"
        picture "$demo.window.png" 8000
    done
else
    echo "no xvfb-run: the windows of the demos are not tried"
fi

[ "$failures" -eq 0 ] && echo "all demos do what they should"
exit "$((failures > 0))"
