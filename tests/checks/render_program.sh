#!/usr/bin/env bash
# Checks the program examples/render.cpp: what it writes, and that wrong usage ends with one
# sentence and exit code 2, leaves no partial file, and keeps an existing one.
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
few=(--width 20 --height 16 --rays 2 --caustic-photons 1000)

# Each kind of file, each renderer; the folder of --out is made.
for file in a.png a.hdr a.pfm; do
    "$render" "$scene" "${few[@]}" --out "new/$file" >out.txt
    [ -s "new/$file" ] || wrong "no new/$file"
    grep -q 'caustics map' out.txt || wrong "no line of the caustics pass"
    grep -q 'per sample' out.txt || wrong "no rays per sample"
done
"$render" "$scene" "${few[@]}" --renderer path --quiet --out new >out.txt
[ -s new/balls.png ] || wrong "no new/balls.png"
[ ! -s out.txt ] || wrong "--quiet is not quiet: $(cat out.txt)"
for renderer in normals albedo depth; do
    "$render" "$scene" "${few[@]}" --renderer $renderer --quiet --out $renderer.pfm
    [ -s $renderer.pfm ] || wrong "no $renderer.pfm"
done
cmp -s normals.pfm depth.pfm && wrong "--renderer depth shows normals"
for indirect in rays map photons gather cache none; do
    "$render" "$scene" "${few[@]}" --indirect $indirect --general-photons 500 \
        --caustic-kernel cone --general-nearest 20 --depth 3 --roulette 2 --quiet --out $indirect.pfm
done

# Layers beside a picture of the same bytes, and in one EXR file if OpenEXR is there.
"$render" "$scene" "${few[@]}" --quiet --out lone.pfm
"$render" "$scene" "${few[@]}" --layers normal,depth,light-paths,glass=ES+.*L --quiet --out layered.pfm
cmp lone.pfm layered.pfm || wrong "--layers changes the picture"
for layer in N Z emission direct caustics indirect glass; do
    [ -s layered.$layer.pfm ] || wrong "no layered.$layer.pfm"
done
cmp -s layered.direct.pfm layered.indirect.pfm && wrong "direct light is indirect light"
grep -q '"layers": "normal,depth,light-paths,glass=ES+.\*L"' layered.pfm.json ||
    wrong "no layers in $(cat layered.pfm.json)"
if "$render" "$scene" "${few[@]}" --layers object,albedo --quiet --out layered.exr 2>err.txt; then
    [ -s layered.exr ] && [ ! -e layered.albedo.pfm ] || wrong "no layered.exr alone"
else
    grep -q 'must end in .png, .hdr' err.txt || wrong "EXR: $(cat err.txt)"
fi
cmp -s rays.pfm none.pfm && wrong "--indirect none changes nothing"
cmp -s map.pfm photons.pfm && wrong "--indirect photons changes nothing"

# The other options change the picture, and are accepted by name.
"$render" "$scene" "${few[@]}" --quiet --out plain.pfm
for choice in --split-glass "--sampling random" "--sampling jittered" "--sampling sobol" \
    "--precision double" "--shadow-rays 2" "--caustic-radius 0.3" "--caustic-radius 0" \
    "--caustic-budget equal" "--caustic-budget flux" "--caustic-budget area" \
    "--caustic-budget brightness" "--photon-numbers sobol" "--photon-bounces 1" \
    "--passes 2"; do
    # shellcheck disable=SC2086
    "$render" "$scene" "${few[@]}" $choice --quiet --out choice.pfm
    ! cmp -s plain.pfm choice.pfm || wrong "$choice changes nothing"
done
"$render" "$scene" "${few[@]}" --sampling multi-jittered --precision float \
    --indirect rays --quiet --out choice.pfm
cmp plain.pfm choice.pfm || wrong "the defaults are not the defaults"

