#!/usr/bin/env python3
"""Do the tests notice each small change to a header?

    mutate.py [options] [WHAT]...     ./scripts/test --mutate calls it

WHAT is a test (sphere), a room (geometry), or a header (geometry/sphere.hpp); without one,
all headers are tried. mutants.py makes the mutants. One program holds all mutants that a test
must notice: it is compiled once, and the environment variable LJUS_MUTANT chooses among them.
Each test case is first run alone to see which mutants it executes; a mutant is then tried
with these cases only, the quick ones first, until an assertion fails.

A header's own tests are tests/NAME_test.cpp, those that say '// concept: NAME' in their first
lines, and those that tests/mutants/tests names. tests/mutants/equivalent lists mutants that
no test can notice, with the reason; they are not counted.

  --sample N      only N mutants of each header, chosen at random
  --seed S        the seed of the random choice (1)
  --all N         at most N mutants in total, chosen at random
  --again         only those that survived the last run in this folder; with --sample N
                  also N of each header that never ran
  --long          also with the tests that say '// long:', which otherwise run only for
                  headers without another test
  --jobs N        number of parallel jobs (the number of processors)
  --build FOLDER  folder to work in (build/mutants)
  --commands FILE a compile_commands.json with the flags of the tests
  --report FILE   also write the survivors to this file
  --csv FILE      write a table by rooms, of this run and all earlier ones in this folder
  --compiled      also mutants that only the compiler evaluates, each in its own program
  --list          only count the mutants; with --csv write the table of known results
"""

import argparse
import concurrent.futures
import hashlib
import json
import math
import os
import random
import re
import resource
import shlex
import shutil
import signal
import subprocess
import sys
import time
from collections import Counter, defaultdict
from pathlib import Path

import mutants

ROOT = Path(__file__).resolve().parents[2]
INCLUDE = ROOT / "include"
TESTS = ROOT / "tests"
HERE = Path(__file__).resolve().parent
MEMORY = 4 << 30  # bytes that a test may ask for
NOTICED = ("killed", "crashed", "timed out")


def read(file):
    return file.read_text(encoding="utf-8")


def write(file, text):
    file.parent.mkdir(parents=True, exist_ok=True)
    if not file.exists() or read(file) != text:
        file.write_text(text, encoding="utf-8")


def floor(header):
    """math/frame.hpp: math; accel/detail/bvh_build.hpp: accel; parallel.hpp: parallel."""
    return header.split("/")[0].removesuffix(".hpp")


# --- Which test is a header's own -------------------------------------------------------
def heads():
    """The first lines of each test, by its name."""
    files = sorted(TESTS.glob("*_test.cpp"))
    return {f.name.removesuffix("_test.cpp"): read(f).split("\n")[:4] for f in files}


def tests_of_headers(with_long):
    head_of = heads()
    further = defaultdict(list)
    long_ones = set()
    for name, lines in head_of.items():
        for line in lines:
            if match := re.match(r"// concept: (\w+)", line):
                further[match[1]].append(name)
            if line.startswith("// long: "):
                long_ones.add(name)
    table = {}
    for line in read(HERE / "tests").split("\n"):
        if line.strip() and not line.startswith("#"):
            header, names = line.split(":")
            for name in names.split():
                if name not in head_of:
                    sys.exit(f"tests/mutants/tests: there is no test '{name}'.")
            if not (INCLUDE / "ljus" / header.strip()).exists():
                sys.exit(f"tests/mutants/tests: there is no header '{header.strip()}'.")
            table[header.strip()] = names.split()
    result = {}
    for file in sorted((INCLUDE / "ljus").rglob("*.hpp")):
        header = file.relative_to(INCLUDE / "ljus").as_posix()
        names = [file.stem] * (file.stem in head_of) + further[file.stem]
        names += [name for name in table.get(header, []) if name not in names]
        quick = [n for n in names if n not in long_ones]
        result[header] = quick if quick and not with_long else names
    return result


def wanted(header, tests, what):
    return not what or header in what or floor(header) in what or set(tests) & set(what)


# --- Mutants that change nothing that a test could see ----------------------------------
def equivalent_ones():
    """{(header, old line, new line): reason}"""
    result, header, pairs, old = {}, None, [], None
    for number, line in enumerate(read(HERE / "equivalent").split("\n"), 1):
        if not line.strip() or line.startswith("#"):
            continue
        kind, text = line[:1], line[1:].strip()
        if kind == "-":
            old = text
        elif kind == "+":
            pairs.append((old, text))
        elif kind == "=":
            for pair in pairs:
                result[(header, *pair)] = text
            pairs = []
        elif kind.strip():
            header = line.strip()
        else:
            sys.exit(f"tests/mutants/equivalent:{number}: not a header, -, + or =.")
    return result


