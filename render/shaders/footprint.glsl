// Where in its cell's footprint a fragment lies: any ellipse is an affine picture of the unit disc,
// and the rectangle around it one of the square around the disc.
//
// With POINTS a footprint is one square point around it, of which the fragments take their part, or
// with SQUARE all; without, it is a quad with its corners on the rectangle.

#ifndef SQUARE

#ifdef VERTEX_STAGE
#ifdef POINTS
flat out vec4 disc_from_point; // two columns
#else
out vec2 disc;
#endif
#endif

#ifdef FRAGMENT_STAGE
#ifdef POINTS
flat in vec4 disc_from_point;
vec2 position_on_disc() {
    vec2 point = vec2(2, -2) * gl_PointCoord + vec2(-1, 1);
    return disc_from_point.xy * point.x + disc_from_point.zw * point.y;
}
#else
in vec2 disc;
vec2 position_on_disc() { return disc; }
#endif
#endif

#endif
