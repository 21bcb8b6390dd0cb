// Live: photons land under a ball of glass, and discs of one radius make light of them.
"use strict";

ljusLive.define("density_estimate", figure => {
    const { wasm } = figure;
    const size = 300, most = wasm.photons_in_all(), wide = wasm.width();
    const floor = figure.canvas(size, size, "Photons on a floor, and the disc of an estimate");
    const light = figure.canvas(size, size, "The light of the floor by such discs");
    const chart = figure.canvas(620, 170, "The light along the middle line of the floor");
    const pen = floor.getContext("2d"), plot = chart.getContext("2d");
    const cells = wasm.picture_size(), rings = wasm.reference_size(), white = 14;

    const radius = figure.slider("radius of the disc", -2.5, -1, 0.05, -1.8,
        () => { stale = true; }, e => (10 ** e).toFixed(3) + " m");
    figure.play(radius, 12);
    const inside = figure.readout("photons in this disc");
    const found = figure.readout("irradiance by them");
    const off = figure.readout("error of the floor, rms");

    wasm.setup();
    const at = -0.1; // of the disc, on the middle line
    let dots = [], stale = true, landing = [];
    const X = x => size * (0.5 + x / wide);

    function land(time) {
        const before = dots.length / 2;
        const count = wasm.land(Math.max(1, Math.round(wasm.sent() / 60)));
        dots = Array.from(figure.floats(wasm.dots(), 2 * count));
        for (let i = before; i < count; ++i) landing.push({ i, time });
        stale = true;
    }

    function drawFloor(colors, r, time) {
        figure.clear(floor);
        pen.fillStyle = colors.foreground;
        pen.globalAlpha = 0.05;
        pen.fillRect(0, 0, size, size);
        pen.globalAlpha = 0.7;
        let count = 0;
        for (let i = 0; i < dots.length; i += 2) {
            const within = Math.hypot(dots[i] - at, dots[i + 1]) < r;
            count += within;
            pen.fillStyle = within ? colors.red : colors.foreground;
            pen.fillRect(X(dots[i]) - 0.75, X(dots[i + 1]) - 0.75, 1.5, 1.5);
        }
        pen.fillStyle = colors.primary; // photons that come down
        landing = landing.filter(one => time - one.time < 350);
        for (const one of landing) {
            const height = 1 - (time - one.time) / 350;
            pen.globalAlpha = 1 - height;
            pen.beginPath();
            pen.arc(X(dots[2 * one.i]), X(dots[2 * one.i + 1]), 1 + 9 * height, 0, 7);
            pen.fill();
        }
        pen.globalAlpha = 1;
        pen.strokeStyle = colors.red;
        pen.lineWidth = 1.5;
        pen.beginPath();
        pen.arc(X(at), X(0), r / wide * size, 0, 7);
        pen.stroke();
        return count;
    }

    function drawChart(colors, r) {
        const high = e => 160 - 150 * Math.min(e / white, 1);
        const line = (points, color, width) => {
            plot.strokeStyle = color;
            plot.lineWidth = width;
            plot.beginPath();
            for (const [x, e] of points) plot.lineTo(620 * (0.5 + x / wide), high(e));
            plot.stroke();
        };
        const right = [], guess = [];
        let sum = 0; // over the floor: a place counts as the ring through it
        for (let i = -rings; i < rings; ++i) {
            const x = (i + 0.5) / rings * wide / 2;
            right.push([x, wasm.reference(i < 0 ? -1 - i : i)]);
            guess.push([x, wasm.estimate(x, r)]);
            sum += (guess[i + rings][1] - right[i + rings][1]) ** 2 * Math.abs(i + 0.5);
        }
        figure.clear(chart);
        line([[-wide / 2, 0], [wide / 2, 0]], colors.muted, 1);
        line(right, colors.foreground, 1.2);
        line(guess, colors.red, 2);
        plot.font = "13px sans-serif";
        plot.fillStyle = colors.foreground;
        plot.fillText("many photons", 8, 20);
        plot.fillStyle = colors.red;
        plot.fillText("these discs", 8, 38);
        return Math.sqrt(sum) / rings;
    }

    figure.onFrame(time => {
        const r = 10 ** radius.value, colors = figure.colors;
        if (wasm.sent() < most) land(time);
        const counting = wasm.count_reference(0) < 200000;
        if (counting) wasm.count_reference(2000);
        inside.value = drawFloor(colors, r, time);
        if (stale)
            figure.shade(light, figure.floats(wasm.picture(r), cells * cells), cells, white);
        stale = false;
        off.value = drawChart(colors, r).toFixed(2) + " W/m²";
        found.value = wasm.estimate(at, r).toFixed(2) + " W/m²";
        figure.tell(r);
        return counting || landing.length > 0;
    });
});
