// The values of the slices that a session shows, read beside the frames.
#pragma once

#include "app/choice/frame.h"
#include "app/frame/asker.h"
#include "index/file/index_file.h"

#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace isochron::app {

/// One reading goes on at a time; the newest wish follows it, so that slices follow a hand that moves
/// them as fast as they can be read. What is shown are always the planes that were read together.
class SliceSupply {
  public:
    explicit SliceSupply(std::shared_ptr<const index::IndexFile> file);

    /// Continues with the same data that have more steps.
    void set_file(std::shared_ptr<const index::IndexFile> file) { file_ = std::move(file); }
    /// Sets the function that is called, on the reading thread, when slices have been read.
    void set_wake(std::function<void()> wake) { reading_.set_wake(std::move(wake)); }

    /// Called once a frame. Never waits in a live session; a replay waits for what it asks for.
    void update(const Frame& frame);
    /// What was read last, by plane.
    const std::vector<index::SliceValuesPtr>& shown() const { return shown_; }
    /// Whether other slices are asked for than are shown.
    bool come() const { return come_; }
    /// Why slices could not be read; taken by the call.
    std::vector<std::string> take_messages() { return std::exchange(messages_, {}); }

  private:
    using Queries = std::vector<index::SliceQuery>;
    struct Wanted {
        std::shared_ptr<const index::IndexFile> file;
        Queries queries;
        std::vector<index::SliceValuesPtr> at_hand;
    };
    struct Read {
        Queries queries;
        std::vector<index::SliceValuesPtr> slices;
        std::string failure; ///< empty: none
    };
    static Read read(const Wanted& wanted, const Asking& asking);
    void take();

    std::shared_ptr<const index::IndexFile> file_;
    std::vector<index::SliceValuesPtr> shown_;
    Queries failed_; ///< cannot be read
    bool reads_ = false, come_ = false;
    std::vector<std::string> messages_;
    Asker<Wanted, Read> reading_;
};

/// The slices of a picture. @param read as `SliceSupply::shown`
std::vector<ShownSlice> shown_slices(const std::vector<index::SliceValuesPtr>& read,
                                     const ExplorerState& state, const index::IndexFile& file);

} // namespace isochron::app
