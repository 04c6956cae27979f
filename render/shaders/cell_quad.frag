#version 450 core
// A fast quad in one flat color; with ROUND only the ellipse in it.

#include "footprint.glsl"

flat in vec4 shaded;
out vec4 result;

void main() {
#ifdef ROUND
    vec2 at = position_on_disc();
    if (dot(at, at) > 1.0)
        discard;
#elif defined(POINTS) && !defined(SQUARE)
    vec2 at = abs(position_on_disc());
    if (max(at.x, at.y) > 1.0)
        discard;
#endif
    result = vec4(shaded.rgb, 1.0);
}
