#!/usr/bin/env bash
# Checks the tools that make and check the book's pages: numbers of chapters in titles and
# references, the index of the report, and a page with every flaw, all of which are found.
. "$(dirname "$0")/common.sh"
command -v perl >/dev/null 2>&1 || skip "perl is not installed"
command -v python3 >/dev/null 2>&1 || skip "python3 is not installed"
tools=$LJUS_ROOT/chapters/tools
folder=$scratch/book_pages
rm -rf "$folder"
mkdir -p "$folder/html"
cd "$folder"
wrong=0
wrong() { echo "WRONG: $*"; wrong=1; }

# A page, as the filter passes it to Doxygen.
cat >page.md <<'END'
# Sphere {#ch_sphere}
See \ref ch_bvh, chapter \ref ch_bvh "99" and \ref ch_sphere_trade "the trade".
<p class="ljus-caption">A caption.</p>
END
cat >right.md <<'END'
# 6 · Sphere {#ch_sphere}
See \ref ch_bvh "Bounding volumes", chapter \ref ch_bvh "8" and \ref ch_sphere_trade "the trade".
<div class="ljus-caption">A caption.</div>
END
perl "$tools/page" page.md | diff - right.md || wrong "a page is read otherwise"
perl "$tools/page" "$LJUS_ROOT/chapters/contents.md" >contents.md || wrong "no contents"
[ "$(grep -c '^\\page part_' contents.md)" -eq 7 ] || wrong "the book has not seven parts"
grep -q '^| Figure 11 .*ch_caustics.*fig-11' contents.md || wrong "figure 11 is in no index"

# Changes to Doxygen's pages.
cat >html/ch_sphere.html <<'END'
<html><head><title>Sphere</title><script src="https://polyfill.io/x.js"></script></head><body>
<div><div class="header"><div class="headertitle"><div class="title">6 · Sphere</div></div></div>
<div class="contents"><div class="textblock"><h1><a class="anchor" id="here"></a>The trade</h1>
<div class="image"><img src="a.png" alt=""/>
<div class="caption">Two balls.</div></div>
<div class="image">
<object type="image/svg+xml" data="plot.svg" style="pointer-events: none;"></object>
<div class="caption">
Error against time</div></div>
<div class="fragment"><div class="line"><a id="l00009" name="l00009"></a><span class="lineno">    9</span> </div>
<div class="line">std::<span class="keywordtype">float</span>ing_po<span class="keywordtype">int</span> <a class="code hl_function" href="q.html#x">normal</a>;</div></div><!-- fragment -->
<dl class="exercise"><dt><b><a class="el" href="exercise.html#_exercise000009">Exercise:</a></b></dt><dd>One by importance, \(k\) of \(\frac{a}{b}\).</dd></dl>
<svg class="ljus-plot" viewBox="0 0 9 9"><g id="gnuplot_canvas"></g></svg>
<div class="ljus-caption">Noise against time</div>
<h3>&lt;tt&gt;eon&lt;/tt&gt;</h3>
<p ><details>
<summary>More</summary> One.</details>
</p>
<p ><details>
Two.</details>
</p>
<table class="markdownTable"><tr><td>2.8e+02</td><td>1.5e+00</td><td>-1.01e+04</td><td>5.4e-05</td><td>1e+06 times</td><td class="markdownTableBodyNone"><code>ljus/<a href="x_y.html">x_y.hpp</a></code></td></tr></table>
</div></div><!-- contents -->
</body></html>
END
sed 's/Sphere/Ray/; s/_exercise000009/_exercise000001/' html/ch_sphere.html >html/ch_ray.html
echo '<tagfile></tagfile>' >tags
perl "$tools/finish" "$folder/html" tags >/dev/null || wrong "the pages are not finished"
page=html/ch_sphere.html
grep -q '<body class="ljus-page">' $page || wrong "a page of the book has no class"
grep -q 'polyfill' $page && wrong "a script comes from the network"
grep -q 'alt="Two balls."' $page || wrong "a picture has no alt text"
grep -q '<img src="plot.svg" alt="Error against time"/>' $page || wrong "a plot stands in a frame"
grep -q 'table-frame"><svg role="img" aria-label="Noise against time" class="ljus-plot"' $page ||
    wrong "a plot of gnuplot does not scroll, or is not said"
grep -q '"fragment"><div class="line">std::floating_point normal;' $page || wrong "a listing has wrong links or colours"
grep -q '<h3><code>eon</code></h3>' $page || wrong "a heading shows the marks of code"
grep -q '<td>280</td><td>1.5</td><td>-10100</td><td>5.4e-05</td><td>1e+06 times</td>' $page ||
    wrong "a cell is not written out: $(grep '<td>' $page)"
grep -q '<code>ljus/<a href="x_y.html">x_<wbr/>y.hpp</a></code>' $page || wrong "code in a cell cannot break"
grep -qF '<span class="ljus-whole">\(\frac{a}{b}\).</span></dd>' $page || wrong "a full stop leaves its formula"
[ "$(grep -c '<details>' $page)" -eq 1 ] || wrong "a fold of two paragraphs is two folds"
grep -q 'id="_exercise000009".*Exercise 6.1' $page || wrong "an exercise has no number"
[ "$(grep -c 'rel="prev" href="ch_ray.html"' $page)" -eq 2 ] || wrong "no chapter before"
grep -q 'One by importance, k of …' html/search-text.js || wrong "the search does not know a word"

