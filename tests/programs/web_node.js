// SPDX-License-Identifier: MIT
// What the library draws in WebAssembly, against the same source compiled for this machine.
// node --no-experimental-fetch web_node.js <the programs' folder> [time]: with `time` it says how long pictures take.
"use strict";
const { execFileSync } = require("child_process");
const fs = require("fs");
const os = require("os");
const path = require("path");
const programs = path.resolve(process.argv[2]);
const create = require(path.join(programs, "web", "caustic_map.js"));

const methods = ["sheets", "splats", "thin lens", "dots"], names = ["ring", "tumbler", "pool"];
const lamps = [[0.75, 0.55, 1.5], [-1.55, 0.95, 1.6], [0.2, 0.25, 2.1]];

// Floating point is the same in both but for the C library's functions (angles on a tube, logarithms where sheets are
// split), a unit in the last place, which folds magnify by a thousand at most: 1e-4 of a pixel. A photon that meets a
// rim in one and misses it in the other moves its flux out of a few pixels: two such photons may. A wrong formula moves
// all pixels.
const most = 1e-4, odd = 16;

function native(scene, method, photons, size, seconds) {
    const file = path.join(os.tmpdir(), "web-native-" + process.pid + ".raw");
    execFileSync(path.join(programs, "web", "web_caustic_map"),
        [scene, method, photons, size, ...lamps[scene], seconds, file].map(String));
    const bytes = fs.readFileSync(file);
    fs.unlinkSync(file);
    return new Float32Array(bytes.buffer, bytes.byteOffset, size * size);
}

create().then(caustics => {
    const draw = (scene, method, photons, size, seconds) => {
        const at = caustics._nephroid_draw(scene, method, photons, size, ...lamps[scene], seconds);
        return new Float32Array(caustics.HEAPF32.buffer, at, size * size); // not before: the call may grow the memory
    };
    if (process.argv[3] === "time") {
        console.log(`load ${os.loadavg()[0].toFixed(1)} on ${os.cpus().length} cores; processor ms, 512 x 512 places`);
        for (const [scene, photons] of [[0, 5000], [1, 5000], [2, 4000]])
            for (const method of [0, 1, 2, 3]) {
                const times = [];
                for (let i = 0; i < 12; ++i) {
                    const start = process.cpuUsage();
                    draw(scene, method, photons, 512, 0.1 * i);
                    const { user, system } = process.cpuUsage(start);
                    times.push((user + system) / 1000);
                }
                times.sort((a, b) => a - b);
                console.log(`${names[scene]}, ${methods[method]}, ${photons} photons: median ${times[6].toFixed(1)}, ` +
                    `best ${times[0].toFixed(1)}`);
            }
        return;
    }
    let failed = 0;
    const size = 128, photons = 4000, seconds = 1.25;
    for (let scene = 0; scene < 3; ++scene)
        for (let method = 0; method < 4; ++method) {
            const here = native(scene, method, photons, size, seconds);
            const there = draw(scene, method, photons, size, seconds);
            const total = light => light.reduce((a, b) => a + b, 0);
            const sum = total(here), other = total(there), mean = sum / here.length;
            const apart = Array.from(here, (e, i) => Math.abs(e - there[i]));
            const differing = apart.filter((d, i) => !(d <= most * (mean + here[i]))).length;
            const rms = Math.sqrt(apart.reduce((a, d) => a + d * d, 0) / apart.length) / mean;
            const holds = sum > 0 && differing <= odd && Math.abs(other / sum - 1) <= 2 / photons;
            failed += !holds;
            console.log(`${names[scene]}, ${methods[method]}: rms difference ${rms.toExponential(1)} of the mean, ` +
                `energy ${(other / sum - 1).toExponential(1)}, ${differing} of ${size * size} pixels differ` +
                (holds ? "" : "  FAILED"));
        }
    process.exitCode = failed ? 1 : 0;
}).catch(error => {
    console.error(String(error.stack || error).slice(0, 2000));
    process.exit(1);
});
