// Live: a point of a triangle and its weights.
"use strict";

ljusLive.define("triangle", figure => {
    const { wasm } = figure;
    const plane = figure.canvas(420, 320,
        "A triangle, a point P, and the areas between P and each two corners");
    const pen = plane.getContext("2d");

    const show = figure.choice("inside", ["three areas", "colours by the weights"], 0);
    const outputs = ["weight of V₁, 1 − u − v", "of V₂, u", "of V₃, v"].map(
        label => figure.readout(label));
    const verdict = figure.readout("the ray at P");
    const area = figure.readout("area");

    // P, then the corners.
    const spots = [{ x: 190, y: 180 }, { x: 60, y: 260 }, { x: 360, y: 285 },
                   { x: 185, y: 45 }];
    const names = ["P", "V₁", "V₂", "V₃"];
    for (const spot of spots) figure.keep(null, spot, "x", "y");
    let held = 0;
    figure.onDrag(plane, spot => {
        if (spot.key) { // Enter goes on to the next point
            if (!spot.moved) held = (held + 1) % spots.length;
        } else if (spot.first) {
            const distance = s => Math.hypot(s.x - spot.x, s.y - spot.y);
            held = [1, 2, 3].filter(i => distance(spots[i]) < 24)
                .sort((i, k) => distance(spots[i]) - distance(spots[k]))[0] || 0;
        }
        const to = spot.key ? { x: spots[held].x + spot.dx, y: spots[held].y + spot.dy }
            : held === 0 || spot.moved ? spot : spots[held];
        Object.assign(spots[held], { x: Math.max(8, Math.min(412, to.x)),
                                     y: Math.max(8, Math.min(312, to.y)) });
    });

    function line(a, b, color, width, dash) {
        pen.strokeStyle = color;
        pen.lineWidth = width;
        pen.setLineDash(dash || []);
        pen.beginPath();
        pen.moveTo(a.x, a.y);
        pen.lineTo(b.x, b.y);
        pen.stroke();
    }

    // The straight line through two points, as far as the picture goes.
    function longLine(a, b, color) {
        const x = b.x - a.x, y = b.y - a.y, far = 1000 / Math.max(1, Math.hypot(x, y));
        line({ x: a.x - far * x, y: a.y - far * y },
             { x: b.x + far * x, y: b.y + far * y }, color, 1, [3, 5]);
    }

    figure.onFrame(() => {
        const colors = figure.colors;
        const ofCorner = ["#d64550", "#2fa36b", "#3b8ed0"];
        const [p, ...corners] = spots;
        wasm.set_corners(...corners.flatMap(c => [c.x, c.y]));
        const whole = wasm.area();
        const weights = [0, 1, 2].map(i => wasm.weight(i, p.x, p.y));
        const hit = wasm.hits(p.x, p.y) !== 0;

        figure.clear(plane);
        if (show.value === 1)
            figure.paint(plane, figure.bytes(wasm.mixed_colors(), 4 * 210 * 160),
                         210, 160, 0, 0, 420, 320);
        for (let i = 0; i < 3; ++i) {
            const a = corners[(i + 1) % 3], b = corners[(i + 2) % 3];
            longLine(a, b, colors.muted);
            line(a, b, colors.foreground, 1.5);
            if (show.value === 0 && weights[i] > 0) {
                pen.fillStyle = ofCorner[i];
                pen.globalAlpha = 0.35;
                pen.beginPath();
                for (const spot of [p, a, b]) pen.lineTo(spot.x, spot.y);
                pen.fill();
                pen.globalAlpha = 1;
            }
        }
        corners.forEach((corner, i) =>
            line(p, corner, ofCorner[i], 1.5, weights[i] < 0 ? [2, 4] : []));
        pen.font = "15px sans-serif";
        pen.setLineDash([]);
        spots.forEach((spot, i) => {
            pen.fillStyle = i === 0 ? colors.foreground : ofCorner[i - 1];
            pen.beginPath();
            pen.arc(spot.x, spot.y, i === 0 ? 5 : 6, 0, 7);
            pen.fill();
            if (i === held) {
                pen.strokeStyle = colors.primary;
                pen.lineWidth = 2;
                pen.beginPath();
                pen.arc(spot.x, spot.y, 10, 0, 7);
                pen.stroke();
            }
            const label = names[i] + (i === 0 ? "" : "  " + weights[i - 1].toFixed(2));
            const width = pen.measureText(label).width;
            const x = Math.max(2, Math.min(418 - width, spot.x - width / 2));
            const y = spot.y > 160 ? Math.min(314, spot.y + 26)
                : Math.max(16, spot.y - 14);
            pen.fillText(label, x, y);
        });
        outputs.forEach((output, i) => { output.value = weights[i].toFixed(3); });
        verdict.value = hit ? "hits" : "misses";
        // The picture's y points down.
        area.value = Math.round(Math.abs(whole)).toLocaleString("en") +
            (whole < 0 ? ", counter-clockwise" : ", clockwise");
        return false;
    });
    figure.text("Drag P or a corner. By keyboard: the arrows move the point with the " +
                "ring, Enter goes on to the next one.");
});
