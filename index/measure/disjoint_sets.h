// Numbers that are joined into sets.
#pragma once

#include <cstdint>
#include <numeric>
#include <vector>

namespace isochron::index {

/// Each number is in one set; at first each is alone. The least of a set stands for it.
class DisjointSets {
  public:
    explicit DisjointSets(std::size_t count) : next_(count) {
        std::iota(next_.begin(), next_.end(), 0u);
    }
    std::uint32_t least_of(std::uint32_t number) {
        while (next_[number] != number)
            number = next_[number] = next_[next_[number]];
        return number;
    }
    void join(std::uint32_t a, std::uint32_t b) {
        a = least_of(a);
        b = least_of(b);
        if (a < b)
            next_[b] = a;
        else
            next_[a] = b;
    }

  private:
    std::vector<std::uint32_t> next_; ///< a number of the same set that is less, or itself
};

} // namespace isochron::index
