// Live: photons fly through a closed room; at each wall roulette ends some of them.
"use strict";

ljusLive.define("photon_emission", figure => {
    const { wasm } = figure;
    const canvas = figure.canvas(680, 520, "Photons in a closed room, and how many of " +
        "them arrive at their first, second, third surface");
    const pen = canvas.getContext("2d");
    const scale = 310, floor = 352, axis = 500, high = 110, bars = 16, most = 20000;
    const X = x => 340 + scale * x, Y = y => floor - scale * y;

    const albedo = figure.slider("the walls reflect", 0, 0.95, 0.05, 0.5,
        () => begin(), rho => Math.round(100 * rho) + " %");
    figure.play(albedo, 12);
    const sent = figure.readout("photons");
    const met = figure.readout("surfaces met by a photon, in the mean");

    let flights = [], ended = [], next = 0, since = null;
    function begin() {
        wasm.setup(albedo.value);
        flights = [];
        ended = [];
        since = null;
    }
    begin();
    function launch(time) {
        wasm.send(1);
        const path = figure.pairs(figure.floats(wasm.path(), 2 * wasm.path_size()));
        flights.push({ path, time });
        next = time + 250;
    }
    function dot([x, y], radius, color) {
        pen.fillStyle = color;
        pen.beginPath();
        pen.arc(X(x), Y(y), radius, 0, 7);
        pen.fill();
    }

    function drawRoom(colors, time) {
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 1.5;
        pen.strokeRect(X(-1), Y(wasm.height()), 2 * scale, scale * wasm.height());
        pen.strokeStyle = colors.primary;
        pen.lineWidth = 6;
        pen.beginPath();
        pen.moveTo(X(wasm.lamp(0)), Y(wasm.height()));
        pen.lineTo(X(wasm.lamp(1)), Y(wasm.height()));
        pen.stroke();
        pen.globalAlpha = 0.6;
        for (const end of ended) dot(end, 3, colors.red);
        pen.globalAlpha = 1;
        pen.strokeStyle = colors.primary;
        pen.lineWidth = 1.2;
        flights = flights.filter(({ path, time: start }) => {
            const part = figure.along(path, (time - start) / 700);
            const walls = part.slice(1, -1);
            pen.globalAlpha = 0.5;
            pen.beginPath();
            for (const [x, y] of part) pen.lineTo(X(x), Y(y));
            pen.stroke();
            pen.globalAlpha = 1;
            for (const one of walls) dot(one, 2.5, colors.foreground);
            const [x, y] = part[part.length - 1], [endX, endY] = path[path.length - 1];
            dot([x, y], 5, colors.primary);
            const there = part.length === path.length && x === endX && y === endY;
            if (there) ended.push([x, y]);
            return !there;
        });
        ended = ended.slice(-300);
    }

    function drawBars(colors, number) {
        const wide = 2 * scale / bars;
        pen.font = "13px sans-serif";
        pen.textAlign = "center";
        for (let k = 1; k <= bars; ++k) {
            const left = X(-1) + wide * (k - 1), law = albedo.value ** (k - 1);
            const tall = high * wasm.arrived(k) / number;
            pen.fillStyle = colors.primary;
            pen.fillRect(left + 3, axis - tall, wide - 6, tall);
            pen.strokeStyle = colors.foreground;
            pen.lineWidth = 1.5;
            pen.beginPath();
            pen.moveTo(left, axis - high * law);
            pen.lineTo(left + wide, axis - high * law);
            pen.stroke();
            pen.fillStyle = colors.muted;
            pen.fillText(k, left + wide / 2, axis + 15);
        }
        pen.textAlign = "right";
        pen.fillText("flux that arrives at the k-th surface; lines: ρ to the power k − 1",
                     X(1), axis - high + 6);
    }

    // The first ones are seen; after three seconds more and more others are counted.
    figure.onFrame(time => {
        since = since === null ? time : since;
        const before = wasm.send(0);
        if (before < most) {
            if (time > next && flights.length < 10) launch(time);
            const more = time - since < 3000 ? 0 : Math.ceil(before / 60);
            wasm.send(Math.min(more, most - wasm.send(0)));
        }
        const number = wasm.send(0), colors = figure.colors;
        figure.clear(canvas);
        drawRoom(colors, time);
        drawBars(colors, number);
        sent.value = number.toLocaleString("en");
        met.value = (wasm.met() / number).toFixed(2) + ", exactly "
            + (1 / (1 - albedo.value)).toFixed(2);
        figure.tell(albedo.value);
        return number < most || flights.length > 0;
    });
});
