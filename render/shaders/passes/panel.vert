#version 450 core
// Triangles of the control panel: positions in pixels from the top left.

#include "srgb.glsl"

layout(location = 0) in vec2 position;
layout(location = 1) in vec2 texture_position;
layout(location = 2) in vec4 color;

uniform vec2 display_size;

out vec2 fragment_position;
out vec4 fragment_color;

void main() {
    fragment_position = texture_position;
    fragment_color = vec4(linear_from_srgb(color.rgb), color.a);
    const vec2 down = vec2(1.0, -1.0);
    gl_Position = vec4((position / display_size * 2.0 - 1.0) * down, 0.0, 1.0);
}
