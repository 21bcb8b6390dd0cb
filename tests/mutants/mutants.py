"""Makes the mutants of a header: each is one small change.

find(text) reads the bodies of a header's functions and returns regions: pieces of text, each
an expression or a statement, with the mutants that change it. switched() writes a header that
contains all of them,

    (on(17) ? (a + b) : (a - b))

so that one program holds them all, and an environment variable chooses one.

The header is parsed only roughly, without types or names. Where a guess is wrong, the mutant
does not compile, and mutate.py leaves it out. The guesses rely on clang-format: a binary
operator has spaces around it, and a template's brackets have none.
"""

import re
import sys
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2] / "cmake"))
from break_it_patch import function_bodies  # noqa: E402

TOKEN = re.compile(
    r"""(?P<comment>//[^\n]*|/\*.*?\*/)
      | (?P<directive>^[ \t]*\#(?:\\\n|[^\n])*)
      | (?P<string>R"(?P<end>\w*)\(.*?\)(?P=end)"|"(?:\\.|[^"\\\n])*"|'(?:\\.|[^'\\\n])+')
      | (?P<number>\.?\d(?:[eEpP][+-]|'\w|[\w.])*)
      | (?P<word>[A-Za-z_]\w*)
      | (?P<sign><=>|->|::|\+\+|--|[-+*/%&|^]=|==|!=|<=|>=|&&|\|\||(?<=\s)(?:<<|>>)(?=\s)|\S)
    """,
    re.VERBOSE | re.DOTALL | re.MULTILINE,
)
KEYWORDS = set(
    "return throw case else do new delete if for while switch sizeof decltype noexcept "
    "alignof co_return const auto static constexpr".split()
)
BEGINS_NO_EXPRESSION = set(
    "using typedef static_assert template struct class enum union namespace friend throw "
    "assert goto asm".split()
)
OPENS = {"(": ")", "[": "]", "{": "}"}
COMMUTES = set(
    "dot min max distance hypot is_same_v equal same_as multiply fmax fmin swap has "
    "box_union distance2 half_vector larger_cosine same_side schlick_r0 squared_contrast "
    "fujii_term oren_nayar_ratio rough_as_printed rough_fon rough_fujii rough_full "
    "rough_weight".split()
)
DROPPED_CALLS = {
    "abs": 1, "sqrt": 1, "normalize": 1, "floor": 1, "ceil": 1, "round": 1,
    "min": 2, "max": 2, "clamp": 3, "copysign": 2, "reflect": 2, "isfinite": 0,
}
FLIPPED = {
    "+": ["-"], "-": ["+"], "*": ["/"], "/": ["*"], "%": ["/"],
    "<": ["<=", ">="], ">": [">=", "<="], "<=": ["<", ">"], ">=": [">", "<"],
    "==": ["!="], "!=": ["=="], "&&": ["||"], "||": ["&&"], "|": ["&"], "&": ["|"],
    "+=": ["-="], "-=": ["+="], "*=": ["/="], "/=": ["*="], "|=": ["&="], "&=": ["|="],
    "<<": [">>"], ">>": ["<<"],
}  # fmt: skip
AXES = {"x": "y", "y": "x", "z": "x"}
ELSEWHERE = ("_WIN32", "_MSC_VER", "FP_FAST_FMA")  # behind #ifdef: not compiled here


@dataclass
class Token:
    kind: str
    text: str
    start: int
    end: int
    partner: int = -1  # of a bracket


@dataclass
class Mutant:
    operator: str
    line: int
    edits: list  # (start, end, new text) in the header
    before: str
    after: str
    number: int = 0  # among all of a program; 0: left out


@dataclass
class Region:
    start: int
    end: int
    kind: str  # expression, condition, statement
    mutants: list = field(default_factory=list)
    name: str = ""  # of the constant that stops being one, if a mutant is on
    constant: tuple = ()  # where its word constexpr stands
    constexpr: bool = False  # in a function that the compiler may run


