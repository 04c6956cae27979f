// Decides from the signs of a reader when it is waited for no longer.
#pragma once

#include "index/readers/process/message_socket.h"
#include "index/readers/process/process_signs.h"

#include <chrono>
#include <optional>
#include <string>

namespace isochron::index {

/// Time is counted in looks, each of which counts as `kLook`, so that time in which this process
/// itself was stopped does not count.
class ReaderWatch {
  public:
    using Duration = std::chrono::milliseconds;
    static constexpr Duration kLook = MessageSocket::kAwait;

    /// A request begins. @param patience how long the reader may make no progress
    /// @param of_bytes what is added for the size of the file
    void begin(Duration patience, Duration of_bytes);

    /// Looks at the reader once. @param now none where the system does not tell
    /// @return why it is to be stopped, if it is
    std::optional<std::string> look(const std::optional<ProcessSigns>& now);

  private:
    Duration patience_{0}, of_bytes_{0};
    Duration silent_{0}; ///< since it last read, touched new memory or waited for a disk
    Duration asleep_{
        0}; ///< time of this request in which the reader neither ran nor waited for a disk
    std::optional<ProcessSigns> last_;
};

} // namespace isochron::index
