// The binary part of a GLB file: views of numbers, one after the other, packed if that is wished.
#pragma once

#include "index/export/buffered_sink.h"
#include "index/export/exported_step.h"
#include "index/system/scratch_file.h"

#include <nlohmann/json.hpp>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <vector>

namespace isochron::index {

class GlbViews {
  public:
    using Json = nlohmann::ordered_json;
    static constexpr const char* kPacked = "EXT_meshopt_compression";

    /// @param file to be; what is written lies beside it until its length is known
    /// @param packing null: nothing is packed
    GlbViews(const std::filesystem::path& file, const MeshPacking* packing)
        : scratch_(file), out_(scratch_), packing_(packing) {}

    /// @return where the next view begins
    std::uint64_t begin();
    /// A number of a mesh.
    template <class T>
    void put(const T& value) {
        if (!packing_)
            return out_.put(value);
        const auto added = std::as_bytes(std::span(&value, 1));
        view_.insert(view_.end(), added.begin(), added.end());
    }
    /// A number that is never packed.
    template <class T>
    void put_plain(const T& value) {
        out_.put(value);
    }

    // Each ends the view that began there, and returns its number.
    std::size_t end_plain(std::uint64_t begin);
    /// @param stride bytes from one vertex to the next
    std::size_t end_vertices(std::uint64_t begin, std::uint64_t stride);
    /// Ends a view of triangles' corners, 32 bits each. @param vertices how many vertices the
    /// corners may name
    std::size_t end_triangles(std::uint64_t begin, std::size_t vertices);

    /// The bytes so far. Complete them before, so that a chunk of a file can end there.
    std::uint64_t size() const { return out_.size(); }
    void complete();
    void copy_to(BufferedSink& out) const { out.copy(scratch_, size()); }
    /// `bufferViews` and `buffers` of the document.
    const Json& views() const { return views_; }
    Json buffers() const;

  private:
    std::size_t push(Json view);
    std::size_t end_packed(std::uint64_t begin, std::uint64_t stride, const char* mode,
                           const std::vector<std::byte>& bytes);

    ScratchFile scratch_;
    BufferedSink out_;
    const MeshPacking* packing_;
    Json views_ = Json::array();
    std::vector<std::byte> view_; ///< the one that is to be packed
    std::uint64_t unpacked_ = 0;  ///< bytes of all packed views once they are unpacked
};

} // namespace isochron::index