class Reader:
    def __init__(self, text):
        self.text = text
        self.directives = []
        self.tokens = []
        self.clean = text  # without comments
        pieces, done = [], 0
        elsewhere = 0  # so many #if are open in what is not compiled here
        for match in TOKEN.finditer(text):
            kind = match.lastgroup if match.lastgroup != "end" else "string"
            if match["string"]:
                kind = "string"
            if kind == "comment":
                pieces.append(text[done : match.start()])
                pieces.append(re.sub(r"[^\n]", " ", match[0]))
                done = match.end()
            elif kind == "directive":
                self.directives.append(match.start())
                word, *names = match[0].replace("#", " ").split()
                if elsewhere:
                    elsewhere += word.startswith("if")
                    elsewhere -= word == "endif" or (word == "else" and elsewhere == 1)
                elif word == "ifdef" and names[0] in ELSEWHERE:
                    elsewhere = 1
            elif not elsewhere:
                self.tokens.append(Token(kind, match[0], match.start(), match.end()))
        self.clean = "".join(pieces) + text[done:]
        self.pair_brackets()
        self.regions = []

    # --- What the tokens are ----------------------------------------------------------
    def pair_brackets(self):
        tokens, open_ones = self.tokens, []
        for i, token in enumerate(tokens):
            if token.kind != "sign":
                continue
            if token.text in OPENS:
                open_ones.append(i)
            elif token.text in OPENS.values():
                while open_ones and tokens[open_ones[-1]].text == "<":
                    open_ones.pop()
                if open_ones:
                    self.join(open_ones.pop(), i)
            elif token.text == "<" and i and self.opens_template(i):
                open_ones.append(i)
            elif token.text == ">" and open_ones and tokens[open_ones[-1]].text == "<":
                self.join(open_ones.pop(), i)
            elif token.text == ";":
                while open_ones and tokens[open_ones[-1]].text == "<":
                    open_ones.pop()

    def join(self, first, last):
        self.tokens[first].partner = last
        self.tokens[last].partner = first

    def opens_template(self, i):
        before, token = self.tokens[i - 1], self.tokens[i]
        if before.text == "template":
            return True
        return (before.kind == "word" or before.text == "]") and before.end == token.start

    def opens(self, i):
        return self.tokens[i].partner > i

    def after(self, i):
        """The token after this one, or after the group that it opens."""
        return self.tokens[i].partner + 1 if self.opens(i) else i + 1

    def is_operand_end(self, i):
        token = self.tokens[i]
        return (
            (token.kind == "word" and token.text not in KEYWORDS)
            or token.kind in ("number", "string")
            or token.text in (")", "]", "}")
            or (token.text == ">" and token.partner >= 0)
        )

    def is_binary(self, i):
        if i == 0 or not self.is_operand_end(i - 1):
            return False
        token = self.tokens[i]
        spaced = self.text[token.start - 1].isspace() and self.text[token.end].isspace()
        return spaced

    def find(self, first, last, *texts):
        """The places of these tokens in [first, last), outside of brackets."""
        found, i = [], first
        while i < last:
            if self.tokens[i].text in texts and self.tokens[i].partner < 0:
                found.append(i)
            i = self.after(i)
        return found

    def pieces(self, first, last, *texts):
        begin, result = first, []
        for at in [*self.find(first, last, *texts), last]:
            result.append((begin, at))
            begin = at + 1
        return result

    # --- Statements -------------------------------------------------------------------
    def block(self, first, last):
        i = first
        while i < last:
            i = max(self.statement(i, last), i + 1)

    def end_of_statement(self, i, last):
        while i < last and self.tokens[i].text != ";":
            i = self.after(i)
        return i

    def statement(self, i, last):
        tokens = self.tokens
        word = tokens[i].text
        if word == "{":
            self.block(i + 1, tokens[i].partner)
            return tokens[i].partner + 1
        if word == ";":
            return i + 1
        if word == "[" and tokens[i + 1].text == "[":  # an attribute
            return self.after(i)
        if word in ("if", "while", "switch"):
            constant = tokens[i + 1].text == "constexpr"
            open_ = i + 2 if constant else i + 1
            close = tokens[open_].partner
            if not constant:
                if word == "switch":
                    self.expression(open_ + 1, close)
                else:
                    self.condition(open_ + 1, close, word)
            i = self.statement(close + 1, last)
            if word == "if" and i < last and tokens[i].text == "else":
                i = self.statement(i + 1, last)
            return i
        if word == "for":
            open_, close = i + 1, tokens[i + 1].partner
            parts = self.pieces(open_ + 1, close, ";")
            if len(parts) == 3:
                self.simple(*parts[0], None)
                if parts[1][0] < parts[1][1]:
                    self.condition(*parts[1], "for")
            else:
                for colon in self.find(open_ + 1, close, ":")[:1]:
                    self.expression(colon + 1, close)
            return self.statement(close + 1, last)
        if word == "do":
            i = self.statement(i + 1, last)
            self.condition(i + 2, tokens[i + 1].partner, "while")
            return tokens[i + 1].partner + 2
        if word in ("case", "default"):
            return (self.find(i, last, ":") or [i])[0] + 1
        if word in ("try", "else"):
            return self.statement(i + 1, last)
        if word == "catch":
            return self.statement(self.after(i + 1), last)
        end = self.end_of_statement(i, last)
        if word in ("return", "co_return"):
            if i + 1 < end:
                self.expression(i + 1, end)
        elif word not in BEGINS_NO_EXPRESSION and word not in ("break", "continue"):
            self.simple(i, end, end)
        return end + 1

    def declares(self, first, last):
        """Whether a statement begins with a type and a name."""
        tokens, i, types = self.tokens, first, 0
        while i < last:
            token = tokens[i]
            if token.text in ("const", "auto", "static", "constexpr", "thread_local"):
                return True
            if token.text == "::":
                types = 0
            elif token.text == "<" and self.opens(i):
                i = token.partner
                types = 1
            elif token.text in ("&", "*") and types and token.start == tokens[i - 1].end:
                types = 1
            elif token.kind == "word":
                if types:
                    return True
                types = 1
            else:
                return False
            i += 1
        return False

    def simple(self, first, last, semicolon):
        """A declaration, or an expression that is a statement."""
        if first >= last:
            return
        if not self.declares(first, last):
            if semicolon is None:
                self.expression(first, last)
            else:
                self.expression(first, last, "statement", semicolon)
            return
        constants = self.find(first, last, "constexpr")
        for begin, end in self.pieces(first, last, ","):
            equals = self.find(begin, end, "=")
            region = None
            if equals:
                region = self.expression(equals[0] + 1, end)
            else:
                self.groups(begin, end)
            if constants:
                if region is None:
                    continue
                name = self.tokens[equals[0] - 1]
                if len(self.pieces(first, last, ",")) > 1 or name.kind != "word":
                    region.mutants.clear()
                word = self.tokens[constants[0]]
                region.name, region.constant = name.text, (word.start, word.end)

    def condition(self, first, last, word):
        for semicolon in self.find(first, last, ";"):
            self.simple(first, semicolon, None)
            first = semicolon + 1
        equals = self.find(first, last, "=")
        if equals:  # if (const auto hit = ...)
            self.expression(equals[0] + 1, last)
            return
        region = self.expression(first, last, "condition")
        whole = (self.tokens[first].start, self.tokens[last - 1].end)
        old = self.clean[slice(*whole)]
        if word == "if":
            self.add(region, "never", [(*whole, "false")], whole, old, "false")
            self.add(region, "always", [(*whole, "true")], whole, old, "true")
        elif word == "while":
            self.add(region, "never", [(*whole, "false")], whole, old, "false")

    # --- Expressions ------------------------------------------------------------------
    def groups(self, first, last):
        """What stands in the brackets of a declaration or an expression."""
        tokens, i = self.tokens, first
        while i < last:
            text = tokens[i].text
            if text == "requires":
                return
            if text == "[" and not (i > 0 and self.is_operand_end(i - 1)):
                i = self.lambda_(i, last)
                continue
            if self.opens(i) and text != "<":
                before = tokens[i - 1].text if i else ""
                if before not in ("sizeof", "decltype", "noexcept", "alignof", "alignas", "requires"):
                    for begin, end in self.pieces(i + 1, tokens[i].partner, ","):
                        if begin < end:
                            self.item(begin, end)
            i = self.after(i)

    def item(self, first, last):
        if self.tokens[first].text == "." and self.tokens[first + 2].text == "=":
            first += 3
        if first < last:
            self.expression(first, last)

    def lambda_(self, i, last):
        i = self.after(i)
        while i < last and self.tokens[i].text != "{":
            i = self.after(i)
        if i < last:
            self.block(i + 1, self.tokens[i].partner)
            return self.tokens[i].partner + 1
        return i

    def expression(self, first, last, kind="expression", semicolon=None):
        tokens = self.tokens
        end = tokens[semicolon].end if semicolon is not None else tokens[last - 1].end
        region = Region(tokens[first].start, end, kind)
        if not any(region.start < at < region.end for at in self.directives):
            self.regions.append(region)
        self.groups(first, last)
        if tokens[first].text in ("{", "["):  # {a, b} cannot be chosen by ?:
            return region
        if kind == "statement" and semicolon is not None:
            whole = (region.start, region.end)
            self.add(region, "statement", [(*whole, ";")], whole, self.clean[slice(*whole)], "")
        i = first
        ternary = first  # where the condition of the next ?: begins
        while i < last:
            if tokens[i].text == "[" and not (i > 0 and self.is_operand_end(i - 1)):
                i = self.after(i)
                while i < last and tokens[i].text != "{":
                    i = self.after(i)
            elif tokens[i].text == "?":
                whole = (tokens[ternary].start, tokens[i - 1].end)
                old = self.clean[slice(*whole)]
                edit = [(*whole, f"!({old})")]
                self.add(region, "negated", edit, whole, old, f"!({old})")
                ternary = i + 1
            elif tokens[i].text in (":", "="):
                ternary = i + 1
            else:
                if tokens[i].text in ("+=", "-=", "*=", "/=", "|=", "&="):
                    ternary = i + 1
                self.token(region, i, first, last)
            i = self.after(i)
        return region

    def edit(self, region, operator, start, end, new):
        self.add(region, operator, [(start, end, new)], (start, end), None, None)

    def add(self, region, operator, edits, where, before, after):
        line = self.text.count("\n", 0, where[0]) + 1
        if before is None:
            begin = self.clean.rfind("\n", 0, where[0]) + 1
            stop = self.clean.find("\n", where[1])
            start, end, new = edits[0]
            before = self.clean[begin:stop]
            after = self.clean[begin:start] + new + self.clean[end:stop]
        region.mutants.append(
            Mutant(operator, line, edits, " ".join(before.split()), " ".join(after.split()))
        )

    def token(self, region, i, first, last):
        tokens = self.tokens
        token = tokens[i]
        if token.kind == "number":
            if not (i > 0 and tokens[i - 1].text == "."):
                # How many units of roundoff a bound allows is a choice; none is an error.
                for new in [] if self.is_bound(region) else other_numbers(token.text):
                    self.edit(region, "constant", token.start, token.end, new)
        elif token.text in ("true", "false"):
            new = "false" if token.text == "true" else "true"
            self.edit(region, "constant", token.start, token.end, new)
        elif token.kind == "word":
            before = tokens[i - 1].text if i > first else ""
            if token.text in AXES and before == "." and not self.calls(i, last):
                self.edit(region, "axis", token.start, token.end, AXES[token.text])
            if self.calls(i, last):
                self.call(region, i, first, last)
        elif token.kind == "sign" and token.partner < 0:
            if token.text in ("-", "!") and not self.is_binary(i):
                if i + 1 < last and self.text[token.end].strip():
                    name = "sign" if token.text == "-" else "negated"
                    self.edit(region, name, token.start, token.end, " ")
            elif token.text in FLIPPED and self.is_binary(i):
                name = {"<": "comparison", ">": "comparison", "=": "comparison",
                        "!": "comparison", "&": "logic", "|": "logic"}.get(
                            token.text[0], "arithmetic")  # fmt: skip
                for new in FLIPPED[token.text]:
                    exact = new == token.text + "=" or token.text == new + "="
                    which = "boundary" if exact and name == "comparison" else name
                    self.edit(region, which, token.start, token.end, new)
                if token.text in ("*", "/"):
                    self.factors(region, i, first, last)

    def is_bound(self, region):
        """Whether a number says how many units of roundoff are allowed."""
        around = slice(max(0, region.start - 50), region.end + 50)
        near = self.clean[around].replace("\n", " ")
        return (
            re.search(r"epsilon|rounding_bound", self.clean[region.start : region.end])
            or re.search(r"rounding_bound<\w+>\($", self.clean[: region.start][-40:])
            or re.search(r"\) \* +(std::numeric_limits<\w+>|Limits)::epsilon", near)
        )

    def calls(self, i, last):
        """Whether a word is the name of a function that is called."""
        if self.tokens[i].text in ("requires", "sizeof", "decltype", "alignof"):
            return False
        j = i + 1
        if j < last and tokens_text(self.tokens, j) == "<" and self.opens(j):
            j = self.after(j)
        return j < last and tokens_text(self.tokens, j) == "(" and self.opens(j)

    def call(self, region, i, first, last):
        tokens = self.tokens
        open_ = i + 1 if tokens[i + 1].text == "(" else self.after(i + 1)
        close = tokens[open_].partner
        parts = self.pieces(open_ + 1, close, ",")
        if parts[-1][0] >= parts[-1][1]:
            return
        spans = [(tokens[a].start, tokens[b - 1].end) for a, b in parts]
        texts = [self.clean[slice(*span)] for span in spans]
        name = tokens[i].text
        for k in range(len(spans) - 1) if len(spans) < 4 else []:
            a, b = spans[k], spans[k + 1]
            if name in COMMUTES or texts[k] == texts[k + 1] or len(texts[k]) > 60:
                continue
            if any(text.lstrip().startswith("[") for text in texts):
                continue
            edits = [(*a, texts[k + 1]), (*b, texts[k])]
            whole = (tokens[i].start, tokens[close].end)
            old = self.clean[slice(*whole)]
            self.add(region, "arguments", edits, whole, old, edited(old, whole[0], edits))
        if DROPPED_CALLS.get(name) == len(spans):
            start = tokens[i].start
            j = i
            while j > first and tokens[j - 1].text == "::":
                j -= 2
                start = tokens[j].start
            if j > 0 and tokens[j - 1].text in (".", "->"):
                return
            for text in texts[:2] if name in ("min", "max") else texts[:1]:
                self.edit(region, "call", start, tokens[close].end, f"({text})")

    def factors(self, region, i, first, last):
        tokens = self.tokens
        right = self.primary(i + 1, last)
        if right > i + 1:
            start = tokens[i].start
            self.edit(region, "factor", start, tokens[right - 1].end, "")
        left = self.primary_before(i, first)
        begins = left == first or tokens[left - 1].text not in ("*", "/", "%")
        if tokens[i].text == "*" and left < i and begins:
            self.edit(region, "factor", tokens[left].start, tokens[i].end, "")

    def primary(self, i, last):
        """One past the end of the operand that begins here."""
        tokens = self.tokens
        while i < last and tokens[i].text in ("-", "!", "+", "*", "&", "~"):
            i += 1
        if i >= last:
            return i
        i = self.after(i)
        while i < last:
            text = tokens[i].text
            if text in (".", "->", "::"):
                i += 2
            elif self.opens(i) and (text in "([<" or tokens[i].start == tokens[i - 1].end):
                i = self.after(i)
            else:
                break
        return min(i, last)

    def primary_before(self, i, first):
        tokens = self.tokens
        j = i - 1
        while j >= first:
            token = tokens[j]
            if 0 <= token.partner < j:
                j = token.partner
                before = tokens[j - 1] if j > first else None
                if before is not None and before.end == tokens[j].start and (
                    before.kind == "word" or before.text in (")", "]", ">", "}")
                ) and before.text not in KEYWORDS:
                    j -= 1
                    continue
            if j > first and tokens[j - 1].text in (".", "->", "::"):
                j -= 2
                continue
            break
        if j > first and tokens[j - 1].text in ("-", "*", "!") and not self.is_binary(j - 1):
            j -= 1
        return max(j, first)

    def constants(self):
        """The constants of the namespace: inline constexpr T name = a number or two."""
        for i, token in enumerate(self.tokens):
            if token.text != "inline" or self.tokens[i + 1].text != "constexpr":
                continue
            j = i + 2
            while j < len(self.tokens) and self.tokens[j].text not in ("=", ";", "{", "("):
                j = self.after(j)
            end = self.end_of_statement(i, len(self.tokens))
            if j < len(self.tokens) and self.tokens[j].text == "=" and end - j < 12:
                if self.tokens[j + 1].text not in ("{", "[", "true", "false"):
                    region = self.expression(j + 1, end)
                    word = self.tokens[i + 1]
                    region.name = self.tokens[j - 1].text
                    region.constant = (word.start, word.end)


