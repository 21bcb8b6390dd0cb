#!/usr/bin/env bash
# The program examples/render.cpp: what it writes, and that a wrong use ends with one
# sentence, exit code 2, nothing half-written and no older file lost.
# Usage: render_program.sh PROGRAM SCENE.json SCRATCH
set -euo pipefail
render=$1
scene=$2
scratch=$3
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# refused SENTENCE ARGUMENTS...: exit code 2, and one line on stderr that has SENTENCE.
refused() {
    local sentence=$1 code=0
    shift
    "$render" "$@" >out.txt 2>err.txt </dev/null || code=$?
    [ $code -eq 2 ] || wrong "render $*: exit code $code, not 2"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "render $*: not one line: $(cat err.txt)"
    grep -qF -- "$sentence" err.txt || wrong "render $*: no '$sentence' in: $(cat err.txt)"
}
few=(--width 20 --height 16 --rays 2 --caustic-photons 500)

# Each kind of file, each renderer; the folder of --out is made.
for file in a.png a.hdr a.pfm; do
    "$render" "$scene" "${few[@]}" --out "new/$file" >out.txt
    [ -s "new/$file" ] || wrong "no new/$file"
    grep -q 'caustics map' out.txt || wrong "no line of the caustics pass"
    grep -q 'a sample' out.txt || wrong "no rays a sample"
done
"$render" "$scene" "${few[@]}" --renderer path --quiet --out new >out.txt
[ -s new/balls.png ] || wrong "no new/balls.png"
[ ! -s out.txt ] || wrong "--quiet is not quiet: $(cat out.txt)"
for indirect in rays map photons gather cache none; do
    "$render" "$scene" "${few[@]}" --indirect $indirect --general-photons 500 \
        --caustic-kernel cone --general-nearest 20 --depth 3 --roulette 2 --quiet --out $indirect.pfm
done
cmp -s rays.pfm none.pfm && wrong "--indirect none changes nothing"
cmp -s map.pfm photons.pfm && wrong "--indirect photons changes nothing"

# What else there is to choose changes the picture, and is known by its name.
"$render" "$scene" "${few[@]}" --quiet --out plain.pfm
for choice in --split-glass "--sampling random" "--sampling jittered" "--sampling sobol" \
    "--precision double" "--shadow-rays 2" "--radius 0.3"; do
    # shellcheck disable=SC2086
    "$render" "$scene" "${few[@]}" $choice --quiet --out choice.pfm
    ! cmp -s plain.pfm choice.pfm || wrong "$choice changes nothing"
done
"$render" "$scene" "${few[@]}" --sampling multi-jittered --precision float \
    --indirect rays --quiet --out choice.pfm
cmp plain.pfm choice.pfm || wrong "the defaults are not the defaults"

# A ball with a picture on it, by its own coordinates, and one of the report's material.
cp new/a.png picture.png
sed -e 's/"clay": .*/"clay": {"type": "picture", "file": "picture.png", "map": "uv"},/' \
    -e 's/"mirror": {.*/"mirror": {"type": "mixture", "color": [1, 0, 0]},/' \
    "$scene" >ball.json
"$render" ball.json "${few[@]}" --quiet --out ball.pfm
cmp -s plain.pfm ball.pfm && wrong "a picture and a mixture change nothing"

# The same seed gives the same bytes for any number of threads; another seed does not.
for threads in 1 2 3; do
    "$render" "$scene" "${few[@]}" --threads $threads --quiet --out t$threads.pfm
done
cmp t1.pfm t2.pfm && cmp t1.pfm t3.pfm || wrong "threads change the picture"
"$render" "$scene" "${few[@]}" --seed 2 --quiet --out seed.pfm
! cmp -s t1.pfm seed.pfm || wrong "--seed changes nothing"

# Photons as dots, of each kind and of all.
for kind in direct indirect shadow caustic all; do
    "$render" "$scene" "${few[@]}" --general-photons 500 --photons $kind \
        --out $kind.png >out.txt
    [ -s $kind.png ] || wrong "no $kind.png"
    [ $kind = all ] || grep -q "^  $kind .*stored" out.txt || wrong "no count of $kind photons"
done
cmp -s direct.png indirect.png && wrong "--photons does not tell kinds apart"

# The plan and a pixel's paths; neither writes a file.
mkdir readonly
(cd readonly && "$render" "$scene" --plan >../plan.txt && "$render" "$scene" \
    "${few[@]}" --explain 10,8 >../explain.txt)
grep -q '^caustics map *on' plan.txt || wrong "the plan has no caustics map: $(cat plan.txt)"
grep -q 'E D L  *shadow ray' explain.txt || wrong "no E D L: $(cat explain.txt)"
[ -z "$(ls readonly)" ] || wrong "--plan or --explain wrote a file"

refused "SCENE.json is required"
refused "missing.json" missing.json
refused "Is a directory" new
refused "--explain is 20,0; it must be X,Y" "$scene" "${few[@]}" --explain 20,0
refused "--explain is 1; it must be X,Y" "$scene" "${few[@]}" --explain 1
refused "--explain is 1,2,3; it must be X,Y" "$scene" "${few[@]}" --explain 1,2,3
refused "--rays" "$scene" --rays 0
refused "--width" "$scene" --width -5
refused "--radius" "$scene" --radius nan
refused "--caustic-kernel" "$scene" --caustic-kernel hat
refused "--precision" "$scene" --precision half
refused "--nope" "$scene" --nope
refused "cannot write" "$scene" --out /proc/none/a.png
printf '{"name": "x",\n "camera": {"position": [1e999' >huge.json
refused "huge.json: line 2, column 30: camera.position[0] is 1e999" huge.json
sed 's/"radius": 0.4/"radius": -1/' "$scene" >radius.json
refused "radius.json: objects[2].radius is -1; it must be above 0." radius.json
head -c 700 "$scene" >short.json
refused "short.json: line" short.json
sed 's/, "emission": \[12, 11, 9\]//' "$scene" >dark.json
refused "dark.json: objects has no light" dark.json
sed 's/picture.png/none.png/' ball.json >none.json
refused "none.json: materials.clay.file cannot be used: cannot read 'none.png'" none.json

# A limit on the size of files: one sentence, and the older file is as it was.
cp t1.pfm older.pfm
(
    ulimit -f 1
    code=0
    "$render" "$scene" --width 100 --height 100 --rays 1 --caustic-photons 0 --quiet \
        --out older.pfm 2>limit.txt || code=$?
    [ $code -eq 2 ] && grep -q 'cannot write' limit.txt
) || wrong "the file-size limit: $(cat limit.txt)"
cmp older.pfm t1.pfm || wrong "the older file is lost"

# Ctrl-C: exit code 130 within a second, even with a million rays a pixel.
set -m
"$render" "$scene" --rays 1000000 --caustic-photons 500 --out never.png >out.txt 2>err.txt &
pid=$!
sleep 1
kill -INT $pid
begin=$(date +%s%N)
code=0
wait $pid || code=$?
took=$((($(date +%s%N) - begin) / 1000000))
[ $code -eq 130 ] || wrong "Ctrl-C: exit code $code, not 130"
[ $took -lt 1000 ] || wrong "Ctrl-C: it took $took ms"
[ ! -e never.png ] || wrong "Ctrl-C left a picture"

leftover=$(find . -name '*.part*' -o -name '.ljus*')
[ -z "$leftover" ] || wrong "left behind: $leftover"
[ $wrong -eq 0 ] && echo "the render program does what it says"
exit $wrong
