// A NetCDF file as its library gives it: variables, attributes and values, its errors as ours.
#pragma once

#include "index/formats/stored_scalar.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace isochron::index {

struct NetcdfDimension {
    std::string name;
    std::size_t length = 0;
    bool operator==(const NetcdfDimension&) const = default;
};

struct NetcdfVariable {
    int group = 0, id = 0;
    std::string name = {};               ///< with the groups it is in: `forecast/temperature`
    std::optional<StoredType> type = {}; ///< none: text, or a type of the file's own
    std::vector<NetcdfDimension> dimensions = {}; ///< slowest first
};

/// Stands for the group that a variable is in, whose attributes are asked for as those of variables.
NetcdfVariable group_of(const NetcdfVariable& variable);

/// `T(time 2, lev 18, lat 64, lon 128)`
std::string text(const NetcdfVariable& variable);

class NetcdfFile {
  public:
    /// @throws Error naming the file: not NetCDF, truncated, damaged
    explicit NetcdfFile(const std::filesystem::path& path);
    ~NetcdfFile();
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    const std::string& name() const { return name_; }
    /// Of all groups, in the file's order.
    const std::vector<NetcdfVariable>& variables() const { return variables_; }

    /// The one-dimensional variable called as the dimension is, in the group of `of` or around it.
    const NetcdfVariable* coordinate(const NetcdfVariable& of,
                                     const NetcdfDimension& dimension) const;

    /// Attributes; empty where there is none of that name and kind.
    std::string text(const NetcdfVariable& variable, const char* attribute) const;
    std::vector<double> numbers(const NetcdfVariable& variable, const char* attribute) const;
    /// Whether the values of an attribute are f32 or f64.
    bool is_real(const NetcdfVariable& variable, const char* attribute) const;
    /// scale_factor and add_offset. @throws Error when they are no scaling
    Scaling scaling(const NetcdfVariable& variable) const;
    /// What stands where nothing was written; integers have no such value unless the file says so.
    std::optional<double> fill(const NetcdfVariable& variable) const;

    /// All values, scaled. Meant for coordinates.
    std::vector<double> values(const NetcdfVariable& variable) const;

    /// The box of values from `start`, `count` along each dimension, as stored, in the machine's
    /// byte order. @throws Error naming file and variable
    void read(const NetcdfVariable& variable, std::span<const std::size_t> start,
              std::span<const std::size_t> count, std::span<std::byte> out) const;

    /// Keeps the chunks that steps share decompressed from one step to the next, where 512 MiB do.
    /// @param time the dimension of the steps
    void keep_chunks(const NetcdfVariable& variable, std::size_t time) const;

    /// Values along each dimension of a chunk; empty where there are no chunks.
    std::vector<std::size_t> chunk_of(const NetcdfVariable& variable) const;

    /// @throws Error when the file is too small to hold the variable, whatever its compression: a
    ///         header that lies must not cost memory
    void expect_room(const NetcdfVariable& variable) const;

  private:
    void add_group(int group, const std::string& prefix);
    void expect(int status, const std::string& what) const;

    std::filesystem::path path_;
    std::string name_;
    int file_ = -1;
    std::vector<NetcdfVariable> variables_;
};

} // namespace isochron::index