# --- What became of them, run by run ----------------------------------------------------
def key_in_file(mutant):
    return f"{mutant.line} | {mutant.before} | {mutant.after}"


def file_of_fates(header, options):
    return options.build / "fates" / (header.replace("/", "_") + ".json")


def known_fates(header, options, which="fates"):
    """{key: fate} of all runs here since the header was last changed: how each mutant
    fared the last time, or with which="first" the first time."""
    file = file_of_fates(header, options)
    known = json.loads(read(file)) if file.exists() else {}
    text = hashlib.sha1(read(INCLUDE / "ljus" / header).encode()).hexdigest()
    return known.get(which, {}) if known.get("header") == text else {}


def keep_fates(header, found, fate, options):
    new = {key_in_file(m): fate[id(m)] for m in found if id(m) in fate}
    known = {
        "header": hashlib.sha1(read(INCLUDE / "ljus" / header).encode()).hexdigest(),
        "fates": known_fates(header, options) | new,
        "first": new | known_fates(header, options, "first"),
    }
    write(file_of_fates(header, options), json.dumps(known))


def write_csv(tests_of, equivalent, options):
    """By floor: how many were tried, how many of them are equivalent, and of the others
    how many were noticed when they were tried for the first time, and the last time."""
    rows = defaultdict(Counter)
    everything = 0
    for header in tests_of:
        last = known_fates(header, options)
        first = known_fates(header, options, "first")
        row = rows[floor(header)]
        for region in mutants.find(read(INCLUDE / "ljus" / header))[1]:
            everything += len(region.mutants)
            for mutant in region.mutants:
                result = last.get(key_in_file(mutant), "left out")
                if result == "left out":
                    continue
                row["made"] += 1
                if key_of(header, mutant) in equivalent:
                    row["equivalent"] += 1
                    continue
                row["first"] += first.get(key_in_file(mutant), result) in NOTICED
                row["now"] += result in NOTICED
    compiler = subprocess.run(["g++", "-dumpfullversion"], capture_output=True, text=True)
    made = sum(row["made"] for row in rows.values())
    lines = [
        f"# scripts/test --mutate --sample, {made} of {everything} mutants, chosen at random",
        "# header by header. At first: before there were tests for those that lived. Those",
        "# that were killed once are not tried again. Tests at -O1; "
        f"g++ {compiler.stdout.strip()}.",
        "floor,made,equivalent,killed at first,share at first,killed now,share now",
    ]
    for name, row in [*sorted(rows.items()), ("all", sum(rows.values(), Counter()))]:
        tried = row["made"] - row["equivalent"]
        if tried:
            then, now = (f"{row[k]},{100 * row[k] / tried:.0f} %" for k in ("first", "now"))
            lines.append(f"{name},{row['made']},{row['equivalent']},{then},{now}")
    write(options.csv, "\n".join([*lines, ""]))


# --- How a test is compiled -------------------------------------------------------------
def command_of(test, commands):
    """The compiler and its flags, without what is compiled."""
    source = TESTS / f"{test}_test.cpp"
    for entry in commands:
        if Path(entry["directory"], entry["file"]).resolve() == source:
            words = entry.get("arguments") or shlex.split(entry["command"])
            kept, skip = [], False
            for word in words:
                if skip or word in ("-c", entry["file"], "-Winvalid-pch"):
                    skip = False
                elif word in ("-o", "-include"):
                    skip = True
                elif not re.match(r"-W|-DLJUS_CORE\b|-O\d|.*ccache$", word):
                    kept.append(word)
            return kept
    flags = ["-std=c++20", "-DNDEBUG", "-fopenmp", f"-I{INCLUDE}"]
    flags += [f"-I{TESTS}", f"-I{ROOT}/examples"]
    if Path("/usr/include/mpfr.h").exists():
        flags += ["-DLJUS_TEST_HAS_MPFR"]
    return [os.environ.get("CXX", "g++"), *flags]


def with_headers(command, folder):
    """The same with this folder first on the include path."""
    for i, word in enumerate(command):
        if word.startswith("-I") or word == "-isystem":
            return [*command[:i], f"-I{folder}", *command[i:]]
    return [*command, f"-I{folder}"]