def tokens_text(tokens, i):
    return tokens[i].text


def other_numbers(text):
    """What a number is changed to: another one of its type."""
    match = re.fullmatch(r"(0x[\da-fA-F']+|[\d'.]+(?:[eE][+-]?\d+)?)(\w*)", text)
    if not match:
        return []
    digits, suffix = match[1].replace("'", ""), match[2]
    if digits.startswith("0x"):
        return [hex(int(digits, 16) + 1) + suffix]
    if "." not in digits and "e" not in digits.lower():
        value = int(digits)
        return [f"{value + 1}{suffix}"] + ([f"{value - 1}{suffix}"] if value > 1 else [])
    value = float(digits)
    if value == 0:
        return [f"1.0{suffix}"]
    if value == 1:
        return [f"1.1{suffix}"]
    if value < 1e-2:  # a tolerance
        return [f"0.0{suffix}", f"{value * 1000!r}{suffix}"]
    return [f"{value * 1.1!r}{suffix}"]


def edited(text, start, edits):
    for first, last, new in sorted(edits, reverse=True):
        text = text[: first - start] + new + text[last - start :]
    return text


def find(text):
    """The regions of a header, in the order in which they begin; outer ones first."""
    reader = Reader(text)
    starts = {token.start: i for i, token in enumerate(reader.tokens)}
    for begin, _ in function_bodies(text):
        i = starts.get(begin)
        if i is not None and reader.opens(i):
            before = len(reader.regions)
            reader.block(i + 1, reader.tokens[i].partner)
            head = re.split("[;}]", reader.clean[:begin])[-1]
            for region in reader.regions[before:]:
                region.constexpr = "constexpr" in head
    reader.constants()
    regions = [region for region in reader.regions if region.mutants]
    for region in regions:
        seen = set()
        kept = []
        for mutant in region.mutants:
            key = edited(reader.clean[region.start : region.end], region.start, mutant.edits)
            key = re.sub(r"\s+", "", key)
            if key not in seen and key != re.sub(
                r"\s+", "", reader.clean[region.start : region.end]
            ):
                seen.add(key)
                kept.append(mutant)
        region.mutants = kept
    regions.sort(key=lambda region: (region.start, -region.end))
    return reader, [region for region in regions if region.mutants]


