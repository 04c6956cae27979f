// Reads values from JSON and checks each; an error names the value that is wrong.
#pragma once

#include "interaction/pose.h"

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <string_view>

namespace isochron::interaction {

inline constexpr double kUnitTolerance = 1e-3; ///< how far a quaternion's length may be from 1

/// A value as it may appear in an error line: short, ASCII, without line breaks.
std::string excerpt(const nlohmann::json& value);

/// @throws Error `where: expected .., got ..`; so do the functions below
[[noreturn]] void fail(std::string_view where, std::string_view expected,
                       const nlohmann::json& got);

/// An object's members. Ask for each once; `done` throws if there are others.
class Members {
  public:
    Members(const nlohmann::json& object, std::string_view where);
    /// Null when it is missing.
    const nlohmann::json* find(const char* key);
    const nlohmann::json& at(const char* key);
    /// @throws Error naming a member that was not asked for
    /// @param known every key that was asked for
    void done(std::initializer_list<std::string_view> known) const {
        done(std::span(known.begin(), known.size()));
    }
    void done(std::span<const std::string_view> known) const;

  private:
    const nlohmann::json& object_;
    std::string_view where_;
    std::size_t used_ = 0;
};

/// Finite numbers only.
double number(const nlohmann::json& value, std::string_view where);
double number(const nlohmann::json& value, std::string_view where, double low, double high);
float small_number(const nlohmann::json& value, std::string_view where);
std::uint64_t natural(const nlohmann::json& value, std::string_view where, std::uint64_t most);
bool boolean(const nlohmann::json& value, std::string_view where);
std::string text(const nlohmann::json& value, std::string_view where,
                 std::size_t longest = std::string::npos);
/// @return the value itself
const nlohmann::json& list(const nlohmann::json& value, std::string_view where, std::size_t least,
                           std::size_t most);

/// `[x, y, z, qx, qy, qz, qw]`.
nlohmann::json pose_json(const Pose& pose);
Pose pose_from(const nlohmann::json& value);

template <typename Quaternion>
void require_unit(const Quaternion& q, std::string_view where, const nlohmann::json& got) {
    if (std::abs(glm::length(q) - 1) > kUnitTolerance)
        fail(where, "a unit quaternion", got);
}

} // namespace isochron::interaction
