#!/usr/bin/env bash
# No program writes over what it reads, or over another of its own files, by whatever name
# or link: it says so before any work, and every file is as it was. What cannot be written
# is found before any work as well.
# Usage: files_program.sh RENDER COMPARE MERGE INSPECT SCENE.json SCRATCH
set -euo pipefail
render=$1
compare=$2
merge=$3
inspect=$4
scene=$5
scratch=$6
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# A scene with a texture, and with a mesh that has a material file.
few=(--width 8 --height 8 --rays 1 --caustic-photons 200 --threads 1 --quiet)
"$render" "$scene" "${few[@]}" --out tx.png
rm tx.png.json
printf 'mtllib tri.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl red\nf 1 2 3\n' >tri.obj
printf 'newmtl red\nKd 1 0 0\n' >tri.mtl
sed -e 's/"clay": .*/"clay": {"type": "picture", "file": "tx.png", "map": "uv"},/' \
    -e 's/^ "objects": \[/&{"type": "mesh", "file": "tri.obj", "material": "white"},/' \
    "$scene" >view.png.json
mkdir linked
ln -s ../tx.png linked/soft.png
ln tx.png linked/hard.png
ln -s . here
cp view.png.json named.json
ln -s nowhere.png to-nowhere.png # one file by two names

# refused SENTENCE COMMAND...: exit code 2, one line on stderr that has SENTENCE, and every
# file is as it was.
all_files() {
    find . ! -name '*.txt' -exec ls -ld {} + | sed 's/ .* / /' | sort
    find . -type f ! -name '*.txt' -exec cksum {} + | sort
}
refused() {
    local sentence=$1 code=0
    shift
    all_files >before.txt
    "$@" >out.txt 2>err.txt </dev/null || code=$?
    [ $code -eq 2 ] || wrong "$*: exit code $code, not 2"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "$*: not one line: $(cat err.txt)"
    grep -qF -- "$sentence" err.txt || wrong "$*: no '$sentence' in: $(cat err.txt)"
    all_files >after.txt
    cmp -s before.txt after.txt || wrong "$* changed a file: $(diff before.txt after.txt)"
}
lost="it must be another file, or that would be lost"
own="it must be a file of its own"

# What is read: the scene, by its sidecar; texture, mesh and its materials, by any name.
refused "the file of settings beside --out is 'view.png.json', which is read as" \
    "$render" view.png.json "${few[@]}" --out view.png
for out in view.png here/view.png "$PWD/view.png" linked/../view.png; do
    refused "$lost" "$render" view.png.json "${few[@]}" --out "$out"
done
for out in tx.png ./tx.png here/tx.png linked/soft.png linked/hard.png; do
    refused "which is read as 'tx.png'" "$render" named.json "${few[@]}" --out "$out"
    refused "which is read as 'tx.png'" "$render" named.json "${few[@]}" \
        --passes 1 --out a.png --preview "$out"
done
refused "--out is 'tx.png', which is read" "$render" named.json "${few[@]}" \
    --show-photons all --out tx.png
for file in named.json tri.obj tri.mtl tx.png; do # with --resume, or it is there already
    refused "--checkpoint is '$file', which is read" "$render" named.json "${few[@]}" \
        --passes 1 --out a.png --checkpoint "$file" --resume
done
mv tri.mtl aside.mtl # the mesh does without; a checkpoint of this name would become it
refused "--checkpoint is 'tri.mtl', which is read" "$render" named.json "${few[@]}" \
    --passes 1 --out a.png --checkpoint tri.mtl
mv aside.mtl tri.mtl

# What is written: picture, settings, preview and checkpoint, two at a time.
pass=("$render" named.json "${few[@]}" --passes 1)
refused "$own" "${pass[@]}" --out k.png --checkpoint k.png
refused "$own" "${pass[@]}" --out k.png --checkpoint k.png.json
refused "$own" "${pass[@]}" --out k.png --preview k.png
refused "$own" "${pass[@]}" --out k.hdr --checkpoint here/k.hdr
refused "$own" "${pass[@]}" --out k.hdr --preview new/k.png --checkpoint new/../new/k.png
refused "$own" "${pass[@]}" --out nowhere.png --checkpoint to-nowhere.png
refused "$own" "${pass[@]}" --out to-nowhere.png --preview nowhere.png
refused "stands below --out, 'k.png'; $own" "${pass[@]}" --out k.png --checkpoint k.png/a
refused "stands below --checkpoint" "${pass[@]}" --out k/k.png --checkpoint k

