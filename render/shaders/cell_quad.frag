#version 450 core
// A fast quad in one flat color; with ROUND only the ellipse in it, with IN_CELL only what of it lies
// in the cell.

#include "footprint.glsl"

flat in vec4 shaded;
out vec4 result;

void main() {
#ifdef ROUND
    vec2 at = position_on_disc();
    float outwards = dot(at, at);
#ifdef IN_CELL
    vec3 place = abs(position_in_cell());
    outwards = max(max(outwards, place.x), max(place.y, place.z));
#endif
    if (outwards > 1.0)
        discard;
#elif defined(POINTS) && !defined(SQUARE)
    vec2 at = abs(position_on_disc());
    if (max(at.x, at.y) > 1.0)
        discard;
#endif
    result = vec4(shaded.rgb, 1.0);
}
