// The tiers: search structures that an index can hold beside its volume.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

enum class Tier : std::uint8_t {
    bricks, ///< extremes of bricks: small, exact together with the volume, for every type
    tree,   ///< the paper's Temporal Hierarchical Index Tree
};
constexpr std::array<std::string_view, 2> kTierNames{"bricks", "tree"};

constexpr std::optional<Tier> tier_from_name(std::string_view name) {
    for (std::size_t i = 0; i < kTierNames.size(); ++i)
        if (kTierNames[i] == name)
            return static_cast<Tier>(i);
    return std::nullopt;
}

/// Whether a name is that of a tier that programs up to version 0.2 built, and that no search uses
/// any more.
constexpr bool is_former_tier(std::string_view name) {
    return name == "cells" || name == "deltas";
}

class TierSet {
  public:
    bool has(Tier tier) const { return bits_ & bit(tier); }
    TierSet with(Tier tier) const { return TierSet(bits_ | bit(tier)); }
    TierSet with(Tier tier, bool has_it) const {
        return TierSet(has_it ? bits_ | bit(tier) : bits_ & ~bit(tier));
    }
    bool operator==(const TierSet&) const = default;

    TierSet() = default;

  private:
    static unsigned bit(Tier tier) { return 1u << static_cast<unsigned>(tier); }
    explicit TierSet(unsigned bits) : bits_(bits) {}
    unsigned bits_ = 0;
};

/// Which tiers an index has, and why.
struct ChosenTiers {
    TierSet tiers;
    std::vector<std::string> reasons; ///< sentences for `info`
    bool asked = false;               ///< chosen by the user
    std::uint32_t steps = 0;          ///< steps of the series when the tiers were chosen
};

} // namespace isochron::index