class Writer:
    """Writes a header with its mutants, and notes on which lines they stand."""

    def __init__(self, reader, regions):
        self.reader = reader
        self.regions = [r for r in regions if any(m.number for m in r.mutants)]
        self.out = []
        self.line = 1
        self.lines = {}  # a line: the mutants that stand there alone
        self.spans = []  # (first line, last line, region)
        self.text = reader.text
        for region in self.regions:
            if region.constant:
                a, b = region.constant
                self.text = self.text[:a] + "const    ".ljust(b - a) + self.text[b:]

    def put(self, text):
        self.out.append(text)
        self.line += text.count("\n")

    def write(self):
        self.put('#include "ljus_mutants.hpp"\n')
        self.range(0, len(self.text), self.regions)
        return "".join(self.out)

    def range(self, start, end, regions):
        at = start
        i = 0
        while i < len(regions):
            region = regions[i]
            inner = []
            while i + 1 < len(regions) and regions[i + 1].start < region.end:
                inner.append(regions[i + 1])
                i += 1
            i += 1
            self.put(self.text[at : region.start])
            self.region(region, inner)
            at = region.end
        self.put(self.text[at:end])

    def region(self, region, inner):
        first = self.line
        clean = self.reader.clean[region.start : region.end]
        statement = region.kind == "statement"
        on = "::ljus_mutants::chosen_at_run_time" if region.constant else "::ljus_mutants::on"
        self.put("{\n" if statement else "(\n")
        for mutant in region.mutants:
            if not mutant.number:
                continue
            self.lines[self.line] = mutant
            new = " ".join(edited(clean, region.start, mutant.edits).split("\n"))
            if statement:
                self.put(f"if ({on}({mutant.number})) {{ {new} }} else\n")
            elif region.kind == "condition":
                self.put(f"{on}({mutant.number}) ? static_cast<bool>({new}) :\n")
            else:
                self.put(f"{on}({mutant.number}) ? ({new}) :\n")
        if region.kind == "condition":
            self.put("static_cast<bool>")
        self.put("{ " if statement else "(")
        self.range(region.start, region.end, inner)
        self.put("}\n}" if statement else "))")
        self.spans.append((first, self.line, region))