for choice in "--path-lights power" "--path-lights rays" "--path-lights paths" \
    "--roulette-threshold 0 --roulette 1" "--roulette-max 0.5 --roulette 1"; do
    "$render" "$scene" "${few[@]}" --renderer path --quiet --out path.pfm
    # shellcheck disable=SC2086
    "$render" "$scene" "${few[@]}" --renderer path $choice --quiet --out choice.pfm
    ! cmp -s path.pfm choice.pfm || wrong "$choice changes nothing"
done
for choice in "--irradiance-radius 0.2" "--irradiance-shadow-rays 1" "--gather-depth 2"; do
    cached=(--indirect cache --general-photons 2000)
    "$render" "$scene" "${few[@]}" "${cached[@]}" --quiet --out cached.pfm
    # shellcheck disable=SC2086
    "$render" "$scene" "${few[@]}" "${cached[@]}" $choice --quiet --out choice.pfm
    ! cmp -s cached.pfm choice.pfm || wrong "$choice changes nothing"
done

# Chosen settings are printed, and written to the JSON beside the picture.
json_has() { grep -q -- "$1" choice.pfm.json || wrong "no $1 in $(cat choice.pfm.json)"; }
for rule in report any enough; do # where the photons are right, the picture is the same
    "$render" "$scene" "${few[@]}" --skip $rule --quiet --out choice.pfm
    json_has "\"skip\": \"$rule\""
    json_has '"skipped_rays": [1-9]'
done
"$render" "$scene" "${few[@]}" --skip enough --skip-bounces --skip-radius 0.4 \
    --skip-tolerance 0.25 --skip-risk 0.125 --caustic-budget area --caustic-radius 0 \
    --photon-numbers sobol --photon-bounces 9 --photon-memory 2 --out choice.pfm >out.txt
for line in '"skip": "enough"' '"skip-bounces": true' '"skip-radius": 0.4,' \
    '"skip-tolerance": 0.25,' '"skip-risk": 0.125,' '"caustic-budget": "area"' \
    '"caustic-shares": \[' '"photon-numbers": "sobol"' '"photon-bounces": 9,' \
    '"photon-memory": 2,' '"skipped_rays": [1-9]' \
    '"skipped_bounces": [1-9]'; do
    json_has "$line"
done
grep -q 'shares of the photons: 0\.' out.txt || wrong "no shares in $(cat out.txt)"
grep -q 'skipped: [1-9]' out.txt || wrong "no skipped rays in $(cat out.txt)"
"$render" "$scene" --skip enough --caustic-budget flux --caustic-radius 0 --passes 7 --alpha 0.5 \
    --plan >plan.txt
for line in '^skipped rays  *on ' 'shared out by flux, the radius comes from the photons' \
    'photon mapping in 7 passes, alpha 0.5$'; do
    grep -q "$line" plan.txt || wrong "no $line in the plan"
done
# Too few photons are said, on the terminal and beside the picture.
"$render" "$scene" "${few[@]}" --preset draft --general-photons 500 --quiet --out choice.pfm \
    2>err.txt
grep -q '^of 500 general photons .* landed twice or more, fewer than 1024' err.txt ||
    wrong "no remark on few photons: $(cat err.txt)"
json_has '"remarks": "of 500 general photons'
# So is a camera in a surface, which may see nothing else.
sed 's/"position": \[0, 1, 4.5\]/"position": [0, 0, 1]/' "$scene" >floor.json
"$render" floor.json "${few[@]}" --quiet --out choice.pfm 2>err.txt
grep -q '^camera.position lies in a surface' err.txt ||
    wrong "no remark on a camera in the floor: $(cat err.txt)"
json_has '"remarks": "camera.position lies in a surface'
"$render" "$scene" "${few[@]}" --quiet --out choice.pfm 2>err.txt
[ ! -s err.txt ] || wrong "a remark on nothing: $(cat err.txt)"
# So is a mesh of which something is left out.
printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 1 2 9\n' >torn.obj
sed 's/^ "objects": \[/&{"type": "mesh", "file": "torn.obj", "material": "white"},/' \
    "$scene" >torn.json
