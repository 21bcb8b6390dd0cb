#!/usr/bin/env bash
# Checks the numbers of the book: those in its prose come from existing tables, numbers typed
# by hand are found, and the tool that does this reports errors.
. "$(dirname "$0")/common.sh"
command -v perl >/dev/null 2>&1 || skip "perl is not installed"
numbers=$LJUS_ROOT/chapters/tools/numbers
folder=$scratch/book_numbers
rm -rf "$folder"
mkdir -p "$folder"
cd "$folder"
export LJUS_FIGURES=$folder
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

cat >table.csv <<'END'
# prog.cpp, one run;
# a machine.
way,rays,"time, s",noise,noise
plain, 1 ,0.5,12 %,3
plain,4,2.125,,4
"wide, eight",4,0.25,1.5e-3,5
END
cat >page.md <<'END'
a \number{table, plain|4, time, s} s, \number{table, #3, noise; %.4f},
\number{table, plain,
noise} and \number{table, #last, noise#2}; \given{7 %}.
\conditions{table}
\table{table}
END
cat >right.txt <<'END'
a 2.125 s, 0.0015,
12&nbsp;%
 and 5; 7 %.
prog.cpp, one run; a machine.
END
perl "$numbers" page.md >filled.md
head -4 filled.md | diff - right.txt || wrong "a page is filled in otherwise"
[ "$(wc -l <filled.md)" -eq "$(wc -l <page.md)" ] || wrong "the number of lines has changed"
grep -q '<td>wide, eight</td><td>4</td><td>0.25</td>' filled.md || wrong "no table"
perl "$numbers" --check page.md || wrong "a good page is refused"

# refused SENTENCE TEXT: --check ends with 1, and says so.
refused() {
    local code=0
    echo "$2" >bad.md
    perl "$numbers" --check bad.md 2>err.txt || code=$?
    [ $code -eq 1 ] && grep -qF -- "$1" err.txt || wrong "$2: $code, $(cat err.txt)"
}
refused "there is no none.csv" '\number{none, plain, noise}'
refused "has no column 'color'" '\number{table, plain, color}'
refused "has no row 'red'" '\number{table, red, noise}'
refused "has no row '#9'" '\number{table, #9, noise}'
refused "the cell is empty" '\number{table, plain|4, noise}'
refused "it needs FILE, ROW, COLUMN" '\number{table, plain}'
refused "is not a number" '\number{table, #1, noise; %.2f}'
refused "there is no measured/none.csv" '\table{measured/none}'
refused "does not say how it was measured" '\conditions{plain}'

# typed COUNT TEXT: COUNT numbers of the text look measured.
typed() {
    echo "$2" >typed.md
    perl "$numbers" --typed typed.md 2>err.txt || true
    [ "$(wc -l <err.txt)" -eq "$1" ] || wrong "$2: $(cat err.txt)"
}
typed 2 'It took 1.5 s, and the error was 0.012.'
typed 2 'A slope of -0.67, 3 times as much.'
typed 0 'Radius 0.5, 1000 photons, version 3.13.5, \given{28 %}, \f$0.123\f$, `0.123`.'
typed 0 '    render --caustic-radius 0.123'
typed 0 '\exercise{Find it. (Check: 0.123.)}'

printf 'what,a\nx,3\n' >1.csv
printf 'what,a\nx,10\n' >2.csv
printf 'what,a\nx,9\n' >3.csv
perl "$numbers" --median 1.csv 2.csv 3.csv >median.csv && grep -qx 'x,9' median.csv || wrong "the median is another"

"$LJUS_ROOT/chapters/tools/check_numbers" "$LJUS_ROOT" || wrong "numbers of the book are typed"
while read -r program _ names; do
    for name in $names; do
        [ -s "$LJUS_ROOT/chapters/measured/$name.csv" ] ||
            wrong "chapters/measured/$name.csv is missing: ./scripts/measure $program"
    done
done < <(grep -v '^#' "$LJUS_ROOT/chapters/measured/list.txt")
[ $wrong -eq 0 ] && echo "the book's numbers are pulled from its tables"
exit $wrong
