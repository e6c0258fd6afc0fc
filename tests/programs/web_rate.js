// SPDX-License-Identifier: MIT
// How many frames a second the page of examples/web shows while its lamp moves, and what they cost a processor:
// node web_browser.js <chromium> <the page's folder> <any folder> web_rate.js
"use strict";
const os = require("os");

module.exports = async ({ evaluate, open, sleep, spent }) => {
    await open(1180, 860);
    for (const [scene, name] of [[0, "ring"], [1, "tumbler"], [2, "pool"]]) {
        await evaluate(`nephroidPage.choose(${scene})`);
        await sleep(5000);
        const from = await spent(), first = await evaluate("nephroidPage.state.frames"), start = Date.now();
        await sleep(8000);
        const to = await spent(), frames = await evaluate("nephroidPage.state.frames") - first;
        const seconds = (Date.now() - start) / 1000, per = key => 1000 * (to[key] - from[key]) / frames;
        const width = await evaluate("nephroidPage.view.canvas.width");
        const light = per("page"), eye = per("drawing");
        console.log(`${name}: ${(frames / seconds).toFixed(1)} frames/s at load ${os.loadavg()[0].toFixed(1)} on ` +
            `${os.cpus().length} cores. Processor ms a frame: ${light.toFixed(1)} for the light, ` +
            `${eye.toFixed(1)} for WebGL in software, ${width} pixels wide. So one core makes ` +
            `${(1000 / light).toFixed(0)} frames/s of light, ${(1000 / (light + eye)).toFixed(0)} of both`);
    }
};
