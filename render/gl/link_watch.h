// Tells whoever prepares a picture of every program that is linked, which may take a driver long.
// While a session is made, some dozens are linked.
#pragma once

#include <functional>

namespace isochron::render {

/// As long as it lives, `link_program` calls its function on this thread, after each program. The
/// function may throw, which ends what links. One at a time on a thread.
class LinkWatch {
  public:
    explicit LinkWatch(std::function<void()> linked);
    ~LinkWatch();
    LinkWatch(const LinkWatch&) = delete;
    LinkWatch& operator=(const LinkWatch&) = delete;

    /// Called by `link_program`: a program was linked.
    static void tell();

  private:
    const std::function<void()> linked_;
};

} // namespace isochron::render
