#!/usr/bin/env bash
# Runs the example mpi_tracking on different numbers of ranks, kills some, restarts, and damages checkpoints:
#   mpi_test.sh MPIEXEC PATH_OF_MPI_TRACKING MESH OTHER_MESH
set -uo pipefail

mpiexec=$1
program=$(realpath "$2")
mesh=$(realpath "$3")
other_mesh=$(realpath "$4")
. "$(dirname "$0")/checks.sh"

# Open MPI: more ranks than processors, as root too, each on any processor (several tests run at a time), and without
# a system call that containers forbid. It keeps memory until the end, which the address sanitizer would call lost.
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 \
    OMPI_MCA_hwloc_base_binding_policy=none OMPI_MCA_btl_vader_single_copy_mechanism=none \
    ASAN_OPTIONS=${ASAN_OPTIONS:+$ASAN_OPTIONS:}detect_leaks=0

# run RANKS ARG...: leaves the exit status in $status and the output in the files out and err.
run() {
    what="$1 ranks: ${*:2}"
    timeout 300 "$mpiexec" -n "$1" "$program" "${@:2}" >out 2>err </dev/null
    status=$?
}

hash_of_run() { sed -n 's/^hash *\([0-9a-f]\{32\}\)$/\1/p' out; }

# run_ok HASH RANKS ARG...: status 0, no particle outside, and this hash (if it is not empty).
run_ok() {
    run "${@:2}"
    check_ok "$1"
}
check_ok() {
    [ "$status" -eq 0 ] || fail "exit status $status" "$(cat out err)"
    grep -qE "^particles .* 0 lost, 0 outside of the mesh$" out || fail "a particle got out:" "$(cat out)"
    [ "$(hash_of_run | wc -l)" -eq 1 ] || fail "not one hash:" "$(cat out)"
    [ -z "$1" ] || [ "$(hash_of_run)" = "$1" ] || fail "the hash is not $1:" "$(cat out)"
}

# refused TEXT FILE RANKS ARG...: status 2, this text, no result, and the file stays as it is.
refused() {
    local text=$1 file=$2
    cp "$file" before
    run "${@:3}"
    [ "$status" -eq 2 ] || fail "exit status $status, not 2" "$(cat err)"
    grep -qF -- "mpi_tracking: $text" err || fail "no '$text' in:" "$(cat err)"
    [ -z "$(hash_of_run)" ] || fail "there is a result:" "$(cat out)"
    cmp -s "$file" before || fail "changed $file"
}

# One hash, and the same counts for every face.
few=(--particles 60000 --faces faces.csv)
run_ok "" 1 "$mesh" "${few[@]}"
hash=$(hash_of_run)
mv faces.csv first.csv
for ranks in 2 4; do
    run_ok "$hash" $ranks "$mesh" "${few[@]}"
    cmp -s faces.csv first.csv || fail "other counts"
done
run_ok "$hash" 2 "$mesh" "${few[@]}" --threads 2 --batch 1000 --check
[ "$(tail -n +2 first.csv | awk -F, '{ hits += $2; ends += $3 } END { print (hits > 500000), ends, NR }')" = "1 60000 75408" ] ||
    fail "the counts do not add up"
# The mean way is that of the cosine law, within 1 %: six times the deviation of so few particles.
awk '/^flights/ { mean = $4; expected = $NF; found = 1 } END { d = mean / expected - 1; exit !(found && d * d < 1e-4) }' \
    out || fail "another mean way:" "$(cat out)"
what="ranks on unlike processors"
timeout 300 "$mpiexec" -n 1 env PIERCE_BACKEND=plain PIERCE_BROADPHASE=grid "$program" "$mesh" "${few[@]}" : \
    -n 1 "$program" "$mesh" "${few[@]}" >out 2>err </dev/null
status=$?
check_ok "$hash"
run_ok "" 2 "$mesh" "${few[@]}" --seed 2
[ "$(hash_of_run)" != "$hash" ] || fail "another seed, the same hash"
run_ok "" 2 --particles 20000 # without a mesh: one is made

# Killed twice, rank 2 of 4 and rank 0 of 3, then to the end with 2: the hash of a run that nobody killed.
many=(--particles 300000 --checkpoint run.ckpt --every 0.05)
run_ok "" 1 "$mesh" --particles 300000
whole=$(hash_of_run)

