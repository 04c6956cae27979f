#version 450 core
// Places one quad (or, with POINTS, one point) per cell so that it just encloses the cell's footprint
// in the picture, and computes the cell's light.

layout(binding = 0) uniform usamplerBuffer cells;

#include "frame.glsl"
#include "pixels.glsl"
#include "cell_order.glsl"
#include "cell_place.glsl"
#include "lighting.glsl"
#include "appearance.glsl"
#include "cell_box.glsl"
#include "plane.glsl"
#include "surroundings.glsl"
#include "footprint.glsl"

#ifdef SHADED_APART
flat out vec4 shaded;
#else
vec4 shaded;
#endif

#ifndef POINTS
const vec2 kCorners[4] = vec2[](vec2(-1, -1), vec2(1, -1), vec2(1, 1), vec2(-1, 1));
#endif

#ifdef CUT
#include "cut.glsl"
#else
#include "ellipse.glsl"
#endif

void main() {
    start_eye();
#ifdef POINTS
    uvec3 drawn = in_order(gl_VertexID);
#else
    uvec3 drawn = in_order(gl_VertexID >> 2);
    disc = kCorners[gl_VertexID & 3];
#endif
    uvec3 cell = texelFetch(cells, int(drawn.x)).xyz;
    CellBox box = box_of(cell);
    vec3 normal = plane_normal(cell.z);
    Footprint footprint = footprint_of(box.size, normal, cell.z);
    vec3 center = box.middle + box.size * footprint.center;

    uint style = cell.y >> 16;
    vec3 in_eye = (EYE(eye_from_index) * vec4(center, 1.0)).xyz;
    vec3 lit = shade(in_eye, normal, base_color(style));
    lit *= unshadowed(box.in_index + box.voxels * footprint.center, toward_eye_in_index(center), box.size,
                      normal, style & 7u);
    shaded = vec4(written(lit), surfaces[style & 7u].a * near_share(in_eye));

    if (!blended && shaded.a <= evenly(hash_of(cell)))
        gl_Position = vec4(0, 0, -2, 1);
    else
        draw(footprint, box.size, center, drawn.yz);
}
