// Ljus: searches the words of the book and the names of the library, without a server. The
// two lists, search-text.js and search-names.js, are made by tools/finish and loaded when
// the field is first used.
"use strict";

(function () {
    let loading = null;

    function load(file) {
        return new Promise(resolve => {
            const script = document.createElement("script");
            script.src = file;
            script.onload = script.onerror = resolve;
            document.head.appendChild(script);
        });
    }

    function lists() {
        loading = loading || Promise.all([load("search-text.js"), load("search-names.js")]);
        return loading;
    }

    function escaped(text) {
        return text.replace(/&/g, "&amp;").replace(/</g, "&lt;").replace(/"/g, "&quot;");
    }

    // A pattern for a word: at the beginning of one, if it is of letters.
    function pattern(word) {
        const plain = word.replace(/[.*+?^${}()|[\]\\]/g, "\\$&");
        return new RegExp((/^[a-z]/i.test(word) ? "\\b" : "") + plain, "gi");
    }

    // Sections that hold every word; those that have it in the title come first.
    function findText(words) {
        const found = [];
        (window.ljusText || []).forEach((section, order) => {
            let score = 0;
            for (const word of words) {
                const wanted = pattern(word);
                const inTitle = (section[1].match(wanted) || []).length;
                const inText = (section[2].match(wanted) || []).length;
                if (inTitle + inText === 0) return;
                score += 20 * inTitle + Math.min(inText, 10);
            }
            if (!/^(ch_|index)/.test(section[0])) score /= 10; // lists come last
            found.push({ section, score, order });
        });
        found.sort((a, b) => b.score - a.score || a.order - b.order);
        return found.slice(0, 12).map(hit => hit.section);
    }

    function findNames(text) {
        const wanted = text.toLowerCase().replace(/^ljus::/, "");
        const found = [];
        for (const name of window.ljusNames || []) {
            const at = name[0].toLowerCase().indexOf(wanted);
            if (at >= 0) found.push({ name, score: at + name[0].length / 100 });
        }
        found.sort((a, b) => a.score - b.score);
        return found.slice(0, 8).map(hit => hit.name);
    }

    // The words of a section around the first that was looked for.
    function excerpt(text, words) {
        const at = Math.max(0, text.search(pattern(words[0])));
        const from = at < 60 ? 0 : text.indexOf(" ", at - 60) + 1;
        let part = escaped((from ? "… " : "") + text.slice(from, from + 180) + " …");
        for (const word of words)
            if (word.length > 1) part = part.replace(pattern(escaped(word)), "<mark>$&</mark>");
        return part;
    }

    document.addEventListener("DOMContentLoaded", () => {
        const field = document.getElementById("ljus-search-field");
        const results = document.getElementById("ljus-search-results");
        if (!field || !results) return;
        document.body.appendChild(results); // above the pages, not within the side bar
        let chosen = -1;

        function close() {
            results.hidden = true;
            field.setAttribute("aria-expanded", "false");
            field.removeAttribute("aria-activedescendant");
            chosen = -1;
        }

        function choose(at) {
            const links = results.querySelectorAll("a");
            if (!links.length) return;
            chosen = (at + links.length) % links.length;
            links.forEach((link, i) => link.setAttribute("aria-selected", i === chosen));
            links[chosen].scrollIntoView({ block: "nearest" });
            field.setAttribute("aria-activedescendant", links[chosen].id);
        }

        function show() {
            const text = field.value.trim();
            if (text.length < 2) return close();
            const words = text.split(/\s+/);
            const row = (address, title, below) =>
                `<a role="option" tabindex="-1" href="${escaped(address)}">` +
                `<b>${escaped(title)}</b>${below}</a>`;
            const sections = findText(words);
            const names = words.length === 1 ? findNames(text) : [];
            const textRows = sections.map(section =>
                row(section[0], section[1], `<span>${excerpt(section[2], words)}</span>`)).join("");
            const nameRows = !names.length ? "" :
                '<div class="ljus-search-kind">The library</div>' + names.map(name =>
                    row(name[1], name[0], ` <i>${escaped(name[2])}</i>`)).join("");
            // Who types a whole name of the library looks for it there.
            const exact = names.length && names[0][0].toLowerCase() === text.toLowerCase();
            results.innerHTML = (exact ? nameRows + '<div class="ljus-search-kind">The book</div>' + textRows
                : textRows + nameRows) || `<p>Nothing is found for “${escaped(text)}”.</p>`;
            results.querySelectorAll("a").forEach((link, i) => { link.id = "ljus-found-" + i; });
            results.hidden = false;
            field.setAttribute("aria-expanded", "true");
            chosen = -1;
        }

        field.addEventListener("focus", lists);
        field.addEventListener("input", () => lists().then(show));
        field.addEventListener("keydown", event => {
            if (event.key === "Escape") { close(); return; }
            if (event.key === "ArrowDown" || event.key === "ArrowUp") {
                event.preventDefault();
                if (results.hidden) lists().then(show);
                else choose(chosen + (event.key === "ArrowDown" ? 1 : chosen < 0 ? 0 : -1));
            }
            if (event.key === "Enter") {
                const link = results.querySelectorAll("a")[Math.max(chosen, 0)];
                if (!results.hidden && link) { close(); window.location.href = link.href; }
            }
        });
        document.addEventListener("keydown", event => {
            const typing = /^(INPUT|TEXTAREA|SELECT)$/.test(event.target.tagName);
            if (event.key === "/" && !typing && !event.ctrlKey && !event.metaKey) {
                event.preventDefault();
                field.focus();
            }
        });
        document.addEventListener("click", event => {
            if (!results.contains(event.target) && event.target !== field) close();
        });
    });
})();
