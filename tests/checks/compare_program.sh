#!/usr/bin/env bash
# Checks the program examples/compare.cpp: what it prints for pictures with known errors, what
# it writes, and that wrong usage ends with one sentence and exit code 2.
# Usage: compare_program.sh PROGRAM SCRATCH
set -euo pipefail
compare=$1
scratch=$2
rm -rf "$scratch"
mkdir -p "$scratch"
cd "$scratch"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# grey NAME WIDTH HEIGHT BITS: a PFM file of one grey; BITS are the bytes of its float in hex,
# lowest byte first.
grey() {
    local i=0
    { printf 'Pf\n%d %d\n-1.0\n' "$2" "$3"
      while [ $i -lt $(($2 * $3)) ]; do printf "$4"; i=$((i + 1)); done } >"$1"
}
half='\x00\x00\x00\x3f' # 0.5
one='\x00\x00\x80\x3f'
grey one.pfm 30 20 "$one"
grey half.pfm 30 20 "$half"
grey small.pfm 20 20 "$one"
grey nan.pfm 30 20 '\x00\x00\xc0\x7f'

# refused SENTENCE ARGUMENTS...: exit code 2, and one line on stderr that has SENTENCE.
refused() {
    local sentence=$1 code=0
    shift
    "$compare" "$@" >out.txt 2>err.txt </dev/null || code=$?
    [ $code -eq 2 ] || wrong "ljus-compare $*: exit code $code, not 2"
    [ "$(wc -l <err.txt)" -eq 1 ] || wrong "ljus-compare $*: not one line: $(cat err.txt)"
    grep -qF -- "$sentence" err.txt || wrong "ljus-compare $*: no '$sentence' in: $(cat err.txt)"
}
# says SENTENCE: the last output has it.
says() { grep -qF -- "$1" out.txt || wrong "no '$1' in: $(cat out.txt)"; }
# line TEXT: a line of the last output is this, behind two blanks.
line() { grep -qxF -- "  $1" out.txt || wrong "no line '$1' in: $(cat out.txt)"; }

# Equal pictures, and one half as bright as the other: (1/2)^2 / 1.01.
"$compare" one.pfm one.pfm >out.txt
line 'mean             1'
line 'difference %     0'
line 'relMSE           0'
line 'HDR-FLIP         0'
"$compare" half.pfm one.pfm >out.txt
line 'mean             0.5'
line 'reference mean   1'
line 'difference %     -50'
line 'RMSE             0.5'
line 'relMSE           0.24752'
line 'trimmed relMSE   0.24752'
line 'block relMSE     0.24752'
"$compare" half.pfm one.pfm --epsilon 0 --json >out.txt
says '"epsilon":0.01' # (0.1 times a mean of 1)^2
says '"difference %":-50.0}'
says '"RMSE":0.5,'
[ "$(wc -l <out.txt)" -eq 1 ] || wrong "--json is not one line"
"$compare" half.pfm one.pfm --quiet >out.txt
[ ! -s out.txt ] || wrong "--quiet is not quiet: $(cat out.txt)"
grey black.pfm 30 20 '\x00\x00\x00\x00'
"$compare" one.pfm black.pfm >out.txt
line 'reference mean   0'
! grep -q 'difference' out.txt || wrong "a difference relative to a black picture"

# Blocks: 0.5 and 1 have the mean 0.75 with a standard error of 0.25, by which they are off
# from 1; two runs that agree have no noise.
"$compare" half.pfm one.pfm --pieces one.pfm >out.txt
line 'block means      18' # 3 x 2 of three channels
line 'off by 3 errors  0'
line 'by noise alone   3.687' # Student's tails beyond 3 hold a fifth
"$compare" half.pfm one.pfm --pieces half.pfm >out.txt
line 'off by 3 errors  18'

# Maps, also of equal pictures.
"$compare" half.pfm one.pfm --out new/flip.png --quiet
"$compare" one.pfm one.pfm --out new/flip-0.png --quiet
cmp -s new/flip.png new/flip-0.png && wrong "the map does not see the difference"
"$compare" new/flip.png new/flip.png >out.txt # PNG files are read
line 'difference %     0'

refused "REFERENCE is required" one.pfm
refused "cannot read 'none.pfm'" none.pfm one.pfm
refused "The image's size is 20 x 20; the reference has 30 x 20" small.pfm one.pfm
refused "The image's size is 20 x 20; the reference has 30 x 20" \
    half.pfm one.pfm --pieces one.pfm small.pfm
refused "the pixel in column 0, row 0 of 'nan.pfm' is not finite" nan.pfm one.pfm
refused "the pixel in column 0, row 0 of 'nan.pfm' is not finite" one.pfm nan.pfm
refused "--epsilon" half.pfm one.pfm --epsilon -1
refused "--seed" half.pfm one.pfm --seed 3
refused "cannot write" half.pfm one.pfm --out /proc/none/a.png
head -c 100 one.pfm >short.pfm
refused "short.pfm" short.pfm one.pfm
printf 'no picture' >text.png
refused "text.png is not a picture that can be read" text.png one.pfm

[ $wrong -eq 0 ] && echo "ljus-compare does what it says"
exit $wrong
