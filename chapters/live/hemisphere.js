// Live: a hemisphere that fills with directions, and their histogram beside the density.
"use strict";

ljusLive.define("hemisphere", figure => {
    const { wasm } = figure;
    const belts = wasm.belt_count(), shown = 5000;
    const dome = figure.canvas(330, 300, "Directions on the hemisphere; drag to turn it");
    const bars = figure.canvas(430, 300, "The share of the directions in each belt");
    const ball = dome.getContext("2d"), plot = bars.getContext("2d");

    const names = ["cosine", "uniform", "naive"];
    const sampler = figure.choice("directions", names, 2, () => begin());
    const judge = figure.choice("judged by the density", ["of the same", ...names], 1,
                                () => begin());
    const most = figure.slider("how many", 2, 5, 0.25, 4.5, null,
                               e => Math.round(10 ** e));
    const drawn = figure.readout("drawn");
    const sum = figure.readout("chi-square");
    const chance = figure.readout("p");

    const view = { tilt: 0.6, turn: 0.4 };
    figure.keep(null, view, "tilt", "turn");
    let seed = 1, total = 0, directions = [];
    function begin() {
        wasm.restart(sampler.value, judge.value ? judge.value - 1 : sampler.value, seed++);
        total = 0;
        directions = [];
    }
    begin();
    figure.onDrag(dome, spot => {
        view.turn += spot.dx / 120;
        view.tilt = Math.max(0, Math.min(1.5, view.tilt - spot.dy / 120));
    });

    function drawDome(colors) {
        const cosine = Math.cos(view.tilt), sine = Math.sin(view.tilt);
        const c = Math.cos(view.turn), s = Math.sin(view.turn), r = 140;
        const middle = 150 + 60 * sine; // seen from the side the dome is half as high
        figure.clear(dome);
        ball.strokeStyle = colors.line;
        ball.fillStyle = colors.muted;
        ball.lineWidth = 1;
        for (const degrees of [0, 30, 60]) { // circles of equal height
            const z = Math.sin(degrees * Math.PI / 180);
            const ring = r * Math.sqrt(1 - z * z);
            ball.beginPath();
            ball.ellipse(165, middle - r * z * sine, ring, ring * cosine, 0, 0, 7);
            ball.stroke();
        }
        ball.fillStyle = colors.blue;
        ball.globalAlpha = Math.max(0.3, 0.9 - directions.length / 20000);
        for (let i = 0; i < directions.length; i += 3) {
            const x = c * directions[i] - s * directions[i + 1];
            const y = s * directions[i] + c * directions[i + 1];
            const down = y * cosine - directions[i + 2] * sine;
            ball.fillRect(164 + r * x, middle + r * down - 1, 2, 2);
        }
        ball.globalAlpha = 1;
        ball.strokeStyle = colors.foreground; // the normal
        ball.lineWidth = 1.5;
        ball.beginPath();
        ball.moveTo(165, middle);
        ball.lineTo(165, middle - r * sine);
        ball.stroke();
    }

    function drawBars(colors) {
        const all = figure.doubles(wasm.histogram(), 2 * belts);
        const highest = Math.max(0.13, ...all);
        const x = i => 40 + 380 * i / belts, y = share => 256 - 228 * share / highest;
        figure.clear(bars);
        plot.font = "12px sans-serif";
        plot.lineWidth = 1;
        plot.strokeStyle = colors.line;
        plot.fillStyle = colors.muted;
        plot.textAlign = "right";
        for (let share = 0; share <= highest; share += highest > 0.3 ? 0.1 : 0.05) {
            plot.beginPath();
            plot.moveTo(40, y(share));
            plot.lineTo(420, y(share));
            plot.stroke();
            plot.fillText((100 * share).toFixed(0) + " %", 36, y(share) + 4);
        }
        plot.textAlign = "center";
        for (const cosine of [0, 0.25, 0.5, 0.75, 1])
            plot.fillText(cosine, Math.min(x(belts * cosine), 414), 274);
        plot.fillText("height of the belt: 0 at the horizon, 1 at the normal", 230, 292);
        plot.fillStyle = colors.blue;
        plot.globalAlpha = 0.6;
        for (let i = 0; i < belts; ++i)
            plot.fillRect(x(i) + 1, y(all[i]), x(1) - x(0) - 2, 256 - y(all[i]));
        plot.globalAlpha = 1;
        plot.strokeStyle = colors.red;
        plot.lineWidth = 2;
        plot.beginPath();
        for (let i = 0; i < belts; ++i) {
            plot.lineTo(x(i), y(all[belts + i]));
            plot.lineTo(x(i + 1), y(all[belts + i]));
        }
        plot.stroke();
        plot.textAlign = "left";
        plot.fillStyle = colors.red;
        plot.fillText("what the density says", 48, 18);
        plot.fillStyle = colors.blue;
        plot.fillText("share found", 200, 18);
    }

    figure.onFrame(() => {
        const wanted = Math.round(10 ** most.value);
        if (total > wanted) begin();
        const more = Math.min(wanted - total, 2000, 2 + Math.ceil(total / 25));
        if (more > 0) {
            const fresh = figure.floats(wasm.draw(more), 3 * more);
            if (directions.length < 3 * shown) directions.push(...fresh);
            total += more;
        }
        const colors = figure.colors, p = wasm.p_value();
        drawDome(colors);
        drawBars(colors);
        drawn.value = total;
        // Below five expected in each cell the test does not hold.
        sum.value = total < 1000 ? "needs 1000 directions"
            : wasm.chi_square().toFixed(0) + ", " + wasm.freedom() + " expected";
        chance.value = total < 1000 ? "" : p < 1e-6 ? "0" : p.toFixed(3);
        return total < wanted;
    });
});
