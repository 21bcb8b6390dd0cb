// Live: the disc of a density estimate on a floor, and the estimate along the floor.
"use strict";

ljusLive.define("disc", figure => {
    const { wasm } = figure;
    const steps = wasm.curve_steps(), most = 32; // maps in the mean
    const floor = figure.canvas(490, 240, "The floor of two rooms from above, and photons");
    const chart = figure.canvas(490, 200, "The irradiance along the floor");
    const pen = floor.getContext("2d"), plot = chart.getContext("2d");

    const radius = figure.slider("radius", 0.03, 0.4, 0.01, 0.15, () => { again = true; },
                                 r => r.toFixed(2));
    const photons = figure.slider("photons", 3, 4.75, 0.25, 4, () => { send(); },
                                  e => Math.round(10 ** e));
    const corrected = figure.toggle("corrected at edges", false, null);
    const right = figure.readout("right");
    const found = figure.readout("estimate");
    const mended = figure.readout("corrected");
    const part = figure.readout("part of the disc on the floor");

    const at = { x: -0.93, z: 0.5 };
    figure.keep(() => { again = true; }, at, "x", "z");
    let dots = [], again = true, maps = 0, sums = [];
    function send() {
        const number = wasm.trace(Math.round(10 ** photons.value), 1);
        dots = Array.from(figure.floats(wasm.floor_photons(), 2 * number));
        again = true;
    }
    send();
    const left = 46, wide = 436, deep = 218; // the same in both pictures
    const x = u => left + wide * (u + 1) / 2, y = v => 11 + deep * v;
    figure.onDrag(floor, spot => {
        if (spot.key) {
            at.x += 2 * spot.dx / wide;
            at.z += spot.dy / deep;
        } else {
            at.x = 2 * (spot.x - left) / wide - 1;
            at.z = (spot.y - 11) / deep;
        }
        at.x = Math.max(-1, Math.min(1, at.x));
        at.z = Math.max(0.001, Math.min(0.999, at.z));
        again = true;
    });

    function drawFloor(colors) {
        figure.clear(floor);
        pen.fillStyle = colors.foreground;
        pen.globalAlpha = 0.06;
        pen.fillRect(x(0), y(0), x(1) - x(0), deep);
        pen.globalAlpha = 0.6;
        pen.fillStyle = colors.foreground;
        const size = dots.length > 20000 ? 1 : 1.6;
        for (let i = 0; i < dots.length; i += 2)
            pen.fillRect(x(dots[i]) - size / 2, y(dots[i + 1]) - size / 2, size, size);
        pen.globalAlpha = 1;

        // The disc: what of it lies on the floor, and what beside it.
        const round = () => {
            pen.beginPath();
            pen.ellipse(x(at.x), y(at.z), radius.value * wide / 2, radius.value * deep,
                        0, 0, 7);
        };
        pen.globalAlpha = 0.35;
        pen.fillStyle = colors.red;
        round();
        pen.fill();
        pen.save();
        pen.beginPath();
        pen.rect(x(-1), y(0), wide, deep);
        pen.clip();
        pen.globalAlpha = 1;
        pen.fillStyle = colors.background;
        round();
        pen.fill();
        pen.fillStyle = colors.blue;
        pen.globalAlpha = 0.35;
        round();
        pen.fill();
        pen.globalAlpha = 0.9;
        pen.fillStyle = colors.blue;
        for (let i = 0; i < dots.length; i += 2)
            if (Math.hypot(dots[i] - at.x, dots[i + 1] - at.z) < radius.value)
                pen.fillRect(x(dots[i]) - 1, y(dots[i + 1]) - 1, 2, 2);
        pen.restore();
        pen.globalAlpha = 1;
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 1.5;
        pen.strokeRect(x(-1), y(0), wide, deep);
        pen.lineWidth = 4;
        pen.beginPath();
        pen.moveTo(x(0), y(0));
        pen.lineTo(x(0), y(1));
        pen.stroke();
        pen.fillStyle = colors.foreground;
        pen.beginPath();
        pen.arc(x(at.x), y(at.z), 4, 0, 7);
        pen.fill();
    }

    function drawChart(colors) {
        const highest = 1.5 * wasm.exact(-0.5, at.z) + 0.02;
        const h = e => 166 - 150 * Math.min(1.05, e / highest);
        const line = (values, color, width, dashed) => {
            plot.strokeStyle = color;
            plot.lineWidth = width;
            plot.setLineDash(dashed ? [5, 4] : []);
            plot.beginPath();
            for (let i = 0; i <= steps; ++i) plot.lineTo(x(2 * i / steps - 1), h(values(i)));
            plot.stroke();
            plot.setLineDash([]);
        };
        figure.clear(chart);
        plot.font = "13px sans-serif";
        plot.fillStyle = colors.muted;
        plot.strokeStyle = colors.line;
        plot.textAlign = "right";
        for (let e = 0; e <= highest; e += 0.05) {
            plot.beginPath();
            plot.moveTo(left, h(e));
            plot.lineTo(left + wide, h(e));
            plot.stroke();
            plot.fillText(e.toFixed(2), left - 4, h(e) + 4);
        }
        const address = wasm.along(at.z, radius.value);
        const one = Array.from(figure.doubles(address, 2 * steps + 2));
        const shift = corrected.value ? steps + 1 : 0;
        plot.globalAlpha = 0.6;
        line(i => one[shift + i], colors.muted, 1);
        plot.globalAlpha = 1;
        line(i => wasm.exact(2 * i / steps - 1 + (2 * i === steps ? 1e-6 : 0), at.z),
             colors.foreground, 1.5, true);
        if (maps) line(i => sums[shift + i] / maps, corrected.value ? colors.green
                                                                    : colors.blue, 2.5);
        plot.strokeStyle = colors.foreground;
        plot.lineWidth = 1;
        plot.beginPath();
        plot.moveTo(x(at.x), 20);
        plot.lineTo(x(at.x), 166);
        plot.stroke();
        plot.textAlign = "left";
        const key = [["right", colors.foreground], ["these photons", colors.muted],
                     ["mean of " + maps + " maps", corrected.value ? colors.green
                                                                   : colors.blue]];
        key.forEach(([text, color], i) => {
            plot.fillStyle = color;
            plot.fillText(text, left + 140 * i, 192);
        });
    }

    figure.onFrame(() => {
        if (again) {
            again = false;
            maps = 0;
            sums = new Array(2 * steps + 2).fill(0);
        } else if (maps < most) {
            const address = wasm.along_others(Math.round(10 ** photons.value), 2 + maps,
                                              at.z, radius.value);
            const more = figure.doubles(address, 2 * steps + 2);
            sums = sums.map((sum, i) => sum + more[i]);
            ++maps;
        }
        const colors = figure.colors;
        drawFloor(colors);
        drawChart(colors);
        right.value = wasm.exact(at.x, at.z).toFixed(4);
        found.value = wasm.estimate(at.x, at.z, radius.value, 0).toFixed(4);
        mended.value = wasm.estimate(at.x, at.z, radius.value, 1).toFixed(4);
        part.value = (100 * wasm.part_of_disc(at.x, at.z, radius.value)).toFixed(0) + " %";
        return maps < most;
    });
});
