// What readers may read: the folders of the files that the user has named.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace isochron::index {

/// Places are only added. A reader knows the places that were there when it started; its fence
/// cannot learn more.
class ReadablePlaces {
  public:
    /// Adds the folder of a file, and of a symbolic link also the file that it leads to; of a
    /// folder itself. What is not there is not added.
    void add(const std::filesystem::path& file);
    bool contain(const std::filesystem::path& file) const;

    std::vector<std::filesystem::path> all() const;
    /// Changes whenever something is added.
    std::uint64_t age() const { return age_; }

  private:
    /// Identifies a file or folder: one that was removed and made anew is another, though it may have
    /// the inode's number again. Its time of birth tells where the file system knows that.
    struct Which {
        std::uint64_t device = 0, number = 0;
        std::int64_t born = 0; ///< [ns] since 1970
        bool operator==(const Which&) const = default;
    };
    static Which which(const std::filesystem::path& place);
    bool contain_real(const std::filesystem::path& real) const;
    void add_real(const std::filesystem::path& real);

    std::map<std::filesystem::path, Which> places_; ///< by absolute paths without links
    std::uint64_t age_ = 0;
};

/// The line about a file that names another one outside of these places.
std::string leads_out(const std::filesystem::path& file, const std::filesystem::path& to);

} // namespace isochron::index
