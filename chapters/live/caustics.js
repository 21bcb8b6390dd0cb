// Live: photons fly through a ball of glass and gather on the floor.
"use strict";

ljusLive.define("caustics", figure => {
    const { wasm } = figure;
    const canvas = figure.canvas(680, 540, "Photons from a lamp through a ball of glass to " +
        "the floor, and how bright they make it");
    const pen = canvas.getContext("2d");
    const [lamp, ball, radius, wide] = [0, 1, 2, 3].map(i => wasm.place(i));
    const scale = 330 / wide, floor = 405, axis = 530, high = 110, brightest = 16, most = 3000;
    const X = x => 340 + scale * x, Y = y => floor - scale * y;

    const index = figure.slider("index of the ball", 1, 2.4, 0.02, 1.5,
        () => begin(500), n => n.toFixed(2));
    figure.play(index, 14);
    const sent = figure.readout("photons");
    const peak = figure.readout("the brightest place, against the floor without a ball");

    let trails = [], flights = [], next = 0, rate = 1;
    function send() {
        wasm.send();
        const path = figure.pairs(figure.floats(wasm.path(), 2 * wasm.path_size()));
        trails.push(path);
        return path;
    }
    // A new ball gets some photons at once, to be compared with the one before.
    function begin(photons) {
        wasm.setup(index.value);
        trails = [];
        flights = [];
        rate = 1;
        for (let i = 0; i < photons; ++i) send();
    }
    begin(0);

    function line(points, x, y) {
        pen.beginPath();
        for (const one of points) pen.lineTo(x(one[0]), y(one[1]));
        pen.stroke();
    }
    function drawScene(colors, time) {
        pen.globalAlpha = 0.15;
        pen.fillStyle = colors.blue;
        pen.beginPath();
        pen.arc(X(0), Y(ball), scale * radius, 0, 7);
        pen.fill();
        pen.globalAlpha = Math.max(0.05, 0.5 / (1 + trails.length / 60));
        pen.strokeStyle = colors.primary;
        pen.lineWidth = 1;
        const seen = trails.slice(-600), flying = new Set(flights.map(one => one.path));
        for (const path of seen) if (!flying.has(path)) line(path, X, Y);
        pen.globalAlpha = 1;
        pen.fillStyle = colors.primary;
        flights = flights.filter(({ path, time: since }) => {
            const part = figure.along(path, (time - since) / 500);
            const [x, y] = part[part.length - 1];
            pen.globalAlpha = 0.4;
            line(part, X, Y);
            pen.globalAlpha = 1;
            pen.beginPath();
            pen.arc(X(x), Y(y), 4, 0, 7);
            pen.fill();
            return part.length < path.length || time - since < 1000;
        });
        pen.beginPath();
        pen.arc(X(0), Y(lamp), 6, 0, 7);
        pen.fill();
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 2;
        line([[-wide, 0], [wide, 0]], X, Y);
    }

    figure.onFrame(time => {
        const colors = figure.colors, before = trails.length;
        if (before < most && time > next) {
            for (let i = 0; i < rate; ++i) {
                const path = send();
                if (i < 2 && path.length > 1) flights.push({ path, time });
            }
            rate = Math.max(1, Math.round(trails.length / 60));
            next = time + 120;
        }
        figure.clear(canvas);
        drawScene(colors, time);
        const places = wasm.curve_size();
        const curve = Array.from(figure.floats(wasm.curve(), places));
        pen.strokeStyle = colors.muted;
        pen.lineWidth = 1;
        line([[-wide, 1], [wide, 1]], X, e => axis - high * e / brightest);
        pen.strokeStyle = colors.red;
        pen.lineWidth = 2;
        line(curve.map((e, i) => [wide * (2 * i / (places - 1) - 1), e]), X,
             e => axis - high * Math.min(e / brightest, 1));
        pen.fillStyle = colors.muted;
        pen.font = "13px sans-serif";
        pen.fillText("light of the floor; grey: its middle without a ball", X(-wide),
                     axis - high + 10);
        sent.value = trails.length.toLocaleString("en");
        peak.value = Math.max(...curve).toFixed(1) + " times";
        figure.tell(index.value);
        return trails.length < most || flights.length > 0;
    });
});
