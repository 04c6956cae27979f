#version 450 core
// A triangle beside the cells, lit, cut and faded near the eye as surfaces are.
// EDGES: a line of it, whose depths say nothing of a normal.

#include "frame.glsl"
#include "lighting.glsl"
#include "appearance.glsl"

layout(location = 4) uniform vec4 color; // linear light; a: opacity
in vec3 at_in_eye;
in vec3 at_in_index;
in vec3 normal;
out vec4 result;

void main() {
    vec3 n = normal;
#ifndef EDGES
    vec3 across = cross(dFdx(at_in_eye), dFdy(at_in_eye));
    if (dot(n, n) == 0.0)
        n = across;
#endif
    vec2 lit = light_in_eye(at_in_eye, n);
    float share = near_share(at_in_eye);
#ifdef BLENDED
    result = layer_of(color.rgb, lit, turned, color.a) * share;
#else
    vec3 cell = floor(at_in_index);
    uvec3 number = uvec3(ivec3(cell));
    if (share <= grain(at_in_index - cell - 0.5, hash_of(uvec3(number.x & 0xffffu | number.y << 16, number.z, 0))))
        discard;
    result = vec4(color.rgb * lit.x + lit.y, 1.0);
#endif
}