# The others.
"$render" "$scene" "${few[@]}" --out a.pfm
"$render" "$scene" "${few[@]}" --seed 2 --out b.pfm
cp tx.png c.png
refused "--out is 'c.png', which is read as" "$compare" c.png b.pfm --out c.png
refused "--out is 'tx.png', which is read as 'linked/hard.png'; $lost" "$compare" b.pfm \
    linked/hard.png --out tx.png
refused "--out is 'here/c.png', which is read" "$compare" a.pfm b.pfm --pieces c.png \
    --out here/c.png
"$render" "$scene" "${few[@]}" --slice 1/1 --out part
cp part/balls-1-of-1.slice m.pfm.json
refused "the file of settings beside --out is 'm.pfm.json', which is read as" \
    "$merge" m.pfm.json --out m.pfm
cp m.pfm.json m.pfm
refused "--out is 'm.pfm', which is read as" "$merge" m.pfm --out m.pfm
rm m.pfm m.pfm.json
sed 's/Kd 1 0 0/map_Kd tx.png/' tri.mtl >tx.mtl
sed 's/tri.mtl/tx.mtl/' tri.obj >tx.obj
for picture in tx.png here/tx.png linked/soft.png linked/hard.png; do
    refused "--out is '$picture', which is read as" "$inspect" tx.obj --out "$picture"
done
refused "cannot write into the folder 'tx.obj'" "$inspect" tx.obj --out tx.obj
refused "cannot write" "$inspect" tx.obj --out /proc/none/a.png
refused "--out is empty" "$render" named.json "${few[@]}" --out ""

# The file of settings is tried before the work, as the picture is. (A file that nobody may
# write; the root may, but it is not replaced.)
mkdir s.png.json
refused "s.png.json': Is a directory" "$render" "$scene" "${few[@]}" --out s.png
refused "cannot write" "$merge" part --out s.png
touch r.png.json
chmod 444 r.png.json
refused "r.png.json': Permission denied" "$render" "$scene" "${few[@]}" --out r.png
long=$(printf 'x%.0s' $(seq 245)) # of its settings' file the name is too long
refused "File name too long" "$render" "$scene" "${few[@]}" --out "$long.png"

# What is no other file is no obstacle: the same picture once more, also behind a link, whose
# target must be there.
refused "it is a link to a file that does not exist" "$render" named.json "${few[@]}" \
    --out to-nowhere.png
touch nowhere.png
for _ in 1 2; do
    "$render" named.json "${few[@]}" --passes 1 --out to-nowhere.png --preview p.png ||
        wrong "a second picture is refused"
done

# A slice is of the scene that was read, and says so, though its file changes meanwhile.
if command -v stdbuf >before.txt; then
    rm -f out.txt
    cp "$scene" edited.json
    slow=("${few[@]:0:6}" --caustic-photons 300000 --threads 1)
    "$render" edited.json "${slow[@]}" --quiet --out whole.pfm
    "$render" edited.json "${slow[@]}" --quiet --slice 1/2 --out before.slice
    stdbuf -oL "$render" edited.json "${slow[@]}" --slice 2/2 --out during.slice >out.txt &
    pid=$!
    until [ -s out.txt ] || ! kill -0 $pid; do sleep 0.01; done # it has read the scene
    sed 's/"vfov_deg": 36/"vfov_deg": 70/' "$scene" >edited.json
    [ ! -e during.slice ] || echo "the scene did not change in time: nothing is tested"
    wait $pid || wrong "no slice of a scene that has changed: exit code $?"
    "$merge" before.slice during.slice --quiet --out merged.pfm || wrong "another scene"
    cmp whole.pfm merged.pfm || wrong "a slice of the changed scene"
    "$render" edited.json "${slow[@]}" --quiet --slice 2/2 --out after.slice
    refused "its scene_hash is" "$merge" before.slice after.slice --out never.pfm
fi

[ $wrong -eq 0 ] && echo "no program writes over what it needs"
exit $wrong
