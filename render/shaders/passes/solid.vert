#version 450 core
// Places a triangle's corner, and lights the triangle from the eye.

layout(binding = 0) uniform samplerBuffer triangles; // three corners, color
uniform mat4 eye_from_model;
uniform mat4 clip_from_eye;
flat out vec3 color; // light

#include "srgb.glsl"

void main() {
    int first = gl_VertexID / 3 * 4;
    vec3 corners[3];
    for (int i = 0; i < 3; ++i)
        corners[i] = (eye_from_model * vec4(texelFetch(triangles, first + i).xyz, 1.0)).xyz;
    vec3 normal = cross(corners[1] - corners[0], corners[2] - corners[0]);
    vec3 middle = (corners[0] + corners[1] + corners[2]) / 3.0;
    float size = length(normal) * length(middle);
    float facing = size > 0.0 ? max(0.0, dot(normal, -middle) / size) : 0.0;
    color = linear_from_srgb(texelFetch(triangles, first + 3).rgb * (0.3 + 0.7 * facing));
    gl_Position = clip_from_eye * vec4(corners[gl_VertexID % 3], 1.0);
}
