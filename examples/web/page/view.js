// SPDX-License-Identifier: MIT
// The picture: a caustic map as a texture, the scene's shader, and a camera.
"use strict";

class CausticView {
    constructor(canvas) {
        this.canvas = canvas;
        const gl = canvas.getContext("webgl2", { antialias: false, alpha: false, preserveDrawingBuffer: true });
        if (!gl)
            throw new Error("This page needs WebGL 2, which this browser does not offer.");
        this.gl = gl;
        this.programs = [null, null, null];
        this.hasLevels = ["EXT_color_buffer_float", "EXT_color_buffer_half_float"].some(e => gl.getExtension(e));
        gl.bindBuffer(gl.ARRAY_BUFFER, gl.createBuffer());
        gl.bufferData(gl.ARRAY_BUFFER, new Float32Array([-1, -1, 3, -1, -1, 3]), gl.STATIC_DRAW);
        gl.enableVertexAttribArray(0);
        gl.vertexAttribPointer(0, 2, gl.FLOAT, false, 0, 0);
        this.texture = gl.createTexture();
        gl.bindTexture(gl.TEXTURE_2D, this.texture);
        const set = (name, value) => gl.texParameteri(gl.TEXTURE_2D, name, value);
        set(gl.TEXTURE_MIN_FILTER, this.hasLevels ? gl.LINEAR_MIPMAP_LINEAR : gl.LINEAR);
        set(gl.TEXTURE_MAG_FILTER, gl.LINEAR);
        set(gl.TEXTURE_WRAP_S, gl.CLAMP_TO_EDGE);
        set(gl.TEXTURE_WRAP_T, gl.CLAMP_TO_EDGE);
        this.texels = 0;
    }

    program(scene) {
        if (this.programs[scene])
            return this.programs[scene];
        const gl = this.gl, program = gl.createProgram();
        const text = "#version 300 es\n#define SCENE " + scene + "\n" + causticFragmentShader;
        for (const [kind, source] of [[gl.VERTEX_SHADER, causticVertexShader], [gl.FRAGMENT_SHADER, text]]) {
            const shader = gl.createShader(kind);
            gl.shaderSource(shader, source);
            gl.compileShader(shader);
            if (!gl.getShaderParameter(shader, gl.COMPILE_STATUS))
                throw new Error(gl.getShaderInfoLog(shader));
            gl.attachShader(program, shader);
        }
        gl.bindAttribLocation(program, 0, "corner");
        gl.linkProgram(program);
        if (!gl.getProgramParameter(program, gl.LINK_STATUS))
            throw new Error(gl.getProgramInfoLog(program));
        const places = {};
        for (let i = 0; i < gl.getProgramParameter(program, gl.ACTIVE_UNIFORMS); ++i) {
            const name = gl.getActiveUniform(program, i).name;
            places[name] = gl.getUniformLocation(program, name);
        }
        return this.programs[scene] = { program, places };
    }

    // The irradiance of size x size places of the floor, as floats. Half of their digits are enough to look at.
    upload(irradiance, size) {
        const gl = this.gl;
        if (size !== this.texels)
            gl.texImage2D(gl.TEXTURE_2D, 0, gl.R16F, size, size, 0, gl.RED, gl.FLOAT, irradiance);
        else
            gl.texSubImage2D(gl.TEXTURE_2D, 0, 0, 0, size, size, gl.RED, gl.FLOAT, irradiance);
        this.texels = size;
        if (this.hasLevels)
            gl.generateMipmap(gl.TEXTURE_2D);
    }

    camera(orbit) {
        const { azimuth: a, elevation: e, distance, target } = orbit;
        const back = [Math.cos(a) * Math.cos(e), Math.sin(a) * Math.cos(e), Math.sin(e)];
        const aspect = this.canvas.width / this.canvas.height, reach = 0.42 / Math.min(aspect, 1);
        const right = [-Math.sin(a), Math.cos(a), 0];
        const up = [-Math.cos(a) * Math.sin(e), -Math.sin(a) * Math.sin(e), Math.cos(e)];
        return {
            eye: target.map((t, i) => t + distance * back[i]),
            forward: back.map(x => -x),
            right: right.map(x => x * reach * aspect),
            up: up.map(x => x * reach),
        };
    }

    // The ray's direction at a place of the picture, -1 to 1 to the right and up.
    ray(camera, x, y) {
        return camera.forward.map((f, i) => f + x * camera.right[i] + y * camera.up[i]);
    }

    draw(scene, orbit, lamp, power, halfMap, waves, samples) {
        const gl = this.gl, { program, places } = this.program(scene), camera = this.camera(orbit);
        gl.viewport(0, 0, this.canvas.width, this.canvas.height);
        gl.useProgram(program);
        for (const name of ["eye", "right", "up", "forward"])
            gl.uniform3fv(places[name], camera[name]);
        gl.uniform2f(places.pixel, 2 / this.canvas.width, 2 / this.canvas.height);
        gl.uniform1i(places.samples, samples);
        gl.uniform3fv(places.lamp, lamp);
        gl.uniform1f(places.power, power);
        gl.uniform1f(places.halfMap, halfMap);
        gl.uniform1f(places.texels, this.texels);
        gl.uniform1f(places.hasLevels, this.hasLevels ? 1 : 0);
        if (places["waves[0]"])
            gl.uniform4fv(places["waves[0]"], waves);
        gl.drawArrays(gl.TRIANGLES, 0, 3);
    }
}
