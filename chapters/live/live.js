// Ljus: live figures. The library itself, compiled to WebAssembly, draws in the page.
//
// A new figure NAME in five steps:
//
//   1. chapters/live/NAME.cpp includes the headers that the chapter explains, and
//      exports plain functions: extern "C" [[gnu::used]] double f(double). Arrays: a
//      function that returns the address of a static buffer. Beside them int checks()
//      and double check(int), numbers that are the same in the page and in a native
//      program, within double tolerance() of each.
//   2. chapters/live/NAME.js: ljusLive.define("NAME", figure => { ... }). What a figure
//      offers is listed below, under "What a figure can use".
//   3. In the chapter, around the still picture and its caption:
//          \live{NAME}
//
//          \image html still.png "Caption"
//
//          \endlive
//      Text of class ljus-live-only is shown while the figure runs, and ljus-live-still
//      while it does not. Of captions with data-upto="NUMBER" figure.tell() chooses one.
//   4. ./scripts/book --dev (or: cmake --build build/dev --target live, and the page).
//   5. chapters/live/check HTML BIN NAME tries it, in node and in Chromium.
//
// A page without JavaScript, a browser without WebAssembly, a module that is missing or
// a figure that fails: the still picture stays. Nothing comes from a network.
"use strict";

var ljusLive = (function () {
    const makers = {};  // by name: what define() was given
    const modules = {}; // by name: the bytes of a module
    const loading = {}; // by address: a promise
    const figures = []; // those that run

    function element(tag, name, text) {
        const result = document.createElement(tag);
        if (name) result.className = name;
        if (text) result.textContent = text;
        return result;
    }

    function load(address) {
        return loading[address] = loading[address] || new Promise((done, failed) => {
            const script = element("script");
            script.src = address;
            script.onload = done;
            script.onerror = () => failed(new Error(address + " is not there"));
            document.head.append(script);
        });
    }

    // A module of emscripten's standalone kind imports next to nothing; what it asks
    // for is there, and does nothing.
    function instantiate(bytes) {
        return WebAssembly.compile(bytes).then(module => {
            const imports = {};
            for (const one of WebAssembly.Module.imports(module)) {
                const badDescriptor = 8; // WASI's errno: nothing can be written
                imports[one.module] = imports[one.module] || {};
                imports[one.module][one.name] = () => badDescriptor;
            }
            return WebAssembly.instantiate(module, imports);
        }).then(instance => {
            if (instance.exports._initialize) instance.exports._initialize();
            return instance.exports;
        });
    }

    // --- Colours of the theme, light or dark ----------------------------------------

    function themeColors() {
        const style = getComputedStyle(document.documentElement);
        const color = name => style.getPropertyValue(name).trim();
        return {
            foreground: color("--page-foreground-color"),
            background: color("--page-background-color"),
            muted: color("--page-secondary-foreground-color"),
            line: color("--separator-color"),
            primary: color("--primary-color"),
            red: color("--ljus-erratum"),
            green: color("--ljus-exercise"),
            blue: color("--ljus-predict"),
        };
    }
    const onTheme = [];
    function themeChanged() {
        for (const f of onTheme) f();
    }

    // --- What a figure can use ------------------------------------------------------
    //
    //   figure.wasm, figure.memory     the exports of the module, and its memory
    //   figure.floats(address, count)  an array over that memory; also doubles, ints,
    //                                  bytes. Ask again after a call that may have made
    //                                  the memory grow.
    //   figure.code                    the bytes of the module, for workers
    //   figure.canvas(w, h, label)     a <canvas>; its 2-D context draws in units of
    //                                  w x h whatever its size and the screen's pixels
    //   figure.clear(canvas)           makes it empty
    //   figure.paint(canvas, rgba, width, height [, x, y, w, h])   a picture of bytes
    //   figure.slider(label, min, max, step, value, onChange, format)
    //   figure.toggle(label, value, onChange)
    //   figure.choice(label, names, value, onChange)   value: the number of the name
    //   figure.button(label, onClick)
    //       onChange and format may be left out. They return { input, value, enabled }:
    //       read and set; setting calls no onChange.
    //   figure.keep(onChange, object, name, ...)   object.name, which a drag changes, goes
    //                                  into the address; returns one { value } for each
    //   figure.play(one, seconds [, min, max])   a button that moves a slider or a kept
    //                                  value to its end; .begin() does so from the start.
    //                                  Without a call, it moves the first slider.
    //   figure.tell(value)             shows the first caption whose data-upto is not below
    //   figure.readout(label)          an <output>: set its .value
    //   figure.text(text)              a paragraph below the controls; set .textContent
    //   figure.onDrag(canvas, f)       f({ x, y, dx, dy, first, last, moved, key }):
    //                                  mouse, touch, and arrow keys as small steps;
    //                                  Enter is a click. A click: last and not moved.
    //                                  With key, only dx and dy mean something.
    //   figure.onHover(canvas, f)      f({ x, y }), or f(null) when the pointer leaves
    //   figure.onFrame(f)              f(time) per animation frame while in sight; when
    //                                  it returns false it is called again only after a
    //                                  control, a drag, the theme or figure.redraw()
    //   figure.shade(canvas, values, size, white)   size x size values as greys
    //   figure.pairs(numbers)          [x, y, x, y] as [[x, y], [x, y]]
    //   figure.redraw()                asks for a frame
    //   figure.along(path, length)     the part of a path of [x, y] up to a length
    //   figure.onSight(f)              f(true) and f(false): in sight or not
    //   figure.colors                  of the theme: foreground, background, muted,
    //                                  line, primary, red, green, blue
    //   figure.onDispose(f)            called when the figure ends
    //
    // Every figure has a button that resets it, and an address with its controls' values,
    // and what it keeps, PAGE.html#NAME=1,0.5, which changes as they do.

    function makeFigure(box, name, wasm, code) {
        const stage = element("div", "ljus-live-stage");
        const pictures = element("div", "ljus-live-pictures");
        const controls = element("div", "ljus-live-controls");
        const readouts = element("div", "ljus-live-readouts");
        stage.append(pictures, controls, readouts);

        const figure = { name, wasm, memory: wasm.memory, code, box, stage, frames: 0,
                         inSight: false };
        const sightListeners = [], endings = [], players = [], settings = [];
        let work = () => false, again = true, waiting = false, ended = false;

        function end(error) {
            if (ended) return;
            ended = true;
            figure.inSight = false;
            for (const f of endings) f();
            onTheme.splice(onTheme.indexOf(figure.redraw), 1);
            stage.remove();
            box.classList.remove("ljus-running");
            figures.splice(figures.indexOf(figure), 1);
            if (error) console.error("the figure " + name + " has stopped:", error);
        }
        // Calls a function of the figure; one that fails ends it.
        function guarded(f, ...values) {
            if (ended) return false;
            try { return f(...values); } catch (error) { end(error); return false; }
        }

        // Frames, while there is something to do and somebody to see it.
        function schedule() {
            if (waiting || !again || !figure.inSight || ended) return;
            waiting = true;
            requestAnimationFrame(time => {
                waiting = false;
                if (!figure.inSight || ended) return;
                again = false;
                ++figure.frames;
                for (const move of players) if (move(time)) again = true;
                if (guarded(work, time) !== false) again = true;
                if (figure.frames === 1) figure.readAddress(); // sliders have their ends now
                schedule();
            });
        }
        figure.redraw = () => { again = true; schedule(); };
        figure.onFrame = f => { work = f; figure.redraw(); };
        figure.onSight = f => sightListeners.push(f);
        figure.onDispose = f => endings.push(f);
        figure.dispose = () => end();
        figure.setSight = seen => {
            if (seen === figure.inSight || ended) return;
            figure.inSight = seen;
            for (const f of sightListeners) guarded(f, seen);
            schedule();
        };
        onTheme.push(figure.redraw);
        Object.defineProperty(figure, "colors", { get: themeColors });

        const view = Kind => (address, count) =>
            new Kind(wasm.memory.buffer, address, count);
        figure.floats = view(Float32Array);
        figure.doubles = view(Float64Array);
        figure.ints = view(Int32Array);
        figure.bytes = view(Uint8ClampedArray);

        // --- Canvases
        figure.canvas = (width, height, label) => {
            const canvas = element("canvas");
            const scale = Math.max(1, window.devicePixelRatio || 1);
            canvas.width = Math.round(width * scale);
            canvas.height = Math.round(height * scale);
            canvas.style.aspectRatio = width + " / " + height;
            canvas.style.width = width + "px";
            canvas.setAttribute("role", "img");
            canvas.setAttribute("aria-label", label || name);
            canvas.units = { width, height };
            canvas.getContext("2d").scale(canvas.width / width, canvas.height / height);
            pictures.append(canvas);
            return canvas;
        };
        figure.clear = canvas => canvas.getContext("2d").clearRect(
            0, 0, canvas.units.width, canvas.units.height);
        figure.paint = (canvas, rgba, width, height, x = 0, y = 0,
                        w = canvas.units.width, h = canvas.units.height) => {
            const copy = canvas.copy = canvas.copy || element("canvas");
            if (copy.width !== width || copy.height !== height) {
                copy.width = width;
                copy.height = height;
            }
            copy.getContext("2d").putImageData(new ImageData(
                new Uint8ClampedArray(rgba), width, height), 0, 0);
            canvas.getContext("2d").drawImage(copy, x, y, w, h);
        };

        figure.shade = (canvas, values, size, white) => {
            const bytes = new Uint8ClampedArray(4 * size * size);
            values.forEach((value, i) => {
                bytes.fill(255 * (value / white) ** (1 / 2.2), 4 * i, 4 * i + 3);
                bytes[4 * i + 3] = 255;
            });
            figure.paint(canvas, bytes, size, size);
        };

        // --- Pointer and keys
        const place = (canvas, event) => {
            const frame = canvas.getBoundingClientRect(), units = canvas.units;
            return { x: (event.clientX - frame.left) / frame.width * units.width,
                     y: (event.clientY - frame.top) / frame.height * units.height };
        };
        figure.onDrag = (canvas, f) => {
            let last = null, moved = false, at = null;
            const tell = (spot, first, end, key) => {
                const from = last || spot;
                last = at = spot;
                guarded(f, { x: spot.x, y: spot.y, dx: spot.x - from.x,
                             dy: spot.y - from.y, first, last: end, moved, key });
                if (end) {
                    last = null;
                    writeSettings();
                }
                figure.redraw();
            };
            canvas.tabIndex = 0;
            canvas.classList.add("ljus-draggable");
            let start = null;
            canvas.addEventListener("pointerdown", event => {
                if (event.button !== 0) return;
                canvas.setPointerCapture(event.pointerId);
                start = place(canvas, event);
                moved = false;
                tell(start, true, false, false);
            });
            canvas.addEventListener("pointermove", event => {
                if (!start) return;
                const spot = place(canvas, event);
                if (Math.hypot(spot.x - start.x, spot.y - start.y) > 3) moved = true;
                if (moved) tell(spot, false, false, false);
            });
            const release = event => {
                if (!start) return;
                const cancelled = event.type !== "pointerup"; // it scrolls the page
                const spot = cancelled ? last : place(canvas, event);
                moved = moved || cancelled;
                start = null;
                tell(spot, false, true, false);
            };
            canvas.addEventListener("pointerup", release);
            canvas.addEventListener("pointercancel", release);
            const steps = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, -1],
                            ArrowDown: [0, 1], Enter: [0, 0] };
            canvas.addEventListener("keydown", event => {
                const step = steps[event.key];
                if (!step || event.altKey || event.ctrlKey || event.metaKey) return;
                event.preventDefault();
                const size = event.shiftKey ? 1 : 8;
                at = at || { x: canvas.units.width / 2, y: canvas.units.height / 2 };
                last = at;
                moved = event.key !== "Enter";
                tell({ x: at.x + size * step[0], y: at.y + size * step[1] }, true, true,
                     true);
            });
        };
        figure.onHover = (canvas, f) => {
            canvas.addEventListener("pointermove", event => {
                guarded(f, place(canvas, event));
                figure.redraw();
            });
            canvas.addEventListener("pointerleave", () => {
                guarded(f, null);
                figure.redraw();
            });
        };

        // --- Controls
        function control(kind, label, input, onChange, value, set, shown) {
            const row = element("label", "ljus-live-" + kind);
            row.append(element("span", "", label), input);
            if (shown) row.append(shown);
            input.setAttribute("aria-label", label);
            controls.append(row);
            const made = { input, get value() { return value(); }, set value(to) { set(to); },
                           get enabled() { return !input.disabled; },
                           get min() { return Number(input.min); },
                           get max() { return Number(input.max); },
                           set enabled(on) { input.disabled = !on; },
                           choose: to => { set(to); changed(onChange, value()); } };
            settings.push(made);
            return made;
        }
        const changed = (onChange, value) => {
            if (onChange) guarded(onChange, value);
            figure.redraw();
        };
        figure.keep = (onChange, object, ...names) => names.map(name => {
            const kept = { get value() { return Number(object[name].toFixed(3)); },
                           set value(to) { object[name] = to; },
                           choose: to => { kept.value = to; changed(onChange); } };
            settings.push(kept);
            return kept;
        });

        // --- The address
        const write = hash => history.replaceState(null, "",
            location.href.replace(/#.*/, "") + hash);
        figure.state = () => settings.map(one => Number(one.value)).join(",");
        const writeSettings = () => write("#" + name + "=" + figure.state());
        controls.addEventListener("change", writeSettings);
        figure.readAddress = () => addressed(name).forEach((value, i) => {
            if (settings[i] && Number.isFinite(value)) settings[i].choose(value);
        });
        figure.reset = () => {
            write("");
            restart(figure);
        };
        figure.slider = (label, min, max, step, value, onChange, format) => {
            const input = element("input"), output = element("output");
            const show = () => {
                output.value = format ? format(Number(input.value)) : input.value;
                input.setAttribute("aria-valuetext", output.value);
            };
            input.type = "range";
            Object.assign(input, { min, max, step });
            input.value = value;
            show();
            input.addEventListener("input", () => {
                show();
                changed(onChange, Number(input.value));
            });
            return control("slider", label, input, onChange, () => Number(input.value),
                           to => { input.value = to; show(); }, output);
        };
        figure.toggle = (label, value, onChange) => {
            const input = element("input");
            input.type = "checkbox";
            input.checked = value;
            input.addEventListener("change", () => changed(onChange, input.checked));
            return control("toggle", label, input, onChange, () => input.checked,
                           to => { input.checked = to; });
        };
        figure.choice = (label, names, value, onChange) => {
            const input = element("select");
            names.forEach(text => input.append(element("option", "", text)));
            input.selectedIndex = value;
            input.addEventListener("change",
                                   () => changed(onChange, input.selectedIndex));
            return control("choice", label, input, onChange, () => input.selectedIndex,
                           to => { input.selectedIndex = to; });
        };
        figure.button = (label, onClick) => {
            const input = element("button", "ljus-live-button", label);
            input.type = "button";
            input.addEventListener("click", () => changed(onClick));
            controls.append(input);
            return { input, get enabled() { return !input.disabled; },
                     set enabled(on) { input.disabled = !on; } };
        };
        figure.play = (one, seconds, from, to) => {
            const min = () => from ?? one.min, max = () => to ?? one.max;
            let at = null, last = null, put = 0; // where it is; null: it stands still
            let asked = false; // by a reader: the address follows, as one of this figure does
            const go = start => {
                if (start === null && (asked || addressed(name).length)) writeSettings();
                at = start;
                last = null;
                put = one.value;
                button.input.textContent = at === null ? "play" : "pause";
                figure.redraw();
            };
            const button = figure.button("play", () => {
                asked = true;
                go(at !== null ? null : one.value < max() ? one.value : min());
            });
            players.push(time => {
                if (at === null) return false;
                if (one.value !== put) { // somebody has moved it
                    go(null);
                    return false;
                }
                const passed = Math.min(time - (last || time), 100) / 1000;
                last = time;
                at = Math.min(max(), at + (max() - min()) * passed / seconds);
                one.value = at;
                if (one.value !== put) one.choose(one.value);
                put = one.value;
                if (at === max()) go(null);
                return true;
            });
            return { begin: () => { asked = false; go(min()); } };
        };
        // What every figure has.
        figure.finish = () => {
            const first = settings.find(one => one.input && one.input.type === "range");
            if (first && !players.length) figure.play(first, 12);
            figure.resetButton = figure.button("reset", figure.reset).input;
        };
        figure.tell = value => {
            const all = Array.from(box.querySelectorAll("[data-upto]"));
            const told = all.find(one => value <= Number(one.dataset.upto));
            for (const one of all) one.hidden = one !== told;
        };
        figure.pairs = numbers => Array.from({ length: numbers.length / 2 },
            (_, i) => [numbers[2 * i], numbers[2 * i + 1]]);
        figure.along = (path, length) => {
            const part = path.slice(0, 1);
            for (let i = 1; i < path.length && length > 0; ++i) {
                const [x, y] = path[i - 1], dx = path[i][0] - x, dy = path[i][1] - y;
                const step = Math.min(1, length / Math.hypot(dx, dy));
                part.push([x + step * dx, y + step * dy]);
                length -= Math.hypot(dx, dy);
            }
            return part;
        };
        figure.readout = label => {
            const row = element("div", "ljus-live-readout"), output = element("output");
            row.append(element("span", "", label), output);
            readouts.append(row);
            return output;
        };
        figure.text = text => {
            const paragraph = element("p", "ljus-live-text", text);
            stage.append(paragraph);
            return paragraph;
        };
        return figure;
    }

    // --- Beginning ------------------------------------------------------------------

    async function start(box) {
        const name = box.dataset.live;
        let figure = null;
        try {
            await load("live/" + name + ".wasm.js");
            if (!modules[name]) return; // this build has no module of it
            if (!WebAssembly.validate(modules[name])) // it has SIMD, the browser has not
                await load("live/" + name + ".plain.wasm.js");
            await load("live/" + name + ".js");
            figure = makeFigure(box, name, await instantiate(modules[name]),
                                modules[name]);
            figures.push(figure);
            box.insertBefore(figure.stage, box.firstChild);
            makers[name](figure);
            figure.finish();
            box.classList.add("ljus-running");
            const sight = new IntersectionObserver(entries => {
                figure.seen = entries[entries.length - 1].isIntersecting;
                figure.setSight(figure.seen && !document.hidden);
            });
            sight.observe(figure.stage);
            figure.onDispose(() => sight.disconnect());
        } catch (error) {
            if (figure) figure.dispose();
            box.classList.remove("ljus-running");
            console.warn("the figure " + name + " stays still:", error);
        }
    }

    // Begins a figure anew; the page keeps its place meanwhile.
    function restart({ box, dispose }) {
        box.style.minHeight = box.offsetHeight + "px";
        dispose();
        box.classList.add("ljus-running");
        start(box).then(() => {
            box.style.minHeight = "";
            const now = figures.find(figure => figure.box === box);
            if (now) now.resetButton.focus({ preventScroll: true });
        });
    }

    // The values that the address gives to the controls of a figure.
    function addressed(name) {
        const [, figure, values] = /^#(\w+)=([-\d.,]+)$/.exec(location.hash) || [];
        return figure === name ? values.split(",").map(Number) : [];
    }
    function goToAddress() {
        const box = Array.from(document.querySelectorAll(".ljus-live"))
            .find(one => addressed(one.dataset.live).length > 0);
        if (box) box.scrollIntoView({ block: "center" });
        const running = figures.find(figure => figure.box === box);
        if (running) restart(running);
    }

    document.addEventListener("DOMContentLoaded", () => {
        const boxes = document.querySelectorAll(".ljus-live");
        if (!boxes.length || typeof WebAssembly !== "object" ||
            typeof IntersectionObserver !== "function") return;
        const near = new IntersectionObserver(entries => {
            for (const entry of entries) if (entry.isIntersecting) {
                near.unobserve(entry.target);
                start(entry.target);
            }
        }, { rootMargin: "600px" });
        boxes.forEach(box => near.observe(box));
        goToAddress();
        window.addEventListener("hashchange", goToAddress);
        new MutationObserver(themeChanged).observe(document.documentElement,
            { attributes: true, attributeFilter: ["class"] });
        matchMedia("(prefers-color-scheme: dark)")
            .addEventListener("change", themeChanged);
        document.addEventListener("visibilitychange", () => {
            for (const figure of figures)
                figure.setSight(!document.hidden && figure.seen);
        });
    });

    return {
        figures,
        define: (name, maker) => { makers[name] = maker; },
        module: (name, base64) => {
            if (base64)
                modules[name] = Uint8Array.from(atob(base64), c => c.charCodeAt(0));
        },
        instantiate,
    };
})();
