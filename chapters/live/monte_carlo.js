// Live: many runs of an estimator, n running up; their errors beside 1 / sqrt(n).
"use strict";

ljusLive.define("monte_carlo", figure => {
    const { wasm } = figure;
    const runs = 32, last = 24;
    const samples = k => Math.round(4 * 2 ** (k / 2)); // 4 to 16384
    const ways = ["uniform", "cosine", "grazing"], numbers = ["random", "strata", "Owen"];
    const means = figure.canvas(400, 290, "The means of 32 runs against their samples");
    const errors = figure.canvas(390, 290, "The error of the runs against their samples");
    const left = means.getContext("2d"), right = errors.getContext("2d");

    const density = figure.choice("density", ways, 0, () => restart());
    const points = figure.choice("numbers", numbers, 0, () => restart());
    const count = figure.slider("samples", 0, last, 1, 0, null, k => samples(k));
    const play = figure.play(count, 2.6);
    figure.button("again, other numbers", () => { seed += runs; done = {}; restart(); });
    const blue = figure.readout("blue run");
    const truth = figure.readout("right");
    const off = figure.readout("rms error of 32 runs");

    let seed = 1, chosen = 0, done = {};
    function restart() {
        play.begin();
    }
    restart();
    figure.onDrag(means, spot => {
        if (spot.key) {
            count.value += Math.sign(spot.dx);
            chosen = (chosen + runs + Math.sign(spot.dy)) % runs;
            return;
        }
        count.value = Math.max(0, Math.min(last, Math.round((spot.x - 46) / 340 * last)));
        const now = results(name(), count.value).means; // the run that is nearest
        const off = now.map(mean => Math.abs(height(mean) - spot.y));
        chosen = off.indexOf(Math.min(...off));
    });

    // What the runs have after so many samples; worked out when it is first asked for.
    const rightAnswer = wasm.right_answer();
    const deviations = ways.map((_, way) => wasm.deviation(way) / rightAnswer);
    const name = () => density.value + 3 * points.value;
    function results(key, k) {
        const kept = done[key] = done[key] || [];
        if (!kept[k]) {
            const way = key % 3, from = Math.floor(key / 3);
            const address = wasm.run_some(way, from, samples(k), 0, runs, seed);
            const all = figure.doubles(address, 2 * runs);
            kept[k] = { means: [], bars: [], rms: wasm.rms_error(runs) / rightAnswer };
            for (let i = 0; i < runs; ++i) {
                kept[k].means.push(all[2 * i] / rightAnswer);
                kept[k].bars.push(all[2 * i + 1] / rightAnswer);
            }
        }
        return kept[k];
    }

    const x = k => 46 + 340 * k / last;
    const height = mean => 137 - 234 * Math.max(-0.52, Math.min(0.52, mean - 1));
    function frame(canvas, pen, colors, lines, text) {
        figure.clear(canvas);
        pen.setLineDash([]);
        pen.lineWidth = 1;
        pen.strokeStyle = colors.line;
        pen.fillStyle = colors.muted;
        pen.font = "12px sans-serif";
        pen.textAlign = "center";
        for (const k of [0, 4, 8, 12, 16, 20, 24]) {
            pen.beginPath();
            pen.moveTo(x(k), 20);
            pen.lineTo(x(k), 254);
            pen.stroke();
            pen.fillText(samples(k), Math.min(x(k), 368), 270);
        }
        pen.fillText("samples n", 216, 286);
        pen.textAlign = "right";
        for (const [y, label] of lines) {
            pen.beginPath();
            pen.moveTo(46, y);
            pen.lineTo(386, y);
            pen.stroke();
            pen.fillText(label, 42, y + 4);
        }
        pen.textAlign = "left";
        pen.fillText(text, 8, 12);
    }

    function drawMeans(colors, key, k) {
        const y = height;
        frame(means, left, colors, [0.5, 0.75, 1, 1.25, 1.5].map(m => [y(m), m.toFixed(2)]),
              "mean / I: 32 runs, and the blue one with two standard errors");
        left.save();
        left.beginPath();
        left.rect(46, 18, 342, 238);
        left.clip();
        left.strokeStyle = colors.muted;
        left.globalAlpha = 0.35;
        for (let i = 0; i < runs; ++i) {
            left.beginPath();
            for (let j = 0; j <= k; ++j) left.lineTo(x(j), y(results(key, j).means[i]));
            left.stroke();
        }
        left.globalAlpha = 0.25; // the band of the chosen run
        left.fillStyle = colors.blue;
        left.beginPath();
        const edge = (j, sign) => {
            const r = results(key, j);
            left.lineTo(x(j), y(r.means[chosen] + 2 * sign * r.bars[chosen]));
        };
        for (let j = 0; j <= k; ++j) edge(j, 1);
        for (let j = k; j >= 0; --j) edge(j, -1);
        left.fill();
        left.globalAlpha = 1;
        left.strokeStyle = colors.blue;
        left.lineWidth = 2.5;
        left.beginPath();
        for (let j = 0; j <= k; ++j) left.lineTo(x(j), y(results(key, j).means[chosen]));
        left.stroke();
        left.strokeStyle = colors.foreground;
        left.lineWidth = 1;
        left.setLineDash([5, 4]);
        left.beginPath();
        left.moveTo(46, y(1));
        left.lineTo(386, y(1));
        left.stroke();
        left.restore();
        left.fillStyle = colors.blue;
        left.beginPath();
        left.arc(x(k), y(results(key, k).means[chosen]), 4, 0, 7);
        left.fill();
    }

    function drawErrors(colors, key, k) {
        const y = error => 20 + 234 * Math.max(0, Math.min(1, -Math.log10(error) / 7));
        frame(errors, right, colors,
              [0, 1, 2, 3, 4, 5, 6, 7].map(e => [y(10 ** -e), e ? "1e-" + e : "1"]),
              "error / I, root mean square");
        right.save();
        right.beginPath();
        right.rect(46, 18, 342, 238);
        right.clip();
        if (key % 3 !== 2) { // the grazing density's sigma is infinite
            const sigma = deviations[key % 3];
            right.strokeStyle = right.fillStyle = colors.foreground;
            right.setLineDash([5, 4]);
            right.beginPath();
            right.moveTo(x(0), y(sigma / 2));
            right.lineTo(x(last), y(sigma / 128));
            right.stroke();
            right.setLineDash([]);
            right.fillText("σ / √n", x(19), y(sigma / 60) - 8);
        }
        const pens = [colors.blue, colors.primary, colors.green];
        for (const [other, kept] of Object.entries(done)) {
            const mine = Number(other) === key;
            const end = mine ? k : kept.length - 1;
            right.globalAlpha = mine ? 1 : 0.4;
            right.strokeStyle = right.fillStyle = pens[Math.floor(other / 3)];
            right.lineWidth = mine ? 2.5 : 1.2;
            right.beginPath();
            for (let j = 0; j <= end; ++j)
                if (kept[j]) right.lineTo(x(j), y(kept[j].rms));
            right.stroke();
            if (!kept[end]) continue;
            right.textAlign = "right";
            right.fillText(ways[other % 3] + ", " + numbers[Math.floor(other / 3)],
                           Math.max(x(end), 170) - 4, y(kept[end].rms) - (mine ? 8 : -14));
        }
        right.restore();
    }

    figure.onFrame(() => {
        const k = count.value, key = name();
        for (let j = 0; j <= k; ++j) results(key, j);
        const colors = figure.colors, now = results(key, k);
        drawMeans(colors, key, k);
        drawErrors(colors, key, k);
        blue.value = (rightAnswer * now.means[chosen]).toFixed(5) + " ± "
            + (rightAnswer * now.bars[chosen]).toFixed(5);
        truth.value = rightAnswer.toFixed(5);
        off.value = (100 * now.rms).toPrecision(2) + " %";
        return false;
    });
});