"$render" torn.json "${few[@]}" --quiet --out choice.pfm 2>err.txt
grep -q 'line 5: 1 faces refer to a vertex that does not exist' err.txt ||
    wrong "no remark on a mesh: $(cat err.txt)"
# So is a picture that no light has reached, here within a ball; a part of it is not.
cat >dark.json <<'END'
{"camera": {"position": [0, 0, 0.1], "look_at": [0, 0, 0], "up": [0, 1, 0], "vfov_deg": 40},
 "image": {"width": 4, "height": 4},
 "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]}},
 "objects": [{"type": "sphere", "material": "grey", "center": [0, 0, 0], "radius": 1}],
 "lights": [{"type": "point", "position": [0, 3, 0], "intensity": [9, 9, 9]}]}
END
"$render" dark.json --rays 1 --quiet --out dark.pfm 2>err.txt
grep -q '^every pixel is black: ' err.txt || wrong "no remark on a dark picture: $(cat err.txt)"
# An option that leaves light out is named: a lamp within glass is a caustic.
cat >lantern.json <<'END'
{"camera": {"position": [0, 3, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vfov_deg": 20},
 "image": {"width": 4, "height": 4},
 "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]},
               "glass": {"type": "dielectric", "ior": 1.5}},
 "objects": [{"type": "disc", "material": "grey", "center": [0, 0, 0], "normal": [0, 1, 0],
              "radius": 1},
             {"type": "sphere", "material": "glass", "center": [0, 5, 0], "radius": 1},
             {"type": "sphere", "material": "grey", "center": [0, 5, 0], "radius": 0.5,
              "emission": [9, 9, 9]}]}
END
"$render" lantern.json --rays 1 --caustic-photons 0 --quiet --out dark.pfm 2>err.txt
grep -q '^every pixel is black: .*--caustic-photons 0 leaves out' err.txt ||
    wrong "no word on missing caustics: $(cat err.txt)"
for left_out in "--indirect none" "--depth 1"; do
    "$render" dark.json --rays 1 $left_out --quiet --out dark.pfm 2>err.txt
    grep -q "^every pixel is black: .*$left_out leaves out" err.txt ||
        wrong "no word on $left_out in a dark picture: $(cat err.txt)"
done
"$render" dark.json --rays 1 --region 0,0,2,2 --quiet --out dark.pfm 2>err.txt
[ ! -s err.txt ] || wrong "a remark on a dark part: $(cat err.txt)"
# So is light in so small a unit that relMSE, with its fixed epsilon, misses the noise: a floor
# of albedo 1/2 at distance 1 from an intensity of pi/50 has the radiance 1/100.
cat >dim.json <<'END'
{"camera": {"position": [0, 3, 0], "look_at": [0, 0, 0], "up": [0, 0, 1], "vfov_deg": 0.1},
 "image": {"width": 4, "height": 4},
 "materials": {"grey": {"type": "lambertian", "albedo": [0.5, 0.5, 0.5]}},
 "objects": [{"type": "disc", "material": "grey", "center": [0, 0, 0], "normal": [0, 1, 0],
              "radius": 1}],
 "lights": [{"type": "point", "position": [0, 1, 0],
             "intensity": [0.0628319, 0.0628319, 0.0628319]}]}
END
for wants in "--more-rays 2" "--error 0.1"; do
    "$render" dim.json $wants --quiet --out choice.pfm 2>err.txt
    grep -q '^the mean radiance of the picture is 0.01, .* all lamps by 100$' err.txt ||
        wrong "no remark on dim light with $wants: $(cat err.txt)"
    json_has '"remarks": ".*the mean radiance of the picture is 0.01,'
done
"$render" dim.json --rays 2 --quiet --out choice.pfm 2>err.txt
[ ! -s err.txt ] || wrong "a remark on noise that nothing judges: $(cat err.txt)"
sed 's/"vfov_deg": 0.1/"vfov_deg": 60/; s/: 4/: 200/g' dim.json >wide.json
"$render" wide.json --preset fast --show-photons direct --general-photons 100 --quiet --out choice.pfm 2>err.txt
[ ! -s err.txt ] || wrong "a remark on few photons shown: $(cat err.txt)"
sed 's/0\.0628319/6.28319/g' dim.json >bright.json
"$render" bright.json --more-rays 2 --quiet --out choice.pfm 2>err.txt
[ ! -s err.txt ] || wrong "a remark on bright light: $(cat err.txt)"
# So is a radius in another unit than the scene's, of a picture in passes as well; the plan
# shows it beside the scene's size.
for passes in "" "--passes 2"; do
    "$render" "$scene" "${few[@]}" --caustic-radius 1e-5 $passes --quiet --out choice.pfm \
        2>err.txt
    grep -q '^--caustic-radius is 1e-5, and .* most of their light is missed' err.txt ||
        wrong "no remark on the radius with '$passes': $(cat err.txt)"
    json_has '"remarks": "--caustic-radius is 1e-5'
done
"$render" "$scene" --caustic-radius 1e-5 --plan >plan.txt
grep -q '^caustics map .*; radius 1e-5 in a scene 3 across$' plan.txt ||
    wrong "no radius in the plan: $(cat plan.txt)"
"$render" "$scene" "${few[@]}" --renderer path --path-lights power --quiet --out choice.pfm
json_has '"path-lights": "power"'

# Passes: the same bytes for any number of threads, and when stopped and resumed; and a
# preview.
passes=("$scene" "${few[@]}" --caustic-radius 0 --caustic-budget brightness --alpha 0.5 --quiet)
"$render" "${passes[@]}" --passes 6 --threads 1 --out whole.pfm
"$render" "${passes[@]}" --passes 2 --threads 2 --out part.pfm --checkpoint part.check
"$render" "${passes[@]}" --passes 6 --threads 2 --out choice.pfm --checkpoint part.check \
    --resume --preview part.png --every 0
cmp whole.pfm choice.pfm || wrong "a resumed picture is another"
[ -s part.png ] || wrong "no preview"
refused "--passes is 5; it must be at least 6, the passes in 'part.check'." \
    "${passes[@]}" --passes 5 --out fewer.pfm --checkpoint part.check --resume
[ ! -e fewer.pfm ] || wrong "six passes are saved as five"
json_has '"passes": 6,'
json_has '"alpha": 0.5'
json_has '"caustic-shares": \['
"$render" "${passes[@]}" --passes 2 --precision double --preset fast --out choice.pfm
json_has '"preset": "fast"'
json_has '"rays": 2,'
json_has '"more-rays": 0,'
"$render" "$scene" --width 20 --height 16 --passes 2 --quiet --out choice.pfm
json_has '"rays": 1,'

# A promise: settings are chosen and printed, and the promise is kept. The clock is wall-clock
# time and the machine may be busy, so the seconds are those that the program reports.
"$render" "$scene" --width 24 --height 20 --seconds 2 --out choice.pfm >out.txt
grep -q '^  The mean of [0-9]* pictures by ' out.txt || wrong "no reason in $(cat out.txt)"
grep -q 'relMSE .* to .* path-traced pixels), noise ' out.txt || wrong "no estimate in $(cat out.txt)"
json_has '"seconds": 2.0,'
took=$(sed -n 's/^ *"took": \([0-9.]*\),*$/\1/p' choice.pfm.json)
awk "BEGIN { exit !($took >= 1.6 && $took <= 2.4) }" || wrong "2 s took $took s"
"$render" "$scene" --width 24 --height 20 --error 0.05 --threads 1 --quiet --out choice.pfm
json_has '"error": 0.05'
estimate=$(sed -n 's/^ *"relMSE": \([0-9.e-]*\),*$/\1/p' choice.pfm.json)
awk "BEGIN { exit !($estimate > 0 && $estimate <= 0.05) }" ||
    wrong "an error of 0.05 became $estimate"

# A ball with a picture on it, by its own coordinates, and one of the report's material.
cp new/a.png picture.png
sed -e 's/"clay": .*/"clay": {"type": "picture", "file": "picture.png", "map": "uv"},/' \
    -e 's/"mirror": {.*/"mirror": {"type": "mixture", "color": [1, 0, 0]},/' \
    "$scene" >ball.json
"$render" ball.json "${few[@]}" --quiet --out ball.pfm
cmp -s plain.pfm ball.pfm && wrong "a picture and a mixture change nothing"

# Every setting of --help is in the file beside a picture, under its own name.
"$render" --help >help.txt
"$render" "$scene" "${few[@]}" --preset fast --passes 1 --quiet --out choice.pfm
cp choice.pfm.json all.json
"$render" "$scene" "${few[@]}" --renderer path --quiet --out choice.pfm
cat choice.pfm.json >>all.json
for name in $(sed -n 's/^  --\([a-z-]*\).*/\1/p' help.txt); do
    case $name in
        version | out | threads | quiet | slice | seconds | error) continue ;;
        schema | region | layers) continue ;;
        checkpoint | preview | plan | hooks | explain | show-photons) continue ;;
    esac
    grep -q "\"$name\": " all.json || wrong "--$name is not in the file beside the picture"
