// What a draw of cells knows: where its eyes are, and how surfaces look. Drawn in one pass, two
// eyes are two instances, each in its own viewport; EYE(field) is the field of the current one.

struct Eye {
    // Rows of pixel_from_index: clip space with x and y in pixels from the middle of the viewport.
    vec4 row_x, row_y, row_z, row_w;
    // The view ray of a pixel, in index space. Across it, per pixel times w: `ray_right`, `ray_up`.
    // Along it, per unit of w (where w = 1 for all, of clip z): `ray_ahead` plus, in perspective,
    // the pixel's share of the other two; its w is the clip z per that unit.
    vec4 ray_right, ray_up, ray_ahead;
    mat4 eye_from_index;
    mat4 eye_from_physical; // linear part
    vec4 eye_in_index;      // w = 0 where the view is parallel: the direction towards the eye
    vec4 clip_per_pixel;    // xy
    vec4 viewport;          // corner and size in the target, pixels
    vec4 depth_cue;         // distance [m] where it starts, 1 / its length, strength
    vec4 key_light;         // direction towards it, eye space
    vec4 up;                // of the room, eye space
    vec4 between_eyes;      // of the viewer, eye space: what fades near by is the same for both
    vec4 cut;               // plane in eye space: what lies above it is cut away
};

layout(std140, binding = 0) uniform Frame {
    Eye eyes[2];
    vec4 surfaces[MOST_SURFACES];   // linear light; a: opacity of a cell
    vec4 no_value;      // color where there is no value to color by, linear light
    vec4 light;         // strengths of the ambient light, the head light and the key light
    vec4 material;      // reflectance, shininess, floor's share of the ambient light, outline
    vec4 near_fade;     // distance [m] up to which all is gone, 1 / the way to whole, grains per voxel
    vec2 color_range;   // coordinate = x value + y
    bool colored;       // by a value rather than by surface
    bool linear_light;  // what is written: light, or the display's values
    float radius;       // of the footprint, in voxels
    int order_begin;    // the n-th cell drawn is in slot order[order_begin + n * order_step],
    int order_step;     // or in slot n where the step is 0
    bool blended;
    int drawn_surfaces; // a bit for each
    bool soft_near_eye; // fade what comes so near that it would veil the whole view
    float color_ratio;  // of the values at the map's ends where it goes by logarithms, else 0
    vec4 index_from_normal[3]; // rows: planes' normals from physical to index space
    vec4 surroundings;      // places of the field of surroundings per voxel; w: how much they darken
    vec4 surroundings_size; // its places along x, y and z of a surface, and of how many
};

#ifdef TWO_EYES
// Both are read and one is taken: cheaper than an index that is not the same for all.
#define EYE(field) (EYE_INDEX == 0 ? eyes[0].field : eyes[1].field)
#ifdef VERTEX_STAGE
#define EYE_INDEX gl_InstanceID
flat out int eye_of_instance;
#else
#define EYE_INDEX eye_of_instance
flat in int eye_of_instance;
#endif
#else
#define EYE(field) eyes[0].field
#define EYE_INDEX 0
#endif

#ifdef VERTEX_STAGE
// First in every main(): leads the vertex to its eye's viewport.
void start_eye() {
#ifdef TWO_EYES
    eye_of_instance = gl_InstanceID;
    gl_ViewportIndex = gl_InstanceID;
#endif
}
#endif
