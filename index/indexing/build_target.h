// The file that a build writes: a new file that appears when complete, or an index that grows.
#pragma once

#include "index/file/sections/file_layout.h"
#include "index/system/byte_sink.h"
#include "index/system/new_file.h"
#include "index/system/team.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace isochron::index {

/// Shared by all members of a team: all of them call every function. Throws as `Team::together`
/// does.
class BuildTarget {
  public:
    virtual ~BuildTarget() = default;
    virtual ByteSink& sink() = 0;
    /// Where what was written so far can be read. Called on rank 0.
    /// @param name of the index
    virtual std::filesystem::path path_to_read(const std::filesystem::path& name) const = 0;
    /// Makes what was written valid. @param header used from the rank 0 only
    /// @param look called on rank 0 once the header is written. What it throws leaves an older file of
    /// the name as it was; an index that grows may have grown.
    virtual void commit(const FileHeader& header, const std::function<void()>& look) = 0;
};

/// A new file, which rank 0 creates.
class NewTarget final : public BuildTarget {
  public:
    NewTarget(Team& team, const std::filesystem::path& target);
    NewFile& sink() override { return *file_; }
    std::filesystem::path path_to_read(const std::filesystem::path& /*name*/) const override {
        return file_->path_to_open();
    }
    void commit(const FileHeader& header, const std::function<void()>& look) override;

  private:
    Team& team_;
    std::optional<NewFile> file_;
};

/// An index that has steps already. The present header and the parts that it names are not touched
/// until the new header is written, so at any crash of process or machine one of the two is valid.
/// Destroyed without a commit, it cuts off what was written.
class GrowingTarget final : public BuildTarget {
  public:
    /// @param file each member's own, opened with `alone` on rank 0 @param held its header
    GrowingTarget(Team& team, GrowingSink& file, const FileHeader& held);
    ~GrowingTarget() override;
    GrowingTarget(const GrowingTarget&) = delete;
    GrowingTarget& operator=(const GrowingTarget&) = delete;

    GrowingSink& sink() override { return file_; }
    std::filesystem::path path_to_read(const std::filesystem::path& name) const override {
        return name;
    }
    void commit(const FileHeader& header, const std::function<void()>& look) override;

  private:
    Team& team_;
    GrowingSink& file_;
    std::uint64_t held_bytes_;
    bool may_count_ = false; ///< the new header may have been written
};

} // namespace isochron::index
