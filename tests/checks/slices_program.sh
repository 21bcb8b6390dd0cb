#!/usr/bin/env bash
# Checks render --slice and ljus-merge: 1 to 16 slices make the same bytes as one process; if
# a slice is missing, given twice, damaged, or of another picture, a sentence says so and no
# picture is written; a killed slice leaves nothing that looks complete.
# Usage: slices_program.sh RENDER MERGE SCENE.json SCRATCH
set -euo pipefail
render=$1
merge=$2
scene=$3
scratch=$4
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
cp "$scene" scene.json
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }
slices() { # N FOLDER ARGUMENTS...
    local n=$1 folder=$2 k
    shift 2
    for ((k = 1; k <= n; ++k)); do
        "$render" scene.json "$@" --slice $k/$n --quiet --out "$folder" || wrong "slice $k/$n"
    done
}

few=(--width 20 --height 33 --rays 2 --caustic-photons 300 --exposure 0.5)
"$render" scene.json "${few[@]}" --quiet --out whole.pfm
"$render" scene.json "${few[@]}" --quiet --out whole.png
for n in 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16; do
    slices $n part$n "${few[@]}"
    "$merge" part$n --quiet --out merged.pfm
    cmp whole.pfm merged.pfm || wrong "$n slices make another picture"
done
"$merge" part16/*.slice --out merged.png >out.txt # named one by one; and another kind
cmp whole.png merged.png || wrong "16 slices make another PNG file"
grep -q 'merged.png' out.txt || wrong "it does not say where the picture is"
# The file of settings is the same except for the cost.
alike() { grep -v '"seconds"\|"slices"\|"scene_hash"\|"exposure"' "$1" | tr -d ' ,\n' |
    sed 's/"version":\[[0-9]*\]//'; }
[ "$(alike whole.png.json)" = "$(alike merged.png.json)" ] || wrong "another file of settings: $(diff whole.png.json merged.png.json)"

# Other renderers, double, and more slices than rows.
for choice in "--renderer path" "--precision double" "--indirect cache --general-photons 500"; do
    # shellcheck disable=SC2086
    { "$render" scene.json "${few[@]}" $choice --quiet --out w.pfm
      rm -rf some; slices 5 some "${few[@]}" $choice; }
    "$merge" some --quiet --out m.pfm
    cmp w.pfm m.pfm || wrong "$choice: 5 slices make another picture"
done
"$render" scene.json "${few[@]}" --height 2 --quiet --out w.hdr
rm -rf some
slices 5 some "${few[@]}" --height 2
"$merge" some --quiet --out m.hdr
cmp w.hdr m.hdr || wrong "more slices than rows make another picture"

# refused SENTENCE COMMAND...: exit code 2, one line on stderr that has SENTENCE, and no
# picture.
refused() {
    local sentence=$1 code=0
    shift
    "$@" >out.txt 2>err.txt </dev/null || code=$?
    [ $code -eq 2 ] || wrong "$*: exit code $code, not 2"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "$*: not one line: $(cat err.txt)"
    grep -qF -- "$sentence" err.txt || wrong "$*: no '$sentence' in: $(cat err.txt)"
    [ ! -e never.pfm ] || wrong "$*: there is a picture"
}
merge_refused() { local sentence=$1; shift; refused "$sentence" "$merge" "$@" --out never.pfm; }
at() { echo "part$2/scene-$1-of-$2.slice"; }
merge_refused "of 4 slices 1 is missing: 3/4; render with --slice what is missing" \
    "$(at 1 4)" "$(at 2 4)" "$(at 4 4)"
merge_refused "of 16 slices 15 are missing: 1/16, 2/16, 3/16, 4/16, 5/16, 6/16, 7/16, 9/16, 10/16, 11/16, ...;" "$(at 8 16)"
merge_refused "are both slice 2/4" part4 "$(at 2 4)"
merge_refused "is slice 1/3 and 'part4/scene-1-of-4.slice' 1/4" part4 "$(at 1 3)"
mkdir others
"$render" scene.json "${few[@]}" --seed 2 --slice 3/4 --quiet --out others/seed.slice
merge_refused "'others/seed.slice' is of another picture than 'part4/scene-1-of-4.slice': its seed is 2, and not 1" \
    "$(at 1 4)" "$(at 2 4)" others/seed.slice "$(at 4 4)"
"$render" scene.json "${few[@]}" --caustic-photons 301 --slice 3/4 --quiet --out others/photons.slice
merge_refused "its caustic-photons is 301, and not 300" "$(at 1 4)" "$(at 2 4)" others/photons.slice "$(at 4 4)"
sed 's/"ior": 1.5/"ior": 1.6/' scene.json >others/scene.json
"$render" others/scene.json "${few[@]}" --slice 3/4 --quiet --out others/scene.slice
merge_refused "its scene_hash is" "$(at 1 4)" "$(at 2 4)" others/scene.slice "$(at 4 4)"
{ head -c 900 "$(at 3 4)"; printf '\177'; tail -c +902 "$(at 3 4)"; } >others/damaged.slice
cmp -s "$(at 3 4)" others/damaged.slice && wrong "nothing is damaged"
merge_refused "others/damaged.slice': its checksum is wrong" "$(at 1 4)" "$(at 2 4)" others/damaged.slice "$(at 4 4)"
for bytes in 0 15 60 500 1500; do
    head -c $bytes "$(at 3 4)" >others/short.slice
    merge_refused "cannot read 'others/short.slice'" "$(at 1 4)" others/short.slice
done
merge_refused "it is another kind of file" whole.pfm
merge_refused "cannot read 'none.slice'" none.slice
merge_refused "there is no slice to merge"
mkdir empty
merge_refused "the folder 'empty' has no slice" empty

few+=(--quiet)
for text in 0/4 5/4 3 3/ /4 3/4x -1/4 1/0 1/65537 3.0/4; do
    refused "--slice is '$text'; it must be K/N" "$render" scene.json "${few[@]}" --slice "$text" --out never
done
refused "a slice is not a picture" "$render" scene.json "${few[@]}" --slice 1/2 --out never.pfm
refused "is for --slice" "$render" scene.json "${few[@]}" --out never.slice
refused "cannot be combined with --slice" "$render" scene.json "${few[@]}" --slice 1/2 --passes 3 --out never
refused "give --more-rays 0" "$render" scene.json "${few[@]}" --slice 1/2 --more-rays 3 --out never
[ ! -e never ] && [ ! -e never.slice ] || wrong "what was refused left something"

# A slice killed at any time leaves nothing; rendering only that slice again completes the
# picture.
rm "$(at 3 4)"
for wait in 0.02 0.1 0.3; do
    "$render" scene.json "${few[@]}" --rays 100000 --slice 3/4 --out part4 &
    pid=$!
    sleep $wait
    kill -KILL $pid
    code=0
    wait $pid 2>wait.txt || code=$?
    [ $code -eq 137 ] || wrong "killed slice: exit code $code"
    [ "$(ls part4 | wc -l)" -eq 3 ] || wrong "a killed slice leaves: $(ls part4)"
    merge_refused "of 4 slices 1 is missing: 3/4" part4
done
"$render" scene.json "${few[@]}" --slice 3/4 --out part4
"$merge" part4 --quiet --out merged.pfm
cmp whole.pfm merged.pfm || wrong "a slice that is rendered again makes another picture"
leftover=$(find . -name '*.ljus-part*' -o -name '.ljus*')
[ -z "$leftover" ] || wrong "left behind: $leftover"

[ $wrong -eq 0 ] && echo "slices make the picture of one process"
exit $wrong