done

# A part of the picture: PFM stores rows from the bottom, so that the uppermost ones are
# the last bytes of both files.
"$render" "$scene" "${few[@]}" --renderer path --quiet --out whole.pfm
size=$(sed -n 2p whole.pfm)
"$render" "$scene" "${few[@]}" --renderer path --region "0,0,${size% *},3" --quiet --out part.pfm
cmp <(tail -c $((12 * 3 * ${size% *})) whole.pfm) <(tail -c $((12 * 3 * ${size% *})) part.pfm) ||
    wrong "--region changes pixels"
grep -q "\"region\": \"0,0,${size% *},3\"" part.pfm.json || wrong "the file does not name the region"
"$render" "$scene" "${few[@]}" --region 1,1,9999,1 --out no.pfm 2>says && wrong "a region beyond the picture"
grep -q -e "--region is 1,1,9999,1; it must be X,Y,W,H" says || wrong "a region: $(cat says)"

# The schema is JSON, and needs no scene.
"$render" --schema >schema.json
grep -q '"definitions"' schema.json || wrong "--schema prints no schema"

# The same seed gives the same bytes for any number of threads; another seed does not.
for threads in 1 2 3; do
    "$render" "$scene" "${few[@]}" --threads $threads --quiet --out t$threads.pfm
