#version 450 core
// Triangles of the control panel: the glyph texture's coverage times the color.

layout(binding = 0) uniform sampler2D glyphs;

in vec2 fragment_position;
in vec4 fragment_color;

out vec4 color;

void main() { color = fragment_color * texture(glyphs, fragment_position); }
