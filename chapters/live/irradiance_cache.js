// Live: points of an irradiance cache, how far they count, and the light between them.
"use strict";

ljusLive.define("irradiance_cache", figure => {
    const { wasm } = figure;
    const canvas = figure.canvas(680, 520, "Points on a floor beside a bright wall, how far " +
        "each of them counts, and the light that is interpolated between them");
    const pen = canvas.getContext("2d");
    const scale = 265, floor = 300, axis = 505, high = 165;
    const X = x => 30 + scale * x, Y = y => floor - scale * y;

    const reach = figure.slider("reach a", -1.3, 0.3, 0.05, -0.3, null,
        e => (10 ** e).toFixed(2));
    figure.play(reach, 14);
    const anew = figure.readout("places that gather for themselves");
    const off = figure.readout("error of the others, rms");

    const number = wasm.setup(), places = wasm.curve_size(), wide = wasm.width_of_floor();
    const points = Array.from({ length: number }, (_, i) => {
        const ends = figure.pairs(figure.doubles(wasm.ends(i), 2 * wasm.ends_size()));
        return { x: wasm.point(i, 0), light: wasm.point(i, 1), far: wasm.point(i, 2), ends };
    });
    const exact = Array.from(figure.doubles(wasm.exact(), places));
    let begun = null;

    function line(points, color, width) {
        pen.strokeStyle = color;
        pen.lineWidth = width;
        pen.beginPath();
        for (const [x, y] of points) pen.lineTo(x, y);
        pen.stroke();
    }

    // The points gather one after the other; then each counts as far as it may.
    function drawRoom(colors, a, time) {
        pen.save();
        pen.beginPath();
        pen.rect(0, 0, 680, floor + 6);
        pen.clip();
        let busy = false;
        points.forEach(({ x, far, ends }, i) => {
            const away = (time - begun - 300 * i) / 600;
            busy = busy || away < 2;
            if (away < 0) return;
            pen.globalAlpha = 1 - Math.max(0, Math.min(1, away - 1));
            if (away < 2) for (const end of ends) {
                const part = figure.along([[x, 0], end], 1.5 * away);
                line(part.map(([x, y]) => [X(x), Y(y)]), colors.primary, 1);
            }
            pen.globalAlpha = 1;
            if (away > 1) {
                pen.strokeStyle = pen.fillStyle = colors.blue;
                pen.lineWidth = 1;
                pen.beginPath();
                pen.arc(X(x), Y(0), scale * a * far, Math.PI, 2 * Math.PI);
                pen.stroke();
                pen.globalAlpha = 0.04;
                pen.fill();
                pen.globalAlpha = 1;
            }
            pen.fillStyle = colors.blue;
            pen.beginPath();
            pen.arc(X(x), Y(0), 4, 0, 7);
            pen.fill();
        });
        pen.restore();
        line([[X(wide), Y(1)], [X(0), Y(1)]], colors.foreground, 1.5);
        line([[X(0), Y(0)], [X(wide), Y(0)]], colors.foreground, 1.5);
        line([[X(0), Y(1)], [X(0), Y(0)]], colors.primary, 6);
        return busy;
    }

    function drawCurves(colors, between) {
        const up = e => axis - high * e / 0.5;
        line([[X(0), axis], [X(wide), axis]], colors.muted, 1);
        line(exact.map((e, i) => [X(wasm.curve_place(i)), up(e)]), colors.foreground, 1.2);
        for (let i = 0; i < places; ++i) { // in parts, each between places that gather
            const part = [];
            for (; i < places && between[i] >= 0; ++i)
                part.push([X(wasm.curve_place(i)), up(between[i])]);
            if (part.length > 0) line(part, colors.red, 2.5);
            if (i < places) {
                pen.fillStyle = colors.green;
                pen.fillRect(X(wasm.curve_place(i)) - 1.2, up(exact[i]) - 2.5, 2.4, 5);
            }
        }
        pen.fillStyle = colors.blue;
        for (const { x, light } of points) {
            pen.beginPath();
            pen.arc(X(x), up(light), 3, 0, 7);
            pen.fill();
        }
        pen.font = "13px sans-serif";
        [["interpolated", colors.red], ["gathered there", colors.green],
         ["right", colors.foreground]].forEach(([text, color], i) => {
            pen.fillStyle = color;
            pen.fillText(text, X(wide) - 110, axis - high + 20 + 17 * i);
        });
    }

    figure.onFrame(time => {
        begun = begun === null ? time : begun;
        const a = 10 ** reach.value, colors = figure.colors;
        const between = Array.from(figure.doubles(wasm.interpolated(a), places));
        figure.clear(canvas);
        const busy = drawRoom(colors, a, time);
        drawCurves(colors, between);
        const errors = between.map((e, i) => e / exact[i] - 1).filter(e => e > -1);
        anew.value = places - errors.length + " of " + places;
        const sum = errors.reduce((sum, e) => sum + e * e, 0);
        off.value = errors.length
            ? (100 * Math.sqrt(sum / errors.length)).toFixed(1) + " %" : "none";
        figure.tell(a);
        return busy;
    });
});
