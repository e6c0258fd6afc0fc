// SPDX-License-Identifier: MIT
// Drives the page of examples/web in a headless Chromium over its debugging pipe, as a person would.
// node web_browser.js <chromium> <the page's folder> <folder for what comes out> [width height name]
"use strict";
const { spawn } = require("child_process");
const fs = require("fs");
const path = require("path");
const [chromium, folder, out] = process.argv.slice(2);

const profile = fs.mkdtempSync(path.join(out, "profile-"));
const browser = spawn(chromium, ["--headless=new", "--no-sandbox", "--disable-gpu-sandbox", "--use-angle=swiftshader",
    "--enable-unsafe-swiftshader", "--remote-debugging-pipe", "--user-data-dir=" + profile, "--no-first-run",
    "--disable-background-networking", "--disable-dev-shm-usage", "--hide-scrollbars", "about:blank"],
    { stdio: ["ignore", "ignore", "ignore", "pipe", "pipe"] });
const end = code => {
    browser.kill();
    browser.once("exit", () => {
        fs.rmSync(profile, { recursive: true, force: true, maxRetries: 5 });
        process.exit(code);
    });
    setTimeout(() => process.exit(code), 5000);
};
const fail = message => {
    console.error("FAILED: " + message);
    end(1);
};

// Messages are JSON, and end with a zero byte.
let number = 0, received = "";
const waiting = new Map(), requests = [];
let told = [];
browser.stdio[4].setEncoding("utf8");
browser.stdio[4].on("data", data => {
    received += data;
    for (let at = received.indexOf("\0"); at >= 0; at = received.indexOf("\0")) {
        const message = JSON.parse(received.slice(0, at));
        received = received.slice(at + 1);
        if (message.id) {
            const { resolve, reject } = waiting.get(message.id);
            waiting.delete(message.id);
            message.error ? reject(new Error(JSON.stringify(message.error))) : resolve(message.result);
        } else if (message.method === "Runtime.exceptionThrown") {
            told.push(message.params.exceptionDetails.exception.description);
        } else if (message.method === "Network.requestWillBeSent") {
            requests.push(message.params.request.url);
        }
    }
});
let session;
const call = (method, params = {}) => new Promise((resolve, reject) => {
    waiting.set(++number, { resolve, reject });
    browser.stdio[3].write(JSON.stringify({ id: number, method, params, sessionId: session }) + "\0");
});
// Processor seconds of the page and of what draws for it, since they began.
const spent = async () => {
    const id = ++number;
    const { processInfo } = await new Promise((resolve, reject) => {
        waiting.set(id, { resolve, reject });
        browser.stdio[3].write(JSON.stringify({ id, method: "SystemInfo.getProcessInfo" }) + "\0");
    });
    const of = type => processInfo.filter(p => p.type === type).reduce((sum, p) => sum + p.cpuTime, 0);
    return { page: of("renderer"), drawing: of("GPU") };
};
const sleep = ms => new Promise(resolve => setTimeout(resolve, ms));
const evaluate = async text => {
    const answer = await call("Runtime.evaluate", { expression: text, returnByValue: true, awaitPromise: true });
    if (answer.exceptionDetails)
        throw new Error(answer.exceptionDetails.exception.description);
    return answer.result.value;
};
const until = async (what, text, seconds = 300) => {
    for (const start = Date.now(); Date.now() - start < 1000 * seconds; await sleep(100))
        if (await evaluate(text))
            return;
    throw new Error(what + ": not within " + seconds + " s; the page says: " +
        await evaluate("document.getElementById('verdict')?.textContent"));
};
const mouse = (type, x, y, buttons) => call("Input.dispatchMouseEvent",
    { type, x, y, button: buttons || type === "mouseReleased" ? "left" : "none", buttons, clickCount: 1 });
const screen = async name => {
    const { data } = await call("Page.captureScreenshot", { format: "png" });
    fs.writeFileSync(path.join(out, name + ".png"), Buffer.from(data, "base64"));
};
const open = async (width, height, density = 1) => {
    await call("Emulation.setDeviceMetricsOverride",
        { width, height, deviceScaleFactor: density, mobile: width < 600 });
    await call("Page.navigate", { url: "file://" + path.resolve(folder, "index.html") });
    const failed = "document.getElementById('verdict')?.className === 'failed'";
    await until("the page loads", "!!window.nephroidPage || " + failed);
    if (await evaluate(failed))
        throw new Error(await evaluate("document.getElementById('verdict')?.textContent"));
};
// The picture that WebGL drew, as its mean and its variance.
const seen = () => evaluate(`(() => {
    const gl = nephroidPage.view.gl, w = gl.drawingBufferWidth, h = gl.drawingBufferHeight;
    const bytes = new Uint8Array(4 * w * h);
    gl.readPixels(0, 0, w, h, gl.RGBA, gl.UNSIGNED_BYTE, bytes);
    let sum = 0, squares = 0;
    for (let i = 0; i < bytes.length; i += 4) { sum += bytes[i]; squares += bytes[i] * bytes[i]; }
    const mean = sum / (w * h);
    return { mean, deviation: Math.sqrt(squares / (w * h) - mean * mean) };
})()`);

const check = (holds, what) => {
    if (!holds)
        throw new Error(what);
    console.log("holds: " + what);
};

async function main() {
    const { targetInfos } = await call("Target.getTargets");
    const { targetId } = targetInfos.find(target => target.type === "page");
    session = (await call("Target.attachToTarget", { targetId, flatten: true })).sessionId;
    for (const domain of ["Page", "Runtime", "Network"])
        await call(domain + ".enable");
    return require(path.resolve(process.argv[5] || path.join(__dirname, "web_checks.js")))(
        { call, evaluate, until, mouse, screen, open, seen, check, sleep, spent, requests, told, out, fs, path });
}
main().then(() => end(0), error => fail(error.message));
