// Live: a soap film by thickness and angle.
"use strict";

ljusLive.define("soap_film", figure => {
    const { wasm } = figure;
    const names = ["spectrum", "integrals", "three"];
    const thickest = 1500;
    const strips = figure.canvas(440, 178, "Colours of the film against its thickness");
    const plot = figure.canvas(440, 230, "The reflected part against the wavelength");
    const band = strips.getContext("2d"), pen = plot.getContext("2d");

    const thick = figure.slider("thickness", 0, thickest, 5, 300, null, d => d + " nm");
    const angle = figure.slider("angle", 0, 80, 1, 0, null, a => a + "°");
    const mean = figure.readout("of white light the film reflects");
    const limit = figure.readout("a very thick film");

    const left = 76, width = 356;
    figure.onDrag(strips, spot => {
        thick.value = spot.key ? thick.value + 5 * (spot.dx - spot.dy) / 8
            : (spot.x - left) / width * thickest;
    });

    function drawStrips(colors) {
        figure.clear(strips);
        band.font = "14px sans-serif";
        names.forEach((name, i) => {
            band.textAlign = "left";
            band.fillStyle = colors.foreground;
            band.fillText(name, 4, 27 + 48 * i);
            const row = figure.bytes(wasm.strip(i, angle.value, thickest), 4 * 200);
            figure.paint(strips, row, 200, 1, left, 2 + 48 * i, width, 44);
        });
        band.textAlign = "center";
        band.fillStyle = colors.muted;
        for (const d of [0, 500, 1000, 1500])
            band.fillText(d + (d === 1500 ? " nm" : ""),
                          Math.min(left + d / thickest * width, 410), 166);
        const x = left + thick.value / thickest * width;
        band.strokeStyle = colors.foreground;
        band.lineWidth = 2;
        band.strokeRect(x - 3, 1, 6, 144);
    }

    function drawPlot(colors) {
        const shares = Array.from(
            figure.floats(wasm.reflectance(angle.value, thick.value), 181));
        // The highest that a maximum can be, rounded up to something.
        const most = 2.2 * wasm.mean_reflected(angle.value);
        const top = [0.1, 0.2, 0.5, 1].find(t => t >= Math.min(1, most));
        const x = nm => left + (nm - 380) / 360 * width, y = r => 190 - r / top * 170;
        figure.clear(plot);
        figure.paint(plot, figure.bytes(wasm.rainbow(), 4 * 181), 181, 1,
                     left, 192, width, 10);
        pen.strokeStyle = colors.line;
        pen.fillStyle = colors.muted;
        pen.font = "13px sans-serif";
        pen.lineWidth = 1;
        pen.textAlign = "right";
        for (const part of [0, 0.5, 1]) {
            pen.beginPath();
            pen.moveTo(left, y(part * top));
            pen.lineTo(left + width, y(part * top));
            pen.stroke();
            pen.fillText(100 * part * top + " %", left - 6, y(part * top) + 4);
        }
        pen.textAlign = "center";
        for (const nm of [400, 500, 600, 700]) pen.fillText(nm + " nm", x(nm), 219);
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 2.5;
        pen.beginPath();
        shares.forEach((r, i) => pen.lineTo(x(380 + 2 * i), y(r)));
        pen.stroke();
        // What the eye makes of it.
        const [r, g, b] = figure.bytes(wasm.swatch(0, angle.value, thick.value), 4);
        pen.fillStyle = `rgb(${r}, ${g}, ${b})`;
        pen.fillRect(4, 70, 24, 70);
        pen.strokeStyle = colors.muted;
        pen.lineWidth = 1;
        pen.strokeRect(4, 70, 24, 70);
        pen.fillStyle = colors.muted;
        pen.textAlign = "left";
        pen.fillText("seen", 2, 158);
    }

    figure.onFrame(() => {
        const colors = figure.colors;
        drawStrips(colors);
        drawPlot(colors);
        const percent = part => (100 * part).toFixed(1) + " %";
        mean.value = percent(wasm.luminance_reflected(angle.value, thick.value));
        limit.value = percent(wasm.mean_reflected(angle.value));
        return false;
    });
});
