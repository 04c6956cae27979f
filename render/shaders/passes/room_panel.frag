#version 450 core
// A panel in the room, with a dot where the user points. Takes the mean of four points in the
// pixel's footprint, each from a finer mip level than usual, so that letters seen at a slant stay
// sharp.

layout(binding = 0) uniform sampler2D picture; // light, pre-multiplied
uniform float core;                            // least opacity that is drawn
uniform vec4 pointed;                          // place of the dot, its half sizes (0: no dot)

in vec2 place;
out vec4 color;

const vec3 kDot = vec3(1.0, 0.6, 0.15), kRim = vec3(0.02); // light

void main() {
    vec2 across = dFdx(place), along = dFdy(place);
    color = vec4(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 offset = vec2((i & 1) == 0 ? -0.25 : 0.25, (i & 2) == 0 ? -0.25 : 0.25);
        color += 0.25 * texture(picture, place + offset.x * across + offset.y * along, -1.0);
    }
    if (pointed.z > 0.0) {
        float out_of = length((place - pointed.xy) / pointed.zw);
        float pixel = max(length(vec2(dFdx(out_of), dFdy(out_of))), 1e-6);
        float disc = clamp((1.0 - out_of) / pixel + 0.5, 0.0, 1.0);
        float inner = clamp((0.7 - out_of) / pixel + 0.5, 0.0, 1.0);
        color = mix(color, vec4(mix(kRim, kDot, inner), 1.0), disc);
    }
    if (color.a < core)
        discard;
}