def libraries():
    """What the headers of /usr/include have to be linked with."""
    needed = {"mpfr.h": ["-lmpfr", "-lgmp"]}
    return [
        library
        for header, names in needed.items() for library in names
        if Path("/usr/include", header).exists()
    ]  # fmt: skip


class Program:
    """One test with all the mutants that it is to notice."""

    def __init__(self, test, options):
        self.test = test
        self.options = options
        self.folder = options.build / test
        self.source = TESTS / f"{test}_test.cpp"
        self.mutants = []  # (header, mutant), by their numbers less 1
        self.headers = {}  # header: (reader, regions)
        self.dropped = Counter()  # by header

    def take(self, header, regions, chosen):
        reader, all_regions = regions
        kept = []
        for region in all_regions:
            mine = [m for m in region.mutants if id(m) in chosen]
            if mine:
                copies = [mutants.Mutant(**vars(m)) for m in mine]
                kept.append(mutants.Region(**{**vars(region), "mutants": copies}))
        if not kept:
            return
        self.headers[header] = (reader, kept)
        for region in kept:
            for mutant in region.mutants:
                self.mutants.append((header, mutant))
                mutant.number = len(self.mutants)

    def write_headers(self):
        self.writers = {}
        switch = mutants.SWITCH.replace("COUNT", str(len(self.mutants)))
        write(self.folder / "include/ljus_mutants.hpp", switch)
        for header, (reader, regions) in self.headers.items():
            writer = mutants.Writer(reader, regions)
            file = self.folder / "include/ljus" / header
            write(file, writer.write())
            self.writers[str(file)] = writer

    def compiler(self):
        command = command_of(self.test, self.options.compile_commands)
        return [*with_headers(command, self.folder / "include"), "-w", "-O1"]

    def drop(self, mutant, header):
        if mutant.number:
            mutant.number = 0
            self.dropped[header] += 1
            return 1
        return 0

    def drop_region(self, region, header):
        return sum(self.drop(mutant, header) for mutant in region.mutants)

    def drop_what_does_not_compile(self):
        """Compiles, leaves out what the compiler complains about, and compiles again."""
        shutil.rmtree(self.folder / "include", ignore_errors=True)  # of another run
        for _ in range(25):
            self.write_headers()
            command = [*self.compiler(), "-fsyntax-only", "-ftemplate-backtrace-limit=0"]
            run = subprocess.run(
                [*command, "-fdiagnostics-color=never", str(self.source)],
                capture_output=True, text=True, errors="replace",
            )  # fmt: skip
            if run.returncode == 0:
                return True
            if not self.drop_by(run.stderr):
                write(self.folder / "errors.txt", run.stderr)
                break
        print(f"{self.test}: it does not compile; see {self.folder}/errors.txt", flush=True)
        return False

    def drop_by(self, messages):
        place = re.compile(r"^(\S[^:\n]*):(\d+)(?::\d+)?:\s*(.*)$")
        count, context, unplaced = 0, [], []
        for line in messages.split("\n"):
            match = place.match(line)
            if not match:
                continue
            here = (match[1], int(match[2]))
            if not match[3].startswith(("error", "fatal error")):
                if match[3].startswith(("required", "in ", "  ")) or "required" in match[3]:
                    context.append(here)
                continue
            dropped = 0
            for file, number in [here, *context]:
                writer = self.writers.get(os.path.realpath(file))
                if writer and number in writer.lines:
                    header = str(Path(file).relative_to(self.folder / "include/ljus"))
                    mutant = writer.lines[number]
                    dropped = self.drop(mutant, header) or 1
                    count += dropped
                    break
            if not dropped:
                unplaced.append((here, list(context), match[3]))
            context = []
        if count:
            return count
        # No mutant stands on a line of its own: all of a piece of text.
        for here, context, _ in unplaced:
            for file, number in [here, *context]:
                writer = self.writers.get(os.path.realpath(file))
                spans = [s for s in (writer.spans if writer else []) if s[0] <= number <= s[1]]
                if spans:
                    region = min(spans, key=lambda span: span[1] - span[0])[2]
                    header = str(Path(file).relative_to(self.folder / "include/ljus"))
                    count += self.drop_region(region, header)
                    break
        # A constant that may not cease to be one.
        names = set(re.findall(r"(\w+)['’]", messages))
        for loud in (True, False):
            if count:
                break
            for header, (_, regions) in self.headers.items():
                for region in regions:
                    if region.constant and (region.name in names or not loud):
                        count += self.drop_region(region, header)
        return count

    def build(self):
        if not self.drop_what_does_not_compile():
            return False
        self.program = self.folder / f"{self.test}_mutants"
        main = self.options.build / "doctest_main.o"
        flags = command_of(self.test, self.options.compile_commands)
        if not main.exists():
            source = str(TESTS / "doctest_main.cpp")
            subprocess.run([*flags, "-O1", "-c", source, "-o", str(main)], check=True)
        run = subprocess.run(
            [*self.compiler(), str(self.source), str(main), "-o", str(self.program), *libraries()],
            capture_output=True, text=True, errors="replace",
        )  # fmt: skip
        if run.returncode:
            write(self.folder / "errors.txt", run.stderr)
            print(f"{self.test}: it does not link; see {self.folder}/errors.txt", flush=True)
        return run.returncode == 0

    # --- Running it ---------------------------------------------------------------------
    def run(self, number, cases, limit, more=()):
        """What became of the mutant: survived, killed, crashed, timed out."""
        arguments = [str(self.program), *more]
        if cases is not None:
            escaped = [re.sub(r"([,\\])", r"\\\1", case) for case in cases]
            arguments.append("--test-case=" + ",".join(escaped))
        work = self.folder / f"run{number}"
        work.mkdir(exist_ok=True)
        environment = {**os.environ, "LJUS_MUTANT": str(number), "TMPDIR": str(work)}
        environment["LJUS_MUTANTS_SEEN"] = str(work / "seen.txt")
        environment.setdefault("OMP_WAIT_POLICY", "passive")

        def set_limits():  # processor time: other programs may be running
            resource.setrlimit(resource.RLIMIT_AS, (MEMORY, MEMORY))
            seconds = math.ceil(limit)
            resource.setrlimit(resource.RLIMIT_CPU, (seconds, seconds + 1))

        process = subprocess.Popen(
            arguments, cwd=work, env=environment, stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, start_new_session=True,
            preexec_fn=set_limits,
        )  # fmt: skip
        try:
            self.output = process.communicate(timeout=8 * limit)[0]
            code = process.returncode
            self.code = code
            result = "survived" if code == 0 else "killed" if code == 1 else "crashed"
            if code in (-signal.SIGXCPU, -signal.SIGKILL):
                result = "timed out"
        except subprocess.TimeoutExpired:
            os.killpg(process.pid, signal.SIGKILL)
            process.communicate()
            result = "timed out"
        seen = work / "seen.txt"
        self.seen = [int(line) for line in read(seen).split()] if seen.exists() else []
        shutil.rmtree(work, ignore_errors=True)
        return result

    def learn(self):
        """Which cases there are, how long each takes, and what each comes by."""
        self.run(0, None, 60, ["--list-test-cases", "--reporters=xml"])
        text = self.output.decode(errors="replace")
        names = re.findall(r'<TestCase name="(.*?)"', text)
        table = {"&quot;": '"', "&lt;": "<", "&gt;": ">", "&apos;": "'", "&amp;": "&"}
        self.cases = {}
        self.comes_by = defaultdict(list)
        for name in names:
            for escape, sign in table.items():
                name = name.replace(escape, sign)
            start = time.monotonic()
            result = self.run(-1, [name], 600)
            if result != "survived":
                print(f"{self.test}: '{name}' {result} though nothing is wrong, exit code {self.code}", flush=True)
                write(self.folder / "unbroken.txt", self.output.decode(errors="replace"))
                continue
            self.cases[name] = time.monotonic() - start
            for number in self.seen:
                self.comes_by[number].append(name)

    def attempt(self, number):
        cases = sorted(self.comes_by.get(number, []), key=self.cases.get)
        if not cases:
            return "not reached"
        total = sum(self.cases[case] for case in cases)
        quick, sum_ = [], 0.0
        for case in cases:
            sum_ += self.cases[case]
            if sum_ > max(0.2, 0.15 * total):
                break
            quick.append(case)
        slow = cases[len(quick) :]
        for part in (quick, slow):
            if part:
                limit = max(self.options.timeout, 4 * sum(self.cases[case] for case in part))
                result = self.run(number, part, limit, ["--abort-after=1", "--no-breaks"])
                if result != "survived":
                    return result
        return "survived"

    def attempt_compiled(self, number):
        """A mutant that only the compiler runs: it has a program of its own."""
        program = self.folder / f"{self.test}_mutant{number}"
        flags = [f"-DLJUS_MUTANT={number}", str(self.source)]
        command = [*self.compiler(), *flags, str(self.options.build / "doctest_main.o")]
        run = subprocess.run([*command, "-o", str(program), *libraries()], capture_output=True)
        if run.returncode:
            return "killed"  # by a static_assert, or as no constant
        limit = max(self.options.timeout, 4 * sum(self.cases.values()))
        self.program = program
        result = self.run(number, list(self.cases), limit, ["--abort-after=1", "--no-breaks"])
        program.unlink()
        return "not reached" if result == "survived" else result

    def try_all(self):
        start = time.monotonic()
        self.learn()
        live = [m.number for _, m in self.mutants if m.number]
        results = {}
        with concurrent.futures.ThreadPoolExecutor(self.options.jobs) as pool:
            runs = {pool.submit(self.copy().attempt, number): number for number in live}
            for run in concurrent.futures.as_completed(runs):
                results[runs[run]] = run.result()
            compiled = {
                m.number
                for _, regions in self.headers.values() for region in regions
                for m in region.mutants
                if region.constexpr and results.get(m.number) == "not reached"
            }  # fmt: skip
            if self.options.compiled:
                runs = {pool.submit(self.copy().attempt_compiled, n): n for n in compiled}
                for run in concurrent.futures.as_completed(runs):
                    results[runs[run]] = run.result()
        self.seconds = time.monotonic() - start
        return results

    def copy(self):  # output and seen belong to one run at a time
        twin = Program(self.test, self.options)
        twin.__dict__.update(self.__dict__)
        return twin


