// Live: a k-d tree cuts the plane, and a search finds the k nearest photons in it.
"use strict";

ljusLive.define("kd_tree", figure => {
    const { wasm } = figure;
    const count = 2000, size = 440;
    const plane = figure.canvas(size, size, "Photons on a floor, boxes of the tree, a search");
    const pen = plane.getContext("2d");

    const set = figure.choice("photons", ["spread evenly", "a caustic"], 1, () => build());
    const halvings = figure.slider("halvings shown", 0, 7, 1, 7, null);
    const wanted = figure.slider("k nearest", 1, 200, 1, 40, () => { changed = true; });
    const within = figure.slider("within the radius", 0.02, 0.5, 0.01, 0.5,
                                 () => { changed = true; },
                                 r => r >= 0.5 ? "any" : r.toFixed(2));
    figure.button("search step by step", () => { step = 0; });
    const computed = figure.readout("distances computed");
    const asked = figure.readout("boxes asked");
    const reach = figure.readout("reach");

    const at = { x: 0.3, y: 0.62 };
    figure.keep(() => { changed = true; }, at, "x", "y");
    let places = [], leaves = [], changed = true, step = null;
    let order = [], reaches = [], leafOf = [];
    function boxes(depth) {
        const number = wasm.cut(depth);
        return Array.from(figure.floats(wasm.cut_boxes(), 6 * number));
    }
    function build() {
        places = Array.from(figure.floats(wasm.build(set.value, count), 2 * count));
        leaves = boxes(99);
        for (let b = 0; b < leaves.length; b += 6)
            leafOf.fill(b, leaves[b], leaves[b + 1]);
        changed = true;
    }
    leafOf = new Array(count).fill(0);
    build();
    figure.onDrag(plane, spot => {
        if (spot.key) {
            at.x += spot.dx / size;
            at.y += spot.dy / size;
        } else {
            at.x = spot.x / size;
            at.y = spot.y / size;
        }
        at.x = Math.max(0, Math.min(1, at.x));
        at.y = Math.max(0, Math.min(1, at.y));
        changed = true;
    });
    function search() {
        const radius = within.value >= 0.5 ? 10 : within.value;
        const steps = wasm.search(at.x, at.y, wanted.value, radius);
        order = Array.from(figure.ints(wasm.search_order(), steps));
        reaches = Array.from(figure.floats(wasm.search_reach(), steps));
        step = step === null ? 0 : Infinity; // the first one is seen step by step
    }

    function dots(indices, color, width) {
        pen.fillStyle = color;
        for (const i of indices)
            pen.fillRect(size * places[2 * i] - width / 2, size * places[2 * i + 1] - width / 2,
                         width, width);
    }
    function box(all, b, fill) {
        const [x, y, right, bottom] = all.slice(b + 2, b + 6).map(c => size * c);
        if (fill) pen.fillRect(x, y, right - x, bottom - y);
        else pen.strokeRect(x, y, right - x, bottom - y);
    }

    figure.onFrame(() => {
        if (changed) search();
        changed = false;
        const done = Math.min(order.length, Math.floor(step));
        const seen = order.slice(0, done);
        const radius = done ? reaches[done - 1] : Infinity;
        const found = seen.filter(i =>
            Math.hypot(places[2 * i] - at.x, places[2 * i + 1] - at.y) <= radius * (1 + 1e-6));

        const colors = figure.colors;
        figure.clear(plane);
        pen.fillStyle = colors.primary; // the leaves that were looked into
        pen.globalAlpha = 0.18;
        for (const b of new Set(seen.map(i => leafOf[i]))) box(leaves, b, true);
        pen.globalAlpha = 1;
        pen.strokeStyle = colors.muted;
        pen.lineWidth = 0.7;
        const cut = boxes(halvings.value);
        for (let b = 0; b < cut.length; b += 6) box(cut, b, false);
        pen.globalAlpha = 0.55;
        dots(Array(count).keys(), colors.muted, 2);
        pen.globalAlpha = 1;
        dots(seen, colors.primary, 3);
        dots(found, colors.blue, 4);
        pen.strokeStyle = pen.fillStyle = colors.foreground;
        pen.lineWidth = 1.5;
        if (radius < 9) {
            pen.beginPath();
            pen.arc(size * at.x, size * at.y, size * radius, 0, 7);
            pen.stroke();
        }
        pen.beginPath();
        pen.arc(size * at.x, size * at.y, 4, 0, 7);
        pen.fill();
        computed.value = done + " of " + count;
        asked.value = wasm.search_boxes();
        reach.value = radius < 9 ? radius.toFixed(3) + ", " + found.length + " found"
                                 : "any, " + found.length + " found";
        if (step >= order.length) step = Infinity;
        else step += Math.max(0.5, order.length / 300); // some five seconds
        return step < Infinity;
    });
});