# A page with each flaw that needs no browser.
flaw() {
    rm -f html/*.html html/*.js
    echo "<html><body><div class=\"contents\"><p id=\"here\">$2</p></div></body></html>" >html/index.html
    local code=0
    python3 "$tools/check_pages" html --static >out.txt 2>err.txt || code=$?
    if [ -z "$1" ]; then
        [ $code -eq 0 ] || wrong "$2: $(cat err.txt)"
    elif [ $code -ne 1 ] || ! grep -qF -- "$1" err.txt; then
        wrong "$2: $code, $(cat err.txt)"
    fi
}
flaw '' '<a href="#here">here</a>'
flaw 'dead link to none.html' '<a href="none.html">there</a>'
flaw 'has no place there' '<a href="#there">there</a>'
flaw 'no alt text' '<img src="index.html" alt=""/>'
flaw 'comes from the network' '<script src="https://example.org/x.js"></script>'

# Wrong wordings are found.
mkdir -p chapters
cp "$LJUS_ROOT/chapters/words.txt" chapters
echo 'It casts 16 rays a pixel.' >chapters/01-page.md
rm -f html/*.html
python3 "$tools/check_words" chapters html >out.txt 2>err.txt && wrong "a wording is let through"
grep -q "01-page.md:1: 'rays a pixel': write \"per pixel\"" err.txt || wrong "$(cat err.txt)"

# What is made for a page is shown on one.
mkdir -p shown/{chapters/kept/01,include,examples,tests,benchmarks}
cd shown
printf '%s\n' '\number{table, 1, 2} \htmlinclude plot.svg' '\snippet{lineno} a.hpp shown' \
    >chapters/01-page.md
touch README.md chapters/kept/01/{table.csv,plot.gp,plot.csv}
echo 'Table t{.name = "table"}; Plot p{.name = "of-" + name}; path("plot.png");' \
    >examples/01_page.cpp
printf '// [%s]\n' shown shown >include/a.hpp
"$tools/check_shown" . >../out.txt 2>../err.txt || wrong "what is shown is refused: $(cat ../err.txt)"
mkdir -p chapters/measured
touch chapters/kept/01/lost.csv chapters/measured/idle.csv
echo 'Drawing d{.name = "drawn"}; path("picture.png");' >>examples/01_page.cpp
printf '// [%s]\n' once unshown unshown >>include/a.hpp
"$tools/check_shown" . >../out.txt 2>../err.txt && wrong "what no page shows is let through"
for name in 'no page shows lost' 'no page shows drawn' 'no page shows picture' 'quotes measured/idle' \
    '\[once\] stands' 'shows \[unshown\]'; do
    grep -q "$name" ../err.txt || wrong "not said: $name"
done
[ "$(wc -l <../err.txt)" -eq 7 ] || wrong "$(cat ../err.txt)"
cd ..

# The table of the README is that of the book.
cell() { awk -F, -v r="$1" -v m="$2" -v c="$3" '$1 == r && $2 == m { print $c }' \
    "$LJUS_ROOT/chapters/measured/two_pass-trade-table.csv"; }
for rays in 4 16 64 256; do
    row="| $rays"
    for method in 'photon mapping' 'path tracing'; do
        row="$row | $(cell $rays "$method" 3) s | $(cell $rays "$method" 4)"
    done
    grep -qF -- "$row |" "$LJUS_ROOT/README.md" || wrong "README.md should have the row $row |"
done

# So is its plot, which changes if a number changes.
perl "$tools/pareto" --check || wrong "the plot of the README is an old one"
mkdir -p old/tools old/measured old/pictures
cp "$tools/pareto" "$tools/contents.pm" old/tools
cp "$LJUS_ROOT"/chapters/measured/trades-front-*.csv old/measured
perl old/tools/pareto
cmp old/pictures/pareto.svg "$LJUS_ROOT/chapters/pictures/pareto.svg" || wrong "the plot is another"
sed -i 's/^0\.0[0-9]*,/0.5,/' old/measured/trades-front-report.csv
perl old/tools/pareto --check 2>err.txt && wrong "an old plot of the README is let through"
grep -q "is not of today's numbers" err.txt || wrong "$(cat err.txt)"
[ "$(wc -c <"$LJUS_ROOT/chapters/pictures/pareto.svg")" -lt 100000 ] || wrong "the plot is too large"

# A plot says nothing of gnuplot, and is as high as its legend needs.
if command -v gnuplot >/dev/null 2>&1; then
    mkdir -p plots
    for n in 2 4; do
        {
            printf 'set terminal svg size 720,400\nset output "p%s.svg"\nset key outside top horizontal\n' $n
            printf 'plot for [i=1:%s] i*x title sprintf("a name that fills a row of the legend, %%d", i)\n' $n
        } >plots/p$n.gp
        touch plots/p$n.csv
    done
    "$LJUS_ROOT/scripts/plot" plots
    grep -q '<title>\|<desc>\|aria-label' plots/p2.svg && wrong "a plot says what gnuplot says"
    grep -q '<svg class="ljus-plot"' plots/p2.svg || wrong "a plot has no class"
    grep -q 'viewBox="0 0 720 400"' plots/p2.svg || wrong "a plot of two rows is higher"
    grep -q 'viewBox="0 0 720 434"' plots/p4.svg || wrong "a plot shrinks below its legend"
fi

[ $wrong -eq 0 ] && echo "the book's pages are made and checked as they should be"
exit $wrong
