#version 450 core
// A picture, times a factor.

layout(binding = 0) uniform sampler2D picture;
layout(location = 0) uniform float factor;
out vec4 color;

void main() {
    color = factor * texelFetch(picture, ivec2(gl_FragCoord.xy), 0);
}
