#version 450 core
// A corner of the polygon that a slice is.

layout(location = 0) uniform mat4 clip_from_even;
layout(location = 1) uniform vec4 corners[6]; // even coordinates
out vec3 even;

void main() {
    even = corners[gl_VertexID].xyz;
    gl_Position = clip_from_even * vec4(even, 1.0);
}
