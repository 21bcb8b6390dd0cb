// Ljus: two kinds of figures that a reader can move. Without this script a page shows
// the same pictures one below the other.
//
//   <div class="ljus-compare" data-labels="before|after"> two \image lines </div>
//   <div class="ljus-sweep" data-name="depth" data-values="1|2|3|4"> four \image lines </div>
"use strict";

(function () {
    function element(tag, name, text) {
        const result = document.createElement(tag);
        if (name) result.className = name;
        if (text) result.textContent = text;
        return result;
    }

    // The pictures of a figure, taken out of Doxygen's frames; captions stay below.
    function takeImages(figure, stage) {
        const images = Array.from(figure.querySelectorAll("img"));
        const captions = Array.from(figure.querySelectorAll(".caption"))
            .map(caption => caption.textContent.trim()).filter(text => text);
        for (const image of images) {
            image.draggable = false;
            stage.appendChild(image);
        }
        figure.replaceChildren(stage);
        return { images, captions };
    }

    function range(max, value, label) {
        const input = element("input");
        input.type = "range";
        input.min = 0;
        input.max = max;
        input.value = value;
        input.setAttribute("aria-label", label);
        return input;
    }

    function compare(figure) {
        if (figure.querySelectorAll("img").length !== 2) return;
        const labels = (figure.dataset.labels || "|").split("|");
        const stage = element("div", "ljus-compare-stage");
        const { captions } = takeImages(figure, stage);
        const input = range(1000, 500, labels.join(" or "));
        input.addEventListener("input", () =>
            stage.style.setProperty("--split", input.value / 10 + "%"));
        stage.append(input, element("span", "ljus-label left", labels[0]),
                     element("span", "ljus-label right", labels[1]));
        if (captions.length) figure.append(element("p", "ljus-caption", captions.join(" ")));
    }

    function sweep(figure) {
        const stage = element("div", "ljus-sweep-stage");
        const values = (figure.dataset.values || "").split("|");
        const name = figure.dataset.name || "";
        const { images, captions } = takeImages(figure, stage);
        if (!images.length) return;
        // On paper all pictures are there, each with its value and its caption.
        const frames = images.map((image, i) => {
            const frame = element("figure");
            const value = [name, values[i]].filter(text => text).join(": ");
            const said = [value, captions[i]].filter(text => text).join(". ");
            frame.append(image, element("figcaption", "", said));
            return frame;
        });
        stage.append(...frames);
        const input = range(images.length - 1, 0, name);
        const output = element("output");
        const caption = element("p", "ljus-caption");
        const show = () => {
            const at = Number(input.value);
            frames.forEach((frame, i) => frame.classList.toggle("shown", i === at));
            output.textContent = values[at] || "";
            caption.textContent = captions[at] || "";
        };
        input.addEventListener("input", show);
        const control = element("div", "ljus-sweep-control");
        control.append(element("span", "", name), input, output);
        figure.append(control, caption);
        show();
    }

    // Paper has no folds: they are open while a page is printed.
    let folds = [];
    window.addEventListener("beforeprint", () => {
        folds = Array.from(document.querySelectorAll("details:not([open])"));
        for (const fold of folds) fold.open = true;
    });
    window.addEventListener("afterprint", () => {
        for (const fold of folds) fold.open = false;
    });

    document.addEventListener("DOMContentLoaded", () => {
        document.querySelectorAll(".ljus-compare").forEach(compare);
        document.querySelectorAll(".ljus-sweep").forEach(sweep);
    });
})();