done
cmp t1.pfm t2.pfm && cmp t1.pfm t3.pfm || wrong "threads change the picture"
"$render" "$scene" "${few[@]}" --seed 2 --quiet --out seed.pfm
! cmp -s t1.pfm seed.pfm || wrong "--seed changes nothing"

# Photons as dots, of each kind and of all.
for kind in direct indirect shadow caustic all; do
    "$render" "$scene" "${few[@]}" --general-photons 500 --show-photons $kind \
        --out $kind.png >out.txt
    [ -s $kind.png ] || wrong "no $kind.png"
    [ $kind = all ] || grep -q "^  $kind .*stored" out.txt || wrong "no count of $kind photons"
done
cmp -s direct.png indirect.png && wrong "--show-photons does not tell kinds apart"

# The plan, the hooks and a pixel's paths; none writes a file.
mkdir readonly
(cd readonly && "$render" "$scene" --plan >../plan.txt && "$render" "$scene" --hooks \
    >../hooks.txt && "$render" "$scene" "${few[@]}" --explain 10,8 >../explain.txt)
[ "$(wc -l <plan.txt)" -le 12 ] || wrong "the plan is longer than 12 lines: $(cat plan.txt)"
grep -q '^shape SphereT<float> has bounds, ' hooks.txt || wrong "no hooks of a sphere: $(cat hooks.txt)"
grep -q '^caustics map *on' plan.txt || wrong "the plan has no caustics map: $(cat plan.txt)"
grep -q 'E D L  *shadow ray' explain.txt || wrong "no E D L: $(cat explain.txt)"
[ -z "$(ls readonly)" ] || wrong "--plan or --explain wrote a file"

