#!/usr/bin/env bash
# Checks the program examples/34_many_machines.cpp: 1 to 4 ranks make the same bytes as one
# process, and a killed rank leaves no picture. Exit code 77 if mpirun cannot start a rank.
# A map in regions, chapters/experiments/34_distributed_map.cpp, gives any number of ranks
# the same picture, to rounding.
# Usage: many_machines.sh MPIRUN PROGRAM SCRATCH RENDER SCENE.json REGIONS COMPARE
set -euo pipefail
mpirun=$1
program=$2
scratch=$3
render=$4
scene=$5
regions=$6
compare=$7
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# Runs all ranks on this machine, also as root, and more of them than it has processors.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1 OMPI_MCA_btl_base_warn_component_unused=0
export OMPI_MCA_btl=self,vader,tcp OMPI_MCA_btl_vader_single_copy_mechanism=none
ranks() { local n=$1; shift; timeout 120 "$mpirun" -n "$n" "$@"; }
ranks 1 true >out.txt 2>&1 || { echo "mpirun does not start: $(head -3 out.txt)"; exit 77; }

few=(--width 40 --height 30 --rays 2 --caustic-photons 5000 --threads 1)
picture=many-machines.pfm
"$program" "$scene" "${few[@]}" --quiet --out alone # without mpirun: one rank
for n in 1 2 3 4; do
    ranks $n "$program" "$scene" "${few[@]}" --out ranks$n >out.txt || wrong "$n ranks: exit code $?"
    cmp alone/$picture ranks$n/$picture || wrong "$n ranks made another picture"
    grep -q "^$n ranks:" out.txt || wrong "no line of $n ranks: $(cat out.txt)"
done
# More ranks than rows and photons, and two threads each.
tiny=("$scene" --width 9 --height 2 --rays 1 --caustic-photons 2 --quiet)
ranks 3 "$program" "${tiny[@]}" --threads 2 --out few || wrong "more ranks than rows"
"$program" "${tiny[@]}" --out few1
cmp few/$picture few1/$picture || wrong "more ranks than rows make another picture"
"$program" "$scene" "${few[@]}" --seed 2 --quiet --out seed
! cmp -s alone/$picture seed/$picture || wrong "--seed changes nothing"

# The program `render`, without ranks, makes the same picture.
"$render" "$scene" "${few[@]}" --quiet --out render.pfm
cmp render.pfm alone/$picture || wrong "ranks make another picture than render"

# A map in regions. The radius is a tenth of the room, so that most photons have copies.
for n in 1 2 5; do
    ranks $n "$regions" "$scene" --width 40 --height 30 --rays 2 --photons 5000 --radius 0.3 \
        --threads 1 --quiet --out regions$n || wrong "$n regions: exit code $?"
    "$compare" regions$n/distributed-map.pfm regions1/distributed-map.pfm >out.txt ||
        wrong "$n regions: $(cat out.txt)"
    awk '/relMSE/ && $2 < 1e-12 { good = 1 } END { exit !good }' out.txt ||
        wrong "$n regions make another picture: $(cat out.txt)"
done

# Wrong usage: one sentence per rank, no picture, and no rank that waits for ever.
code=0
ranks 2 "$program" none.json --out never >out.txt 2>err.txt || code=$?
[ $code -ne 0 ] && [ $code -ne 124 ] || wrong "a missing scene: exit code $code"
grep -q "cannot read 'none.json'" err.txt || wrong "no sentence: $(cat err.txt)"

# Ranks that disagree: the scene, or any setting; or one that only prints its help.
sed 's/"ior": 1.5/"ior": 1.6/' "$scene" >other.json
apart() { # SENTENCE, and what the second rank is given
    local sentence=$1 code=0 other=$2
    shift 2
    timeout 60 "$mpirun" -n 1 "$program" "$scene" "${few[@]}" --out never : \
        -n 1 "$program" "$other" "${few[@]}" --out never "$@" >out.txt 2>err.txt || code=$?
    [ $code -ne 0 ] && [ $code -ne 124 ] || wrong "ranks apart, $*: exit code $code"
    grep -q "$sentence" err.txt || wrong "ranks apart, $*: $(cat err.txt)"
    [ ! -e never/$picture ] || wrong "ranks apart, $*: there is a picture"
}
apart "rank 1 is to make another picture than rank 0: its scene_hash is" other.json
apart "its width is 41, and not 40" "$scene" --width 41
apart "its rays is 3, and not 2" "$scene" --rays 3
apart "its seed is 2, and not 1" "$scene" --seed 2
apart "its caustic-photons is 5001, and not 5000" "$scene" --caustic-photons 5001
apart "another rank has ended before the work began" "$scene" --help
ranks 2 "$program" --help >out.txt || wrong "all ranks with --help: exit code $?"
cp "$scene" many-machines.pfm
code=0
ranks 2 "$program" many-machines.pfm "${few[@]}" --out . >out.txt 2>err.txt || code=$?
[ $code -ne 0 ] && grep -q "which is read as 'many-machines.pfm'" err.txt ||
    wrong "the scene is written over: $(cat err.txt)"
cmp "$scene" many-machines.pfm || wrong "the scene is lost"

# A killed rank ends the others, and leaves neither a picture nor part of one.
timeout 120 "$mpirun" -n 3 "$program" "$scene" --width 200 --height 200 --rays 100000 \
    --threads 1 --out never >out.txt 2>err.txt &
job=$!
victim=
for _ in 1 2 3 4 5 6 7 8 9 10; do
    sleep 0.5
    child=$(pgrep -P "$job" || true) # mpirun, or whatever MPI calls it, below timeout
    victim=$([ -z "$child" ] || pgrep -P "$child" -f -- '--out never' | tail -1)
    [ -z "$victim" ] || break
done
sleep 1
if [ -n "$victim" ]; then
    kill -9 "$victim"
    code=0
    wait $job || code=$?
    [ $code -ne 0 ] && [ $code -ne 124 ] || wrong "a killed rank: exit code $code"
    grep -q 'signal 9' err.txt out.txt || wrong "mpirun does not say who died: $(cat err.txt)"
else
    wrong "no rank to kill was found"
    kill "$job" || true
fi
[ ! -e never/$picture ] || wrong "there is a picture"
leftover=$(find . -name '*.ljus-part*' -o -name '.ljus*')
[ -z "$leftover" ] || wrong "left behind: $leftover"
[ $wrong -eq 0 ] && echo "many machines make the picture of one"
exit $wrong