def key_of(header, mutant):
    return (header, mutant.before, mutant.after)


def name_of(header, mutant):
    return f"{header}:{mutant.line}: {mutant.operator}"


def main():
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("what", nargs="*")
    parser.add_argument("--sample", type=int)
    parser.add_argument("--all", type=int)
    parser.add_argument("--seed", default="1")
    parser.add_argument("--again", action="store_true")
    parser.add_argument("--long", action="store_true")
    parser.add_argument("--list", action="store_true")
    parser.add_argument("--compiled", action="store_true")
    parser.add_argument("--jobs", type=int, default=os.cpu_count() or 1)
    parser.add_argument("--timeout", type=float, default=5)
    parser.add_argument("--build", type=Path, default=ROOT / "build/mutants")
    parser.add_argument("--commands", type=Path)
    parser.add_argument("--report", type=Path)
    parser.add_argument("--csv", type=Path)
    options = parser.parse_args()
    options.build = options.build.resolve()
    options.build.mkdir(parents=True, exist_ok=True)
    options.compile_commands = []
    if options.commands and options.commands.exists():
        options.compile_commands = json.loads(read(options.commands))

    tests_of = tests_of_headers(options.long)
    known = set(tests_of) | {floor(h) for h in tests_of} | {t for v in tests_of.values() for t in v}
    for what in options.what:
        if what not in known:
            sys.exit(f"there is no test, floor or header '{what}' with mutants.")
    equivalent = equivalent_ones()
    unused = {key for key in equivalent if not options.what}

    chosen_of, regions_of = {}, {}
    for header, tests in tests_of.items():
        if not wanted(header, tests, options.what):
            continue
        regions_of[header] = mutants.find(read(INCLUDE / "ljus" / header))
        found = [m for region in regions_of[header][1] for m in region.mutants]
        unused -= {key_of(header, m) for m in found}
        found = [m for m in found if key_of(header, m) not in equivalent]
        known = known_fates(header, options)
        found = [m for m in found if known.get(key_in_file(m)) != "left out"]
        last = []
        if options.again:
            file = options.build / "survivors" / header.replace("/", "_")
            keys = {tuple(k) for k in json.loads(read(file))} if file.exists() else set()
            last = [m for m in found if key_of(header, m)[1:] in keys]
            never = [m for m in found if m not in last and key_in_file(m) not in known]
            found = never if options.sample is not None else []
        if options.sample is not None and len(found) > options.sample:
            found = random.Random(f"{options.seed} {header}").sample(found, options.sample)
        found = last + found
        chosen_of[header] = found
    if options.all is not None:
        everything = [(h, m) for h, found in chosen_of.items() for m in found]
        kept = random.Random(options.seed).sample(everything, min(options.all, len(everything)))
        kept = {id(m) for _, m in kept}
        chosen_of = {h: [m for m in found if id(m) in kept] for h, found in chosen_of.items()}
    for key in sorted(unused):
        print(f"tests/mutants/equivalent: {key[0]} has no '{key[1]}' any more.")
    if options.list:
        if options.csv:
            write_csv(tests_of, equivalent, options)
        for header, found in chosen_of.items():
            print(f"{len(found):6} {header}: {' '.join(tests_of[header])}")
        print(f"{sum(map(len, chosen_of.values())):6} in all")
        return

    # Each test is asked about all the headers that are its own; a second test of a header
    # only about what the first one left alive.
    fate = {}  # (header, mutant): what became of it
    dropped = Counter()
    by_test = defaultdict(list)
    rounds = max((len(tests) for tests in tests_of.values()), default=0)
    for turn in range(rounds):
        by_test.clear()
        for header, tests in tests_of.items():
            if header in chosen_of and turn < len(tests):
                by_test[tests[turn]].append(header)
        for test in sorted(by_test):
            program = Program(test, options)
            asked = {}
            for header in by_test[test]:
                left = [
                    m for m in chosen_of[header]
                    if fate.get(id(m), "survived") in ("survived", "not reached")
                ]  # fmt: skip
                asked.update({id(m): m for m in left})
                program.take(header, regions_of[header], asked)
            if not program.mutants:
                continue
            start = time.monotonic()
            originals = []
            for header in program.headers:
                for region in regions_of[header][1]:
                    originals += [m for m in region.mutants if id(m) in asked]
            if not program.build():
                for original in originals:
                    fate.setdefault(id(original), "left out")
                continue
            built = time.monotonic() - start
            results = program.try_all()
            tally = Counter(results.values())
            for original, (_, copy) in zip(originals, program.mutants):
                result = results.get(copy.number, "left out") if copy.number else "left out"
                before = fate.get(id(original))
                if before == "survived" and result in ("not reached", "left out"):
                    continue
                fate[id(original)] = result
            counts = ", ".join(f"{n} {what}" for what, n in sorted(tally.items()))
            print(
                f"{test}: {counts}; {sum(program.dropped.values())} do not compile; "
                f"{built:.0f} s to build, {program.seconds:.0f} s to run "
                f"({sum(program.cases.values()):.1f} s a test)", flush=True,
            )  # fmt: skip

    for header, found in chosen_of.items():
        keep_fates(header, found, fate, options)
    report(chosen_of, tests_of, fate, options)
    if options.csv:
        write_csv(tests_of, equivalent, options)


