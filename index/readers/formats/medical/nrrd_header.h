// The fields of an NRRD header.
#pragma once

#include <cstdint>
#include <filesystem>
#include <iosfwd>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

class NrrdHeader {
  public:
    /// @throws Error naming the file when it does not begin like NRRD, or the header has no end
    explicit NrrdHeader(const std::filesystem::path& path);

    /// A field. @param key in lower case, without blanks, since the spelling in files varies
    std::optional<std::string> find(const std::string& key) const;
    /// The value of a key of the user, `MultiVolume.FrameLabels`, as it is spelled.
    std::optional<std::string> own(const std::string& key) const;
    /// A field that must be there. @throws Error when it is missing
    std::string need(const std::string& key) const;
    /// Fields that none of these keys are, as the file has them; the user's own without values.
    std::vector<std::string> others(const std::set<std::string_view>& keys) const;
    /// Names that follow `data file: LIST`.
    const std::vector<std::string>& listed() const { return listed_; }
    const std::string& file() const { return file_; }
    std::uint64_t bytes() const { return bytes_; }

  private:
    bool lists() const;
    bool read_line(std::istream& in, std::string& line);

    std::string file_;
    std::map<std::string, std::string> fields_;
    std::map<std::string, std::string> spelled_; ///< keys as the file has them
    std::map<std::string, std::string> own_;     ///< keys of the user
    std::vector<std::string> listed_;
    std::uint64_t bytes_ = 0;
};

} // namespace isochron::index
