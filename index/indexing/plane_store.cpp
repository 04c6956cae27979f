// Keeps planes of a step that are needed once more.
#include "index/indexing/plane_store.h"

#include "index/system/huge_pages.h"

#include <algorithm>

namespace isochron::index {
namespace {

constexpr std::uint64_t kPiece = 1 << 20; ///< [bytes] read at a time

} // namespace

PlaneStore::PlaneStore(std::uint64_t bytes, std::uint64_t most, const std::filesystem::path& beside)
    : all_(bytes) {
    if (bytes > most)
        file_.emplace(beside);
}

void PlaneStore::append(std::span<const std::byte> planes) {
    if (file_) {
        file_->write_at(end_, planes);
    } else {
        if (bytes_.capacity() < all_) {
            bytes_.reserve(all_);
            ask_for_huge_pages(bytes_.data(), all_);
        }
        bytes_.insert(bytes_.end(), planes.begin(), planes.end());
    }
    end_ += planes.size();
}

void PlaneStore::drain(const std::function<void(std::span<const std::byte>)>& take) {
    for (std::uint64_t at = 0; file_ && at < end_; at += bytes_.size()) {
        bytes_.resize(std::min(kPiece, end_ - at));
        file_->read(at, bytes_);
        take(bytes_);
    }
    if (!file_ && end_ > 0)
        take(bytes_);
    bytes_.clear();
    end_ = 0;
}

} // namespace isochron::index
