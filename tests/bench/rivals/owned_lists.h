// The sorted lists of one time node, with their memory.
#pragma once

#include "index/paper/interval_tree.h"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace isochron::bench {

class OwnedLists {
  public:
    explicit OwnedLists(std::size_t entries) {
        for (auto& part : parts_)
            part.resize(entries);
    }
    std::size_t size() const { return parts_[0].size(); }
    std::uint64_t bytes() const { return parts_.size() * size() * sizeof(std::uint32_t); }

    index::Lists<index::Writable> writable() {
        return {parts_[0], parts_[1], parts_[2], parts_[3]};
    }
    index::Lists<index::Readable> readable() const {
        return {parts_[0], parts_[1], parts_[2], parts_[3]};
    }

  private:
    std::array<std::vector<std::uint32_t>, 4> parts_;
};

} // namespace isochron::bench
