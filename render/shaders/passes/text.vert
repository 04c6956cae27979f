#version 450 core
// Places one rectangle on the screen: a character, or a plain area.

#include "srgb.glsl"

layout(binding = 0) uniform samplerBuffer quads; // at, rectangle, rectangle in the atlas, color

layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_model;
    vec4 size; // viewport [pixels] xy, whether places are whole pixels z, least coverage drawn w
};

out vec2 place;
flat out vec4 color;
flat out int kind; // 0 a letter, 1 a halo, -1 a plain area

void main() {
    int quad = 4 * (gl_VertexID >> 2);
    int corner = gl_VertexID & 3;
    vec2 upper = vec2(corner == 1 || corner == 2, corner >= 2);
    vec4 rectangle = texelFetch(quads, quad + 1);
    vec4 in_atlas = texelFetch(quads, quad + 2);
    place = mix(in_atlas.xy, in_atlas.zw, upper);
    color = texelFetch(quads, quad + 3);
    color.rgb = linear_from_srgb(color.rgb);
    vec4 attached = texelFetch(quads, quad);
    kind = attached.w == 0.0 ? -1 : int(attached.w) & 1;
    vec4 at = clip_from_model * vec4(attached.xyz, 1.0);
    if (size.z > 0.0 && at.w > 0.0) {
        vec2 pixel = (0.5 * at.xy / at.w + 0.5) * size.xy;
        at.xy = (2.0 * round(pixel) / size.xy - 1.0) * at.w;
    }
    at.xy += mix(rectangle.xy, rectangle.zw, upper) * 2.0 / size.xy * at.w;
    gl_Position = at.w > 0.0 ? at : vec4(0, 0, -2, 1);
}
