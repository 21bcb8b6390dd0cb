// Live: two patches; their form factor in closed form and by two kinds of chance.
"use strict";

ljusLive.define("form_factors", figure => {
    const { wasm } = figure;
    const lines = 96, most = 4e6; // rays drawn; samples until the estimates rest
    const room = figure.canvas(400, 320, "Two patches and rays from the lower one");
    const chart = figure.canvas(390, 320, "Both estimates against the number of samples");
    const pen = room.getContext("2d"), plot = chart.getContext("2d");

    const at = { x: 0.15, z: 0.85 };
    const presets = [{ x: 0, z: 1, angle: 0, side: 1 },
                     { x: -0.5, z: 0.5, angle: 90, side: 1 },
                     { x: 0.9, z: 0.6, angle: -60, side: 0.4 }];
    figure.choice("the blue patch", ["face to face", "on a common edge",
                                     "small and apart"], 0, k => {
        angle.value = presets[k].angle;
        side.value = presets[k].side;
        Object.assign(at, presets[k]);
        limit();
    });
    const angle = figure.slider("turned by", -120, 120, 1, 0, () => limit(), a => a + "°");
    const side = figure.slider("side", 0.1, 2, 0.05, 1, () => limit(), s => s.toFixed(2));
    const closed = figure.readout("closed form, from orange to blue");
    const back = figure.readout("from blue to orange");
    const byRays = figure.readout("by rays");
    const byPairs = figure.readout("by pairs of points");
    Object.assign(at, presets[0]);
    figure.keep(() => limit(), at, "x", "z");
    let changed = true, exact = 0, rows = [];
    figure.onDrag(room, spot => {
        at.x += spot.dx / (scale * Math.cos(turn));
        at.z -= spot.dy / (scale * Math.cos(lift));
        limit();
    });

    // From the side and a little above; x to the right, z up, y away.
    const scale = 118, turn = 0.42, lift = 0.32;
    const place = p => {
        const along = p[0] * Math.cos(turn) + p[1] * Math.sin(turn);
        const away = p[1] * Math.cos(turn) - p[0] * Math.sin(turn);
        return [200 + scale * along,
                250 - scale * (p[2] * Math.cos(lift) + away * Math.sin(lift))];
    };
    function polygon(corners, color, strength) {
        pen.beginPath();
        for (const corner of corners) pen.lineTo(...place(corner));
        pen.closePath();
        pen.fillStyle = pen.strokeStyle = color;
        pen.globalAlpha = strength;
        pen.fill();
        pen.globalAlpha = 1;
        pen.lineWidth = 2;
        pen.stroke();
    }

    function limit() { // above the floor, and in the picture
        const reach = side.value / 2;
        const low = reach * Math.abs(Math.sin(angle.value * Math.PI / 180));
        at.x = Math.max(-1.5, Math.min(1.5, at.x));
        at.z = Math.max(Math.max(low, 0.02), Math.min(2, at.z));
        changed = true;
    }

    function moveOther() {
        wasm.place(at.x, at.z, angle.value, side.value);
        exact = wasm.closed_form();
        rows = [];
    }

    function drawRoom(colors) {
        const other = [0, 1, 2, 3].map(i => [0, 1, 2].map(k => wasm.corner(i, k)));
        const rays = figure.floats(wasm.ray_lines(lines), 7 * lines);
        figure.clear(room);
        const h = 0.5;
        polygon([[-h, -h, 0], [h, -h, 0], [h, h, 0], [-h, h, 0]], colors.primary, 0.35);
        for (const arrives of [0, 1]) {
            pen.strokeStyle = arrives ? colors.blue : colors.muted;
            pen.globalAlpha = arrives ? 0.8 : 0.25;
            pen.lineWidth = 1;
            for (let i = 0; i < 7 * lines; i += 7) {
                if (rays[i + 6] !== arrives) continue;
                pen.beginPath();
                pen.moveTo(...place(rays.subarray(i, i + 3)));
                pen.lineTo(...place(rays.subarray(i + 3, i + 6)));
                pen.stroke();
            }
        }
        polygon(other, colors.blue, 0.25);
    }

    function drawChart(colors) {
        const x = n => 46 + 330 * Math.log10(n / 64) / Math.log10(most / 64);
        const y = ratio => 158 - 260 * Math.max(-0.6, Math.min(0.6, ratio - 1));
        figure.clear(chart);
        plot.font = "12px sans-serif";
        plot.lineWidth = 1;
        plot.strokeStyle = colors.line;
        plot.fillStyle = colors.muted;
        plot.textAlign = "right";
        for (const ratio of [0.5, 0.75, 1, 1.25, 1.5]) {
            plot.beginPath();
            plot.moveTo(46, y(ratio));
            plot.lineTo(380, y(ratio));
            plot.stroke();
            plot.fillText(ratio.toFixed(2), 42, y(ratio) + 4);
        }
        plot.textAlign = "center";
        for (const n of [100, 1e3, 1e4, 1e5, 1e6])
            plot.fillText(n < 1e4 ? n : "1e" + Math.log10(n), x(n), 304);
        plot.textAlign = "left";
        plot.fillText("estimate / closed form, with two standard errors", 8, 12);
        plot.fillText("samples", 330, 318);
        if (!(exact > 0)) return;
        [colors.red, colors.blue].forEach((color, i) => {
            const k = 1 - i; // pairs below rays
            plot.fillStyle = plot.strokeStyle = color;
            plot.globalAlpha = 0.2;
            plot.beginPath();
            for (const r of rows) plot.lineTo(x(r.n), y((r.mean[k] + 2 * r.bar[k]) / exact));
            for (const r of [...rows].reverse())
                plot.lineTo(x(r.n), y((r.mean[k] - 2 * r.bar[k]) / exact));
            plot.fill();
            plot.globalAlpha = 1;
            plot.lineWidth = 2;
            plot.beginPath();
            for (const r of rows) plot.lineTo(x(r.n), y(r.mean[k] / exact));
            plot.stroke();
            plot.fillText(k ? "pairs of points" : "rays by the cosine", k ? 60 : 190, 276);
        });
    }

    const shown = k => { // one sample has no error yet
        const error = wasm.error_of_mean(k);
        return wasm.mean(k).toFixed(5) + " ± " + (error < Infinity ? error.toFixed(5) : "…");
    };
    figure.onFrame(() => {
        if (changed) moveOther();
        changed = false;
        const n = wasm.samples();
        if (n < most) wasm.more(n < 640 ? 1 : Math.min(250, Math.ceil(n / 64 / 12)));
        const last = rows.length ? rows[rows.length - 1].n : 0;
        if (wasm.samples() > 1.04 * last && wasm.samples() > 64)
            rows.push({ n: wasm.samples(), mean: [wasm.mean(0), wasm.mean(1)],
                        bar: [wasm.error_of_mean(0), wasm.error_of_mean(1)] });
        const colors = figure.colors;
        drawRoom(colors);
        drawChart(colors);
        closed.value = exact.toFixed(5);
        back.value = (exact / wasm.area_of_other()).toFixed(5);
        byRays.value = shown(0);
        byPairs.value = shown(1);
        return wasm.samples() < most;
    });
});
