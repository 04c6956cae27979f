#version 450 core
// A triangle of a mesh, lit as the exact surface is: for each pixel, by normals in between.
// NEAR: the directions to the eye and to the key light are found for each pixel, and what is too near is
// left out. Else these directions, which hardly change within a triangle, are interpolated from the
// vertices. LIT_AT_VERTICES: the light itself is, as triangles are of few pixels.

#include "frame.glsl"
#ifdef LIT_AT_VERTICES
#include "srgb.glsl"
#else
#include "lighting.glsl"
#endif
#include "appearance.glsl"

#ifdef COLORS
in vec2 colored_by; // see mesh.vert
flat in uint of_surface;
#else
layout(location = 0) uniform vec3 base; // linear light
#endif

#ifdef LIT_AT_VERTICES
in vec2 lit;
#ifdef BLENDED
in float turned_away;
#endif
#else
in vec4 normal;
#ifdef NEAR
in vec3 at_in_eye;
in vec3 at_in_index;
#else
in vec3 to_eye;
in vec4 halfway;
#endif
#endif
out vec4 result;

void main() {
#ifdef COLORS
    vec3 base = !colored             ? surfaces[of_surface].rgb
                : colored_by.y < 0.5 ? no_value.rgb
                                     : mapped_color(colored_by.x / colored_by.y);
#endif
#if defined(NEAR)
    vec2 lit = normal.w * light_in_eye(at_in_eye, normal.xyz);
#elif !defined(LIT_AT_VERTICES)
    vec3 n = normal.xyz * inversesqrt(max(dot(normal.xyz, normal.xyz), 1e-20));
    float facing = dot(n, to_eye);
    n = facing < 0.0 ? -n : n;
    vec2 lit = normal.w * light_of(n, abs(facing), halfway);
#endif
#ifdef BLENDED
#ifdef LIT_AT_VERTICES
    float turned = turned_away;
#endif
    result = layer_of(base, lit, turned, surfaces[of_surface].a);
#ifdef NEAR
    result *= near_share(at_in_eye);
#endif
#else
    vec3 shown = base * lit.x + lit.y;
#if defined(NEAR)
    vec3 cell = floor(at_in_index);
    if (near_share(at_in_eye) <= grain(at_in_index - cell - 0.5, hash_of(uvec3(uint(cell.x) | uint(cell.y) << 16, uint(cell.z), 0))))
        discard;
#endif
    result = vec4(shown, 1.0);
#endif
}
