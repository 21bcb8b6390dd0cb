// What tools/edition does in Chromium to a page that holds many pages of the book, each in a
// section whose id is the page's label.
"use strict";

const edition = (function () {
    const sections = Array.from(document.querySelectorAll("section.edition-page"));
    const labels = new Set(sections.map(section => section.id));

    function make(tag, name, ...content) {
        const result = document.createElement(tag);
        if (name) result.className = name;
        result.append(...content);
        return result;
    }

    function remove(root, selector) {
        for (const one of root.querySelectorAll(selector)) one.remove();
    }

    const unwrap = link => link.replaceWith(...link.childNodes);

    // The page and the place that a link leads to; nothing if it is not in this book.
    function target(link, from) {
        const [file, place] = link.getAttribute("href").split("#");
        const label = file ? file.replace(/\.html$/, "") : from;
        return labels.has(label) ? [label, place || ""] : null;
    }

    // Places by names that no two pages share, and links that lead to them.
    function link(section) {
        for (const one of section.querySelectorAll("[id]"))
            if (!one.closest("svg")) one.id = `${section.id}.${one.id}`;
        for (const one of section.querySelectorAll(".contents a[href]")) {
            const href = one.getAttribute("href");
            if (/^[a-z]+:/.test(href)) continue;
            const to = target(one, section.id);
            if (to) one.href = "#" + (to[1] ? `${to[0]}.${to[1]}` : to[0]);
            else unwrap(one);
        }
    }

    // The answers of a page are taken out of their folds: [exercise, its name, answer].
    function answers(section) {
        return Array.from(section.querySelectorAll("details.ljus-answer"), fold => {
            let exercise = fold.previousElementSibling;
            while (exercise && !exercise.matches("dl.exercise")) exercise = exercise.previousElementSibling;
            if (!exercise) throw new Error("an answer follows no exercise: " + fold.textContent.slice(0, 60));
            fold.querySelector("summary").remove();
            fold.remove();
            return [exercise, exercise.querySelector("dt").textContent.replace(/:\s*$/, ""), fold];
        });
    }

    // Two headings in a box, which Chromium never breaks if it could scroll; the number of a
    // work, which floats, in its text; and sources in the line of their heading, which would
    // often be alone on a page.
    function join() {
        for (const one of document.querySelectorAll(".textblock h1:has(+ p)"))
            if (one.textContent.trim() === "Sources") {
                one.classList.add("edition-sources");
                one.nextElementSibling.prepend(one);
            }
        for (const first of document.querySelectorAll(".textblock :is(h1, h2):has(+ :is(h2, h3))")) {
            const both = make("div", "edition-headings");
            first.before(both);
            both.append(first, first.nextElementSibling);
            both.style.height = both.offsetHeight + "px";
        }
        for (const number of document.querySelectorAll("dl.citelist dt")) {
            number.nextElementSibling.prepend(make("span", "edition-number", ...number.childNodes));
            number.remove();
        }
    }

    // Tables with a head that is repeated on each page, as wide as the paper at most.
    function fit() {
        for (const table of document.querySelectorAll(".contents table")) {
            const head = table.querySelector("tr");
            if (head && head.querySelector("th") && !table.querySelector("thead"))
                table.prepend(make("thead", "", head));
            const room = table.closest(".contents").clientWidth;
            const wide = () => table.getBoundingClientRect().width > room;
            for (let size = 8.2; wide() && size >= 6; size -= 0.4)
                table.style.setProperty("font-size", size + "pt", "important");
            if (wide()) { // its lines are broken
                table.classList.add("edition-wide");
                table.style.setProperty("font-size", "7pt", "important");
            }
        }
        for (const one of document.querySelectorAll("pre"))
            if (one.textContent.split("\n").length > 40) one.classList.add("edition-long");
        for (const one of document.querySelectorAll("details, .ljus-table-frame")) // over a third of a page
            if (one.offsetHeight > 360) one.classList.add("edition-tall");
    }

    const heading = (element, level) => {
        element.setAttribute("role", "heading");
        element.setAttribute("aria-level", level);
    };

    // What would be missing on paper: a picture, a formula, the still of a live figure.
    function flaws() {
        const found = Array.from(document.images).filter(one => !one.complete || !one.naturalWidth)
            .map(one => "no picture " + one.src);
        for (const one of document.querySelectorAll('[data-mml-node="merror"]'))
            found.push("a formula in error: " + one.textContent.slice(0, 60));
        for (const one of document.querySelectorAll(".ljus-live"))
            if (!one.querySelector("img, svg, table") && !one.closest("#index"))
                found.push("no still of the live figure " + one.dataset.live);
        return found;
    }

    // --- The PDF ------------------------------------------------------------------------

    function book(parts) {
        for (const fold of document.querySelectorAll("details")) fold.open = true;
        const index = document.getElementById("index");
        index.classList.add("ljus-title-page");
        for (let at = index.querySelector("h2"), next; at; at = next) { // the first page ends here
            next = at.nextSibling;
            at.remove();
        }
        const gathered = make("section", "ljus-page edition-page");
        gathered.id = "answers";
        const title = make("div", "title", "Answers");
        gathered.append(make("div", "header", make("div", "headertitle", title)));
        const block = gathered.appendChild(make("div", "contents"))
            .appendChild(make("div", "textblock"));
        for (const section of sections) {
            link(section);
            const found = answers(section);
            if (!found.length) continue;
            block.append(make("h2", "", section.dataset.title));
            for (const [exercise, name, fold] of found) {
                const number = make("b");
                const back = make("a", "", name);
                back.href = "#" + exercise.id;
                const answer = make("div", "edition-answer", make("b", "", back, ". "), ...fold.childNodes);
                answer.id = "answer." + exercise.id;
                number.dataset.of = answer.id;
                number.textContent = "000";
                const forth = make("a", "edition-to-answer", "Answer on page ", number);
                forth.href = "#" + answer.id;
                exercise.querySelector("dd").append(" ", forth);
                block.append(answer);
            }
        }
        document.body.append(gathered);
        parts = [...parts, ["Answers", []]];

        const list = make("section", "ljus-page edition-contents");
        list.id = "contents";
        list.append(make("h1", "", "Contents"));
        const style = make("style");
        const line = (name, id, text) => {
            const number = make("b", "", "000");
            number.dataset.of = id;
            const way = make("a", "", text);
            way.href = "#" + id;
            list.append(make("p", name, way, make("i"), number));
        };
        const head = (id, text, at) => {
            const said = JSON.stringify(text);
            style.append(`#${id} { page: p${at}; } @page p${at} { @top-left { content: ${said}; } }`);
        };
        let at = 0;
        for (const [name, chapters] of parts) {
            if (!chapters.length) {
                line("part", "answers", name);
                continue;
            }
            list.append(make("p", "part", name));
            chapters.forEach(([label, text], nth) => {
                const section = document.getElementById(label);
                line("chapter", label, text);
                const part = section.querySelector(".ljus-part");
                part.textContent = name;
                if (nth === 0) heading(part, 1);
                heading(section.querySelector(".title"), 2);
                head(label, text, ++at);
                for (const [tag, level] of [["h1", 3], ["h2", 4], ["h3", 5]])
                    for (const one of section.querySelectorAll(".textblock " + tag)) heading(one, level);
            });
        }
        heading(index.querySelector(".title"), 1);
        heading(title, 1);
        for (const one of gathered.querySelectorAll("h2")) heading(one, 2);
        head("answers", "Answers", ++at);
        document.head.append(style);
        index.after(list);
        join();
        fit();
    }

    function numbers(places) {
        for (const one of document.querySelectorAll("[data-of]")) one.textContent = places[one.dataset.of] || "?";
    }

    // --- The EPUB -----------------------------------------------------------------------

    const kept = new Set(["id", "class", "href", "src", "alt", "title", "colspan", "rowspan", "start"]);

    function code(fragment) {
        remove(fragment, ".lineno, .ttc");
        const lines = fragment.matches("pre") ? [fragment.textContent]
            : Array.from(fragment.querySelectorAll(".line"), line => line.textContent.trimEnd());
        fragment.replaceWith(make("pre", "", lines.join("\n")));
    }

    let drawings = 0;
    function drawing(svg) { // its names are its own
        const own = `d${++drawings}-`;
        const used = new Set();
        for (const one of [svg, ...svg.querySelectorAll("*")])
            for (const attribute of Array.from(one.attributes)) {
                if (/^(data-|aria-|focusable|class$|role$|jax)/.test(attribute.name) && one !== svg ||
                    /^(data-|focusable|jax)/.test(attribute.name)) {
                    one.removeAttributeNode(attribute);
                    continue;
                }
                const place = attribute.value.match(/^#(.+)$|url\(['"]?#([^)'"]+)/);
                if (place && attribute.name !== "fill" || place && /url/.test(attribute.value)) {
                    const name = place[1] || place[2];
                    if (!svg.querySelector(`[id="${CSS.escape(name)}"]`)) continue;
                    used.add(name);
                    attribute.value = attribute.value.replace("#" + name, "#" + own + name);
                }
            }
        for (const one of svg.querySelectorAll("[id]"))
            if (used.has(one.id)) one.id = own + one.id;
            else one.removeAttribute("id");
        svg.removeAttribute("id");
    }

    function short(order) {
        const places = new Map(sections.map(section => [ // a chapter that is done has left its section
            section.id, new Set(Array.from(section.querySelectorAll("[id]"), one => one.id))]));
        return order.map(label => {
            const section = document.getElementById(label);
            const body = make("div", "chapter", make("h1", "", section.dataset.title));
            const text = section.querySelector(".textblock");
            remove(text, "nav, .toc, .ttc, script, style, input, output, .ljus-live-only, .ljus-label, " +
                ".ljus-made, .anchorlink, .ljus-sweep-control, .ljus-sweep > .ljus-caption, .ljus-neighbours");
            for (const one of text.querySelectorAll("div.fragment, pre.fragment")) code(one);
            const found = answers(text);
            if (found.length) {
                text.append(make("h1", "", "Answers"));
                for (const [, name, fold] of found)
                    text.append(make("div", "answer", make("b", "", name + ". "), ...fold.childNodes));
            }
            for (const fold of text.querySelectorAll("details")) {
                const name = fold.querySelector("summary");
                fold.replaceWith(make("div", "fold", make("p", "summary", ...name.childNodes),
                    ...Array.from(fold.childNodes).filter(one => one !== name)));
            }
            for (const one of text.querySelectorAll("mjx-container")) {
                const svg = one.querySelector("svg");
                drawing(svg);
                one.replaceWith(make(one.getAttribute("display") ? "div" : "span",
                    one.getAttribute("display") ? "formula" : "math", svg));
            }
            for (const one of text.querySelectorAll("svg.ljus-plot")) drawing(one);
            for (const one of text.querySelectorAll("a[href]")) {
                const href = one.getAttribute("href");
                if (/^[a-z]+:/.test(href)) continue;
                const to = target(one, label);
                const there = to && (!to[1] || places.get(to[0]).has(to[1]));
                if (there) one.setAttribute("href", `${to[0]}.xhtml${to[1] ? "#" + to[1] : ""}`);
                else unwrap(one);
            }
            for (const one of text.querySelectorAll("p.formulaDsp"))
                one.replaceWith(make("div", "formula", ...one.childNodes));
            for (const level of [3, 2, 1]) // below the chapter's title
                for (const one of text.querySelectorAll("h" + level))
                    one.replaceWith(make("h" + (level + 1), "", ...one.childNodes));
            for (const one of text.querySelectorAll("*")) {
                if (one.closest("svg")) continue;
                for (const attribute of Array.from(one.attributes))
                    if (!kept.has(attribute.name)) one.removeAttributeNode(attribute);
            }
            body.append(...text.childNodes);
            return [section.dataset.title, new XMLSerializer().serializeToString(body)];
        });
    }

    return { flaws, book, numbers, short };
})();
