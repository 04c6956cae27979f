// A system library that is loaded only when it is needed.
#pragma once

#include <string>

namespace isochron::stereo {

/// Stays loaded until the process ends, as GL drivers leave threads and exit handlers behind. Its
/// symbols are private, so that libOSMesa's gl* functions never replace another driver's.
class SharedLibrary {
  public:
    /// @throws render::Error with the loader's message, which names the file
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