SWITCH = """\
#pragma once

#include <cstdio>
#include <cstdlib>
#include <type_traits>

namespace ljus_mutants {

inline constexpr int count = COUNT;
inline unsigned char seen[count + 1] = {};

inline int number() noexcept {
    const char* const text = std::getenv("LJUS_MUTANT");
    return text == nullptr ? 0 : std::atoi(text);
}
inline const int chosen = number();

inline bool chosen_at_run_time(int mutant) noexcept {
    if (chosen < 0) seen[mutant] = 1;
    return chosen == mutant;
}

/// Whether this mutant is on; never while the program is compiled...
constexpr bool on(int mutant) noexcept {
#ifdef LJUS_MUTANT // ... but for the one that this program is compiled for
    return mutant == LJUS_MUTANT;
#else
    return !std::is_constant_evaluated() && chosen_at_run_time(mutant);
#endif
}

/// With LJUS_MUTANT=-1 none is on, and LJUS_MUTANTS_SEEN is the file that lists those that
/// would have been asked.
struct List {
    ~List() {
        const char* const name = std::getenv("LJUS_MUTANTS_SEEN");
        if (chosen >= 0 || name == nullptr) return;
        std::FILE* const file = std::fopen(name, "w");
        if (file == nullptr) return;
        for (int i = 1; i <= count; ++i)
            if (seen[i]) std::fprintf(file, "%d\\n", i);
        std::fclose(file);
    }
};
inline const List list;

} // namespace ljus_mutants
"""