# kill_one RANKS RANK COUNT: once a checkpoint has so many particles.
kill_one() {
    local ranks=$1 rank=$2 i
    what="rank $rank of $ranks is killed"
    rm -f pid.*
    : >err
    # shellcheck disable=SC2016  # for the shell of each rank
    timeout 300 "$mpiexec" -n "$ranks" sh -c 'echo $$ >pid.${OMPI_COMM_WORLD_RANK:-$PMI_RANK}; exec "$0" "$@"' \
        "$program" "$mesh" "${many[@]}" >out 2>err </dev/null &
    for ((i = 0; i < 12000; ++i)); do
        awk -v count="$3" '/ particles are done and kept$/ && $1 >= count { found = 1 } END { exit !found }' err && break
        sleep 0.01
    done
    kill -9 "$(cat "pid.$rank")" || fail "it had ended before:" "$(cat out err)"
    wait $! && fail "mpirun calls this a success:" "$(cat out err)"
    [ -z "$(hash_of_run)" ] || fail "it had come to its end before:" "$(cat out)"
}
begins_at() { sed -n 's/^ranks .* from particle \([0-9]*\) on$/\1/p' out; }

kill_one 4 2 60000
kill_one 3 0 150000
second=$(begins_at)
echo "torn" >run.ckpt.new # as if killed while it wrote
run_ok "$whole" 2 "$mesh" "${many[@]}"
third=$(begins_at)
[ "$second" -ge 60000 ] && [ "$third" -ge 150000 ] && [ "$third" -lt 300000 ] ||
    fail "went on at particles $second and $third"
echo "killed at some time after particles $second and $third of 300000"
[ ! -e run.ckpt.new ] || fail "left run.ckpt.new"
run_ok "$whole" 4 "$mesh" "${many[@]}" # nothing is left to do

# A run may be made longer.
short=(--particles 20000 --checkpoint short.ckpt)
run_ok "" 2 "$mesh" "${short[@]}"
cp short.ckpt long.ckpt
run_ok "$hash" 2 "$mesh" --particles 60000 --checkpoint long.ckpt

# Checkpoints that are not those of this run.
refused "short.ckpt: is of another run: it differs in mesh" short.ckpt 2 "$other_mesh" "${short[@]}"
refused "short.ckpt: is of another run: it differs in --seed" short.ckpt 2 "$mesh" "${short[@]}" --seed 2
refused "short.ckpt: is of another run: it differs in --stick" short.ckpt 2 "$mesh" "${short[@]}" --stick 0.2
refused "short.ckpt: is of another run: it differs in --most-hits" short.ckpt 2 "$mesh" "${short[@]}" --most-hits 9
refused "the checkpoint has more than --particles already" long.ckpt 2 "$mesh" --particles 20000 --checkpoint long.ckpt
# Those that have suffered: cut short anywhere, longer, one bit in any part of it.
size=$(stat -c %s short.ckpt)
bad=(--particles 20000 --checkpoint bad.ckpt)
for length in $((size - 1)) $((size - 8)) $((size / 2)) 24; do
    head -c "$length" short.ckpt >bad.ckpt
    refused "bad.ckpt: is cut short, or too long" bad.ckpt 2 "$mesh" "${bad[@]}"
done
{ cat short.ckpt; printf '12345678'; } >bad.ckpt
refused "bad.ckpt: is cut short, or too long" bad.ckpt 1 "$mesh" "${bad[@]}"
flip() { # at this byte
    cp short.ckpt bad.ckpt
    printf "%b" "\\x$(printf %02x $(($(od -An -tu1 -j "$1" -N 1 short.ckpt) ^ 16)))" |
        dd of=bad.ckpt bs=1 seek="$1" conv=notrunc status=none
}
for byte in 30 70 $((size / 2)) $((size - 3)); do
    flip "$byte"
    refused "bad.ckpt: is damaged: its hash does not fit" bad.ckpt 2 "$mesh" "${bad[@]}"
done
: >bad.ckpt
refused "bad.ckpt: is no checkpoint" bad.ckpt 2 "$mesh" "${bad[@]}"
cp "$mesh" bad.ckpt
refused "bad.ckpt: is no checkpoint" bad.ckpt 1 "$mesh" "${bad[@]}"

# One that can't be written is no reason to lose the run.
run_ok "$hash" 2 "$mesh" --particles 60000 --checkpoint nowhere/run.ckpt
grep -qF "nowhere/run.ckpt.new: can't be opened" err || fail "says nothing of the checkpoint:" "$(cat err)"

# Meshes that are none.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 3 2\nf 1 2 4\nf 1 4 3\n' >open.obj
refused "the mesh is not closed" open.obj 2 open.obj
refused "nowhere.obj" open.obj 2 nowhere.obj
run 2 --colour
[ "$status" -eq 2 ] && [ "$(grep -c "colour" err)" -eq 1 ] || fail "status $status" "$(cat err)"

end_checks
