// The place of a fragment in its cell's footprint.
//
// In an ellipse it is a place on the unit disc: any ellipse is an affine image of the unit disc,
// and
// the rectangle around it an image of the square around the disc. With CUT it is a place in the cell,
// in halves of the enlarged cell's sides.
//
// With POINTS a footprint is drawn as a square point around it, whose fragments outside are
// discarded; with SQUARE it fills the point. Without POINTS it is a quad with the corners of
// the rectangle.

#ifdef VERTEX_STAGE
#define TO_FRAGMENT out
#else
#define TO_FRAGMENT in
#endif

#if defined(POINTS) && defined(CUT)
// For each axis of the cell: the place at the target's origin, its change per pixel to the right and
// up, and a part of the color, which needs no room of its own then.
flat TO_FRAGMENT vec4 stripe[3];
#else
#define SHADED_APART
#if defined(CUT)
TO_FRAGMENT vec3 cell_place;
#elif defined(POINTS) && !defined(SQUARE)
flat TO_FRAGMENT vec4 disc_from_point; // two columns
#endif
#endif
#ifndef POINTS
#if defined(VERTEX_STAGE) && defined(CUT)
vec2 disc; // the corner's sign along each axis
#else
TO_FRAGMENT vec2 disc;
#endif
#endif

#ifdef FRAGMENT_STAGE
#if defined(POINTS) && defined(CUT)
vec3 position_in_cell() {
    vec3 at = vec3(1, gl_FragCoord.xy);
    return vec3(dot(stripe[0].xyz, at), dot(stripe[1].xyz, at), dot(stripe[2].xyz, at));
}
#elif defined(CUT)
vec3 position_in_cell() { return cell_place; }
#elif defined(POINTS) && !defined(SQUARE)
vec2 position_on_disc() {
    vec2 point = vec2(2, -2) * gl_PointCoord + vec2(-1, 1);
    return disc_from_point.xy * point.x + disc_from_point.zw * point.y;
}
#elif !defined(POINTS)
vec2 position_on_disc() { return disc; }
#endif
#endif