def report(chosen_of, tests_of, fate, options):
    lines = []
    totals = defaultdict(Counter)
    by_operator = defaultdict(Counter)
    for header, found in chosen_of.items():
        alive = []
        for mutant in found:
            result = fate.get(id(mutant), "no test")
            totals[floor(header)][result] += 1
            by_operator[mutant.operator][result] += 1
            if result in ("survived", "not reached", "no test"):
                alive.append(mutant)
                lines.append(f"{name_of(header, mutant)} ({result})")
                lines.append(f"    - {mutant.before}")
                lines.append(f"    + {mutant.after}")
        file = options.build / "survivors" / header.replace("/", "_")
        write(file, json.dumps([key_of(header, m)[1:] for m in alive]))
    print("\n".join(lines))
    head = f"{'':12}{'tried':>8}{'killed':>8}{'crashed':>9}{'timed out':>11}"
    table = [head + f"{'survived':>10}{'unreached':>11}{'noticed':>9}"]
    everything = Counter()
    for name, tally in [*sorted(totals.items()), ("all", everything)]:
        everything.update(tally if name != "all" else {})
        alive = tally["survived"], tally["not reached"] + tally["no test"]
        noticed = sum(tally[what] for what in NOTICED)
        tried = noticed + sum(alive)
        share = f"{100 * noticed / tried:.1f} %" if tried else ""
        table.append(
            f"{name:12}{tried:8}{tally['killed']:8}{tally['crashed']:9}"
            f"{tally['timed out']:11}{alive[0]:10}{alive[1]:11}{share:>9}"
        )
    table.append("")
    for name, tally in sorted(by_operator.items()):
        noticed = sum(tally[what] for what in NOTICED)
        tried = sum(tally.values()) - tally["left out"]
        if tried:
            table.append(f"{name:12}{tried:8} tried {100 * noticed / tried:6.1f} % noticed")
    left_out = sum(tally["left out"] for tally in by_operator.values())
    table.append(f"{left_out} were left out: they do not compile.")
    print("\n".join(table))
    if options.report:
        write(options.report, "\n".join([*lines, *table, ""]))


main()
