// Live: a ball moves away, and float loses it.
"use strict";

ljusLive.define("sphere", figure => {
    const { wasm } = figure;
    const size = 240;
    const labels = ["as printed", "robust"];
    const pictures = labels.map(label =>
        figure.canvas(280, 304, "The ball, by the formula " + label));

    const far = figure.slider("distance", 0.5, 6.5, 0.05, 3, null,
        x => Math.round(10 ** x).toLocaleString("en") + " R");
    const mark = figure.toggle("wrong answers in red", true);
    const shares = labels.map(label => figure.readout("wrong, " + label));
    const apart = figure.readout("floats near L² are apart by");

    const eye = { azimuth: 0.6, height: 0.5 };
    figure.keep(null, eye, "azimuth", "height");
    for (const canvas of pictures)
        figure.onDrag(canvas, spot => {
            eye.azimuth -= spot.dx / 100;
            eye.height = Math.max(-1.5, Math.min(1.5, eye.height + spot.dy / 100));
        });

    figure.onFrame(() => {
        const colors = figure.colors;
        const distance = 10 ** far.value;
        pictures.forEach((canvas, robust) => {
            const address = wasm.telescope(robust, distance, eye.azimuth, eye.height,
                                           mark.value ? 1 : 0);
            figure.clear(canvas);
            figure.paint(canvas, figure.bytes(address, 4 * size * size), size, size,
                         0, 24, 280, 280);
            const context = canvas.getContext("2d");
            context.fillStyle = colors.foreground;
            context.font = "15px sans-serif";
            context.fillText(labels[robust] + ", in float", 2, 16);
            shares[robust].value = (100 * wasm.wrong()).toPrecision(2) + " %";
        });
        apart.value = wasm.spacing(distance)
            .toLocaleString("en", { maximumSignificantDigits: 2 }) + " R²";
        return false;
    });
});
