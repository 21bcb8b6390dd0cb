#!/usr/bin/env bash
# Two options of `render` at a time, of all that there are: what is printed or rendered shows
# that the second one is there, or it is refused by name, or said to have no effect. The
# oracle is the output itself: the bytes of the picture and the text.
# Usage: option_pairs.sh RENDER SCENE.json SCRATCH [N]: every Nth pair; without it, all.
set -euo pipefail
render=$1
scene=$2
scratch=$3
step=${4:-1}
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# A value of each option that has an effect where it can have one. What none of them shows
# is left out: --threads and --photon-memory change no picture, --quiet and --help are asked
# of the program, and --resume, --checkpoint and --preview of files.
options=("--width 7" "--height 7" "--rays 3" "--seed 2" "--more-rays 40"
    "--disagreement 0.01" "--sampling random" "--precision double" "--exposure 2"
    "--renderer path" "--preset exact" "--depth 2" "--roulette 1" "--seconds 0.05"
    "--error 5" "--direct analytic" "--shadow-rays 3" "--indirect cache" "--indirect map"
    "--split-glass" "--caustic-photons 400" "--general-photons 700"
    "--caustic-budget equal" "--photon-numbers sobol" "--photon-bounces 3"
    "--caustic-radius 0.7" "--caustic-nearest 3" "--caustic-kernel cone"
    "--general-radius 0.9" "--general-nearest 3" "--general-kernel cone"
    "--fog-radius 0.2" "--fog-nearest 3"
    "--irradiance-every 9" "--irradiance-nearest 9" "--irradiance-radius 0.7"
    "--irradiance-shadow-rays 3" "--gather-rays 3" "--gather-tile 7"
    "--gather-nearest 2" "--gather-reach 0.2" "--gather-depth 2" "--skip enough"
    "--skip-bounces" "--skip-radius 0.2" "--skip-tolerance 0.9" "--skip-risk 0.9"
    "--path-lights rays" "--roulette-threshold 3" "--roulette-max 0.3" "--passes 2"
    "--alpha 0.1" "--every 1" "--plan" "--hooks" "--explain 3,5" "--show-photons all"
    "--slice 1/2" "--region 2,1,4,5" "--layers depth")
# What need not show in a PNG file of few pixels, though it is at work there; nor does any
# number in a plan, or a photon where it only tells that a ray is needed.
slight=" --split-glass --roulette --roulette-threshold --roulette-max --skip --skip-bounces"
slight+=" --skip-radius --skip-tolerance --skip-risk --gather-reach --gather-depth --depth"
slight+=" --precision --photon-bounces --caustic-nearest "
few=(--width 8 --height 8 --rays 2 --caustic-photons 300 --general-photons 500
    --threads 1 --quiet)

# output OPTIONS...: what a run makes, in the file `made`, and its exit code.
output() {
    local code=0
    rm -rf out
    # shellcheck disable=SC2068
    "$render" "$scene" "${few[@]}" $@ --out out >made 2>says </dev/null || code=$?
    rm -f out/*.json
    [ ! -d out ] || cat out/* >>made
    return $code
}

pair=0
for a in "${options[@]}"; do
    case $a in --seconds*|--error*) continue ;; esac # by the clock; below they are refused
    alone=
    for b in "${options[@]}"; do
        pair=$((pair + 1))
        name=${b%% *}
        [ "${a%% *}" != "$name" ] && [ $((pair % step)) -eq 0 ] || continue
        [ -n "$alone" ] || { output "$a" || true; mv made alone; alone=1; }
        code=0
        output "$a" "$b" || code=$?
        case $code in
            0)
                if [[ $slight != *" $name "* && $a != --plan && $a != --skip* &&
                    "$a $name" != "--indirect cache --gather-"* ]] && cmp -s alone made &&
                    ! grep -q -- "$name[ ,].*no effect" says; then
                    wrong "$a $b: $name has no effect, and nothing says so"
                fi
                ;;
            2)
                [ "$(wc -l <says)" -eq 1 ] && grep -q -- "--" says ||
                    wrong "$a $b: no option is named: $(cat says)"
                ;;
            *) wrong "$a $b: exit code $code" ;;
        esac
    done
done
[ $wrong -eq 0 ] && echo "each option of a pair has an effect, or it is said that it has none"
exit $wrong
