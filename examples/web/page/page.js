// SPDX-License-Identifier: MIT
// The page: what is chosen, what is dragged, one picture after the other, and how wrong it is once all is still.
"use strict";

(function () {
    const get = id => document.getElementById(id);
    const methods = ["sheets", "splats", "thin lens", "dots"];
    const scenes = [
        { power: 9, orbit: { azimuth: -1.15, elevation: 0.86, distance: 3.6, target: [0.02, 0.06, 0.06] },
          lamp: [0.75, 0.55, 1.5], photons: 5000, converged: 150000, path: [1.0, 0.75] },
        { power: 15, orbit: { azimuth: -0.95, elevation: 0.62, distance: 4.2, target: [0.32, -0.24, 0.32] },
          lamp: [-1.55, 0.95, 1.6], photons: 5000, converged: 101000, path: [-0.6, 1.1] },
        { power: 12, orbit: { azimuth: -0.9, elevation: 0.85, distance: 4.1, target: [0, 0, 0.66] },
          lamp: [0.2, 0.25, 2.1], photons: 4000, converged: 150000, path: [0.7, 0.7] },
    ];
    const state = {
        scene: 0, method: 0, frames: 0, photons: 5000, size: 512, lamp: [0, 0, 2], seconds: 0,
        wavesRun: true, idles: true, // until somebody drags, the lamp moves by itself
        orbits: scenes.map(s => ({ ...s.orbit })),
    };
    let caustics, view, changed = true, still = 0, last = 0, frames = [], errors = null;
    let sharp = false, fine = 1, sinceAdapted = 0, isNew = true;

    // The library draws the floor's irradiance. Returns a view of its memory, which the next call overwrites.
    function trace(method, photons) {
        const at = caustics._nephroid_draw(state.scene, method, photons, state.size, ...state.lamp, state.seconds);
        return new Float32Array(caustics.HEAPF32.buffer, at, state.size * state.size);
    }

    function waves() {
        const values = [];
        for (let i = 0; i < 4; ++i)
            for (let k = 0; k < 4; ++k) {
                const value = caustics._nephroid_wave(i, k);
                values.push(k === 3 ? (value * state.seconds) % 1 : value);
            }
        return values;
    }

    function show(samples) {
        const scene = scenes[state.scene];
        view.draw(state.scene, state.orbits[state.scene], state.lamp, scene.power,
            caustics._nephroid_half_map(state.scene), waves(), samples);
    }

    function resize() {
        const box = view.canvas.getBoundingClientRect(), dense = Math.min(window.devicePixelRatio || 1, 2);
        const wanted = state.pixels ? [state.pixels, state.pixels]
            : [box.width, box.height].map(x => Math.max(1, Math.round(x * dense * (sharp ? 1 : fine))));
        if (view.canvas.width !== wanted[0] || view.canvas.height !== wanted[1]) {
            [view.canvas.width, view.canvas.height] = wanted;
            changed = true;
        }
    }

    // One picture: light, then what the eye sees of it, which a browser may draw later.
    function picture() {
        const start = performance.now();
        const irradiance = trace(state.method, state.photons), light = performance.now() - start;
        view.upload(irradiance, state.size);
        show(1);
        return { light };
    }

    function frame(now) {
        requestAnimationFrame(frame);
        const passed = Math.min(now - last, 200) / 1000;
        last = now;
        if (state.scene === 2 && state.wavesRun)
            state.seconds += passed, changed = true;
        if (state.idles) {
            state.turn = (state.turn || 0) + 0.35 * passed;
            const scene = scenes[state.scene], [a, b] = scene.path;
            state.lamp[0] = scene.lamp[0] + a * (Math.cos(state.turn) - 1) * 0.5;
            state.lamp[1] = scene.lamp[1] + b * Math.sin(state.turn) * 0.5;
            changed = true;
        }
        if (changed)
            sharp = false;
        resize();
        if (changed) {
            changed = false, errors = state.errors = null, still = now;
            const took = picture();
            ++state.frames;
            const before = frames[frames.length - 1]; // what of a frame's time is not the light's is the picture's
            frames.push({ now, light: took.light, eye: before ? Math.max(now - before.now - before.light, 0) : 0 });
            frames = frames.filter(f => now - f.now < 4000).slice(-24);
            report();
            const eye = frames.slice(-3).reduce((sum, f) => sum + f.eye, 0) / 3;
            if (isNew)
                isNew = false, fine = 0.5, resize(), adapt(timed());
            else if (++sinceAdapted > 4 && frames.length > 4 && (eye > 40 || (eye < 17 && fine < 1)))
                adapt(Math.max(eye, 17));
        } else if (now - still > 250 && !sharp) {
            sharp = true, frames = [];
            resize(), changed = false;
            show(2);
        } else if (now - still > 700 && errors === null) {
            measure();
        }
    }

    // Fewer pixels while the picture takes long, as without a graphics card; all of them once it is still. Of a scene's
    // first picture the time is asked for, of later ones it is what the light leaves of a frame.
    function adapt(eye) {
        fine = Math.min(1, Math.max(0.3, fine * Math.sqrt(25 / eye)));
        sinceAdapted = 0;
    }
    function timed() {
        const one = new Uint8Array(4), gl = view.gl, times = [];
        for (let i = 0; i < 2; ++i) { // the first also compiles
            const start = performance.now();
            show(1);
            gl.readPixels(0, 0, 1, 1, gl.RGBA, gl.UNSIGNED_BYTE, one);
            times.push(performance.now() - start);
        }
        return Math.max(times[1], 1);
    }

    function report() {
        const mean = key => frames.reduce((sum, f) => sum + f[key], 0) / frames.length;
        const first = frames[0], final = frames[frames.length - 1];
        if (frames.length > 3) {
            state.rate = 1000 * (frames.length - 1) / (final.now - first.now);
            state.light = mean("light"), state.eye = mean("eye");
            get("rate").textContent = state.rate.toFixed(0);
            get("light").textContent = state.light.toFixed(0);
            get("eye").textContent = state.eye.toFixed(0);
        }
        for (let i = 0; i < methods.length; ++i)
            get("error" + i).textContent = "", get("bar" + i).style.width = "0";
        get("verdict").textContent = state.idles ? "Drag the lamp. When all is still, each way is measured here."
            : state.scene === 2 && state.wavesRun ? "Stop the waves to measure each way here."
            : "Measured when all is still …";
    }

    // The error of all four ways with as many photons, against a picture of many times more.
    function measure() {
        errors = [];
        const job = errors, scene = scenes[state.scene];
        get("verdict").textContent = "Drawing the converged picture …";
        const steps = [() => { trace(0, scene.converged); caustics._nephroid_keep(); }];
        methods.forEach((name, i) => steps.push(() => {
            trace(i, state.photons);
            const error = caustics._nephroid_error();
            errors[i] = error;
            get("error" + i).textContent = (100 * error).toFixed(error < 0.1 ? 1 : 0) + "%";
            get("bar" + i).style.width = 100 * Math.min(1, Math.log10(1 + 1000 * error) / 3.5) + "%";
        }));
        steps.push(() => {
            trace(state.method, state.photons);
            get("verdict").textContent = "RMS error over the mean, against " + scene.converged.toLocaleString("en") +
                " photons of sheets.";
            state.errors = errors.slice();
        });
        const next = () => {
            if (errors === job && !changed && steps.length) {
                steps.shift()();
                setTimeout(next, 0);
            }
        };
        setTimeout(next, 30);
    }

    // Drags move the lamp in its plane; with a second finger, the right button or shift they turn the camera.
    function listen(canvas) {
        const fingers = new Map();
        const onPlane = event => {
            const box = canvas.getBoundingClientRect(), camera = view.camera(state.orbits[state.scene]);
            const d = view.ray(camera, 2 * (event.clientX - box.left) / box.width - 1,
                1 - 2 * (event.clientY - box.top) / box.height);
            const t = (state.lamp[2] - camera.eye[2]) / d[2];
            return t > 0 && t < 12 ? [camera.eye[0] + t * d[0], camera.eye[1] + t * d[1]] : null;
        };
        canvas.addEventListener("pointerdown", event => {
            canvas.setPointerCapture(event.pointerId);
            fingers.set(event.pointerId, event);
            state.idles = false, changed = true;
            event.preventDefault();
        });
        canvas.addEventListener("pointermove", event => {
            const before = fingers.get(event.pointerId);
            if (!before)
                return;
            fingers.set(event.pointerId, event);
            if (fingers.size > 1 || event.shiftKey || (event.buttons & 2)) {
                const orbit = state.orbits[state.scene], share = 1 / fingers.size;
                orbit.azimuth -= 0.007 * share * (event.clientX - before.clientX);
                orbit.elevation = Math.min(1.5, Math.max(0.25,
                    orbit.elevation + 0.006 * share * (event.clientY - before.clientY)));
            } else {
                const from = onPlane(before), to = onPlane(event);
                if (from && to)
                    for (const i of [0, 1])
                        state.lamp[i] = Math.min(2.4, Math.max(-2.4, state.lamp[i] + to[i] - from[i]));
            }
            changed = true;
        });
        for (const end of ["pointerup", "pointercancel"])
            canvas.addEventListener(end, event => fingers.delete(event.pointerId));
        canvas.addEventListener("contextmenu", event => event.preventDefault());
    }

    function pressed(buttons, chosen) {
        buttons.forEach((button, i) => button.setAttribute("aria-pressed", i === chosen));
    }
    function choose(scene) {
        const chosen = scenes[scene];
        Object.assign(state, { scene, lamp: chosen.lamp.slice(), idles: true, turn: 0 });
        isNew = true, frames = [], errors = state.errors = state.rate = null;
        setPhotons(chosen.photons);
        get("height").value = state.lamp[2];
        get("waves").hidden = scene !== 2;
        pressed(sceneButtons, scene);
        changed = true;
    }
    function setPhotons(count) {
        state.photons = count;
        get("photons").value = Math.log10(count);
        get("count").textContent = count.toLocaleString("en");
        changed = true;
    }
    const sceneButtons = [0, 1, 2].map(i => get("scene" + i)), methodButtons = [0, 1, 2, 3].map(i => get("method" + i));
    sceneButtons.forEach((button, i) => button.onclick = () => choose(i));
    methodButtons.forEach((button, i) => button.onclick = () => {
        state.method = i, frames = [], changed = true;
        pressed(methodButtons, i);
    });
    get("photons").oninput = event => {
        const rough = Math.pow(10, Number(event.target.value)), unit = Math.pow(10, Math.floor(Math.log10(rough)) - 1);
        setPhotons(Math.round(rough / unit) * unit);
    };
    get("height").oninput = event => { state.lamp[2] = Number(event.target.value), changed = true; };
    get("waves").onclick = () => {
        state.wavesRun = !state.wavesRun, changed = true;
        if (!state.wavesRun)
            state.idles = false;
        get("waves").textContent = state.wavesRun ? "Stop the waves" : "Let the waves run";
    };

    createCausticMap().then(module => {
        caustics = module;
        view = new CausticView(get("view"));
        listen(view.canvas);
        choose(0);
        // For the page's test.
        window.nephroidPage = { state, trace, picture, show, choose, touch: () => { changed = true; }, view };
        requestAnimationFrame(now => { last = now, frame(now); });
    }).catch(error => {
        get("verdict").textContent = String(error.message || error);
        get("verdict").className = "failed";
    });
})();
