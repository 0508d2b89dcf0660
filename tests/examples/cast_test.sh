#!/usr/bin/env bash
# Runs the example program `cast` on small meshes and compares what it prints, writes and returns:
#   cast_test.sh PATH_OF_CAST
set -uo pipefail

cast=$(realpath "$1")
. "$(dirname "$0")/checks.sh"

# run ARG...: leaves the exit status in $status and the output in the files out and err.
run() {
    what="cast $*"
    "$cast" "$@" >out 2>err </dev/null
    status=$?
}

# run_error LINE ARG...: status 2, nothing on standard output and just this line on standard error.
run_error() {
    local line=$1
    shift
    run "$@"
    [ "$status" -eq 2 ] || fail "exit status $status, not 2"
    [ "$(cat err)" = "$line" ] || fail "expected: $line" "printed:  $(cat err)"
    [ ! -s out ] || fail "printed on standard output: $(head -n 1 out)"
}

# run_ok ARG...: status 0.
run_ok() {
    run "$@"
    [ "$status" -eq 0 ] || fail "exit status $status, not 0" "$(cat err)"
}

# rows TEXT [FILE]: the rows of the CSV, without the header, are these. The fraction and the point may lie before the
# exact ones, but by rounding only; all else is compared as text.
rows() {
    tail -n +2 "${2:-out}" >printed
    printf '%s\n' "$1" | sed '/^$/d' >expected
    [ "$(wc -l <printed)" -eq "$(wc -l <expected)" ] && paste -d, expected printed | awk -F, '
        function differ(a, b) { return (a == "") != (b == "") || a - b > 1e-12 || b - a > 1e-12 }
        {
            for (i = 1; i <= 5; ++i) if ($i "" != $(i + 9) "") exit 1
            for (i = 6; i <= 9; ++i) if (differ($i, $(i + 9))) exit 1
            if ($15 > $14 || NF != 18) exit 1
        }' || fail "expected: $1" "printed:  $(cat printed)"
}

# contains FILE TEXT
contains() { grep -qF -- "$2" "$1" || fail "no '$2' in:" "$(cat "$1")"; }
lacks() { ! grep -qF -- "$2" "$1" || fail "'$2' in:" "$(cat "$1")"; }

cat >triangle.obj <<'MESH'
v 0 0 0
v 4 0 0
v 0 4 0
f 1 2 3
MESH
# A cube of six squares, fronts outwards. Face 0 is at the bottom (z = 0), face 1 at the top.
cat >cube.obj <<'MESH'
v 0 0 0
v 2 0 0
v 2 2 0
v 0 2 0
v 0 0 2
v 2 0 2
v 2 2 2
v 0 2 2
f 1 4 3 2
f 5 6 7 8
f 1 2 6 5
f 2 3 7 6
f 3 4 8 7
f 4 1 5 8
MESH
# A triangle, the same again, and two of zero area.
cat >odd.obj <<'MESH'
v 0 0 0
v 4 0 0
v 0 4 0
v 2 0 0
f 1 2 3
f 2 3 1
f 1 2 4
f 3 3 4
MESH

# Answers. The header once, then rows only.
run_ok triangle.obj --csv --segment "1 1 3  1 1 -1"
[ "$(head -n 1 out)" = "segment,face,side,feature,exact_fraction,fraction,x,y,z" ] || fail "header: $(head -n 1 out)"
rows "0,0,front,face,0.75,0.75,1,1,0"
contains err "1 segment: 1 hit, 0 missed"

run_ok triangle.obj --csv --segment "1 1 -1  1 1 3" --segment "9 9 1  9 9 -1" --segment "2 0 1  2 0 -1" \
    --segment "0 4 1  0 4 -1" --sides both
rows "0,0,back,face,0.25,0.25,1,1,0
1,,,,,,,,
2,0,front,edge 0,0.5,0.5,2,0,0
3,0,front,vertex 2,0.5,0.5,0,4,0"

run_ok triangle.obj --csv --segment "1 1 -1  1 1 3"
rows "0,,,,,,,,"
run_ok triangle.obj --csv --segment "1 1 -1  1 1 3" --sides back
rows "0,0,back,face,0.25,0.25,1,1,0"
run_ok triangle.obj --csv --segment "1 1 3  1 1 -1" --sides back
rows "0,,,,,,,,"

