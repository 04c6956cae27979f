// Counts what was sent to the GPU, and how much whole sets would have been instead of differences.
#pragma once

#include <cstdint>

namespace isochron::render {

struct UploadCount {
    std::uint64_t sets = 0;              ///< number of sets shown
    std::uint64_t ids = 0;               ///< ids sent for these sets
    std::uint64_t whole_ids = 0;         ///< ids in these sets: sent if each were sent whole
    std::uint64_t id_bytes = 0;          ///< ids, with their slots where differences are sent
    std::uint64_t block_bytes = 0;       ///< blocks of the volume with their pages
    std::uint64_t color_bytes = 0;       ///< color coordinates
    std::uint64_t mesh_bytes = 0;        ///< vertices and triangles
    std::uint64_t surrounding_bytes = 0; ///< SurroundingFields, for ambient occlusion

    UploadCount& operator+=(const UploadCount& other) {
        sets += other.sets;
        ids += other.ids;
        whole_ids += other.whole_ids;
        id_bytes += other.id_bytes;
        block_bytes += other.block_bytes;
        color_bytes += other.color_bytes;
        mesh_bytes += other.mesh_bytes;
        surrounding_bytes += other.surrounding_bytes;
        return *this;
    }
    /// What was added since. @param before an earlier value of this count
    UploadCount since(const UploadCount& before) const {
        return {sets - before.sets,
                ids - before.ids,
                whole_ids - before.whole_ids,
                id_bytes - before.id_bytes,
                block_bytes - before.block_bytes,
                color_bytes - before.color_bytes,
                mesh_bytes - before.mesh_bytes,
                surrounding_bytes - before.surrounding_bytes};
    }
    bool operator==(const UploadCount&) const = default;
};

} // namespace isochron::render
