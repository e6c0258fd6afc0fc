// SPDX-License-Identifier: MIT
// The fragment shader that draws the scenes: it follows the eye's rays through the same ring, tumbler and pool that the
// photons met (../scenes.hpp), and where they end on the floor it looks up the caustic map.
"use strict";

const causticVertexShader = `#version 300 es
in vec2 corner;
out vec2 place;
void main() { place = corner; gl_Position = vec4(corner, 0, 1); }`;

// SCENE: 0 ring, 1 tumbler, 2 pool; defined before this text.
const causticFragmentShader = `
precision highp float;
precision highp sampler2D;
in vec2 place;
out vec4 colour;
uniform vec3 eye, right, up, forward; // right and up reach to the picture's sides
uniform vec2 pixel;                   // a pixel's size in place
uniform int samples;                  // along each side of a pixel
uniform vec3 lamp;
uniform float power;                  // flux per steradian
uniform float halfMap, texels;
uniform sampler2D map;
uniform float hasLevels;
uniform vec4 waves[4];                // amplitude, turns along x and y, phase in turns

const float PI = 3.14159265;
const vec3 lampColour = vec3(1.0, 0.93, 0.82);

float hash(vec2 p) { p = fract(p * vec2(0.1031, 0.1030)); p += dot(p, p.yx + 33.33); return fract((p.x + p.y) * p.x); }
float noise(vec2 p) {
    vec2 i = floor(p), f = fract(p);
    f = f * f * (3.0 - 2.0 * f);
    return mix(mix(hash(i), hash(i + vec2(1, 0)), f.x), mix(hash(i + vec2(0, 1)), hash(i + vec2(1, 1)), f.x), f.y);
}

// A dim studio with two soft boxes.
vec3 surroundings(vec3 d) {
    vec3 light = mix(vec3(0.035, 0.04, 0.05), vec3(0.10, 0.12, 0.16), smoothstep(-0.1, 0.9, d.z));
    vec2 box = abs(d.xy / max(d.z, 0.05) - vec2(-0.9, 0.5));
    light += 0.75 * vec3(0.9, 0.95, 1.0) * smoothstep(0.62, 0.5, box.x) * smoothstep(0.42, 0.3, box.y) * step(0.0, d.z);
    light += 0.22 * vec3(1.0, 0.9, 0.8) * smoothstep(0.08, 0.0, abs(d.z - 0.32)) * smoothstep(0.2, 0.7, d.x);
    return light;
}
// The lamp's mirror image.
vec3 glint(vec3 p, vec3 d, float wide) {
    float away = 1.0 - dot(d, normalize(lamp - p));
    return lampColour * power * 0.9 * exp(-away / wide);
}

float caustic(vec3 p, float way) {
    vec2 q = p.xy / halfMap;
    float inside = max(abs(q.x), abs(q.y));
#if SCENE == 2
    float fade = step(inside, 1.0);
#else
    float fade = smoothstep(1.0, 0.9, inside);
#endif
    float level = hasLevels * max(log2(way * pixel.y * length(up) * texels / (2.2 * halfMap)), 0.0);
    return fade <= 0.0 ? 0.0 : fade * power * textureLod(map, 0.5 * q + 0.5, level).r;
}

vec2 tube(vec3 o, vec3 d, float radius) { // both distances to an endless tube about z
    float dd = dot(d.xy, d.xy), m = -dot(o.xy, d.xy) / dd;
    vec2 near = o.xy + m * d.xy;
    float h = (radius * radius - dot(near, near)) / dd;
    return h < 0.0 ? vec2(1e9) : m + vec2(-1, 1) * sqrt(h);
}
// How near and how far from the z axis the way from a point to the lamp is below a height, squared.
vec2 reachBelow(vec3 p, float height) {
    vec2 way = (lamp.xy - p.xy) * max((height - p.z) / (lamp.z - p.z), 0.0), end = p.xy + way;
    vec2 near = p.xy + clamp(-dot(p.xy, way) / max(dot(way, way), 1e-12), 0.0, 1.0) * way;
    return vec2(dot(near, near), max(dot(p.xy, p.xy), dot(end, end)));
}

#if SCENE == 0
const float INNER = 0.72, OUTER = 0.8, TOP = 0.34;
const vec3 metal = vec3(1.0, 0.72, 0.33);
bool isLit(vec3 p) {
    vec2 reach = reachBelow(p, TOP);
    return reach.x > OUTER * OUTER || reach.y < INNER * INNER;
}
const vec3 causticColour = metal;
vec3 albedo(vec3 p) {
    return mix(vec3(0.235, 0.25, 0.285), vec3(0.275, 0.285, 0.315), noise(p.xy * 26.0));
}
#elif SCENE == 1
const float OUTER = 0.42, INNER = 0.385, TOP = 0.96, UNDER = 0.004, BASE = 0.09, WATER = 0.62;
bool isLit(vec3 p) { return reachBelow(p, TOP).x > OUTER * OUTER; }
const vec3 causticColour = vec3(1);
vec3 albedo(vec3 p) {
    float board = floor(p.y * 1.6), shift = hash(vec2(board, 7.0)) * 9.0;
    float seam = smoothstep(0.0, 0.012, abs(fract(p.y * 1.6) - 0.5) * -1.0 + 0.5);
    float grain = noise(vec2(p.x * 2.6 + shift, p.y * 46.0));
    vec3 wood = mix(vec3(0.30, 0.17, 0.09), vec3(0.50, 0.31, 0.18), grain) * (0.85 + 0.3 * hash(vec2(board, 3.0)));
    return wood * mix(0.55, 1.0, seam);
}
#else
const float DEPTH = 0.8, RIM = 0.86;
const vec3 causticColour = vec3(0.93, 1.0, 1.0);
bool isLit(vec3 p) { return false; } // all light on the floor has passed the water
vec3 tiles(vec2 p) {
    vec2 q = p * 5.0, cell = floor(q), f = abs(fract(q) - 0.5);
    float joint = smoothstep(0.5, 0.475, max(f.x, f.y));
    vec3 glaze = mix(vec3(0.20, 0.47, 0.58), vec3(0.26, 0.53, 0.63), hash(cell));
    return mix(vec3(0.42, 0.56, 0.6), glaze, joint);
}
vec3 albedo(vec3 p) { return tiles(p.xy); }
#endif

vec3 floorLight(vec3 p, float way) {
    vec3 to = lamp - p;
    float d2 = dot(to, to);
    vec3 d = to * inversesqrt(d2);
    float direct = isLit(p) ? power * d.z / d2 : 0.0;
    vec3 light = direct + causticColour * caustic(p, way);
    float vignette = 1.0 / (1.0 + 0.05 * dot(p.xy, p.xy));
    return albedo(p) * (light * lampColour / PI + vec3(0.05, 0.06, 0.075) * vignette);
}

float fresnel(float c, float eta) { // eta: index on the ray's side over that on the other
    float s2 = eta * eta * (1.0 - c * c);
    if (s2 >= 1.0)
        return 1.0;
    float o = sqrt(1.0 - s2), a = (eta * c - o) / (eta * c + o), b = (c - eta * o) / (c + eta * o);
    return 0.5 * (a * a + b * b);
}

#if SCENE == 0
vec3 radiance(vec3 o, vec3 d, out float first) {
    vec3 share = vec3(1), sum = vec3(0);
    float way = 0.0;
    first = 1e9;
    for (int i = 0; i < 6; ++i) {
        float t = d.z < 0.0 ? -o.z / d.z : 1e9, bevel = 0.0;
        vec3 n = vec3(0, 0, 1);
        int hit = t < 1e8 ? 0 : -1;
        float dd = dot(d.xy, d.xy), m = -dot(o.xy, d.xy) / dd;
        vec2 near = o.xy + m * d.xy;
        float near2 = dot(near, near);
        if (near2 < OUTER * OUTER) {
            for (int side = 0; side < 2; ++side) {
                float r = side == 0 ? INNER : OUTER, half2 = (r * r - near2) / dd;
                if (half2 < 0.0)
                    continue;
                for (int k = 0; k < 2; ++k) {
                    float at = m + (k == 0 ? -1.0 : 1.0) * sqrt(half2), z = o.z + at * d.z;
                    if (at > 1e-4 && at < t && z > 0.0 && z < TOP) {
                        t = at, hit = 1;
                        n = vec3((o.xy + t * d.xy) / r, 0) * (side == 0 ? -1.0 : 1.0);
                        bevel = smoothstep(TOP - 0.02, TOP, z);
                    }
                }
            }
            float at = (TOP - o.z) / d.z;
            if (at > 1e-4 && at < t) {
                float r = length(o.xy + at * d.xy);
                if (r > INNER && r < OUTER) {
                    t = at, hit = 1;
                    float x = (r - 0.5 * (INNER + OUTER)) / (0.5 * (OUTER - INNER));
                    n = normalize(vec3((o.xy + at * d.xy) / r * x * x * x * 0.9, 1));
                }
            }
        }
        if (i == 0)
            first = t;
        if (hit < 0)
            return sum + share * surroundings(d);
        vec3 p = o + t * d;
        way += t;
        if (hit == 0)
            return sum + share * floorLight(vec3(p.xy, 0), way);
        n = normalize(n + vec3(0, 0, bevel * 0.9));
        float grazing = pow(1.0 - abs(dot(d, n)), 5.0);
        share *= mix(metal * 0.92, vec3(1), grazing);
        d = reflect(d, n);
        o = p + 1e-4 * n;
        bool seesLamp = p.z > TOP - 0.02 || reachBelow(p + 0.02 * n, TOP).y < INNER * INNER;
        sum += share * glint(p, d, 0.0006) * (seesLamp ? 1.0 : 0.0);
    }
    return sum;
}
#elif SCENE == 1
vec3 reflected(vec3 p, vec3 d) { // once more, without the tumbler
    return d.z < 0.0 ? floorLight(p - d * p.z / d.z, 3.0) : surroundings(d) + glint(p, d, 0.0005);
}
vec3 radiance(vec3 o, vec3 d, out float first) {
    vec3 share = vec3(1), sum = vec3(0);
    float way = 0.0;
    first = 1e9;
    for (int i = 0; i < 14; ++i) {
        float t = d.z < 0.0 ? -o.z / d.z : 1e9, front = 1.0, back = 1.5;
        vec3 n = vec3(0, 0, 1);
        int hit = t < 1e8 ? 0 : -1;
        for (int side = 0; side < 2; ++side) {
            float r = side == 0 ? OUTER : INNER;
            vec2 ts = tube(o, d, r);
            for (int k = 0; k < 2; ++k) {
                float at = k == 0 ? ts.x : ts.y, z = o.z + at * d.z;
                if (at > 1e-4 && at < t && z > (side == 0 ? UNDER : BASE) && z < TOP) {
                    t = at, hit = 1;
                    n = vec3((o.xy + t * d.xy) / r, 0);
                    front = side == 0 ? 1.0 : 1.5;
                    back = side == 0 ? 1.5 : z < WATER ? 1.333 : 1.0;
                }
            }
        }
        for (int k = 0; k < 4; ++k) {
            float height = k == 0 ? TOP : k == 1 ? UNDER : k == 2 ? BASE : WATER;
            float at = (height - o.z) / d.z;
            if (at > 1e-4 && at < t) {
                float r = length(o.xy + at * d.xy);
                if (k == 0 ? r < OUTER && r > INNER : r < (k == 1 ? OUTER : INNER)) {
                    t = at, hit = 1;
                    n = vec3(0, 0, k == 1 ? -1 : 1);
                    front = k == 2 ? 1.333 : 1.0;
                    back = k == 3 ? 1.333 : 1.5;
                }
            }
        }
        if (i == 0)
            first = t;
        if (hit < 0)
            return sum + share * surroundings(d);
        vec3 p = o + t * d;
        way += t;
        if (hit == 0)
            return sum + share * floorLight(vec3(p.xy, 0), way);
        float c = -dot(d, n);
        bool enters = c > 0.0;
        vec3 facing = enters ? n : -n;
        float inside = enters ? front : back; // where the ray comes from
        if (inside > 1.4)
            share *= exp(-t * vec3(0.9, 0.35, 0.5)); // glass is a little green
        else if (inside > 1.1)
            share *= exp(-t * vec3(0.22, 0.06, 0.03));
        float eta = enters ? front / back : back / front, f = fresnel(abs(c), eta);
        if (f < 1.0) {
            if (i < 4)
                sum += share * f * reflected(p + 1e-3 * facing, reflect(d, facing));
            share *= 1.0 - f;
            d = normalize(refract(d, facing, eta));
            o = p - 1e-4 * facing;
        } else {
            d = reflect(d, facing);
            o = p + 1e-4 * facing;
        }
    }
    return sum;
}
#else
float height(vec2 p) {
    float sum = 0.0;
    for (int i = 0; i < 4; ++i)
        sum += waves[i].x * sin(2.0 * PI * (dot(waves[i].yz, p) - waves[i].w));
    return sum;
}
vec2 slopes(vec2 p) {
    vec2 sum = vec2(0);
    for (int i = 0; i < 4; ++i)
        sum += 2.0 * PI * waves[i].x * waves[i].yz * cos(2.0 * PI * (dot(waves[i].yz, p) - waves[i].w));
    return sum;
}
vec3 wall(vec3 p, vec3 n, float refracted) { // the lamp's light as through flat water
    vec3 to = lamp - p;
    float d2 = dot(to, to), along = refracted > 0.5 ? 0.55 : 0.8;
    float light = power * max(dot(n, to) * inversesqrt(d2), 0.0) / d2 * along;
    vec2 q = abs(n.x) > 0.5 ? p.yz : p.xz;
    return tiles(q + vec2(0, 0.05)) * (0.8 * light * lampColour / PI + vec3(0.05, 0.06, 0.07));
}
vec3 basin(vec3 o, vec3 d, float way, float refracted) { // from a point within to the floor or a wall
    vec3 t = (sign(d) - o) / d;
    float side = min(t.x, t.y), down = d.z < 0.0 ? -o.z / d.z : 1e9;
    vec3 p = o + min(side, down) * d;
    vec3 fade = refracted > 0.5 ? exp(-min(side, down) * vec3(0.34, 0.07, 0.035)) : vec3(1);
    if (down < side)
        return fade * floorLight(vec3(p.xy, 0), way + down);
    if (p.z > RIM)
        return surroundings(d) + glint(o, d, 0.00025);
    return fade * wall(p, t.x < t.y ? vec3(-sign(d.x), 0, 0) : vec3(0, -sign(d.y), 0), refracted);
}
vec3 deck(vec3 p) {
    vec3 to = lamp - p;
    float d2 = dot(to, to), edge = max(abs(p.x), abs(p.y));
    vec2 q = p.xy * 2.5, f = abs(fract(q) - 0.5);
    float joint = edge < 1.13 ? 1.0 : smoothstep(0.5, 0.485, max(f.x, f.y));
    vec3 stone = mix(vec3(0.36, 0.335, 0.30), vec3(0.44, 0.41, 0.37), 0.6 * noise(p.xy * 24.0) + 0.4 * hash(floor(q)));
    stone *= edge < 1.13 ? 1.12 : 1.0;
    stone *= smoothstep(1.125, 1.135, edge) * 0.25 + 0.75 + 0.25 * step(edge, 1.12);
    vec3 light = power * to.z * inversesqrt(d2) / d2 * lampColour / PI + vec3(0.05, 0.06, 0.075);
    return stone * mix(0.6, 1.0, joint) * light;
}
vec3 radiance(vec3 o, vec3 d, out float first) {
    first = d.z < 0.0 ? (RIM - o.z) / d.z : 1e9;
    if (d.z >= 0.0)
        return surroundings(d);
    vec3 p = o + first * d;
    if (max(abs(p.x), abs(p.y)) > 1.0)
        return deck(p);
    float t = (DEPTH - p.z) / d.z;
    for (int i = 0; i < 2; ++i)
        t = (DEPTH + height(p.xy + t * d.xy) - p.z) / d.z;
    vec3 q = p + t * d;
    if (max(abs(q.x), abs(q.y)) > 1.0)
        return basin(p, d, first, 0.0);
    vec3 n = normalize(vec3(-slopes(q.xy), 1));
    float f = fresnel(clamp(-dot(d, n), 0.0, 1.0), 1.0 / 1.333);
    vec3 mirrored = reflect(d, n);
    vec3 above = surroundings(mirrored) + glint(q, mirrored, 0.0003);
    return mix(basin(q, normalize(refract(d, n, 1.0 / 1.333)), first + t, 1.0), above, f);
}
#endif

vec3 bulb(vec3 o, vec3 d, float first) { // the lamp on its cord
    float along = dot(lamp - o, d);
    float apart = length(lamp - o - along * d);
    vec3 light = vec3(0);
    if (along > 0.0 && along < first + 0.05)
        light += lampColour * (4.0 * smoothstep(0.05, 0.042, apart) + 0.0035 / (apart * apart + 0.006));
    return light;
}
float cord(vec3 o, vec3 d, float first) {
    vec2 across = vec2(-d.y, d.x) * inversesqrt(dot(d.xy, d.xy)), from = lamp.xy - o.xy;
    float t = dot(from, d.xy) / dot(d.xy, d.xy), z = o.z + t * d.z;
    if (t < 0.0 || t > first || z < lamp.z + 0.04)
        return 0.0;
    return 1.0 - smoothstep(0.004, 0.004 + 1.5 * t * pixel.y * length(up), abs(dot(from, across)));
}

void main() {
    vec3 sum = vec3(0);
    for (int j = 0; j < samples; ++j)
        for (int i = 0; i < samples; ++i) {
            vec2 at = place + pixel * ((vec2(i, j) + 0.5) / float(samples) - 0.5);
            vec3 d = normalize(forward + at.x * right + at.y * up);
            float first;
            vec3 light = radiance(eye, d, first);
            light = mix(light, vec3(0.01), cord(eye, d, first)) + bulb(eye, d, first);
            light = light * (2.51 * light + 0.03) / (light * (2.43 * light + 0.59) + 0.14); // a filmic curve
            sum += light;
        }
    vec3 shown = clamp(sum / float(samples * samples), 0.0, 1.0);
    colour = vec4(pow(shown, vec3(1.0 / 2.2)), 1);
}`;
