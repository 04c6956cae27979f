#version 450 core
// Red from the left eye's picture, green and blue from the right eye's.

layout(binding = 0) uniform sampler2D left_eye;
layout(binding = 1) uniform sampler2D right_eye;
uniform ivec2 corner; // of the viewport in the target, pixels
out vec4 color;

void main() {
    const ivec2 pixel = ivec2(gl_FragCoord.xy) - corner;
    color = vec4(texelFetch(left_eye, pixel, 0).r, texelFetch(right_eye, pixel, 0).gb, 1.0);
}
