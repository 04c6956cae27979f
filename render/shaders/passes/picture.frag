#version 450 core
// A picture seen from far away: the mean of four points in the pixel's footprint.

layout(binding = 0) uniform sampler2D picture;
uniform float opacity;
in vec2 place;
out vec4 color;

void main() {
    vec2 across = dFdx(place), along = dFdy(place);
    vec3 sum = vec3(0.0);
    for (int i = 0; i < 4; ++i) {
        vec2 offset = vec2((i & 1) == 0 ? -0.25 : 0.25, (i & 2) == 0 ? -0.25 : 0.25);
        sum += texture(picture, place + offset.x * across + offset.y * along).rgb;
    }
    color = vec4(0.25 * sum * opacity, opacity);
}
