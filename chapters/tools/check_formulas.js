// Typesets every formula of the pages with the MathJax that the pages use.
// Usage: node check_formulas.js MATHJAX HTML
"use strict";
const fs = require("fs");
const path = require("path");
const [mathjax, html] = process.argv.slice(2);

// \( ... \) and \[ ... \] as Doxygen writes them, outside of scripts and code.
function formulas(text) {
    const plain = text.replace(/<script[\s\S]*?<\/script>/g, "")
        .replace(/<(pre|div class="(line|fragment)")[\s\S]*?<\/(pre|div)>/g, "");
    return Array.from(plain.matchAll(/\\\(([\s\S]*?)\\\)|\\\[([\s\S]*?)\\\]/g))
        .map(match => (match[1] ?? match[2]).replace(/&lt;/g, "<").replace(/&gt;/g, ">")
            .replace(/&amp;/g, "&").replace(/&#39;/g, "'").replace(/&quot;/g, '"'));
}

require(path.resolve(mathjax, "es5/node-main.js")).init({
    loader: { load: ["input/tex-full", "output/svg"] },
    tex: { packages: { "[-]": ["noundefined"] },
           formatError: (jax, error) => { throw error; } },
}).then(MathJax => {
    let count = 0, bad = 0;
    for (const file of fs.readdirSync(html).filter(name => name.endsWith(".html"))) {
        for (const tex of formulas(fs.readFileSync(path.join(html, file), "utf8"))) {
            ++count;
            try {
                MathJax.tex2svg(tex);
            } catch (error) {
                ++bad;
                console.error(`${file}: ${error.message}: ${tex}`);
            }
        }
    }
    console.log(`Formulas: ${count} typeset, ${bad} in error.`);
    process.exit(bad === 0 && count > 0 ? 0 : 1);
}).catch(error => { console.error(error); process.exit(1); });