refused "SCENE.json is required"
refused "missing.json" missing.json
refused "Is a directory" new
refused "--explain is 20,0; it must be X,Y" "$scene" "${few[@]}" --explain 20,0
refused "--explain is 1; it must be X,Y" "$scene" "${few[@]}" --explain 1
refused "--explain is 1,2,3; it must be X,Y" "$scene" "${few[@]}" --explain 1,2,3
refused "--layers has the word 'nromal'; did you mean normal? It may have" "$scene" --layers nromal
refused "two layers with the name 'albedo'" "$scene" --layers albedo=EDL,albedo
refused "The class of paths 'ESX'" "$scene" --layers x=ESX
refused "--region cannot be combined with --layers" "$scene" --layers depth --region 0,0,2,2
refused "with --layers, which takes the same rays" "$scene" --layers depth --preset fast
refused "--rays" "$scene" --rays 0
refused "--width" "$scene" --width -5
refused "--caustic-radius" "$scene" --caustic-radius nan
refused "--caustic-radius is '1e-30'; it must be 0 or a number from 1e-15" "$scene" --caustic-radius 1e-30
refused "--general-radius is '1e-30'; it must be 0 or a number from 1e-15" "$scene" --general-radius 1e-30
refused "--caustic-nearest is '1'; it must be 0 or a whole number from 2" "$scene" --caustic-nearest 1
refused "--general-nearest is '1'; it must be 0 or a whole number from 2" "$scene" --general-nearest 1
refused "--caustic-kernel" "$scene" --caustic-kernel hat
refused "--precision is 'half'; it must be float or double" "$scene" --precision half
refused "--preset is 'best'; it must be draft, fast or exact" "$scene" --preset best
refused "there is no option or argument '--nope'" "$scene" --nope
refused "there is no option or argument '--quality'" "$scene" --quality draft
refused "--seconds" "$scene" --seconds 0
refused "--error" "$scene" --error nan
refused "--error cannot be combined with --seconds, which chooses the settings" "$scene" --seconds 1 --error 0.1
fog=$(dirname -- "$scene")/fog.json
refused "irradiance that is gathered or cached" "$fog" --width 8 --height 8 --indirect cache
refused "settings that cache irradiance" "$fog" --width 8 --height 8 --seconds 1
for option in "--preset fast" "--rays 4" --plan "--explain 1,1" "--renderer path"; do
    # shellcheck disable=SC2086
    refused "cannot be combined with --seconds, which chooses the settings" "$scene" --seconds 1 \
        $option
done
refused "more time does not reduce it" "$scene" --width 8 --height 8 --error 1e-9
refused "--skip" "$scene" --skip jensen
refused "--skip-tolerance" "$scene" --skip-tolerance 1
refused "--skip-risk" "$scene" --skip-risk 0
refused "--skip-radius" "$scene" --skip-radius -1
refused "--caustic-budget" "$scene" --caustic-budget most
refused "--photon-numbers" "$scene" --photon-numbers dice
refused "--photon-bounces" "$scene" --photon-bounces 0
refused "--photon-memory is 1e-06 GB: at most 53760 photons would fit" "$scene" --photon-memory 1e-6
refused "photons for the caustics map would take" "$scene" --photon-memory 1e-4
refused "--path-lights" "$scene" --path-lights all
refused "--roulette-max" "$scene" --roulette-max 0
refused "--passes" "$scene" --passes 0
refused "--alpha" "$scene" --passes 2 --alpha 0
for option in "--alpha 0.5" "--checkpoint a.check" --resume "--preview a.png" "--every 1"; do
    # shellcheck disable=SC2086
    refused "is for pictures that are made in passes: give --passes N, too" "$scene" $option