run_ok triangle.obj --csv --segment "1 1 3  1 1 -1" --max-fraction 0.75
rows "0,0,front,face,0.75,0.75,1,1,0"
run_ok triangle.obj --csv --segment "1 1 3  1 1 -1" --max-fraction 0.7499
rows "0,,,,,,,,"

run_ok cube.obj --csv --segment "0.5 0.75 4  0.5 0.75 -4"
rows "0,1,front,face,0.25,0.25,0.5,0.75,2"
run_ok cube.obj --csv --segment "0.5 0.75 4  0.5 0.75 -4" --segment "5 5 5  6 6 6" --all --sides both
[ "$(tail -n +2 out | cut -d, -f1-5)" = "0,1,front,face,0.25
0,0,back,face,0.5
1,,,," ] || fail "$(cat out)"
contains err "2 segments: 1 hit, 1 missed, 2 hits in all"
run_ok cube.obj --csv --segment "0.5 0.75 4  0.5 0.75 -4" --segment "5 5 5  6 6 6" --any
[ "$(cat out)" = "segment,hit
0,yes
1,no" ] || fail "$(cat out)"

# All digits: a third is read back as the same number, in float with fewer of them.
run_ok triangle.obj --csv --segment "1 1 1  1 1 -2"
[ "$(tail -n 1 out | cut -d, -f5)" = 0.3333333333333333 ] || fail "$(cat out)"
run_ok cube.obj --csv --random 200 --sides both
tail -n +2 out | awk -F, '$6 < $5 { ++before } $6 > $5 { exit 1 } END { exit !before }' ||
    fail "the fractions of the points are not at and before the exact ones"
run_ok triangle.obj --csv --float --segment "1 1 1  1 1 -2"
[ "$(tail -n 1 out | cut -d, -f5)" = 0.33333334 ] || fail "$(cat out)"

# Segments from a file and from standard input come before those of the command line.
printf '# from, to\n\n  1 1 3\t1 1 -1   # down\r\n+1 1e0 -.1e1 1 1 3\n' >segments.txt
run_ok triangle.obj --csv --sides both --segments segments.txt --segment "9 9 1 9 9 -1"
rows "0,0,front,face,0.75,0.75,1,1,0
1,0,back,face,0.25,0.25,1,1,0
2,,,,,,,,"
what="cast --segments -"
"$cast" triangle.obj --csv --segments - <segments.txt >out 2>err || fail "$(cat err)"
rows "0,0,front,face,0.75,0.75,1,1,0
1,,,,,,,,"
: >empty.txt
run_ok triangle.obj --csv --segments empty.txt
rows ""

# The table, the counts, and CSV in a file.
run_ok odd.obj --segment "1 1 3  1 1 -1" --segment "9 9 1  9 9 -1"
[ "$(head -n 3 out | tr -s ' ' | sed 's/ 1 1 .*//')" = "segment face side feature exact fraction fraction x y z
 0 0 front face 0.75 0.75
 1 - - - - - - - -" ] || fail "$(cat out)"
contains out "4 faces, of them 2 of zero area and 1 duplicate; 4 vertices"
contains out " ns a segment"
run_ok cube.obj
contains out "6 faces cut into 12 triangles, of them 0 of zero area and 0 duplicates; 8 vertices"
contains out "10 segments: "
run_ok cube.obj --random 50
[ "$(grep -cE '^ *[0-9]+  ' out)" -eq 20 ] || fail "not 20 rows" "$(cat out)"
contains out "... and 30 more rows (--all-rows shows them)"
run_ok cube.obj --random 50 --all-rows
[ "$(grep -cE '^ *[0-9]+  ' out)" -eq 50 ] || fail "not 50 rows" "$(cat out)"
lacks out "more rows"
run_ok triangle.obj --segment "1 1 3 1 1 -1" --csv hits.csv
rows "0,0,front,face,0.75,0.75,1,1,0" hits.csv
lacks out front
contains out "1 face, of them"

# Made-up segments: the same for the same seed, half of them from the front, all aimed.
run_ok cube.obj --random 200 --seed 5 --csv
mv out first
run_ok cube.obj --random 200 --seed 5 --csv
cmp -s first out || fail "another run, other segments"
run_ok cube.obj --random 200 --seed 6 --csv
! cmp -s first out || fail "another seed, the same segments"
run_ok cube.obj --random 200 --seed 5 --csv --sides both --length 0.001
contains err "200 segments: 200 hit, 0 missed"

# Pictures: size, kind and more than one colour.
run_ok cube.obj --picture cube.png --size 80x50 --view -30,20 --samples 2 --threads 3
contains out "cube.png: 80 x 50"
bytes() { od -An -v -tx1 -j "$2" -N "$3" "$1" | tr -d ' \n'; }
# The signature, the header chunk, its width and height, 8 bits of RGB.
[ "$(bytes cube.png 0 26)" = 89504e470d0a1a0a0000000d49484452"00000050""00000032"0802 ] ||
    fail "header $(bytes cube.png 0 26)"
[ "$(bytes cube.png $(($(stat -c %s cube.png) - 8)) 4)" = 49454e44 ] || fail "no end chunk"
# Not a single colour, which is packed into some 80 bytes, and more than the background, alone around a line.
printf 'v 0 0 0\nv 1 1 0\nv 2 2 0\nf 1 2 3\n' >line.obj
run_ok line.obj --picture line.png --size 80x50 --view -30,20 --samples 2
[ "$(stat -c %s line.png)" -gt 500 ] && [ "$(stat -c %s cube.png)" -gt "$(stat -c %s line.png)" ] ||
    fail "$(stat -c %s line.png cube.png) bytes"
run_ok cube.obj --picture other.png --size 80x50 --view 200,-40 --samples 2
! cmp -s cube.png other.png || fail "another view, the same picture"
run_ok cube.obj --picture again.png --size 80x50 --view -30,20 --samples 2 --threads 1
cmp -s cube.png again.png || fail "one thread draws another picture than three"

# A square, and the same corners hollowed out to a point behind: the same outline, other normals. (A zero-area face at
# that point keeps the camera where it is.)
corners='v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nv 0 0 -1\n'
printf "${corners}f 1 2 3\nf 1 3 4\nf 5 5 5\n" >square.obj
printf "${corners}f 1 2 5\nf 2 3 5\nf 3 4 5\nf 4 1 5\n" >hollow.obj
run_ok square.obj --picture square.png --size 80x50 --view 0,0
run_ok hollow.obj --picture hollow.png --size 80x50 --view 0,0
! cmp -s square.png hollow.png || fail "the shading does not depend on the normal"

printf 'v 0 0 0\nv 1e308 1 0\nv -1e308 1e308 0\nf 1 2 3\n' >huge.obj
run huge.obj --picture huge.png
[ "$status" -eq 2 ] && [ "$(cat err)" = "cast: the mesh is too large for a picture" ] || fail "$status" "$(cat err)"

# Help.
run_ok --help
contains out "Examples:"
for option in --segments --segment --random --seed --length --sides --max-fraction --all --any --csv --all-rows \
    --float --picture --view --up --size --samples --threads; do
    contains out "  $option"
done

# Options that can't be understood.
see="(see cast --help)"
run_error "cast: MESH is required $see"
run_error "cast: '--colour' was not expected $see" cube.obj --colour
run_error "cast: '--colour' was not expected $see" --colour
run_error "cast: 'b.obj' was not expected $see" cube.obj b.obj
run_error "cast: --random: 'ten' is not a whole number" cube.obj --random ten
run_error "cast: --random: '1.5' is not a whole number" cube.obj --random 1.5
run_error "cast: --random: '-1' is not a whole number" cube.obj --random -1
run_error "cast: --random: '100000001' is not between 0 and 1e+08" cube.obj --random 100000001
run_error "cast: --seed: '18446744073709551616' is out of range" cube.obj --seed 18446744073709551616
run_error "cast: --length: '0' is not greater than 0" cube.obj --length 0
run_error "cast: --max-fraction: '2' is not between 0 and 1" cube.obj --max-fraction 2
run_error "cast: --max-fraction: 'nan' is not finite" cube.obj --max-fraction nan
run_error "cast: --sides: 'up' is not front, back or both" cube.obj --sides up
run_error "cast: --view: '30' is not two numbers such as 30,20" cube.obj --picture x.png --view 30
run_error "cast: --view: '91' is not between -90 and 90" cube.obj --picture x.png --view 0,91
run_error "cast: --size: '0' is not between 1 and 10000" cube.obj --picture x.png --size 0x5
run_error "cast: --size: '80,50' is not a size such as 800x600" cube.obj --picture x.png --size 80,50
run_error "cast: --up: 'w' is not y or z" cube.obj --picture x.png --up w
run_error "cast: --size requires --picture $see" cube.obj --size 80x50
run_error "cast: --all excludes --any $see" cube.obj --any --all
run_error "cast: --picture needs a value" cube.obj --picture --all
run_error "cast: --segments: 1 required FILE missing $see" cube.obj --segments
run_error "cast: --seed is for made-up segments: add --random N" cube.obj --segment "1 1 3 1 1 -1" --seed 3
run_error "cast: --segment: expected six numbers, found 5" cube.obj --segment "1 1 3 1 1"
run_error "cast: --segment: 'x' is not a number" cube.obj --segment "1 1 3 1 1 x"
[ ! -e x.png ] || fail "wrote x.png"

# Segment files: the line that is wrong, counted from 1.
bad_line() {
    printf '# one comment\n1 1 3 1 1 -1\n%b\n' "$2" >bad.txt
    run_error "bad.txt:3: $1" triangle.obj --segments bad.txt "${@:3}"
}
bad_line "expected six numbers, found 5" "1 2 3 4 5"
bad_line "expected six numbers, found 7" "1 2 3 4 5 6 7"
bad_line "expected six numbers, found 3" "1 2 3 # 4 5 6"
bad_line "'zwei' is not a number" "1 zwei 3 4 5 6"
bad_line "'2,' is not a number" "1 2, 3 4 5 6"
bad_line "'0x10' is not a number" "1 0x10 3 4 5 6"
bad_line "'+-1' is not a number" "1 +-1 3 4 5 6"
bad_line "'nan' is not finite" "nan 2 3 4 5 6"
bad_line "'-inf' is not finite" "1 2 3 4 5 -inf"
bad_line "'1e999' is out of range" "1 2 3 4 5 1e999"
bad_line "'1e39' is out of range" "1 2 3 4 5 1e39" --float
bad_line "'a?b' is not a number" "a\0033b 2 3 4 5 6"
bad_line "'0123456789012345678901234567890123456789...' is not a number" \
    "0123456789012345678901234567890123456789x 2 3 4 5 6"
run_error "nowhere.txt: can't be opened" triangle.obj --segments nowhere.txt
run_error "$folder: can't be read" triangle.obj --segments "$folder"

# Meshes: the library's line, which names the file.
run nowhere.obj
[ "$status" -eq 2 ] || fail "exit status $status, not 2"
[ "$(wc -l <err)" -eq 1 ] || fail "not one line:" "$(cat err)"
contains err "nowhere.obj"
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n' >bad.obj
run bad.obj
[ "$status" -eq 2 ] || fail "exit status $status, not 2"
[ "$(wc -l <err)" -eq 1 ] || fail "not one line:" "$(cat err)"
contains err "bad.obj:4: "

# Files that can't be written.
run_error "nowhere/hits.csv: can't be written" cube.obj --csv nowhere/hits.csv
run_error "nowhere/cube.png: can't be written" cube.obj --picture nowhere/cube.png
if [ -c /dev/full ]; then
    run cube.obj --csv /dev/full
    [ "$status" -eq 2 ] && [ "$(cat err)" = "/dev/full: could not be written in full" ] || fail "$status" "$(cat err)"
    run cube.obj --picture /dev/full
    [ "$status" -eq 2 ] && [ "$(cat err)" = "/dev/full: could not be written in full" ] || fail "$status" "$(cat err)"
    [ -c /dev/full ] || fail "removed /dev/full"
    what="cast >/dev/full"
    "$cast" cube.obj >/dev/full 2>err
    [ $? -eq 2 ] && [ "$(cat err)" = "cast: can't write to standard output" ] || fail "$(cat err)"
    what="cast --help >/dev/full"
    "$cast" --help >/dev/full 2>err
    [ $? -eq 2 ] && [ "$(cat err)" = "cast: can't write to standard output" ] || fail "$(cat err)"
fi

# What the report says of a mesh that is closed but for its faces' sides: it was "not closed: 0 border edges".
tetrahedron='v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n'
printf '%bf 2 4 3\n' "$tetrahedron" >turned.obj
run_ok turned.obj --random 1
contains out 'not closed: 3 edges whose triangles do not face the same way'
lacks out 'border'
printf '%bf 2 3 4\n' "$tetrahedron" >whole.obj
run_ok whole.obj --random 1
contains out '4 vertices; closed'
# And of one that nothing can hit: it was "closed".
printf 'v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n' >flat.obj
run_ok flat.obj --random 1
contains out '3 vertices; empty'
lacks out 'closed'

end_checks
