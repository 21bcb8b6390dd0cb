// Live: gather rays leave a point of the floor, and read irradiance points.
"use strict";

ljusLive.define("final_gathering", figure => {
    const { wasm } = figure;
    const canvas = figure.canvas(680, 530, "Gather rays from the floor of a room, the points " +
        "that they read, and the light that they find along the floor");
    const pen = canvas.getContext("2d");
    const scale = 310, floor = 352, axis = 515, high = 130, asked = 0.25, enough = 2000;
    const X = x => 340 + scale * x, Y = y => floor - scale * y;
    const rays = s => Math.round(2 ** s);

    const count = figure.slider("gather rays of each place", 0, 6, 0.5, 3,
        () => launch(), rays);
    figure.play(count, 12);
    const found = figure.readout("indirect light at the marked place");
    const truth = figure.readout("by many paths");
    const off = figure.readout("error along the floor, rms");

    const photons = wasm.setup();
    const dots = Array.from(figure.doubles(wasm.dots(), 2 * photons));
    const points = Array.from(figure.doubles(wasm.points(), 5 * wasm.points_size()));
    const places = wasm.curve_size();
    const place = i => wasm.curve_place(i);
    const curve = address => Array.from(figure.doubles(address, places));
    const seen = curve(wasm.seen());
    let flights = [], gathered = [], begun = null;
    function launch() {
        const n = rays(count.value);
        flights = Array.from({ length: n }, (_, i) =>
            Array.from(figure.doubles(wasm.ray(asked, i, n), 5)));
        gathered = curve(wasm.gathered(n));
        begun = null;
    }
    launch();

    function line(points, color, width, dash = []) {
        pen.strokeStyle = color;
        pen.lineWidth = width;
        pen.setLineDash(dash);
        pen.beginPath();
        for (const [x, y] of points) pen.lineTo(x, y);
        pen.stroke();
        pen.setLineDash([]);
    }
    function dot(x, y, radius, color) {
        pen.fillStyle = color;
        pen.beginPath();
        pen.arc(X(x), Y(y), radius, 0, 7);
        pen.fill();
    }

    // Rays start one after the other, and all are there after three seconds.
    function drawRoom(colors, time) {
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 1.5;
        pen.strokeRect(X(-1), Y(wasm.height()), 2 * scale, scale * wasm.height());
        dot(wasm.lamp_place(0), wasm.lamp_place(1), scale * wasm.lamp_place(2), colors.primary);
        pen.globalAlpha = 0.6;
        for (let i = 0; i < dots.length; i += 2) dot(dots[i], dots[i + 1], 1.5, colors.blue);
        pen.globalAlpha = 1;
        for (let i = 0; i < points.length; i += 5) // towards the inside, as long as bright
            line([[X(points[i]), Y(points[i + 1])],
                  [X(points[i] + 0.12 * points[i + 2] * points[i + 4]),
                   Y(points[i + 1] + 0.12 * points[i + 3] * points[i + 4])]],
                 colors.primary, 3);
        let flying = false;
        flights.forEach(([x, y, readX, readY, value], i) => {
            const away = (time - begun - 2000 * i / flights.length) / 500;
            const part = figure.along([[asked, 0], [x, y]], away);
            const there = away >= Math.hypot(x - asked, y);
            flying = flying || !there;
            pen.globalAlpha = there ? 0.7 : 1;
            line(part.map(([x, y]) => [X(x), Y(y)]), value > 0 ? colors.red : colors.muted, 1);
            pen.globalAlpha = 1;
            if (away > 0 && !there) dot(...part[1], 4, colors.red);
            if (there) line([[X(x), Y(y)], [X(readX), Y(readY)]], colors.red, 4);
        });
        dot(asked, 0, 5, colors.foreground);
        return flying;
    }

    figure.onFrame(time => {
        begun = begun === null ? time : begun;
        const counted = wasm.add_reference(0), colors = figure.colors;
        if (counted < enough) wasm.add_reference(20);
        const right = curve(wasm.reference());
        figure.clear(canvas);
        const flying = drawRoom(colors, time);
        const along = values => values.map((e, i) => [X(place(i)), axis - high * Math.min(e / 0.7, 1)]);
        line([[X(-1), axis], [X(1), axis]], colors.muted, 1);
        line(along(seen), colors.blue, 1.2, [4, 3]);
        line(along(right), colors.foreground, 1.2);
        line(along(gathered), colors.red, 2);
        pen.font = "13px sans-serif";
        [["gathered", colors.red], ["many paths", colors.foreground],
         ["dashed: the photons of the floor seen directly", colors.blue]].forEach(
            ([text, color], i) => {
                pen.fillStyle = color;
                pen.fillText(text, X(-1) + [0, 75, 160][i], axis - high - 8);
            });
        const i = Math.round((asked / 0.98 + 1) / 2 * (places - 1));
        const sum = gathered.reduce((sum, e, i) => sum + (e - right[i]) ** 2, 0);
        const here = flights.reduce((sum, one) => sum + one[4], 0) / flights.length;
        found.value = here.toFixed(3) + " W/m";
        truth.value = right[i].toFixed(3) + " W/m";
        off.value = Math.sqrt(sum / places).toFixed(3) + " W/m";
        figure.tell(rays(count.value));
        return flying || counted < enough;
    });
});
