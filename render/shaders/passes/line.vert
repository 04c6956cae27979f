#version 450 core
// Widens a line segment to a screen-space quad.

#include "srgb.glsl"

layout(binding = 0) uniform samplerBuffer segments; // from, to, color

layout(std140, binding = 0) uniform Frame {
    mat4 clip_from_model;
    vec4 size; // viewport [pixels] xy, half width with its soft edge [pixels] z, least coverage drawn w
};

// Pixels from the middle of the line, times w, which the fragment shader divides out. It is not
// `noperspective`, as Mesa divides zero by zero when it clips such an output of a vertical line.
out float across_w;
flat out vec4 color;

void main() {
    int segment = 3 * (gl_VertexID >> 2);
    int corner = gl_VertexID & 3;
    vec4 a = clip_from_model * vec4(texelFetch(segments, segment).xyz, 1.0);
    vec4 b = clip_from_model * vec4(texelFetch(segments, segment + 1).xyz, 1.0);
    color = texelFetch(segments, segment + 2);
    color.rgb = linear_from_srgb(color.rgb);

    // Clip at the near plane here, since a point behind the eye has no place on the screen.
    float near_a = a.z + a.w, near_b = b.z + b.w;
    if (near_a <= 0.0 && near_b <= 0.0) {
        across_w = 0.0;
        gl_Position = vec4(0, 0, -2, 1);
        return;
    }
    vec4 cut = mix(a, b, near_a / (near_a - near_b));
    if (near_a < 0.0)
        a = cut;
    if (near_b < 0.0)
        b = cut;

    vec2 on_screen = (b.xy / b.w - a.xy / a.w) * size.xy;
    vec2 along = length(on_screen) > 1e-6 ? normalize(on_screen) : vec2(1, 0);
    float side = corner < 2 ? -1.0 : 1.0;
    vec4 end = corner == 0 || corner == 3 ? a : b;
    float across = side * size.z;
    across_w = across * end.w;
    gl_Position = end + vec4(vec2(-along.y, along.x) * across * 2.0 / size.xy * end.w, 0, 0);
}
