// An HDF5 file through its library: datasets, attributes and values; errors are thrown as Error.
#pragma once

#include "index/readers/formats/stored_scalar.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace isochron::index {

/// An open object of the library: its identifier, and the function that closes it.
class Hdf5Handle {
  public:
    using Close = int (*)(std::int64_t);

    Hdf5Handle() = default;
    /// @param id negative: nothing is open
    Hdf5Handle(std::int64_t id, Close close) : id_(id), close_(close) {}
    ~Hdf5Handle() {
        if (id_ >= 0)
            close_(id_);
    }
    Hdf5Handle(Hdf5Handle&& other) noexcept
        : id_(std::exchange(other.id_, -1)), close_(other.close_) {}
    Hdf5Handle& operator=(Hdf5Handle&& other) noexcept {
        std::swap(id_, other.id_);
        std::swap(close_, other.close_);
        return *this;
    }

    explicit operator bool() const { return id_ >= 0; }
    std::int64_t id() const { return id_; }

  private:
    std::int64_t id_ = -1;
    Close close_ = nullptr;
};

struct Hdf5Dataset {
    std::string path;                      ///< from the root: `/fields/rho`
    std::optional<StoredType> type;        ///< none: text, compound, ...
    std::vector<std::uint64_t> dimensions; ///< slowest first
};

/// `64 x 64 x 32`
std::string shape_text(const std::vector<std::uint64_t>& dimensions);

class Hdf5File {
  public:
    /// @param parts a part of a dataset is read: of rows that are not in chunks no more than it needs
    /// @throws Error naming the file: not HDF5, truncated, damaged
    explicit Hdf5File(const std::filesystem::path& path, bool parts = false);

    const std::string& name() const { return name_; }
    std::int64_t id() const { return file_.id(); }

    /// All datasets that hard links lead to, ordered by name.
    /// @throws Error: damaged, or more than 200,000 objects
    std::vector<Hdf5Dataset> datasets() const;
    /// The dataset at a path, also behind soft and external links; none if there is none.
    std::optional<Hdf5Dataset> dataset(const std::string& path) const;
    bool holds(const std::string& path) const;

    /// Attributes of the object at a path; empty if it has none of that name and kind.
    std::vector<double> numbers(const std::string& object, const std::string& attribute) const;
    /// Whether an attribute is floating-point numbers.
    bool is_real(const std::string& object, const std::string& attribute) const;
    std::string text(const std::string& object, const std::string& attribute) const;
    std::vector<std::string> texts(const std::string& object, const std::string& attribute) const;

    /// The names of the attributes of the object at a path, in their order; empty if there is none.
    std::vector<std::string> attributes(const std::string& object) const;

    /// All values of a short dataset. @throws Error: more than 2^24 values, or damaged
    std::vector<double> values(const Hdf5Dataset& dataset) const;
    /// The texts of a short dataset along its first dimension, characters along a second one put
    /// together; empty: it holds none. @throws Error: damaged
    std::vector<std::string> texts_in(const std::string& path) const;
    /// The path of the first dimension scale along each dimension; empty if there is none.
    std::vector<std::string> scales(const Hdf5Dataset& dataset) const;

    /// @throws Error with file, object and the library's message, when `good` is false
    void expect(bool good, const std::string& what) const;

  private:
    std::string name_;
    Hdf5Handle file_;
};

} // namespace isochron::index
