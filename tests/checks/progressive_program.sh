#!/usr/bin/env bash
# Checks the program examples/32_progressive.cpp, killed at random and resumed often: its sums
# and its picture have the same bytes as those of an undisturbed run; and what it refuses.
# Usage: progressive_program.sh PROGRAM SCRATCH [KILLS]
set -euo pipefail
program=$1
scratch=$2
kills=${3:-12}
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }
# same FOLDER: it has the same files as the folder `whole`, bit for bit.
same() { cmp "whole/progressive.check" "$1/progressive.check" &&
    cmp "whole/progressive-last.png" "$1/progressive-last.png"; }

few=(--width 32 --height 32 --passes 150 --every 0 --quiet)
begin=$(date +%s%N)
"$program" "${few[@]}" --threads 1 --out whole
alone=$((($(date +%s%N) - begin) / 1000000))

# The number of threads and of checkpoints changes nothing.
"$program" --width 32 --height 32 --passes 150 --every 1000 --quiet --threads 2 --out two
same two || wrong "threads or checkpoints change the picture"
[ -s two/progressive-10.png ] || wrong "no picture of ten passes"

RANDOM=31
done=0
resume=()
for ((i = 0; i < kills; ++i)); do
    [ ! -e a/progressive.check ] || resume=(--resume)
    "$program" "${few[@]}" --out a ${resume[@]+"${resume[@]}"} &
    pid=$!
    sleep "$(awk -v r=$RANDOM -v t=$alone 'BEGIN { print 0.01 + r / 32768 * t / 15000 }')"
    if kill -KILL $pid 2>kill.txt; then done=$((done + 1)); fi
    code=0
    wait $pid 2>wait.txt || code=$?
    [ $code -eq 137 ] || [ $code -eq 0 ] || wrong "killed program: exit code $code"
done
[ ! -e a/progressive.check ] || resume=(--resume)
"$program" "${few[@]}" --out a ${resume[@]+"${resume[@]}"}
same a || wrong "killed and resumed, the picture is another"

# Ctrl-C leaves a checkpoint of at least one pass, says so, and writes no final picture.
set -m # else a script's programs in the background ignore it
"$program" --width 32 --height 32 --quiet --passes 1000000 --every 1000 --out b 2>err.txt &
pid=$!
sleep 1
kill -INT $pid
code=0
wait $pid || code=$?
[ $code -eq 130 ] || wrong "Ctrl-C: exit code $code, not 130"
[ -s b/progressive.check ] && [ ! -e b/progressive-last.png ] ||
    wrong "Ctrl-C: no checkpoint, or a picture"
grep -q "stopped: [1-9][0-9]* passes are saved in 'b/progressive.check'; --resume goes on from there" \
    err.txt || wrong "Ctrl-C does not say how to go on: $(cat err.txt)"

# refused SENTENCE FOLDER ARGUMENTS...: exit code 2, one line on stderr that has SENTENCE, and
# no picture.
refused() {
    local sentence=$1 folder=$2 code=0
    shift 2
    rm -f "$folder/progressive-last.png"
    "$program" "$@" --out "$folder" --resume >out.txt 2>err.txt </dev/null || code=$?
    [ $code -eq 2 ] || wrong "$*: exit code $code, not 2"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "$*: not one line: $(cat err.txt)"
    grep -qF -- "$sentence" err.txt || wrong "$*: no '$sentence' in: $(cat err.txt)"
    [ ! -e "$folder/progressive-last.png" ] || wrong "a picture of a refused checkpoint"
}
refused "of another picture: its seed is 1, and not 2" a "${few[@]}" --seed 2
refused "of another picture: its width is 32, and not 33" a --width 33 --height 32 --passes 150 --quiet
refused "cannot read 'none/progressive.check'" none "${few[@]}"
mkdir short
head -c 1000 a/progressive.check >short/progressive.check
refused "short/progressive.check" short "${few[@]}"

echo "$done of $kills were killed"
[ $wrong -eq 0 ] && echo "the progressive program ends with the same bytes"
exit $wrong
