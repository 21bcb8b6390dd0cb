// Live: a ray goes down a tree of boxes.
"use strict";

ljusLive.define("bvh", figure => {
    const { wasm } = figure;
    const plane = figure.canvas(360, 360, "Balls in boxes in boxes, and a ray");
    const graph = figure.canvas(400, 360, "The tree; the nodes that the ray visits");

    let all = true; // steps follow the search to its end
    let steps = null;
    steps = figure.slider("steps of the search", 1, 10, 1, 10,
        value => { all = value === Number(steps.input.max); },
        value => value + (steps ? " of " + steps.input.max : ""));
    figure.play(steps, 6).begin();
    const balls = figure.slider("balls", 4, 64, 1, 24);
    const everyBox = figure.toggle("all boxes", false);
    const boxTests = figure.readout("box tests");
    const ballTests = figure.readout("ball tests");
    const loopTests = figure.readout("ball tests of a loop");
    const found = figure.readout("the ray");

    // The ends of the ray, in the units of the balls.
    const ends = [{ x: 2, y: 20 }, { x: 96, y: 90 }];
    for (const end of ends) figure.keep(null, end, "x", "y");
    let held = 1;
    const px = v => 3.6 * v;
    figure.onDrag(plane, spot => {
        if (spot.key) { // Enter takes the other end
            if (!spot.moved) held = 1 - held;
        } else if (spot.first) {
            const [a, b] = ends.map(
                e => Math.hypot(px(e.x) - spot.x, px(e.y) - spot.y));
            held = a < b ? 0 : 1;
        }
        const to = spot.key
            ? { x: ends[held].x + spot.dx / 3.6, y: ends[held].y + spot.dy / 3.6 }
            : { x: spot.x / 3.6, y: spot.y / 3.6 };
        const one = Object.assign(ends[held], { x: Math.max(1, Math.min(99, to.x)),
                                                y: Math.max(1, Math.min(99, to.y)) });
        const other = ends[1 - held]; // a ray has a direction
        if (Math.hypot(one.x - other.x, one.y - other.y) < 2)
            one.x += one.x < 50 ? 2 : -2;
    });

    let nodes = [];
    function build() {
        const count = wasm.build(balls.value);
        const numbers = figure.floats(wasm.node_data(), 7 * count);
        nodes = Array.from({ length: count }, (_, i) => {
            const [x0, y0, x1, y1, first, number, depth] =
                numbers.subarray(7 * i, 7 * i + 7);
            return { x0, y0, x1, y1, first, count: number, depth };
        });
        // Places in the graph: leaves side by side, a node above its children.
        let leaves = 0;
        const place = node => {
            if (node.count > 0) {
                node.x = leaves++;
                return;
            }
            const children = [nodes[node.first], nodes[node.first + 1]];
            children.forEach(place);
            node.x = (children[0].x + children[1].x) / 2;
        };
        place(nodes[0]);
        const deepest = Math.max(1, ...nodes.map(node => node.depth));
        for (const node of nodes) {
            node.x = 14 + (node.x + 0.5) / leaves * 372;
            node.y = 40 + node.depth / deepest * 296;
        }
    }

    function box(pen, node, color, fill, dashed) {
        pen.strokeStyle = pen.fillStyle = color;
        pen.lineWidth = dashed ? 1 : 1.5;
        pen.setLineDash(dashed ? [3, 4] : []);
        const frame = [node.x0, node.y0, node.x1 - node.x0, node.y1 - node.y0].map(px);
        pen.globalAlpha = fill;
        pen.fillRect(...frame);
        pen.globalAlpha = dashed ? 0.7 : 1;
        pen.strokeRect(...frame);
        pen.globalAlpha = 1;
    }

    function drawPlane(colors, state) {
        const pen = plane.getContext("2d");
        figure.clear(plane);
        if (everyBox.value)
            for (const node of nodes) box(pen, node, colors.muted, 0, true);
        for (const i of state.tested) box(pen, nodes[i], colors.muted, 0, true);
        for (const i of state.visited)
            box(pen, nodes[i], i === state.now ? colors.red : colors.blue, 0.07, false);
        pen.setLineDash([]);
        const numbers = figure.floats(wasm.ball_data(), 3 * balls.value);
        for (let i = 0; i < balls.value; ++i) {
            pen.beginPath();
            const [x, y, radius] = Array.from(numbers.subarray(3 * i, 3 * i + 3), px);
            const asked = state.asked.includes(i);
            pen.arc(x, y, radius, 0, 7);
            pen.fillStyle = i === state.hit ? colors.green
                : asked ? colors.red : colors.muted;
            pen.globalAlpha = asked ? 0.8 : 0.3;
            pen.fill();
            pen.globalAlpha = 1;
        }
        const [from, to] = ends;
        const length = Math.hypot(to.x - from.x, to.y - from.y);
        const reach = state.hit >= 0 ? wasm.distance() : 300;
        pen.strokeStyle = colors.foreground;
        pen.lineWidth = 2;
        pen.beginPath();
        pen.moveTo(px(from.x), px(from.y));
        pen.lineTo(px(from.x + reach * (to.x - from.x) / length),
                   px(from.y + reach * (to.y - from.y) / length));
        pen.stroke();
        ends.forEach((end, i) => {
            pen.beginPath();
            pen.arc(px(end.x), px(end.y), 6, 0, 7);
            pen.fillStyle = i === 0 ? colors.foreground : colors.background;
            pen.fill();
            pen.strokeStyle = i === held ? colors.primary : colors.foreground;
            pen.stroke();
        });
    }

    function drawGraph(colors, state) {
        const pen = graph.getContext("2d");
        figure.clear(graph);
        pen.lineWidth = 1;
        for (const node of nodes) if (node.count === 0)
            for (const i of [node.first, node.first + 1]) {
                const on = state.visited.includes(i);
                pen.strokeStyle = on ? colors.blue : colors.muted;
                pen.lineWidth = on ? 2.5 : 1;
                pen.globalAlpha = on ? 1 : 0.5;
                pen.beginPath();
                pen.moveTo(node.x, node.y);
                pen.lineTo(nodes[i].x, nodes[i].y);
                pen.stroke();
                pen.globalAlpha = 1;
            }
        nodes.forEach((node, i) => {
            const on = state.visited.includes(i), tested = state.tested.includes(i);
            pen.beginPath();
            if (node.count > 0) pen.rect(node.x - 4, node.y - 4, 8, 8);
            else pen.arc(node.x, node.y, 4.5, 0, 7);
            pen.fillStyle = i === state.now ? colors.red
                : on ? colors.blue : colors.background;
            pen.fill();
            pen.lineWidth = 1.5;
            pen.strokeStyle = on ? pen.fillStyle : colors.muted;
            pen.setLineDash(tested && !on ? [2, 2] : []);
            pen.stroke();
            pen.setLineDash([]);
        });
        pen.font = "14px sans-serif";
        pen.fillStyle = colors.muted;
        pen.fillText("root", nodes[0].x + 12, nodes[0].y + 5);
        pen.fillText("○ inner nodes   □ leaves", 8, 16);
    }

    figure.onFrame(() => {
        build();
        const count = wasm.shoot(ends[0].x, ends[0].y, ends[1].x, ends[1].y);
        const hit = wasm.hit();
        steps.input.max = Math.max(count, 1);
        steps.value = all ? count : Math.min(steps.value, count);
        const done = Math.min(steps.value, count);
        const visited = Array.from(figure.ints(wasm.way(), count)).slice(0, done);
        // A visited inner node asks the boxes of both children; the root's comes first.
        const tested = [0].concat(visited.filter(i => nodes[i].count === 0)
            .flatMap(i => [nodes[i].first, nodes[i].first + 1]));
        const pairs = figure.ints(wasm.asked_balls(), 2 * wasm.asked_number());
        const asked = [];
        for (let i = 0; i < pairs.length; i += 2)
            if (pairs[i + 1] <= done) asked.push(pairs[i]);
        const state = { visited, tested, asked, hit: asked.includes(hit) ? hit : -1,
                        now: done < count ? visited[done - 1] : -1 };
        const colors = figure.colors;
        drawPlane(colors, state);
        drawGraph(colors, state);
        boxTests.value = tested.length;
        ballTests.value = asked.length;
        loopTests.value = balls.value;
        found.value = state.hit >= 0 ? "hits after " + wasm.distance().toFixed(1)
            : done < count ? "has found nothing yet" : "hits nothing";
        return false;
    });
});
