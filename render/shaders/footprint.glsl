// The place of a fragment in its cell's footprint, as a place on the unit disc: any ellipse is an
// affine image of the unit disc, and the rectangle around it an image of the square around the
// disc.
//
// With POINTS a footprint is drawn as a square point around it, whose fragments outside are
// discarded; with SQUARE it fills the point. Without POINTS it is a quad whose corners are those of
// the rectangle.

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
