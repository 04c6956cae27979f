#version 450 core
// A splat: its opacity falls off as a Gaussian that is cut at the outline; color is pre-multiplied.
// The Gaussian is computed per fragment instead of read from a table: that is exact at any size,
// and on software GL the look-up would cost more than all the rest of a splat.

layout(location = 0) uniform float falloff; // log2 of the opacity on the outline, negative

#include "footprint.glsl"

flat in vec4 shaded;
out vec4 result;

void main() {
    vec2 at = position_on_disc();
    float outwards = dot(at, at);
    float alpha = outwards < 1.0 ? shaded.a * exp2(falloff * outwards) : 0.0;
    result = vec4(shaded.rgb * alpha, alpha);
}
