// Where a build writes: a file that appears when it is whole, or an index that grows in place.
#pragma once

#include "index/file/file_layout.h"
#include "index/system/byte_sink.h"
#include "index/system/new_file.h"
#include "index/system/team.h"

#include <filesystem>
#include <optional>

namespace isochron::index {

/// Shared by all members of a team; every function is called by all of them, and throws as
/// `Team::together` does.
class BuildTarget {
  public:
    virtual ~BuildTarget() = default;
    virtual ByteSink& sink() = 0;
    /// Makes what was written count. @param header of the first member; of no meaning for others
    virtual void commit(const FileHeader& header) = 0;
};

/// A new file, made by the first member.
class NewTarget final : public BuildTarget {
  public:
    NewTarget(Team& team, const std::filesystem::path& target);
    NewFile& sink() override { return *file_; }
    void commit(const FileHeader& header) override;

  private:
    Team& team_;
    std::optional<NewFile> file_;
};

/// An index that has steps already. What the header that counts so far names is not touched, until
/// the new one is there: whatever ends the process or the machine, and whenever, one of both
/// counts. Destroyed without a commit it cuts off what was written.
class GrowingTarget final : public BuildTarget {
  public:
    /// @param file of each member, opened for the first member alone @param held its header
    GrowingTarget(Team& team, GrowingSink& file, const FileHeader& held);
    ~GrowingTarget() override;
    GrowingTarget(const GrowingTarget&) = delete;
    GrowingTarget& operator=(const GrowingTarget&) = delete;

    GrowingSink& sink() override { return file_; }
    void commit(const FileHeader& header) override;

  private:
    Team& team_;
    GrowingSink& file_;
    std::uint64_t held_bytes_;
    bool may_count_ = false; ///< the new header may have been written
};

} // namespace isochron::index
