// Live: drag the ray that meets a boundary.
"use strict";

ljusLive.define("refraction", figure => {
    const { wasm } = figure;
    const picture = figure.canvas(440, 310,
        "A ray meets a boundary; a part is reflected, the rest refracted");
    const plot = figure.canvas(260, 310, "The reflected share against the angle");
    const light = picture.getContext("2d"), curve = plot.getContext("2d");

    const angle = figure.slider("angle", 0, 90, 0.5, 46, null,
                                a => a.toFixed(1) + "°");
    const index = figure.slider("index of the glass", 1, 2.5, 0.01, 1.5, null,
                                n => n.toFixed(2));
    const side = figure.choice("the ray comes", ["from the air", "from the glass"], 0);
    const bent = figure.readout("refracted");
    const share = figure.readout("reflected");

    const middle = { x: 220, y: 150 };
    figure.onDrag(picture, spot => {
        if (spot.key) { // right and up: away from the normal
            angle.value += (spot.dx - spot.dy) / 8;
            return;
        }
        const a = Math.atan2(Math.abs(middle.x - spot.x), Math.abs(middle.y - spot.y));
        angle.value = a * 180 / Math.PI;
    });

    function ray(from, to, color, width) {
        if (width < 0.1) return;
        const length = Math.hypot(to.x - from.x, to.y - from.y);
        const x = (to.x - from.x) / length, y = (to.y - from.y) / length;
        const tip = 5 + 2 * width;
        light.strokeStyle = light.fillStyle = color;
        light.lineWidth = width;
        light.beginPath();
        light.moveTo(from.x, from.y);
        light.lineTo(to.x - tip * x, to.y - tip * y);
        light.stroke();
        light.beginPath();
        light.moveTo(to.x, to.y);
        light.lineTo(to.x - tip * x - tip / 2.5 * y, to.y - tip * y + tip / 2.5 * x);
        light.lineTo(to.x - tip * x + tip / 2.5 * y, to.y - tip * y - tip / 2.5 * x);
        light.fill();
    }

    function drawLight(colors, degrees, out, reflected) {
        const a = degrees * Math.PI / 180;
        const glass = side.value === 0 ? 150 : 0;
        figure.clear(picture);
        light.fillStyle = colors.blue;
        light.globalAlpha = 0.15;
        light.fillRect(0, glass, 440, side.value === 0 ? 160 : 150);
        light.globalAlpha = 1;
        light.strokeStyle = colors.foreground;
        light.lineWidth = 1.5;
        light.beginPath();
        light.moveTo(0, 150);
        light.lineTo(440, 150);
        light.moveTo(220, 30);
        light.lineTo(220, 290);
        light.stroke();
        const far = 140;
        ray({ x: 220 - far * Math.sin(a), y: 150 - far * Math.cos(a) }, middle,
            colors.blue, 5);
        ray(middle, { x: 220 + far * Math.sin(a), y: 150 - far * Math.cos(a) },
            colors.green, 5 * reflected);
        if (out >= 0) {
            const b = out * Math.PI / 180;
            ray(middle, { x: 220 + far * Math.sin(b), y: 150 + far * Math.cos(b) },
                colors.red, 5 * (1 - reflected));
        }
        light.fillStyle = colors.foreground;
        light.font = "15px sans-serif";
        light.fillText("air", 10, side.value === 0 ? 140 : 170);
        light.fillText("glass", 10, side.value === 0 ? 170 : 140);
    }

    function drawCurves(colors, degrees, n1, n2) {
        const shares = figure.floats(wasm.share_curves(n1, n2), 182);
        const x = d => 34 + d / 90 * 214, y = r => 270 - r * 240;
        figure.clear(plot);
        curve.strokeStyle = colors.line;
        curve.fillStyle = colors.muted;
        curve.font = "13px sans-serif";
        curve.textAlign = "center";
        curve.lineWidth = 1;
        curve.setLineDash([]);
        for (const d of [0, 30, 60, 90]) {
            curve.beginPath();
            curve.moveTo(x(d), y(0));
            curve.lineTo(x(d), y(1));
            curve.stroke();
            curve.fillText(d + "°", Math.min(x(d), 240), 288);
        }
        for (const r of [0, 0.5, 1]) {
            curve.beginPath();
            curve.moveTo(x(0), y(r));
            curve.lineTo(x(90), y(r));
            curve.stroke();
            curve.fillText(r, 16, y(r) + 5);
        }
        for (const model of [1, 0]) { // Schlick below the exact one
            curve.strokeStyle = model === 0 ? colors.green : colors.muted;
            curve.setLineDash(model === 0 ? [] : [4, 4]);
            curve.lineWidth = model === 0 ? 2.5 : 1.5;
            curve.beginPath();
            for (let d = 0; d <= 90; ++d) curve.lineTo(x(d), y(shares[91 * model + d]));
            curve.stroke();
        }
        curve.setLineDash([]);
        curve.fillStyle = colors.green;
        curve.beginPath();
        curve.arc(x(degrees), y(wasm.reflected(degrees, n1, n2)), 5, 0, 7);
        curve.fill();
        curve.textAlign = "left";
        curve.fillText("reflected, exact", 44, 48);
        curve.fillStyle = colors.muted;
        curve.fillText("Schlick", 44, 66);
    }

    figure.onFrame(() => {
        const n1 = side.value === 0 ? 1 : index.value;
        const n2 = side.value === 0 ? index.value : 1;
        const out = wasm.refracted(angle.value, n1, n2);
        const reflected = wasm.reflected(angle.value, n1, n2);
        const colors = figure.colors;
        drawLight(colors, angle.value, out, reflected);
        drawCurves(colors, angle.value, n1, n2);
        bent.value = out < 0 ? "total internal reflection" : out.toFixed(1) + "°";
        share.value = (100 * reflected).toFixed(1) + " %";
        return false;
    });
});
