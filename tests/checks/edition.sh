#!/usr/bin/env bash
# Checks what makes the editions of the book, on a small site: the zip leads nowhere else, slides
# have what their chapters have, the solutions are those that are tested; and flaws are found.
. "$(dirname "$0")/common.sh"
command -v python3 >/dev/null 2>&1 || skip "python3 is not installed"
tools=$LJUS_ROOT/chapters/tools
folder=$scratch/edition
mkdir -p "$folder/html" "$folder/out"
cd "$folder"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# A site with every page that the contents name.
page() { # LABEL TITLE TEXT
    cat >"html/$1.html" <<END
<html><head><title>Ljus: $2</title></head><body><div class="header"><div class="title">$2</div></div>
<div class="contents"><div class="textblock">$3</div></div><!-- contents -->
</body></html>
END
}
for label in $(grep -ho '\\subpage \w*' "$LJUS_ROOT"/chapters/*.md | cut -d' ' -f2 | sort -u) \
    ch_contents ch_report_items errata exercise predict citelist readme index modules; do
    page "$label" "The page $label" '<p >It <a href="ch_contents.html">begins</a>.</p>'
done
# shellcheck disable=SC2016
page ch_ray '5 · Ray' '<p >A ray <a href="ray_8hpp.html">is</a> a
<a href="ray_8hpp_source.html">line</a>.</p>
<dl class="predict" id="p"><dt>Predict:</dt><dd>How long is it?</dd></dl>
<details><summary>Folded</summary><svg class="ljus-plot"></svg></details>
<h1><a class="anchor"></a>The length</h1>
<svg class="ljus-plot"><path d="M0 0"/></svg> <div class="ljus-caption">A drawing.</div>
<p >Then the answer to the prediction is: endless.</p>
<div class="ljus-compare" data-labels="short|long"><div class="image"><img src="a.png" alt="a"/></div>
<div class="image"><img src="b.png" alt="b"/></div></div>
<dl class="exercise" id="e"><dt>Exercise 5.1</dt><dd>How many?</dd></dl>
<p ><details class="ljus-answer">
<summary>Answer</summary> Two.</details></p>'
page index 'Ljus' '<p >The <a href="modules.html">library</a>.</p>'
page ray_8hpp 'ray.hpp' '<p >See <a href="class_none.html">a class</a>.</p>'
page ray_8hpp_source 'Source' ''
echo 'var ljusNames = [
["Ray", "ray_8hpp.html#r", "struct"],
["Other", "other.html", "struct"],
];' >html/search-names.js
touch html/search-text.js html/doxygen.svg html/a.png html/b.png

python3 "$tools/slides" html >/dev/null || wrong "no slides"
python3 - <<'END' >slides.txt
import re
text = open("html/slides_week_01.html", encoding="utf-8").read()
ray = text[text.index('<h2>5 · Ray</h2>'):]
ray = ray[:ray.index('class="chapter"', 20)]
for part in ray.split("<section")[:7]:
    print(re.sub(r"\s+", " ", re.sub(r"<[^>]*>", " ", part.split(">", 1)[1])).strip())
END
diff - slides.txt <<'END' || wrong "slides have something else"
5 · Ray A ray is a line .
Predict How long is it?
The length A drawing.
Answer: The length Then the answer to the prediction is: endless.
The length short long
Exercise 5.1 How many?
Exercise 5.1: answer Two.
END

edition() { python3 "$tools/edition" html out zip "$@" >out.txt 2>err.txt; }
edition || wrong "no zip: $(cat err.txt)"
rm -rf taken && mkdir taken && (cd taken && python3 -m zipfile -e ../out/ljus-book.zip .)
[ -f taken/ljus-book/ray_8hpp.html ] || wrong "the zip lacks a page of the reference that a chapter links to"
[ ! -e taken/ljus-book/ray_8hpp_source.html ] || wrong "the zip has a source listing"
grep -q '<span>a class</span>' taken/ljus-book/ray_8hpp.html || wrong "a link leads out of the zip"
grep -q Other taken/ljus-book/search-names.js && wrong "the search leads out of the zip"
grep -q slides_week_12 <<<"$(ls taken/ljus-book)" || wrong "the zip has no slides"
# A zip without one of its pages is refused.
rm taken/ljus-book/ray_8hpp.html
(cd taken && python3 -m zipfile -c ../out/ljus-book.zip ljus-book)
edition --check && wrong "a dead link in the zip is let through"
grep -q 'ch_ray.html: dead link to ray_8hpp.html' err.txt || wrong "$(cat err.txt)"

# So is an EPUB that is none.
mkdir -p book && echo '<html><p>\(x\)</html>' >book/ch_ray.xhtml
python3 -m zipfile -c out/ljus-short.epub book
python3 "$tools/edition" html out epub --check >out.txt 2>err.txt && wrong "no EPUB is let through"
for flaw in 'not an uncompressed mimetype' 'ch_ray.xhtml is not well-formed' 'ch_caustics is missing'; do
    grep -q "$flaw" err.txt || wrong "$flaw: $(cat err.txt)"
done

# The solutions, under the names of the assignments, apart from the book.
mkdir copy && cp -R "$LJUS_ROOT/scripts" "$LJUS_ROOT/LICENSE" copy
mkdir -p copy/examples copy/tests/assignments
cp -R "$LJUS_ROOT/examples/assignments" copy/examples
cp -R "$LJUS_ROOT/tests/assignments/solutions" copy/tests/assignments
copy/scripts/book --solutions >out.txt 2>&1 || wrong "$(cat out.txt)"
python3 -m zipfile -e copy/build/edition/ljus-solutions.zip .
for answer in "$LJUS_ROOT"/tests/assignments/solutions/?.hpp; do
    number=$(basename "$answer" .hpp)
    cmp "$answer" ljus-solutions/"${number}"_*/answer.hpp || wrong "no solution of assignment $number"
done

[ $wrong -eq 0 ] && echo "the editions are made and checked as they should be"
exit $wrong
