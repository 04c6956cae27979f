#version 450 core
// Darkens a picture: all of it, or only away from its middle.

layout(location = 0) uniform vec4 viewport; // corner and size in the target, pixels
// Strength of the veil over the whole and at the rim, 0 to 1.
layout(location = 1) uniform vec2 strength;
out vec4 color;

void main() {
    vec2 at = 2.0 * (gl_FragCoord.xy - viewport.xy) / viewport.zw - 1.0;
    float rim = strength.y * smoothstep(0.3, 0.8, length(at) / sqrt(2.0));
    color = vec4(0.0, 0.0, 0.0, 1.0 - (1.0 - strength.x) * (1.0 - rim));
}