done
refused "--passes is for --renderer photon; give other renderers more --rays" "$scene" --passes 2 --renderer path
refused "--more-rays cannot be combined with --passes" "$scene" --passes 2 --more-rays 3
refused "--show-photons cannot be combined with --explain" "$scene" --explain 1,1 --show-photons all
refused "--plan cannot be combined with --explain" "$scene" --explain 1,1 --plan
refused "--explain cannot be combined with --passes" "$scene" --passes 2 --explain 1,1
refused "--show-photons cannot be combined with --passes" "$scene" --passes 2 --show-photons all
refused "--resume needs --checkpoint" "$scene" --passes 2 --resume
refused "its name must end with .png" "$scene" --passes 2 --preview a.jpg
refused "it must be a file of its own" "$scene" --passes 2 --out a.pfm --checkpoint a.pfm
refused "cannot write" "$scene" --passes 2 --checkpoint /proc/none/a.check
refused "cannot read 'none.check'" "$scene" --passes 2 --checkpoint none.check --resume
refused "which is there already" "${passes[@]}" --passes 9 --checkpoint part.check
resume=("${passes[@]}" --passes 9 --checkpoint part.check --resume)
refused "'part.check' is of another picture: its seed is 1, and not 3" "${resume[@]}" --seed 3
refused "its alpha is 0.5, and not 0.75" "${resume[@]}" --alpha 0.75
refused "its caustic-budget is \"brightness\", and not \"area\"" "${resume[@]}" --caustic-budget area
refused "its precision is \"float\", and not \"double\"" "${resume[@]}" --precision double
cp "$scene" moved.json # the same scene by another name; and another one by the same
"$render" moved.json "${resume[@]:1}" --exposure 1 --threads 1 --out choice.pfm || wrong "a scene by another name"
sed 's/"ior": 1.5/"ior": 1.6/' "$scene" >moved.json
refused "is of another picture: its scene_hash is " moved.json "${resume[@]:1}"
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

# A limit on the size of files: one sentence, and the existing file is unchanged.
cp t1.pfm older.pfm
(
    ulimit -f 1
    code=0
    "$render" "$scene" --width 100 --height 100 --rays 1 --caustic-photons 0 --quiet \
        --out older.pfm 2>limit.txt || code=$?
    [ $code -eq 2 ] && grep -q 'cannot write' limit.txt
) || wrong "the file-size limit: $(cat limit.txt)"
cmp older.pfm t1.pfm || wrong "the older file is lost"

# Ctrl-C: exit code 130 within three seconds, even with a million rays per pixel; the message
# says what is saved.
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
[ $took -lt 3000 ] || wrong "Ctrl-C: it took $took ms"
grep -q 'stopped: no picture is saved; .* --passes N --checkpoint FILE' err.txt ||
    wrong "Ctrl-C does not say what is saved: $(cat err.txt)"
[ ! -e never.png ] || wrong "Ctrl-C left a picture"

# The same in passes: the passes done so far are in the checkpoint.
"$render" "$scene" --passes 1000000 --caustic-photons 500 --out never.png \
    --checkpoint never.check >out.txt 2>err.txt &
pid=$!
sleep 1
kill -INT $pid
code=0
wait $pid || code=$?
[ $code -eq 130 ] || wrong "Ctrl-C in passes: exit code $code, not 130"
[ -s never.check ] && [ ! -e never.png ] || wrong "Ctrl-C in passes: no checkpoint, or a picture"
grep -q "stopped: [1-9][0-9]* passes are saved in 'never.check'; the same command with --resume" \
    err.txt || wrong "Ctrl-C in passes does not say how to go on: $(cat err.txt)"

leftover=$(find . -name '*.ljus-part*' -o -name '.ljus*')
[ -z "$leftover" ] || wrong "left behind: $leftover"
[ $wrong -eq 0 ] && echo "the render program does what it says"
exit $wrong
