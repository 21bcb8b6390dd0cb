// Live: pass after pass of photons, their mean, and a disc that shrinks.
"use strict";

ljusLive.define("progressive", figure => {
    const { wasm } = figure;
    const size = 300, wide = wasm.width(), white = 14, last = 24;
    const passes = s => Math.round(10 ** (s / 8)); // 1 to 1000
    const floor = figure.canvas(size, size, "The photons of one pass, and its disc");
    const light = figure.canvas(size, size, "The mean of all passes so far");
    const chart = figure.canvas(620, 180, "The mean along the middle line, and its error " +
                                "against the number of passes");
    const pen = floor.getContext("2d"), plot = chart.getContext("2d");
    const cells = wasm.picture_size(), rings = wasm.reference_size();

    const count = figure.slider("passes", 0, last, 1, 0, null, passes);
    figure.play(count, 16);
    const radius = figure.readout("radius of the last pass");
    const used = figure.readout("photons so far");
    const off = figure.readout("error of the mean, rms");

    wasm.setup();
    const means = []; // after so many passes as the slider has positions
    let done = 0, dots = [], shown = null, landed = 0;
    const X = x => size * (0.5 + x / wide);

    // Passes are made when they are asked for, some in each frame.
    function makePasses() {
        const end = performance.now() + 25;
        while (means.length <= count.value && performance.now() < end) {
            done = wasm.pass();
            while (passes(means.length) === done) means.push({
                picture: Array.from(figure.floats(wasm.picture(), cells * cells)),
                line: Array.from(figure.floats(wasm.line(1), 2 * rings)),
                same: Array.from(figure.floats(wasm.line(0), 2 * rings)),
                radius: wasm.radius(done),
            });
        }
    }
    const right = i => wasm.reference(i < rings ? rings - 1 - i : i - rings);
    function error(line) { // over the floor: a place counts as the ring through it
        const sum = line.reduce((sum, e, i) =>
            sum + (e - right(i)) ** 2 * Math.abs(i + 0.5 - rings), 0);
        return Math.sqrt(sum) / rings;
    }

    function drawFloor(colors, r, time) {
        figure.clear(floor);
        pen.fillStyle = colors.foreground;
        pen.globalAlpha = 0.05;
        pen.fillRect(0, 0, size, size);
        let falling = false;
        for (let i = 0; i < dots.length; i += 2) {
            const height = 1 + (i / dots.length) - (time - landed) / 400;
            falling = falling || height > 0;
            if (height > 1) continue;
            const up = Math.max(0, height);
            pen.globalAlpha = 0.8 * (1 - up);
            pen.fillStyle = up > 0 ? colors.primary : colors.foreground;
            pen.beginPath();
            pen.arc(X(dots[i]), X(dots[i + 1]), 1.2 + 8 * up, 0, 7);
            pen.fill();
        }
        pen.globalAlpha = 1;
        pen.strokeStyle = colors.red;
        pen.lineWidth = 1.5;
        pen.beginPath();
        pen.arc(X(-0.1), X(0), r / wide * size, 0, 7);
        pen.stroke();
        return falling;
    }

    function drawChart(colors, now) {
        const draw = (points, color, width, dash = []) => {
            plot.strokeStyle = color;
            plot.lineWidth = width;
            plot.setLineDash(dash);
            plot.beginPath();
            for (const [x, y] of points) plot.lineTo(x, y);
            plot.stroke();
            plot.setLineDash([]);
        };
        const along = line => line.map((e, i) =>
            [300 * (i + 0.5) / (2 * rings), 160 - 150 * Math.min(1, e / white)]);
        figure.clear(chart);
        draw([[0, 160], [300, 160]], colors.muted, 1);
        draw(along(now.line.map((_, i) => right(i))), colors.foreground, 1);
        draw(along(now.same), colors.blue, 1.5, [5, 3]);
        draw(along(now.line), colors.red, 2);

        const x = s => 360 + 240 * s / last;
        const y = e => 160 - 150 * Math.log2(Math.max(e, 0.5) / 0.5) / 2; // 0.5 to 2
        draw([[x(0), 10], [x(0), 160], [x(last), 160]], colors.muted, 1);
        const upTo = means.slice(0, count.value + 1);
        draw(upTo.map((one, s) => [x(s), y(error(one.same))]), colors.blue, 1.5, [5, 3]);
        draw(upTo.map((one, s) => [x(s), y(error(one.line))]), colors.red, 2);
        plot.font = "13px sans-serif";
        plot.fillStyle = colors.muted;
        plot.textAlign = "center";
        for (const s of [0, 8, 16, 24]) plot.fillText(passes(s), x(s), 175);
        plot.textAlign = "right";
        for (const e of [0.5, 1, 2]) plot.fillText(e, x(0) - 5, y(e) + 5);
        plot.textAlign = "left";
        plot.fillText("error against passes", x(0) + 8, 118);
        plot.fillStyle = colors.red;
        plot.fillText("shrinking disc", x(0) + 8, 135);
        plot.fillStyle = colors.blue;
        plot.fillText("dashed: always the first disc", x(0) + 8, 152);
    }

    figure.onFrame(time => {
        makePasses();
        const s = Math.min(count.value, means.length - 1), now = means[s];
        const counting = wasm.count_reference(0) < 200000;
        if (counting) wasm.count_reference(2000);
        if (s !== shown) {
            const number = wasm.land(passes(s));
            dots = Array.from(figure.floats(wasm.dots(), 2 * number));
            landed = time;
            shown = s;
            figure.shade(light, now.picture, cells, white);
        }
        const falling = drawFloor(figure.colors, now.radius, time);
        drawChart(figure.colors, now);
        radius.value = now.radius.toFixed(4) + " m";
        used.value = (500 * passes(s)).toLocaleString("en");
        off.value = error(now.line).toFixed(2) + " W/m²";
        figure.tell(passes(s));
        return counting || falling || s < count.value;
    });
});
