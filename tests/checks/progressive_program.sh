#!/usr/bin/env bash
# The program chapters/experiments/31_experiments.cpp, killed at random and resumed many times: the
# picture has the same bytes as one that was left in peace; and what it refuses.
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

few=(--width 32 --height 32 --passes 150 --every 0 --quiet)
begin=$(date +%s%N)
"$program" "${few[@]}" --threads 1 --picture whole.pfm
alone=$((($(date +%s%N) - begin) / 1000000))

# Another number of threads, and a checkpoint on the way, change nothing.
"$program" "${few[@]}" --threads 2 --picture two.pfm --checkpoint two.check --preview two.png
cmp whole.pfm two.pfm || wrong "threads or a checkpoint change the picture"
[ -s two.png ] || wrong "no preview"

RANDOM=31
done=0
for ((i = 0; i < kills; ++i)); do
    resume=()
    [ ! -e a.check ] || resume=(--resume)
    "$program" "${few[@]}" --picture a.pfm --checkpoint a.check ${resume[@]+"${resume[@]}"} &
    pid=$!
    sleep "$(awk -v r=$RANDOM -v t=$alone 'BEGIN { print 0.01 + r / 32768 * t / 15000 }')"
    if kill -KILL $pid 2>kill.txt; then done=$((done + 1)); fi
    code=0
    wait $pid 2>wait.txt || code=$?
    [ $code -eq 137 ] || [ $code -eq 0 ] || wrong "killed program: exit code $code"
done
resume=()
[ ! -e a.check ] || resume=(--resume)
"$program" "${few[@]}" --picture a.pfm --checkpoint a.check ${resume[@]+"${resume[@]}"}
cmp whole.pfm a.pfm || wrong "killed and resumed, the picture is another"

# Ctrl-C leaves a checkpoint, of more passes than none.
"$program" --width 32 --height 32 --quiet --passes 1000000 --every 1000 --picture never.pfm --checkpoint b.check 2>err.txt &
pid=$!
sleep 1
kill -INT $pid
code=0
wait $pid || code=$?
[ $code -eq 130 ] || wrong "Ctrl-C: exit code $code, not 130"
[ -s b.check ] && [ ! -e never.pfm ] || wrong "Ctrl-C: no checkpoint, or a picture"
grep -q "stopped: [1-9][0-9]* passes are saved in 'b.check'; the same command with --resume" \
    err.txt || wrong "Ctrl-C does not say how to go on: $(cat err.txt)"

# refused SENTENCE ARGUMENTS...: exit code 2, and one line on stderr that has SENTENCE.
refused() {
    local sentence=$1 code=0
    shift
    "$program" "$@" >out.txt 2>err.txt </dev/null || code=$?
    [ $code -eq 2 ] || wrong "$*: exit code $code, not 2"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "$*: not one line: $(cat err.txt)"
    grep -qF -- "$sentence" err.txt || wrong "$*: no '$sentence' in: $(cat err.txt)"
}
refused "of another picture" "${few[@]}" --seed 2 --picture c.pfm --checkpoint a.check --resume
refused "of another picture" --width 33 --height 32 --quiet --picture c.pfm --checkpoint a.check --resume
refused "cannot read 'none.check'" "${few[@]}" --picture c.pfm --checkpoint none.check --resume
head -c 1000 a.check >short.check
refused "short.check" "${few[@]}" --picture c.pfm --checkpoint short.check --resume
refused "--resume needs --checkpoint" --picture c.pfm --resume
refused "are for --picture" --checkpoint a.check
refused "alpha is 0.5; it must be that of the passes so far, 0.666" "${few[@]}" --alpha 0.5 --picture c.pfm --checkpoint a.check --resume
refused "it must be a file of its own" "${few[@]}" --picture c.pfm --checkpoint c.pfm
refused "a.check, which is there already" "${few[@]}" --picture c.pfm --checkpoint a.check
refused "its name must end with .png" "${few[@]}" --picture c.pfm --preview c.jpg
[ ! -e c.pfm ] || wrong "a picture of a refused checkpoint"

echo "$done of $kills were killed"
[ $wrong -eq 0 ] && echo "the progressive program ends with the same bytes"
exit $wrong
