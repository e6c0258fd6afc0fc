// SPDX-License-Identifier: MIT
// What must hold of the page of examples/web; called by web_browser.js.
"use strict";
const { execFileSync } = require("child_process");

module.exports = async page => {
    const { evaluate, until, mouse, screen, open, seen, check, sleep, requests, told, out, fs, path } = page;
    const program = path.join(path.resolve(process.argv[3]), "web_caustic_map");
    const still = "nephroidPage.state.idles = false, nephroidPage.state.wavesRun = false, nephroidPage.touch()";
    await open(1180, 860);
    check(await evaluate("nephroidPage.state.idles"), "the lamp moves by itself until somebody drags it");
    const [before, after] = [await evaluate("nephroidPage.state.lamp[1]"), (await sleep(1500),
        await evaluate("nephroidPage.state.lamp[1]"))];
    check(before !== after, "frame follows frame");

    // A drag moves the lamp in its plane by the way between the points where the finger's rays meet that plane.
    await evaluate(`nephroidPage.choose(0), ${still}`);
    await sleep(800);
    const first = await seen();
    check(first.deviation > 10, `the picture is no blank: its values deviate by ${first.deviation.toFixed(1)} of 255`);
    const lamp = await evaluate("nephroidPage.state.lamp.slice()");
    const box = await evaluate(
        "(r => [r.left, r.top, r.width, r.height])(document.getElementById('view').getBoundingClientRect())");
    const [x, y] = [box[0] + 0.6 * box[2], box[1] + 0.3 * box[3]];
    const light = "(light => light.reduce((a, e, i) => a + e * (i % 512), 0) / light.reduce((a, e) => a + e, 0))" +
        "(nephroidPage.trace(0, 3000))";
    const middle = await evaluate(light);
    await mouse("mousePressed", x, y, 1);
    for (let step = 1; step <= 8; ++step)
        await mouse("mouseMoved", x - step * 25, y + step * 8, 1);
    await mouse("mouseReleased", x - 200, y + 64, 0);
    await sleep(800);
    const moved = await evaluate("nephroidPage.state.lamp.slice()");
    const ends = `[[${x}, ${y}], [${x - 200}, ${y + 64}]]`;
    const wanted = await evaluate(`(([a, b]) => [0, 1].map(i => b[i] - a[i]))(${ends}.map(([x, y]) => {
        const [left, top, width, height] = [${box}], c = nephroidPage.view.camera(nephroidPage.state.orbits[0]);
        const d = nephroidPage.view.ray(c, 2 * (x - left) / width - 1, 1 - 2 * (y - top) / height);
        return [0, 1].map(i => c.eye[i] + (${lamp[2]} - c.eye[2]) / d[2] * d[i]);
    }))`);
    const gone = [0, 1].map(i => moved[i] - lamp[i]);
    const apart = Math.hypot(gone[0] - wanted[0], gone[1] - wanted[1]);
    check(Math.hypot(...gone) > 0.1 && apart < 0.01 && moved[2] === lamp[2],
        `a drag moves the lamp by ${gone.map(g => g.toFixed(3))} where ${wanted.map(g => g.toFixed(3))} is right`);
    const second = await seen();
    check(Math.abs(second.mean - first.mean) + Math.abs(second.deviation - first.deviation) > 0.5,
        "the picture follows the drag");
    const other = await evaluate(light);
    check(Math.abs(other - middle) > 1,
        `the caustic moves with it: its middle by ${(other - middle).toFixed(1)} of 512 places`);

    // The light that the page draws with is that of the program of this machine. Bounds as in web_node.js.
    for (const [scene, method] of [[0, 0], [1, 1], [2, 0]]) {
        await evaluate(`nephroidPage.choose(${scene}), ${still}, nephroidPage.state.seconds = 1.25`);
        const at = await evaluate("nephroidPage.state.lamp.slice()"), file = path.join(out, "native.raw");
        const text = await evaluate(`(e => { const b = new Uint8Array(e.slice().buffer); let s = "";
            for (let i = 0; i < b.length; i += 8192) s += String.fromCharCode(...b.subarray(i, i + 8192));
            return btoa(s); })(nephroidPage.trace(${method}, 4000))`);
        const floats = b => new Float32Array(b.buffer.slice(b.byteOffset, b.byteOffset + b.length));
        const shown = floats(Buffer.from(text, "base64"));
        execFileSync(program, [scene, method, 4000, 512, ...at, 1.25, file].map(String));
        const here = floats(fs.readFileSync(file));
        fs.unlinkSync(file);
        const mean = here.reduce((a, b) => a + b, 0) / here.length;
        const differing = here.filter((e, i) => !(Math.abs(e - shown[i]) <= 1e-4 * (mean + e))).length;
        check(here.length === 512 * 512 && shown.length === here.length && mean > 0 && differing <= 16,
            `scene ${scene}, method ${method}: ${differing} of ${here.length} places differ from the program's`);
        await screen("scene" + scene);
    }

    // Once all is still each way is measured, and sheets are the least wrong.
    await evaluate(`nephroidPage.choose(0), ${still}`);
    await until("errors", "nephroidPage.state.errors && nephroidPage.state.errors.length === 4");
    const errors = await evaluate("nephroidPage.state.errors");
    check(errors.every(e => e > 0 && errors[0] <= e) && errors[0] < 0.5,
        "errors at rest: " + errors.map(e => (100 * e).toFixed(1) + "%").join(", "));

    await open(390, 844, 2);
    await evaluate(`nephroidPage.choose(0), ${still}`);
    await sleep(1500);
    const widths = await evaluate("[document.documentElement.scrollWidth, innerWidth, " +
        "document.getElementById('view').getBoundingClientRect().width]");
    check(widths[0] <= 390 && widths[1] === 390 && widths[2] > 350, "a phone's width holds it: " + widths.join(", "));
    const least = await evaluate("Math.min(...[...document.querySelectorAll('button:not([hidden])')]" +
        ".map(b => b.getBoundingClientRect().height))");
    check(least >= 36, `its buttons can be touched: ${least} pixels high`);
    await screen("phone");

    const foreign = requests.filter(url => !/^(file|data|blob|about):/.test(url));
    check(requests.length > 3 && foreign.length === 0, "nothing is fetched from elsewhere");
    check(told.length === 0, "no error is thrown: " + told.join("; "));
};
