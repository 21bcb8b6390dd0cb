// Live: Flatland. Drag the lamp; photons land; a disc grows until it holds k of them.
"use strict";

ljusLive.define("flatland", figure => {
    const { wasm } = figure;
    const width = 700, floor = 380, scale = 320, axis = 565, high = 140;
    const canvas = figure.canvas(width, 590,
        "A room in two dimensions: a lamp, a mirror, a disc of glass, photons on the " +
        "walls, and below the floor the irradiance that they stand for");
    const pen = canvas.getContext("2d");
    const X = x => width / 2 + scale * x, Y = y => floor - scale * y;
    const [discX, discY, discR, mirrorX, mirrorY, mirrorToX, mirrorToY, height] =
        Array.from({ length: 8 }, (_, i) => wasm.room(i));
    const most = 300000; // photons of the reference

    const lamp = { x: -0.45, y: 0.95 };
    const query = { x: 0.5 };
    let picked = "query", trails = [], top = 0.5;
    const begin = () => {
        wasm.setup(lamp.x, lamp.y, index.value);
        trails = [];
    };
    const count = figure.slider("photons", 2, 4.3, 0.1, 3.3,
        () => { if (wasm.land(0) > wanted()) begin(); },
        e => Math.round(10 ** e).toLocaleString("en"));
    const wanted = () => Math.round(10 ** count.value);
    const nearest = figure.slider("k, the nearest", 3, 300, 1, 60);
    const index = figure.slider("index of the glass", 1, 2.2, 0.05, 1.5, begin,
                                n => n.toFixed(2));
    const paths = figure.toggle("paths of the last photons", true);
    const sent = figure.readout("photons sent");
    const found = figure.readout("by the k nearest");
    const counted = figure.readout("counted there");
    const radius = figure.readout("radius of the disc");
    begin();
    figure.keep(begin, lamp, "x", "y");
    figure.keep(null, query, "x");

    figure.onDrag(canvas, spot => {
        if (spot.first && !spot.key) picked = spot.y > floor - 45 ? "query" : "lamp";
        if (picked === "query") {
            const x = spot.key ? query.x + spot.dx / scale : (spot.x - width / 2) / scale;
            query.x = Math.max(-1, Math.min(1, x));
            return;
        }
        const x = lamp.x + spot.dx / scale, y = lamp.y - spot.dy / scale;
        if (!wasm.lamp_may_be(x, y)) return;
        Object.assign(lamp, { x, y });
        begin();
    });

    function line(points, color, thickness, dash = []) {
        pen.strokeStyle = color;
        pen.lineWidth = thickness;
        pen.setLineDash(dash);
        pen.beginPath();
        for (const [x, y] of points) pen.lineTo(x, y);
        pen.stroke();
        pen.setLineDash([]);
    }
    function disc(x, y, r, color, alpha) {
        pen.globalAlpha = alpha;
        pen.fillStyle = color;
        pen.beginPath();
        pen.arc(X(x), Y(y), r * scale, 0, 7);
        pen.fill();
        pen.globalAlpha = 1;
    }

    // The first photons one by one, then more and more at a time.
    function landSome() {
        const landed = wasm.land(0);
        const step = Math.min(Math.max(1, Math.floor(landed / 25)), wanted() - landed);
        if (step <= 0) return;
        wasm.land(step);
        const at = figure.floats(wasm.path(), 3 * wasm.path_size());
        trails.push(Array.from(at));
        if (trails.length > 12) trails.shift();
    }

    function drawRoom(colors) {
        const ink = [colors.blue, colors.primary, colors.green];
        disc(discX, discY, discR, colors.blue, 0.18);
        line([[X(-1), Y(0)], [X(1), Y(0)], [X(1), Y(height)], [X(-1), Y(height)],
              [X(-1), Y(0)]], colors.foreground, 1.5);
        line([[X(mirrorX), Y(mirrorY)], [X(mirrorToX), Y(mirrorToY)]],
             colors.foreground, 4);
        if (paths.value) trails.forEach((trail, age) => {
            pen.globalAlpha = 0.15 + 0.6 * age / trails.length;
            for (let i = 3; i < trail.length; i += 3)
                line([[X(trail[i - 3]), Y(trail[i - 2])],
                      [X(trail[i]), Y(trail[i + 1])]], ink[trail[i + 2]], 1);
            pen.globalAlpha = 1;
        });
        const dots = figure.floats(wasm.dots(), 3 * wasm.dots_size());
        pen.globalAlpha = dots.length > 9000 ? 0.35 : 0.8;
        for (let i = 0; i < dots.length; i += 3) {
            pen.fillStyle = ink[dots[i + 2]];
            pen.fillRect(X(dots[i]) - 1.5, Y(dots[i + 1]) - 1.5, 3, 3);
        }
        pen.globalAlpha = 1;
        disc(lamp.x, lamp.y, 0.03, colors.primary, 1);
    }

    function drawCurves(colors) {
        const bins = wasm.reference_size(), places = wasm.curve_size();
        const truth = Array.from(figure.floats(wasm.reference(), bins));
        const curve = Array.from(figure.floats(wasm.curve(nearest.value), places));
        const highest = Math.max(0.2, ...truth);
        top += (1.25 * highest - top) * 0.2; // without jumps
        const up = e => Math.max(axis - high, axis - high * e / top);
        line([[X(-1), axis - high], [X(-1), axis], [X(1), axis]], colors.muted, 1);
        const steps = [];
        truth.forEach((e, i) => steps.push([X(-1 + 2 * i / bins), up(e)],
                                           [X(-1 + 2 * (i + 1) / bins), up(e)]));
        line(steps, colors.muted, 1.5);
        line(curve.map((e, i) => [X(-1 + 2 * i / (places - 1)), up(e)]),
             colors.red, 2);
        pen.fillStyle = colors.muted;
        pen.textAlign = "left";
        pen.font = "13px sans-serif";
        pen.fillText("W/m: counted in parts of 2 cm", X(-1) + 8, axis - high + 10);
        pen.fillStyle = colors.red;
        pen.fillText("by the k nearest", X(-1) + 8, axis - high + 27);
        return truth[Math.min(bins - 1, Math.floor((query.x + 1) / 2 * bins))];
    }

    function drawQuery(colors) {
        const estimate = wasm.estimate(query.x, nearest.value), r = wasm.disc();
        disc(query.x, 0, r, colors.red, 0.2);
        const low = X(query.x - r), high = X(query.x + r);
        line([[low, floor], [high, floor]], colors.red, 4);
        line([[X(query.x), floor], [X(query.x), axis]], colors.red, 1, [3, 3]);
        found.value = estimate.toFixed(3) + " W/m";
        radius.value = (100 * r).toFixed(1) + " cm";
    }

    figure.onFrame(() => {
        const colors = figure.colors;
        landSome();
        let reference = wasm.count_reference(0);
        if (reference < most) reference = wasm.count_reference(2000);
        const before = top;
        figure.clear(canvas);
        drawRoom(colors);
        drawQuery(colors);
        counted.value = drawCurves(colors).toFixed(3) + " W/m";
        const landed = wasm.land(0);
        sent.value = landed.toLocaleString("en");
        return landed < wanted() || reference < most || Math.abs(top - before) > 1e-3;
    });
});
