// The uniforms for drawing cells: the eyes, and how surfaces look. In one pass, two eyes are drawn
// as two instances, each in its own viewport; EYE(field) is the field of the current eye.

const int MOST_CUTS = 7; // as kMostCuts

struct Eye {
    // Rows of pixel_from_index: clip space with x and y in pixels from the middle of the viewport.
    vec4 row_x, row_y, row_z, row_w;
    // The view ray of a pixel, in index space. Across it, per pixel times w: `ray_right`, `ray_up`.
    // Along it, per unit of w (where w = 1 for all, of clip z): `ray_ahead` plus, in perspective,
    // the pixel's share of the other two; its w is the clip z per that unit.
    vec4 ray_right, ray_up, ray_ahead;
    mat4 eye_from_index;
    mat4 eye_from_physical; // linear part
    vec4 eye_in_index;      // position (w = 1), or in a parallel view direction to the eye (w = 0)
    vec4 clip_per_pixel;    // xy
    vec4 viewport;          // corner and size in the target, pixels
    vec4 depth_cue;         // distance [m] where it starts, 1 / its range, strength
    vec4 key_light;         // direction towards it, eye space
    vec4 up;                // up in the room, eye space
    vec4 between_eyes;      // middle between the viewer's eyes, eye space: both see the same fading
    vec4 cuts[MOST_CUTS];   // planes in eye space above which everything is cut away
};

layout(std140, binding = 0) uniform Frame {
    Eye eyes[2];
    vec4 surfaces[MOST_SURFACES];   // linear light; a: opacity of a cell
    vec4 no_value;      // color where there is no value to color by, linear light
    vec4 light;         // strengths of the ambient light, the head light and the key light
    vec4 material;      // reflectance, shininess, floor's share of the ambient light, outline
    vec4 near_fade;     // distance [m] below which nothing is drawn, 1 / fading range, grains per voxel
    vec2 color_range;   // place in the map = x * coordinate + y
    bool colored;       // by a value, not by surface
    bool linear_light;  // written colors are linear light; else display values
    float radius;       // radius of the footprint, in voxels
    int order_begin;    // the n-th cell drawn is in slot order[order_begin + n * order_step],
    int order_step;     // or in slot order_begin + n where the step is 0
    bool blended;
    int drawn_surfaces; // a bit for each
    bool soft_near_eye; // fade what comes so near that it would veil the whole view
    float color_ratio;  // ratio of the values at the map's ends where it goes by logarithms, else 0
    bool mixed_levels;  // cells are of several levels of detail: see cell_box.glsl
    bool color_bands;   // the map has bands, whose colors do not flow into each other
    bool corners_by_slot; // surface.vert: corners are there for all slots, else for the cells drawn
    int cut_count;
    vec4 index_from_normal[3]; // rows: planes' normals from physical to index space
    vec4 surroundings;      // places of the field of surroundings per voxel; w: how much they darken
    vec4 surroundings_size; // its places along x, y and z of a surface
    vec4 volume_extent;           // extent of the volume in index space, xyz
};

// A normal in even coordinates, of any length.
vec3 to_index(vec3 normal) {
    return vec3(dot(index_from_normal[0].xyz, normal), dot(index_from_normal[1].xyz, normal),
                dot(index_from_normal[2].xyz, normal));
}

#ifdef TWO_EYES
// Reading both and selecting one is cheaper than an index that differs between invocations.
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
// Call it first in every main(): sends the vertex to its eye's viewport.
void start_eye() {
#ifdef TWO_EYES
    eye_of_instance = gl_InstanceID;
    gl_ViewportIndex = gl_InstanceID;
#endif
}
#endif
