#version 450 core
// A triangle of a mesh, lit as the exact surface is: for each pixel, by normals in between; or, where
// triangles are of few pixels, for each vertex.

#include "frame.glsl"
#ifdef LIT_AT_VERTICES
#include "srgb.glsl"
#else
#include "lighting.glsl"
#endif
#include "appearance.glsl"

#ifdef STYLES
layout(binding = 8) uniform usamplerBuffer styles; // of each triangle
layout(location = 0) uniform int first_triangle;
#else
layout(location = 0) uniform vec3 base; // linear light
#endif

#ifdef LIT_AT_VERTICES
in vec2 lit;
#else
in vec3 at_in_eye;
in vec3 normal;
in float light_share;
#endif
#ifdef NEAR
in vec3 at_in_index;
#endif
out vec4 result;

void main() {
#ifdef STYLES
    uint style = texelFetch(styles, first_triangle + gl_PrimitiveID).x;
    vec3 base = base_color(style);
#endif
#ifndef LIT_AT_VERTICES
    vec2 lit = light_share * light_in_eye(at_in_eye, normal);
#endif
    vec3 shown = written(base * lit.x + lit.y);
#ifdef BLENDED
    float alpha = surfaces[style & 7u].a * near_share(at_in_eye);
    result = vec4(shown * alpha, alpha);
#else
#ifdef NEAR
    vec3 cell = floor(at_in_index);
    if (near_share(at_in_eye) <= grain(at_in_index - cell - 0.5, hash_of(uvec3(uint(cell.x) | uint(cell.y) << 16, uint(cell.z), 0))))
        discard;
#endif
    result = vec4(shown, 1.0);
#endif
}
