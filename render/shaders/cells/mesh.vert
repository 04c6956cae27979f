#version 450 core
// A vertex of a mesh (index::MeshVertex): the place where the surface cuts an edge of the grid.

#include "frame.glsl"
#include "pixels.glsl"
#include "cell_place.glsl"
#include "surroundings.glsl"
#ifndef NEAR
#include "lighting.glsl"
#endif

// First vertex of each surface, ascending.
layout(location = 1) uniform int first_vertices[MOST_SURFACES];
layout(location = 0) in uvec4 vertex; // the lower end's x and y; z and axis; share; normal
#ifdef COLORS
// Place in the color map, in steps of 1 / 65534; 65535: no value.
layout(location = 1) in uint coordinate;
out vec2 colored_by; // the coordinate times the share of what has a value; that share
flat out uint of_surface;
#endif

// See mesh.frag.
#ifdef LIT_AT_VERTICES
out vec2 lit;
#ifdef BLENDED
out float turned_away;
#endif
#else
out vec4 normal; // in eye space; w: the share of light that arrives
#ifdef NEAR
out vec3 at_in_eye;
out vec3 at_in_index;
#else
out vec3 to_eye;
out vec4 halfway;
#endif
#endif

vec3 unpacked(uint word) {
    vec2 at = unpackSnorm2x16(word);
    vec3 n = vec3(at, 1.0 - abs(at.x) - abs(at.y));
    float fold = max(-n.z, 0.0);
    n.xy -= vec2(n.x < 0.0 ? -fold : fold, n.y < 0.0 ? -fold : fold);
    return word == 0x80008000u ? vec3(0) : normalize(n);
}

void main() {
    start_eye();
    ivec3 low = ivec3(vertex.x & 0xffffu, vertex.x >> 16, vertex.y & 0xffffu);
    uint axis = vertex.y >> 16;
    vec3 in_cell = float(vertex.z) / 2147483648.0 * vec3(axis == 0u, axis == 1u, axis == 2u);
    vec3 size = cell_size(low);
    vec4 at = vec4(vertex_place(low) + size * in_cell, 1.0);
    vec3 n = unpacked(vertex.w);
    uint surface = 0u;
    for (int i = 1; i < MOST_SURFACES; ++i)
        surface += uint(gl_VertexID >= first_vertices[i]);
#ifdef COLORS
    colored_by = coordinate == 65535u ? vec2(0) : vec2(float(coordinate) / 65534.0, 1.0);
    of_surface = surface;
#endif
    float share = unshadowed(vec3(low) + in_cell, toward_eye_in_index(at.xyz), size, n, surface);
    vec3 eye_at = (EYE(eye_from_index) * at).xyz, eye_normal = mat3(EYE(eye_from_physical)) * n;
#if defined(LIT_AT_VERTICES)
    lit = share * light_in_eye(eye_at, eye_normal);
#ifdef BLENDED
    turned_away = turned;
#endif
#elif defined(NEAR)
    at_in_eye = eye_at;
    normal = vec4(eye_normal, share);
    at_in_index = vec3(low) + in_cell;
#else
    float to_distance = inversesqrt(max(dot(eye_at, eye_at), 1e-12));
    to_eye = way_to_eye(eye_at, to_distance);
    halfway = halfway_to_key(to_eye);
    // Without a normal a triangle faces the viewer; if only a vertex has none, the others decide.
    vec3 facing = vertex.w == 0x80008000u ? 1e-4 * to_eye : eye_normal;
    normal = vec4(facing, share * cue_left(eye_at, to_distance));
#endif
    vec4 p = to_pixels(at);
    gl_Position = vec4(p.xy * EYE(clip_per_pixel).xy, p.zw);
}
