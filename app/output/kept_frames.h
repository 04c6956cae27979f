// Frames of a movie that are kept beside it while it is made, so that a movie whose process was
// killed goes on where it stopped.
#pragma once

#include "index/system/descriptor.h"
#include "render/gl/image.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace isochron::app {

/// A picture of a frame.
struct FramePart {
    std::string suffix; ///< end of its movie's name: `_front_left`
    std::string note;   ///< text of its picture note
    render::Image image;
};

/// The folder is `.walk.mp4.0123456789abcdef.frames`: the number is a hash of the question. It is the
/// user's alone, and of what lies in it only frames are removed.
class KeptFrames {
  public:
    /// @param movie file or folder that is made
    /// @param question all that decides what the frames show
    /// @throws index::Error when another process makes the same movie now. Where no folder can be
    /// made, nothing is kept.
    KeptFrames(const std::filesystem::path& movie, const std::string& question);
    KeptFrames(const KeptFrames&) = delete;
    KeptFrames& operator=(const KeptFrames&) = delete;

    /// Whether a frame lies there; `read` says whether it is whole.
    bool holds(std::size_t frame) const;
    /// Empty, and the file is removed, unless the frame is there and as it was written.
    std::optional<std::vector<FramePart>> read(std::size_t frame) const;
    /// Keeps a frame. After the first one that cannot be written, none is kept.
    void keep(std::size_t frame, const std::vector<FramePart>& parts);
    /// Removes the frames, and the folder unless something else lies in it.
    void remove();
    const std::filesystem::path& folder() const { return folder_; }
    /// Folders of frames of the same movie that other questions have left.
    std::vector<std::filesystem::path> others() const;

  private:
    std::filesystem::path movie_, folder_;
    index::Descriptor open_; ///< the folder, locked; none: nothing is kept
    bool keeps_ = false;
};

} // namespace isochron::app
