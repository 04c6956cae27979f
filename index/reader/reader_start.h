// What a reader finds when it starts.
#pragma once

namespace isochron::index {

/// The descriptor of its socket.
constexpr int kReaderSocket = 3;

/// Under a sanitizer a reader goes without limits and fence, which the sanitizer's own memory and
/// calls would break. What it reports is seen with log_path=FILE in its options.
#ifdef ISOCHRON_SANITIZED
constexpr bool kReaderIsWatched = true;
#else
constexpr bool kReaderIsWatched = false;
#endif

} // namespace isochron::index
