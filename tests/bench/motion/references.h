// The settled pictures that moving ones are compared with, and the views without cells.
#pragma once

#include "app/config/config.h"
#include "tests/bench/motion/play.h"

#include <deque>
#include <functional>
#include <memory>
#include <vector>

namespace isochron::bench {

struct Reference {
    app::ExplorerState state;
    std::vector<interaction::DeviceState> devices;
    std::vector<render::Image> settled, without; ///< by eye
};

/// Makes each reference once, for all budgets in which the same was shown.
class References {
  public:
    using Check = std::function<void()>; ///< called before each picture; may throw

    References(app::Config config, std::shared_ptr<const index::IndexFile> file, Check check)
        : config_(std::move(config)), file_(std::move(file)), check_(std::move(check)) {}

    /// Notes that a picture will be compared. @return its reference, once `make` has been called
    const Reference& wanted(const ShownPicture& picture);
    /// Draws all references that are wanted.
    void make();

  private:
    app::Config config_;
    std::shared_ptr<const index::IndexFile> file_;
    Check check_;
    std::deque<Reference> references_; ///< do not move
};

} // namespace isochron::bench
