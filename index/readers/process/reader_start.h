// What a reader process has when it starts.
#pragma once

namespace isochron::index {

/// The descriptor of its socket.
constexpr int kReaderSocket = 3;

/// Under a sanitizer a reader has no limits and no fence, since the sanitizer's own memory and
/// calls would break them. To see the sanitizer's reports, set log_path=FILE in its options.
#ifdef ISOCHRON_SANITIZED
constexpr bool kReaderIsWatched = true;
#else
constexpr bool kReaderIsWatched = false;
#endif

} // namespace isochron::index
