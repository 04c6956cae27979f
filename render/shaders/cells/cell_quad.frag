#version 450 core
// A fast quad in one flat color; with CUT only what of it lies in the cell.

#include "footprint.glsl"

#ifdef SHADED_APART
flat in vec4 shaded;
#endif
out vec4 result;

void main() {
#ifdef CUT
    vec3 place = abs(position_in_cell());
    if (max(max(place.x, place.y), place.z) > 1.0)
        discard;
#elif defined(POINTS) && !defined(SQUARE)
    vec2 at = abs(position_on_disc());
    if (max(at.x, at.y) > 1.0)
        discard;
#endif
#ifdef SHADED_APART
    result = vec4(shaded.rgb, 1.0);
#else
    result = vec4(stripe[0].w, stripe[1].w, stripe[2].w, 1.0);
#endif
}
