// Where the chunks and descriptions of a Zarr hierarchy lie: a folder, or a zip file.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <new>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {

/// Leaves new bytes as they are: they are about to be read.
template <class T>
struct Unfilled : std::allocator<T> {
    template <class U>
    struct rebind {                // NOLINT: the name that allocators have for it
        using other = Unfilled<U>; // NOLINT: likewise
    };
    template <class U>
    void construct(U* at) noexcept {
        ::new (static_cast<void*>(at)) U;
    }
    template <class U, class... Arguments>
    void construct(U* at, Arguments&&... arguments) {
        ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
    }
};
using ZarrBytes = std::vector<std::byte, Unfilled<std::byte>>;

class ZarrStore {
  public:
    virtual ~ZarrStore() = default;

    /// Reads the value of a key as `path/to/array/c/0/1`. @return false where there is none
    /// @throws Error naming the file: unreadable, damaged
    virtual bool read(const std::string& key, ZarrBytes& into) const = 0;
    /// Reads a value into memory of its own.
    std::optional<ZarrBytes> read(const std::string& key) const {
        ZarrBytes bytes;
        return read(key, bytes) ? std::optional(std::move(bytes)) : std::nullopt;
    }
    /// [bytes] of a value; none where there is none. @throws Error as `read`
    virtual std::optional<std::uint64_t> size_of_value(const std::string& key) const = 0;
    /// Fills `into` from the byte `at` of a value that is there. @throws Error as `read`, and when
    /// it ends before that
    virtual void part(const std::string& key, std::uint64_t at,
                      std::span<std::byte> into) const = 0;
    /// Names directly below a group, sorted, at most 100,000. @param group without a slash at its
    /// end
    virtual std::vector<std::string> names(const std::string& group) const = 0;

    /// Where it is, for messages.
    const std::string& name() const { return name_; }

  protected:
    explicit ZarrStore(std::string name) : name_(std::move(name)) {}

  private:
    std::string name_;
};

/// The volume of a hierarchy. @throws Error naming the store
std::unique_ptr<class DecodedFile> decode_zarr(std::unique_ptr<ZarrStore> store,
                                               const struct ReadOptions& options);

/// @param path a folder, or a zip file @throws Error naming it
std::unique_ptr<ZarrStore> open_zarr_store(const std::filesystem::path& path);

} // namespace isochron::index
