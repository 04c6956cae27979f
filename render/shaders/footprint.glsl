// The place of a fragment in its cell's footprint, as a place on the unit disc: any ellipse is an
// affine image of the unit disc, and the rectangle around it an image of the square around the
// disc.
//
// With POINTS a footprint is drawn as a square point around it, whose fragments outside are
// discarded; with SQUARE it fills the point. Without POINTS it is a quad whose corners are those of
// the rectangle.
//
// With IN_CELL a fragment also has a place in the cell: on the plane in which the ellipsoid's
// outline lies, in halves of the enlarged cell's sides.

#ifndef SQUARE

#ifdef VERTEX_STAGE
#ifdef POINTS
flat out vec4 disc_from_point; // two columns
#ifdef IN_CELL
flat out vec3 cell_middle_place, cell_right, cell_up; // at the point's middle, and to its edges
#endif
#else
out vec2 disc;
#ifdef IN_CELL
out vec3 cell_place;
#endif
#endif
#endif

#ifdef FRAGMENT_STAGE
#ifdef POINTS
flat in vec4 disc_from_point;
vec2 on_point() { return vec2(2, -2) * gl_PointCoord + vec2(-1, 1); }
vec2 position_on_disc() {
    vec2 point = on_point();
    return disc_from_point.xy * point.x + disc_from_point.zw * point.y;
}
#ifdef IN_CELL
flat in vec3 cell_middle_place, cell_right, cell_up;
vec3 position_in_cell() {
    vec2 point = on_point();
    return cell_middle_place + point.x * cell_right + point.y * cell_up;
}
#endif
#else
in vec2 disc;
vec2 position_on_disc() { return disc; }
#ifdef IN_CELL
in vec3 cell_place;
vec3 position_in_cell() { return cell_place; }
#endif
#endif
#endif

#endif
