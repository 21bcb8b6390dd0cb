// Live: Fresnel and Schlick for any two media.
"use strict";

ljusLive.define("fresnel", figure => {
    const { wasm } = figure;
    const plot = figure.canvas(420, 300, "The reflected share against the angle");
    const disc = figure.canvas(280, 300, "What one sees who looks at the boundary");
    const pen = plot.getContext("2d"), eye = disc.getContext("2d");
    const names = ["exact", "Schlick, thinner side", "Schlick, as printed"];

    const index = n => n.toFixed(2);
    const n1 = figure.slider("n₁, where the light is", 1, 2.5, 0.01, 1.5, null,
                             index);
    const n2 = figure.slider("n₂, behind the boundary", 1, 2.5, 0.01, 1, null, index);
    const angle = figure.slider("angle", 0, 90, 0.5, 60, null,
                                a => a.toFixed(1) + "°");
    figure.play(angle, 12);
    const formula = figure.choice("the disc is by", names, 0);
    const shares = names.map(name => figure.readout(name));
    const critical = figure.readout("critical angle");

    const x = d => 36 + d / 90 * 372, y = r => 268 - r * 250;
    figure.onDrag(plot, spot => {
        angle.value = spot.key ? angle.value + (spot.dx - spot.dy) / 8
            : (spot.x - 36) / 372 * 90;
    });
    figure.onDrag(disc, spot => {
        angle.value = spot.key ? angle.value + (spot.dx - spot.dy) / 8
            : Math.hypot(spot.x - 140, spot.y - 160) / 138 * 90;
    });

    function drawPlot(colors) {
        const curves = figure.floats(wasm.share_curves(n1.value, n2.value), 3 * 181);
        const styles = [colors.green, colors.primary, colors.red];
        figure.clear(plot);
        pen.strokeStyle = colors.line;
        pen.fillStyle = colors.muted;
        pen.font = "13px sans-serif";
        pen.lineWidth = 1;
        pen.setLineDash([]);
        pen.textAlign = "center";
        for (const d of [0, 15, 30, 45, 60, 75, 90]) {
            pen.beginPath();
            pen.moveTo(x(d), y(0));
            pen.lineTo(x(d), y(1));
            pen.stroke();
            pen.fillText(d + "°", Math.min(x(d), 404), 286);
        }
        for (const r of [0, 0.25, 0.5, 0.75, 1]) {
            pen.beginPath();
            pen.moveTo(x(0), y(r));
            pen.lineTo(x(90), y(r));
            pen.stroke();
            pen.fillText(r, 18, y(r) + 5);
        }
        for (const i of [2, 1, 0]) {
            pen.strokeStyle = styles[i];
            pen.lineWidth = i === 0 ? 3 : 2;
            pen.setLineDash([[], [8, 4], [2, 3]][i]);
            pen.beginPath();
            for (let k = 0; k <= 180; ++k) pen.lineTo(x(k / 2), y(curves[181 * i + k]));
            pen.stroke();
        }
        pen.setLineDash([]);
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 1;
        pen.beginPath();
        pen.moveTo(x(angle.value), y(0));
        pen.lineTo(x(angle.value), y(1));
        pen.stroke();
        pen.textAlign = "left";
        names.forEach((name, i) => {
            pen.fillStyle = styles[i];
            pen.fillText(name, 46, 36 + 18 * i);
            pen.beginPath();
            const share = wasm.reflected(i, angle.value, n1.value, n2.value);
            pen.arc(x(angle.value), y(share), i === 0 ? 5 : 3.5, 0, 7);
            pen.fill();
        });
    }

    function drawDisc(colors) {
        figure.clear(disc);
        figure.paint(disc, figure.bytes(wasm.view(formula.value, n1.value, n2.value),
                                        4 * 240 * 240), 240, 240, 2, 22, 276, 276);
        eye.strokeStyle = colors.foreground;
        eye.lineWidth = 1.5;
        eye.beginPath();
        eye.arc(140, 160, angle.value / 90 * 138, 0, 7);
        eye.stroke();
        eye.font = "14px sans-serif";
        eye.fillStyle = colors.foreground;
        eye.fillText("orange: through, blue: mirrored", 2, 15);
    }

    figure.onFrame(() => {
        const colors = figure.colors;
        drawPlot(colors);
        drawDisc(colors);
        shares.forEach((output, i) => {
            output.value = (100 * wasm.reflected(i, angle.value, n1.value, n2.value))
                .toFixed(1) + " %";
        });
        const limit = wasm.critical_angle(n1.value, n2.value);
        critical.value = limit < 90 ? limit.toFixed(1) + "°" : "none";
        return false;
    });
});
