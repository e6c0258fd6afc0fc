// SPDX-License-Identifier: MIT
/// @file  Embree 3 or 4 behind one interface: a triangle mesh as a geometry, and the nearest hit of a ray.
#pragma once

#if __has_include(<embree4/rtcore.h>)
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

#include <cstddef>
#include <cstdint>

/// A mesh, copied. The caller commits, attaches and releases it.
///
/// @param positions  a list of vectors with x, y and z
/// @param triangles  a list of three indices each
template <class Positions, class Triangles>
[[nodiscard]] RTCGeometry triangle_geometry(RTCDevice device, const Positions& positions, const Triangles& triangles) {
    const RTCGeometry geometry = rtcNewGeometry(device, RTC_GEOMETRY_TYPE_TRIANGLE);
    auto* const p = static_cast<float*>(rtcSetNewGeometryBuffer(geometry, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3,
                                                                3 * sizeof(float), positions.size()));
    for (std::size_t i = 0; i < positions.size(); ++i)
        p[3 * i] = positions[i].x, p[3 * i + 1] = positions[i].y, p[3 * i + 2] = positions[i].z;
    auto* const t = static_cast<std::uint32_t*>(rtcSetNewGeometryBuffer(
        geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 3 * sizeof(std::uint32_t), triangles.size()));
    for (std::size_t i = 0; i < 3 * triangles.size(); ++i)
        t[i] = triangles[i / 3][i % 3];
    return geometry;
}

/// The nearest hit; its geomID is RTC_INVALID_GEOMETRY_ID where there is none.
///
/// @param o, d       origin and direction: vectors with x, y and z
/// @param coherent  tells Embree that rays come in an order
template <class Vector>
[[nodiscard]] RTCRayHit nearest_hit(RTCScene scene, const Vector& o, const Vector& d, float t_min, float t_max,
                                    bool coherent = false) {
    RTCRayHit r;
    r.ray.org_x = o.x, r.ray.org_y = o.y, r.ray.org_z = o.z, r.ray.tnear = t_min;
    r.ray.dir_x = d.x, r.ray.dir_y = d.y, r.ray.dir_z = d.z, r.ray.tfar = t_max;
    r.ray.time = 0, r.ray.mask = ~0u, r.ray.flags = 0;
    r.hit.geomID = r.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
#if RTC_VERSION_MAJOR >= 4
    RTCIntersectArguments arguments;
    rtcInitIntersectArguments(&arguments);
    if (coherent)
        arguments.flags = RTC_RAY_QUERY_FLAG_COHERENT;
    rtcIntersect1(scene, &r, &arguments);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    if (coherent)
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    rtcIntersect1(scene, &context, &r);
#endif
    return r;
}
