#!/usr/bin/env bash
# Checks scripts/install-packages on a bare machine without root: it prints a command to type,
# one sentence if it cannot continue, and no error if CMake can fetch what is missing.
. "$(dirname "$0")/common.sh"
bin=$scratch/bin
mkdir "$bin"
for tool in bash cat dirname basename sed tr getconf grep; do
    ln -s "$(command -v $tool)" "$bin/$tool"
done
printf '#!%s\necho 1000\n' "$(command -v bash)" >"$bin/id"
chmod +x "$bin/id"
wrong=0

# looks CODE LINES-OF-STDERR ARGUMENTS...
looks() {
    local code=$1 lines=$2 status=0
    shift 2
    env -i PATH="$bin" bash "$LJUS_ROOT/scripts/install-packages" "$@" \
        >"$scratch/out" 2>"$scratch/err" || status=$?
    if [ $status -ne "$code" ] || [ "$(wc -l <"$scratch/err")" -ne "$lines" ]; then
        echo "WRONG: install-packages $*: exit code $status for $code, and said:"
        cat "$scratch/out" "$scratch/err"
        wrong=1
    fi
}
looks 1 1 test
grep -q 'sudo apt-get install g++ cmake ' "$scratch/out" || { echo "WRONG: no line to type"; wrong=1; }
looks 1 1 --no-install test
grep -q 'there is no C++ compiler; install g++, or set CXX\.$' "$scratch/err" || { echo "WRONG: no sentence"; wrong=1; }
looks 2 1 nonsense
for tool in c++ cmake make; do printf '#!%s\nexit 1\n' "$(command -v bash)" >"$bin/$tool"; done
chmod +x "$bin"/*
looks 0 0 test
looks 0 0 book ci
looks 0 0 --no-install test
grep -q '^ *sudo apt-get install .*doctest-dev' "$scratch/out" ||
    { echo "WRONG: it looks, and does not say what is missing"; wrong=1; }
looks 0 0 --no-install figures
grep -q 'not installed: .*gnuplot-nox' "$scratch/out" || { echo "WRONG: no plots, in silence"; wrong=1; }
# As root without a network it says so, and continues with what is installed.
printf '#!%s\necho 0\n' "$(command -v bash)" >"$bin/id"
printf '#!%s\nexit 100\n' "$(command -v bash)" >"$bin/apt-get"
chmod +x "$bin/apt-get"
looks 0 1 test
grep -q 'apt-get could not install' "$scratch/err" || { echo "WRONG: apt-get failed in silence"; wrong=1; }
# Every script finds its folder with CDPATH, with which cd prints one or finds another.
for script in book figures install-packages measure new-concept plot test trades; do
    help=$(cd "$LJUS_ROOT" && CDPATH=$LJUS_ROOT/tests:$LJUS_ROOT bash scripts/$script --help 2>&1) &&
        [ -n "$help" ] || { echo "WRONG: $script --help with CDPATH: $help"; wrong=1; }
done
# A header or a chapter that has no test of its name: the sentence names its tests.
for row in "photon_path:emission tracing photon" "lamps:goniometric picture_lamp"; do
    said=$(bash "$LJUS_ROOT/scripts/test" "${row%%:*}" 2>&1) && wrong=1
    case $said in
        *"those of '${row%%:*}' are: ${row#*:}"*) ;;
        *) echo "WRONG: test ${row%%:*}: $said"; wrong=1 ;;
    esac
done
# A program for many machines makes no figure: figures does not list it, and refuses its name.
said=$(bash "$LJUS_ROOT/scripts/figures" --no-install many_machines 2>&1) && wrong=1
case $said$(bash "$LJUS_ROOT/scripts/figures" --list) in
    "figures: there is no 'many_machines'; --list shows "*many_machines*)
        echo "WRONG: figures --list has a program that figures does not run"; wrong=1 ;;
    "figures: there is no 'many_machines'; --list shows "*) ;;
    *) echo "WRONG: figures many_machines: $said"; wrong=1 ;;
esac
# A new concept gets its five files; one without a chapter, its three.
mkdir -p "$scratch/new/chapters"
cp -r "$LJUS_ROOT/scripts" "$scratch/new/"
echo '| 49 | \anchor ch_new_idea "New idea" | |' >"$scratch/new/chapters/contents.md"
for row in "5 new_idea geometry" "3 new_format io"; do
    said=$(bash "$scratch/new/scripts/new-concept" ${row#* } 2>&1) || true
    [ "$(grep -c '^created ' <<<"$said")" -eq "${row%% *}" ] ||
        { echo "WRONG: new-concept: $said"; wrong=1; }
done
grep -q 'no chapter' <<<"$said" || { echo "WRONG: new-concept in silence: $said"; wrong=1; }
! grep -q 'ch_new_format' "$scratch"/new/include/ljus/io/new_format.hpp ||
    { echo "WRONG: new-concept refers to a chapter that is not there"; wrong=1; }
# CMake's own words would not say what is wrong.
odd="$scratch/a\"b"
mkdir -p "$odd"
ln -s "$LJUS_ROOT/scripts" "$odd/scripts"
said=$(. "$odd/scripts/common.sh" && configure "$root/build" 2>&1) && wrong=1
case $said in
    *"CMake cannot work in '$odd/build'"*"move the project."*) ;;
    *) echo "WRONG: a folder with a quotation mark: $said"; wrong=1 ;;
esac

[ $wrong -eq 0 ] && echo "install-packages says what is missing"
exit $wrong
