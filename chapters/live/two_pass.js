// Live: figure 1. Workers render pictures of one ray a pixel, each with other random
// numbers, and the page adds them up. Where there are no workers the page renders, some
// rows a frame.
"use strict";

ljusLive.define("two_pass", figure => {
    const { wasm } = figure;
    const size = 240, shown = 480;     // pixels that are rendered; units of the canvas
    const band = 24;                   // rows that a worker renders at a time
    const renew = 16;                  // rays per pixel until a worker makes new maps
    const enough = 4096;               // rays per pixel

    // --- What a reader chooses ------------------------------------------------------

    const picture = figure.canvas(shown, shown,
                                  "The report's final room, being rendered");
    const plot = figure.canvas(260, 230,
                               "The expected error against the rays per pixel");
    const brush = picture.getContext("2d"), pen = plot.getContext("2d");

    let indexChosen = false;
    const power = digits => v => Number((10 ** v).toPrecision(digits));
    const remake = () => changed(true), rerender = () => changed(false);
    const photons = figure.slider("photons", 3, 5.7, 0.1, 5, remake,
                                  v => power(2)(v).toLocaleString("en"));
    const radius = figure.slider("radius of the estimate", -1.7, 0, 0.05, -1, remake,
                                 power(2));
    const depth = figure.slider("surfaces on a camera path", 1, 13, 1, 13, remake,
                                v => v > 12 ? "any" : v);
    const index = figure.slider("index of the balls", 1, 2.4, 0.01, 1.47,
        () => { indexChosen = true; remake(); }, v => v.toFixed(2));
    const distance = figure.slider("distance of the camera", 3, 14, 0.1, 13, rerender,
                                   v => v.toFixed(1));
    const exposure = figure.slider("exposure in stops", -3, 3, 0.1, 0, null,
                                   v => v.toFixed(1));
    const indirect = figure.choice("indirect light",
        ["by indirect rays", "by one ray and the general map",
         "by the general map alone", "none"], 0, remake);
    const classes = ["lamps", "direct light", "caustics", "indirect light",
                     "in mirrors and glass"]
        .map(name => figure.toggle(name, true, rerender));
    const dots = figure.toggle("photons as dots", false);
    figure.button("another ray of the pixel", () => { ++asked.seed; explain(); });
    const shownRays = figure.readout("rays per pixel");
    const shownSpeed = figure.readout("million rays per second");
    const shownPhotons = figure.readout("photons in the caustics map");
    const shownError = figure.readout("expected error (relMSE)");

    const turned = { yaw: 0, pitch: 0 };
    const [yaw] = figure.keep(rerender, turned, "yaw", "pitch");
    figure.play(yaw, 12, -30, 30);

    // From outside one looks through the open side of the room, from inside all around.
    function keepInSight() {
        const within = (v, most) => Math.max(-most, Math.min(most, v));
        const inside = distance.value <= 5;
        turned.yaw = inside ? turned.yaw : within(turned.yaw, 30);
        turned.pitch = within(turned.pitch, inside ? 40 : 20);
    }
    figure.onDrag(picture, spot => {
        if (spot.last && !spot.moved) {
            const pixel = at =>
                Math.min(size - 1, Math.max(0, Math.floor(at * size / shown)));
            asked.x = pixel(spot.x);
            asked.y = pixel(spot.y);
            explain();
        } else if (spot.dx || spot.dy) {
            turned.yaw += spot.dx / 5;
            turned.pitch += spot.dy / 5;
            changed(false);
        }
    });

    picture.style.touchAction = "pan-y"; // up and down, a finger scrolls the page

    // --- Jobs -----------------------------------------------------------------------

    // Does jobs with one instance of the module. Its text goes to the workers, too: it
    // names nothing from outside.
    function jobs(wasm, number) {
        let made = "", round = 0;
        const text = address => {
            const all = new Uint8Array(wasm.memory.buffer);
            const end = all.indexOf(0, address);
            return new TextDecoder().decode(all.slice(address, end));
        };
        const floats = (address, count) =>
            new Float32Array(wasm.memory.buffer, address, count).slice();
        return job => {
            wasm.view(...job.view);
            wasm.carry(job.classes);
            const maps = job.maps.join(" ");
            const answer = { kind: job.kind, version: job.version };
            // New maps now and then: in the mean their noise falls, too.
            if (made !== maps || job.round > round) {
                round = job.round || 0;
                answer.photons = wasm.prepare(...job.maps, 1 + number + 1000 * round);
                made = maps;
            }
            if (job.kind === "dots") {
                const count = wasm.find_dots(job.size, job.size);
                answer.dots = floats(wasm.dot_places(), 5 * count);
            } else if (job.kind === "explain") {
                answer.lines = JSON.parse(text(wasm.explain(
                    job.size, job.size, job.seed, job.x, job.y)));
            } else {
                const rows = wasm.render_rows(job.size, job.size, job.seed, job.first,
                                              job.last);
                answer.rows = floats(rows, 3 * job.size * (job.last - job.first));
                answer.first = job.first;
                answer.last = job.last;
                answer.size = job.size;
                answer.rays = wasm.rays();
            }
            return answer;
        };
    }

    function inWorker() { // the program of a worker
        let run = null;
        onmessage = async event => {
            if (event.data.code)
                run = jobs(await instantiate(event.data.code), event.data.number);
            postMessage(run && !event.data.code ? run(event.data) : { kind: "ready" });
        };
    }

    const crew = []; // { send, busy }
    function hire() {
        const source = jobs + "\n" + ljusLive.instantiate + "\n(" + inWorker + ")();";
        const address = URL.createObjectURL(
            new Blob([source], { type: "text/javascript" }));
        const count = Math.max(1, Math.min(8, navigator.hardwareConcurrency || 2));
        for (let number = 0; number < count; ++number) {
            const worker = new Worker(address);
            const one = { busy: true, send: job => worker.postMessage(job),
                          stop: () => worker.terminate() };
            worker.onmessage = event => {
                one.busy = false;
                if (event.data.kind !== "ready") take(event.data);
                dispatch();
            };
            worker.onerror = workAlone;
            worker.postMessage({ code: figure.code, number });
            crew.push(one);
            figure.onDispose(one.stop);
        }
    }
    let alone = null; // jobs() of the page's own instance
    function workAlone() {
        for (const one of crew.splice(0)) one.stop();
        alone = alone || jobs(wasm, 0);
        figure.redraw();
    }

    let version = 0;    // of what is rendered; answers to older questions are dropped
    let small = 0;      // the version that there is a preview of
    let next = 0;       // the band to render next
    let added = 0;      // rows that were added up
    let dotsAsked = -1, dotPlaces = [];
    const asked = { x: -1, y: -1, seed: 1, wanted: false, lines: null, chosen: -1 };

    function changed(maps) {
        keepInSight();
        ++version;
        next = added = 0;
        errors.length = 0;
        if (maps) shownPhotons.value = "…";
        dotPlaces = [];
        asked.lines = null;
        table.replaceChildren();
        wasm.begin(size, size);
        dispatch();
        figure.redraw();
    }
    function explain() {
        if (asked.x < 0) return;
        asked.wanted = true;
        dispatch();
        figure.redraw();
    }

    function nextJob(rows) {
        const job = { version, size, kind: "rows",
            view: [turned.yaw, turned.pitch, distance.value],
            classes: classes.reduce((sum, one, i) => sum + (one.value ? 1 << i : 0), 0),
            maps: [Math.round(10 ** photons.value), 10 ** radius.value,
                   depth.value > 12 ? 1000 : depth.value, indexChosen ? index.value : 0,
                   indirect.value] };
        if (asked.wanted) {
            asked.wanted = false;
            return Object.assign(job, { kind: "explain", x: asked.x, y: asked.y,
                                        seed: 1e6 + asked.seed });
        }
        if (small !== version) { // first of all a look at the whole
            small = version;
            return Object.assign(job, { kind: "preview", size: size / 4, seed: 0,
                                        first: 0, last: size / 4 });
        }
        if (dots.value && dotsAsked !== version) {
            dotsAsked = version;
            return Object.assign(job, { kind: "dots" });
        }
        const bands = size / rows;
        if (next >= enough * bands) return null;
        const first = next % bands * rows;
        job.seed = 1 + Math.floor(next++ / bands);
        job.round = Math.floor(job.seed / renew);
        return Object.assign(job, { first, last: first + rows });
    }

    function dispatch() {
        if (!figure.inSight) return;
        for (const one of crew) if (!one.busy) {
            const job = nextJob(band);
            if (!job) return;
            one.busy = true;
            one.send(job);
        }
    }

    let rays = 0, since = performance.now();
    function take(answer) {
        rays += answer.rays || 0;
        // While the camera turns each preview is late, and better than none.
        if (answer.version !== version && answer.kind !== "preview") return;
        if (answer.photons !== undefined)
            shownPhotons.value = answer.photons.toLocaleString("en");
        if (answer.kind === "dots") dotPlaces = answer.dots;
        if (answer.kind === "explain") showPath(answer);
        if (answer.rows) {
            begun = true;
            const room = wasm.input_of(answer.rows.length);
            figure.floats(room, answer.rows.length).set(answer.rows);
            if (answer.kind === "preview") {
                wasm.take_preview(answer.size);
            } else {
                wasm.add_rows(answer.first, answer.last);
                added += answer.last - answer.first;
            }
        }
        figure.redraw();
    }

    // --- A path, vertex by vertex ---------------------------------------------------

    const table = document.createElement("table");
    table.className = "markdownTable ljus-live-path";
    const frame = document.createElement("div");
    frame.className = "ljus-table-frame";
    frame.append(table);
    figure.stage.append(frame);

    // The lines of a log as a tree: { position, place, parent, letters, terms, ... }.
    function treeOf(lines) {
        const nodes = [];
        const at = position => nodes.find(
            node => node.position.every((c, i) => c === position[i]));
        let last = null;
        for (const line of lines) {
            let node = at(line.position);
            if (!node) {
                node = { position: line.position, place: line.place, parent: last,
                         terms: [] };
                nodes.push(node);
            }
            if (line.what !== "vertex") {
                node.terms.push(line);
                continue;
            }
            // A branch that split off at glass tells its first vertices once more.
            if (!node.letters)
                Object.assign(node, { letters: line.path, value: line.value,
                                      pdf: line.pdf });
            last = node;
        }
        return nodes;
    }

    function showPath(answer) {
        asked.lines = treeOf(answer.lines);
        asked.chosen = -1;
        table.replaceChildren();
        const row = (cells, kind, number) => {
            const line = document.createElement("tr");
            for (const text of cells) {
                const cell = document.createElement(kind);
                cell.textContent = text;
                line.append(cell);
            }
            if (number >= 0) {
                line.addEventListener("pointerenter", () => choose(number));
                line.addEventListener("pointerleave", () => choose(-1));
            }
            table.append(line);
        };
        const three = v => v.map(c => c.toPrecision(3)).join("  ");
        const spaced = letters => letters.split("").join(" ").replace(/ \+/g, "+");
        row(["", "path", "red, green, blue", "pdf"], "th", -1);
        const sum = [0, 0, 0];
        asked.lines.forEach((node, number) => {
            row([number + 1 + (node.place ? "" : " (out of sight)"),
                 node.letters ? spaced(node.letters) : "ends here",
                 node.letters ? "throughput " + three(node.value) : "",
                 !node.letters ? "" : node.pdf > 0 ? node.pdf.toPrecision(3) : "delta"],
                "td", number);
            for (const term of node.terms) {
                term.value.forEach((c, i) => { sum[i] += c; });
                row(["", spaced(term.path), term.what + " + " + three(term.value), ""],
                    "td", number);
            }
        });
        row(["", "", sum.some(c => c > 0) ? "radiance of this ray " + three(sum) :
            "it finds no light", ""], "td", -1);
    }
    function choose(number) {
        asked.chosen = number;
        figure.redraw();
    }
    figure.onHover(picture, spot => {
        if (!asked.lines) return;
        const near = spot ? asked.lines.findIndex(node => node.place && Math.hypot(
            node.place[0] * shown / size - spot.x,
            node.place[1] * shown / size - spot.y) < 9) : -1;
        if (near !== asked.chosen) choose(near);
    });

    function drawPath() {
        const unit = shown / size;
        const line = (from, to, width, color) => {
            brush.lineWidth = width;
            brush.strokeStyle = color;
            brush.beginPath();
            brush.moveTo(from[0] * unit, from[1] * unit);
            brush.lineTo(to[0] * unit, to[1] * unit);
            brush.stroke();
        };
        for (const node of asked.lines) {
            if (!node.place || !node.parent || !node.parent.place) continue;
            line(node.parent.place, node.place, 4, "#000a");
            line(node.parent.place, node.place, 2, "#fff");
        }
        brush.font = "bold 12px sans-serif";
        brush.textAlign = "center";
        asked.lines.forEach((node, number) => {
            if (!node.place) return;
            const [x, y] = node.place.map(c => c * unit);
            const ends = node.letters ? node.letters.slice(-1) : "";
            brush.beginPath();
            brush.arc(x, y, number === asked.chosen ? 12 : 9, 0, 7);
            brush.fillStyle = ends === "S" ? "#6caae6" :
                ends === "D" ? "#5cc48a" : "#e0a458";
            brush.fill();
            brush.lineWidth = number === asked.chosen ? 3 : 1;
            brush.strokeStyle = number === asked.chosen ? "#fff" : "#000";
            brush.stroke();
            brush.fillStyle = "#000";
            brush.fillText(number + 1, x, y + 4);
        });
    }

    // --- The picture, the numbers, the error as it falls ----------------------------

    const errors = []; // [rays per pixel, relMSE]
    function drawErrors() {
        const colors = figure.colors;
        const x = n => 50 + 200 * Math.log10(n) / Math.log10(enough);
        const y = e => 20 + 180 * -Math.log10(e) / 4;
        figure.clear(plot);
        pen.font = "12px sans-serif";
        pen.lineWidth = 1;
        pen.strokeStyle = colors.line;
        pen.fillStyle = colors.muted;
        const grid = (fromX, fromY, toX, toY) => {
            pen.beginPath();
            pen.moveTo(fromX, fromY);
            pen.lineTo(toX, toY);
            pen.stroke();
        };
        pen.textAlign = "center";
        for (const n of [1, 10, 100, 1000]) {
            grid(x(n), y(1), x(n), y(1e-4));
            pen.fillText(n, x(n), 216);
        }
        pen.textAlign = "right";
        for (const e of [1, 0.1, 0.01, 0.001, 0.0001]) {
            grid(x(1), y(e), x(enough), y(e));
            pen.fillText(e, 46, y(e) + 4);
        }
        pen.textAlign = "left";
        pen.fillText("relMSE", 4, 12);
        pen.fillText("rays per pixel", 160, 228);
        pen.strokeStyle = colors.red;
        pen.lineWidth = 2;
        pen.beginPath();
        for (const [n, e] of errors)
            pen.lineTo(x(n), Math.max(20, Math.min(200, y(e))));
        pen.stroke();
    }

    // Until there is something to see, the page's still stands in its place.
    const still = figure.box.querySelector("img");
    let begun = !still;
    if (still) still.addEventListener("load", figure.redraw);

    let toldAt = 0;
    figure.onFrame(now => {
        if (alone) {
            const until = performance.now() + 12;
            do {
                const job = nextJob(2);
                if (!job) break;
                take(alone(job));
            } while (performance.now() < until);
        }
        const bytes = wasm.show(2 ** exposure.value);
        if (begun)
            figure.paint(picture, figure.bytes(bytes, 4 * size * size), size, size);
        else if (still.naturalWidth) brush.drawImage(still, 0, 0, shown, shown);
        if (dots.value) {
            if (dotsAsked !== version) dispatch();
            for (let i = 0; i < dotPlaces.length; i += 5) {
                const [r, g, b] = dotPlaces.slice(i + 2, i + 5).map(c => 255 * c);
                brush.fillStyle = `rgb(${r}, ${g}, ${b})`;
                brush.fillRect(dotPlaces[i] * shown / size - 1,
                               dotPlaces[i + 1] * shown / size - 1, 2, 2);
            }
        }
        if (asked.lines) drawPath();
        const perPixel = added / size;
        if (now - toldAt > 400) {
            toldAt = now;
            const e = wasm.error();
            if (e >= 0) errors.push([perPixel, e]);
            shownError.value = e >= 0 ? e.toPrecision(2) : "…";
            shownRays.value = perPixel.toFixed(perPixel < 10 ? 1 : 0);
            const seconds = (performance.now() - since) / 1000;
            shownSpeed.value = seconds > 0 ? (rays / seconds / 1e6).toFixed(2) : "…";
            rays = 0;
            since = performance.now();
        }
        drawErrors();
        return alone !== null && perPixel < enough;
    });
    figure.onSight(seen => {
        rays = 0;
        since = performance.now();
        if (seen) dispatch();
    });

    // For the test: rays per pixel so far.
    figure.progress = () => added / size;

    wasm.begin(size, size);
    version = 1;
    try { hire(); } catch (error) { workAlone(); }
});
