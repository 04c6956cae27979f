#version 450 core
// What is behind the data: a color that changes with the height at which one looks, in the room.

layout(location = 0) uniform vec4 viewport; // corner and size in the target, pixels
// Height of the view's ray: per pixel to the right and up, and ahead.
layout(location = 1) uniform vec3 heights;
// The view's ray, per pixel to the right: its length is asked for.
layout(location = 2) uniform vec3 right;
layout(location = 3) uniform vec3 up;
layout(location = 4) uniform vec3 ahead;
layout(location = 5) uniform vec3 low;      // linear light
layout(location = 6) uniform vec3 high;
out vec4 color;

void main() {
    vec2 at = 2.0 * (gl_FragCoord.xy - viewport.xy) / viewport.zw - 1.0;
    float height = dot(heights, vec3(at, 1.0)) / length(at.x * right + at.y * up + ahead);
    color = vec4(mix(low, high, smoothstep(-0.7, 0.7, height)), 1.0);
}
