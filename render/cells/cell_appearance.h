// How cells look: colors, opacity and light.
#pragma once

#include "index/volume/query.h"
#include "render/gl/gl.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <optional>

namespace isochron::render {

/// How one isosurface looks.
struct SurfaceAppearance {
    glm::vec3 color{0.97f, 0.88f, 0.70f}; ///< as a display shows it (sRGB), 0 to 1
    float opacity = 1.0f;                 ///< of the surface seen face-on, 0 to 1
};

inline bool is_translucent(const SurfaceAppearance& surface) {
    return surface.opacity < 1.0f;
}

/// Colors by value: cells carry the value's place in its whole range (`index::CellPoint`).
struct ValueColors {
    GLuint map = 0;                ///< GL_TEXTURE_1D in linear light, from low to high
    float low = 0.0f, high = 1.0f; ///< ends of the map, as fractions of the whole range
    /// The value at the high end over that at the low end where the map goes by logarithms, else 0.
    float ratio = 0.0f;
    glm::vec3 no_value{0.5f, 0.5f, 0.5f}; ///< sRGB, where there is none
};

/// What comes near to a viewer is left out little by little, so that nobody stands in a wall of it:
/// splats and blended surfaces by opacity, quads and opaque surfaces by ever fewer cells and grains
/// of them, chosen in the volume. Distances are from the middle between the eyes, so that both see
/// the same.
struct NearFade {
    float gone = 0.15f,
          whole = 0.35f; ///< [m] nearer than the one nothing is drawn, beyond the other all
    glm::vec3 between_eyes{0.0f}; ///< room
};

struct CellAppearance {
    std::array<SurfaceAppearance, index::kMostSurfaces> surfaces;
    std::optional<ValueColors> values; ///< instead of the surfaces' colors

    float ambient = 0.15f;
    float head_light = 0.50f;                   ///< from the eye
    float key_light = 0.50f;                    ///< from a direction that stands still in the room
    glm::vec3 key_direction{-0.5f, 0.8f, 0.6f}; ///< towards the key light, room frame, any length
    float ground = 0.5f;       ///< ambient light from below, as a share of that from above
    float reflectance = 0.04f; ///< mirrored at normal incidence: 0.04 is that of most non-metals
    float shininess = 40.0f;   ///< exponent of the highlight
    float outline = 0.35f;     ///< how much darker the surface is where it turns away, 0 to 1
    /// How much darker the far end of the volume is than its near end, 0 to 1.
    float depth_cue = 0.45f;
    /// How much darker the surface is where it is surrounded by itself (index::SurroundingField), 0
    /// to 1.
    float occlusion = 0.6f;
    std::optional<NearFade> near_fade;
    /// A plane in the room, normal and offset: what lies above it is cut away, cells whole with
    /// quads and splats, exactly with surfaces.
    std::optional<glm::vec4> cut;
    /// Splats blend as light does. Without it they blend in display values, which on software GL
    /// takes two thirds of the time. Opaque quads look the same either way.
    bool linear_light = true;
};

} // namespace isochron::render
