// Live: a patch moves away from a lamp; irradiance falls, radiance does not.
"use strict";

ljusLive.define("radiance", figure => {
    const { wasm } = figure;
    const side = figure.canvas(680, 240, "A lamp, its photons, and a patch that catches some");
    const seen = figure.canvas(200, 200, "The lamp as the middle of the patch sees it");
    const bars = figure.canvas(460, 200, "Irradiance, solid angle and radiance against " +
                               "those at the least distance");
    const pen = side.getContext("2d"), plot = bars.getContext("2d");
    const pixels = wasm.picture_size(), most = 1000000, near = 0.8, scale = 140;
    const X = x => 70 + scale * x, Y = y => 120 - scale * y;

    const distance = figure.slider("distance of the patch", near, 4, 0.05, near,
        () => begin(), r => r.toFixed(2) + " m");
    figure.play(distance, 12);
    const caught = figure.readout("photons on the patch");
    const irradiance = figure.readout("irradiance");
    const angle = figure.readout("solid angle of the lamp");
    const radiance = figure.readout("radiance of the lamp");

    wasm.setup(near);
    const nearest = wasm.solid_angle();
    wasm.send(most);
    const atNearest = wasm.counted();
    let flights = [], marks = [], next = 0, number = 0;
    function begin() {
        wasm.setup(distance.value);
        wasm.send(50000);
        flights = [];
        marks = [];
    }
    begin();

    function drawSide(colors, time) {
        for (; next < time; next = Math.max(next, time - 100) + 12) {
            const [x, y, dx, dy, t] = figure.doubles(wasm.shown(++number), 5);
            flights.push({ x, y, dx, dy, t, time });
        }
        figure.clear(side);
        pen.fillStyle = pen.strokeStyle = colors.primary;
        pen.beginPath();
        pen.arc(X(0), Y(0), scale * wasm.lamp_radius(), 0, 7);
        pen.fill();
        flights = flights.filter(one => {
            const gone = (time - one.time) / 700, stopped = one.t > 0 && gone >= one.t;
            if (stopped) marks.push(one.y + one.t * one.dy);
            const x = one.x + gone * one.dx, y = one.y + gone * one.dy;
            pen.globalAlpha = one.t > 0 ? 1 : 0.45;
            pen.beginPath();
            pen.arc(X(x), Y(y), one.t > 0 ? 3.5 : 2.5, 0, 7);
            pen.fill();
            return !stopped && Math.abs(x) < 4.4 && Math.abs(y) < 0.9;
        });
        pen.globalAlpha = 1;
        marks = marks.slice(-100);
        pen.fillStyle = colors.red;
        for (const y of marks) pen.fillRect(X(distance.value) - 8, Y(y) - 1.5, 8, 3);
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 4;
        pen.beginPath();
        pen.moveTo(X(distance.value), Y(-0.25));
        pen.lineTo(X(distance.value), Y(0.25));
        pen.stroke();
    }

    function drawSeen() {
        const values = figure.floats(wasm.picture(), pixels * pixels);
        const bytes = new Uint8ClampedArray(4 * pixels * pixels);
        values.forEach((value, i) => bytes.set(value > 0 ? [255, 214, 140, 255]
                                                          : [0, 0, 0, 255], 4 * i));
        figure.paint(seen, bytes, pixels, pixels);
    }

    function drawBars(colors) {
        figure.clear(bars);
        plot.font = "14px sans-serif";
        [["irradiance", wasm.counted() / atNearest, colors.red],
         ["solid angle", wasm.solid_angle() / nearest, colors.blue],
         ["radiance", 1, colors.primary]].forEach(([label, part, color], i) => {
            const y = 20 + 60 * i;
            plot.fillStyle = colors.foreground;
            plot.textAlign = "right";
            plot.fillText(label, 90, y + 22);
            plot.fillStyle = color;
            plot.fillRect(100, y, 290 * part, 34);
            plot.textAlign = "left";
            plot.fillStyle = colors.foreground;
            plot.fillText(part < 1 ? part.toFixed(3) : "1", 108 + 290 * part, y + 22);
        });
    }

    figure.onFrame(time => {
        if (wasm.send(0) < most) wasm.send(20000);
        drawSide(figure.colors, time);
        drawSeen();
        drawBars(figure.colors);
        caught.value = wasm.caught().toLocaleString("en") + " of "
            + wasm.send(0).toLocaleString("en");
        irradiance.value = wasm.counted().toFixed(2) + " W/m²";
        angle.value = wasm.solid_angle().toFixed(4) + " sr";
        radiance.value = wasm.radiance().toFixed(1) + " W/(m² sr)";
        figure.tell(distance.value);
        return number < 4000 || flights.length > 0;
    });
});
