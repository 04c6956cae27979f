// How cells look: colors, opacity and light.
#pragma once

#include "index/volume/query.h"
#include "render/gl/gl.h"

#include <glm/vec3.hpp>
#include <glm/vec4.hpp>

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

namespace isochron::render {

/// How one isosurface looks.
struct SurfaceAppearance {
    glm::vec3 color{0.97f, 0.88f, 0.70f}; ///< as a display shows it (sRGB), 0 to 1
    float opacity = 1.0f;                 ///< opacity of the surface seen face-on, 0 to 1
};

inline bool is_translucent(const SurfaceAppearance& surface) {
    return surface.opacity < 1.0f;
}

/// Colors by value: cells hold the value as a fraction of its whole range (`index::CellPoint`).
struct ValueColors {
    GLuint map = 0;                ///< GL_TEXTURE_1D in linear light, from low to high
    float low = 0.0f, high = 1.0f; ///< ends of the map, as fractions of the whole range
    /// The value at the high end over that at the low end where the map goes by logarithms, else 0.
    float ratio = 0.0f;
    bool bands = false;                   ///< colors do not flow into each other
    glm::vec3 no_value{0.5f, 0.5f, 0.5f}; ///< sRGB, where there is none
};

/// Fades cells near a viewer, so that they do not fill the view: splats and blended surfaces lose
/// opacity; quads lose whole cells, and opaque surfaces small grains, which are chosen by their
/// place in the volume. Distances are measured from the middle between the eyes, so that both eyes
/// see the same.
struct NearFade {
    float gone = 0.15f,
          whole = 0.35f; ///< [m] nothing is drawn nearer than `gone`, everything beyond `whole`
    glm::vec3 between_eyes{0.0f}; ///< room
};

/// A plane and the faces of a box.
inline constexpr std::size_t kMostCuts = 7;

struct CellAppearance {
    std::array<SurfaceAppearance, index::kMostSurfaces> surfaces;
    std::optional<ValueColors> values; ///< instead of the surfaces' colors

    float ambient = 0.15f;
    float head_light = 0.50f;                   ///< from the eye
    float key_light = 0.50f;                    ///< from a fixed direction in the room
    glm::vec3 key_direction{-0.5f, 0.8f, 0.6f}; ///< towards the key light, room frame, any length
    float ground = 0.5f;       ///< ambient light from below, relative to the light from above
    float reflectance = 0.04f; ///< at normal incidence; most non-metals have 0.04
    float shininess = 40.0f;   ///< exponent of the highlight
    float outline = 0.35f;     ///< how much darker the surface is where it turns away, 0 to 1
    /// How much darker the far end of the volume is than its near end, 0 to 1.
    float depth_cue = 0.45f;
    /// How much darker the surface is where it is surrounded by itself (index::SurroundingField), 0
    /// to 1.
    float occlusion = 0.6f;
    std::optional<NearFade> near_fade;
    /// Which of the set's meshes the footprint `mesh` draws (CellBuffers::mesh).
    std::size_t mesh_level = 0;
    /// Surfaces that are drawn, one bit for each; quads and splats show all of them.
    std::uint32_t drawn = ~0u;
    /// Planes in the room (normal, offset), at most kMostCuts, above any of which everything is cut away: whole cells with
    /// quads and splats, exactly at the plane with surfaces.
    std::vector<glm::vec4> cuts;
    /// Splats blend in linear light; else in display values, which takes two thirds of the time on
    /// software GL. Opaque quads look the same either way.
    bool linear_light = true;
};

} // namespace isochron::render
