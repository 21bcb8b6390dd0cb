// Live: the lobe of a rough surface and a ball of it. The page says which surfaces:
// data-surface="matt" or "gloss".
"use strict";

ljusLive.define("lobes", figure => {
    const { wasm } = figure;
    const matt = figure.box.dataset.surface !== "gloss";
    const models = matt
        ? [{ name: "Oren and Nayar, 1994", id: 1 }, { name: "EON", id: 2 }]
        : [{ name: "GGX", id: 3 }];
    const polar = figure.canvas(420, 260,
        "How bright the surface is, seen from each side");
    const disc = figure.canvas(260, 260,
        "A ball of the surface, lit by a distant lamp");
    const pen = polar.getContext("2d");

    const roughness = figure.slider("roughness", matt ? 0 : 0.1, 1, 0.01,
                                    matt ? 0.7 : 0.6, null, r => r.toFixed(2));
    const angle = figure.slider("angle of the light", 0, 85, 1, matt ? 60 : 45, null,
                                a => a + "°");
    const model = matt
        ? figure.choice("ball", ["Lambert", ...models.map(m => m.name)], 1) : null;
    const returned = models.map(m => figure.readout(
        matt ? "returned, " + m.name : "returned by white facets"));

    const foot = { x: 210, y: 236 };
    figure.onDrag(polar, spot => {
        angle.value = spot.key ? angle.value - (spot.dx + spot.dy) / 8
            : Math.abs(Math.atan2(foot.x - spot.x, Math.max(1, foot.y - spot.y)))
                * 180 / Math.PI;
    });

    function arrow(degrees, from, to, color) {
        const a = degrees * Math.PI / 180, x = -Math.sin(a), y = -Math.cos(a);
        const at = r => [foot.x + r * x, foot.y + r * y];
        pen.strokeStyle = pen.fillStyle = color;
        pen.lineWidth = 3;
        pen.beginPath();
        pen.moveTo(...at(from));
        pen.lineTo(...at(to + 10));
        pen.stroke();
        pen.beginPath();
        pen.moveTo(...at(to));
        const [bx, by] = at(to + 13);
        pen.lineTo(bx - 5 * y, by + 5 * x);
        pen.lineTo(bx + 5 * y, by - 5 * x);
        pen.fill();
    }

    function drawPolar(colors) {
        const curves = models.map(m => Array.from(figure.floats(
            wasm.lobe_curve(m.id, roughness.value, angle.value), 181)));
        const inks = [colors.green, colors.red];
        // The longest of what is shown fits: Lambert, or the lobe; but for a few degrees
        // at the horizon, where the model of 1994 has no bound.
        const open = matt ? 6 : 0;
        const largest = Math.max(
            1.25, ...curves.flatMap(curve => curve.slice(open, 181 - open)));
        const scale = 195 / largest;
        figure.clear(polar);
        pen.save();
        pen.beginPath();
        pen.rect(0, 0, 420, foot.y);
        pen.clip();
        pen.strokeStyle = colors.muted;
        pen.lineWidth = 1.5;
        pen.setLineDash([5, 4]);
        pen.beginPath();
        pen.arc(foot.x, foot.y, scale, Math.PI, 2 * Math.PI);
        pen.stroke();
        pen.setLineDash([]);
        curves.forEach((curve, i) => {
            pen.beginPath();
            pen.moveTo(foot.x, foot.y);
            curve.forEach((f, k) => {
                const a = 0.995 * (k - 90) * Math.PI / 180;
                pen.lineTo(foot.x + scale * f * Math.sin(a),
                           foot.y - scale * f * Math.cos(a));
            });
            pen.closePath();
            pen.fillStyle = pen.strokeStyle = inks[i];
            pen.globalAlpha = 0.15;
            pen.fill();
            pen.globalAlpha = 1;
            pen.lineWidth = 2.5;
            pen.stroke();
        });
        pen.restore();
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 1.5;
        pen.beginPath();
        pen.moveTo(10, foot.y);
        pen.lineTo(410, foot.y);
        pen.stroke();
        arrow(angle.value, 200, 20, colors.blue);
        pen.font = "13px sans-serif";
        models.forEach((m, i) => {
            pen.fillStyle = inks[i];
            pen.fillText(m.name, 8, 16 + 17 * i);
        });
        pen.fillStyle = colors.muted;
        pen.fillText("dashed: Lambert", 8, 16 + 17 * models.length);
        pen.textAlign = "right";
        if (largest > 1.3)
            pen.fillText("longest: " + largest.toPrecision(2) + " × Lambert", 412,
                         254);
        pen.textAlign = "left";
    }

    figure.onFrame(() => {
        drawPolar(figure.colors);
        const id = matt ? model.value : models[0].id;
        figure.clear(disc);
        figure.paint(disc, figure.bytes(wasm.ball(id, roughness.value, angle.value),
                                        4 * 200 * 200), 200, 200, 10, 10, 240, 240);
        models.forEach((m, i) => {
            const part = wasm.albedo(m.id, roughness.value, angle.value);
            returned[i].value = (100 * part).toFixed(1) + " %";
        });
        return false;
    });
});
