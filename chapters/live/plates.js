// Live: Veach's plates by three ways to find a lamp, refining side by side.
"use strict";

ljusLive.define("plates", figure => {
    const { wasm } = figure;
    const width = wasm.picture_width(), height = wasm.picture_height();
    const most = 512; // samples per pixel
    const ways = ["paths alone", "shadow rays", "both, weighted"];
    const pictures = ways.map(way => figure.canvas(258, 172, "Veach's plates by " + way));

    const rough = figure.slider("roughness of all plates", -1.5, 1.5, 0.25, 0,
                                e => wasm.restart(2 ** e), e => "× " + (2 ** e).toFixed(2));
    const shares = figure.toggle("colour: who found the light", false,
                                 on => wasm.show_all(on ? 1 : 0));
    const samples = figure.readout("samples per pixel");
    const noise = ways.map(way => figure.readout("noise in the square: " + way));
    wasm.restart(1);

    const spot = { x: 124, y: 50 }; // the largest lamp in the smoothest plate
    figure.keep(null, spot, "x", "y");
    const move = to => {
        if (to.key) {
            spot.x += Math.sign(to.dx);
            spot.y += Math.sign(to.dy);
        } else {
            spot.x = Math.floor(to.x / 258 * width);
            spot.y = Math.floor(to.y / 172 * height);
        }
        spot.x = Math.max(3, Math.min(width - 4, spot.x));
        spot.y = Math.max(2, Math.min(height - 3, spot.y));
    };
    for (const picture of pictures) figure.onDrag(picture, move);

    let address = 0;
    figure.onFrame(() => {
        const end = performance.now() + 14;
        while (wasm.sample_count() < most && performance.now() < end)
            address = wasm.trace_row(shares.value ? 1 : 0);
        const bytes = 4 * width * height;
        pictures.forEach((picture, way) => {
            const pen = picture.getContext("2d");
            figure.paint(picture, figure.bytes(address + way * bytes, bytes), width, height);
            pen.strokeStyle = "white";
            pen.lineWidth = 1.5;
            pen.strokeRect((spot.x - 3) / width * 258, (spot.y - 2) / height * 172,
                           7 / width * 258, 5 / height * 172);
            pen.font = "bold 13px sans-serif";
            pen.fillStyle = "white";
            pen.shadowColor = "black";
            pen.shadowBlur = 4;
            pen.fillText(ways[way], 8, 166);
            pen.shadowBlur = 0;
            noise[way].value = (100 * wasm.noise(way, spot.x, spot.y)).toFixed(0) + " %";
        });
        samples.value = wasm.sample_count();
        return wasm.sample_count() < most;
    });
});
