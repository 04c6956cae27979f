#version 450 core
// A splat: its opacity falls off as a Gaussian that is cut at the outline, color pre-multiplied.
// Computed per fragment rather than looked up in a table: exact at any size, and on software GL the
// look-up costs more than all the rest of a splat.

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
