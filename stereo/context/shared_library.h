// A system library that is opened only when it is needed.
#pragma once

#include <string>

namespace isochron::stereo {

/// Stays open for the rest of the process: GL drivers leave threads and exit handlers behind. Its
/// symbols stay private, so that libOSMesa's gl* functions never stand in for another driver's.
class SharedLibrary {
  public:
    /// @throws render::Error with what the loader said, which names the file
    explicit SharedLibrary(const std::string& file);
    /// @throws render::Error naming the library and the missing symbol
    void* symbol(const char* name) const;
    template <typename Function>
    void get(Function& function, const char* name) const {
        function = reinterpret_cast<Function>(symbol(name));
    }

  private:
    std::string file_;
    void* handle_;
};

} // namespace isochron::stereo
