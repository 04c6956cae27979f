// A NetCDF file through its library: variables, attributes and values; errors are thrown as Error.
#pragma once

#include "index/readers/formats/stored_scalar.h"

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
    std::string name = {};                        ///< with its groups: `forecast/temperature`
    std::optional<StoredType> type = {};          ///< none: text, or a type that the file defines
    std::vector<NetcdfDimension> dimensions = {}; ///< slowest first
};

/// `T(time 2, lev 18, lat 64, lon 128)`
std::string text(const NetcdfVariable& variable);

class NetcdfFile {
  public:
    /// @param parts a part of a variable is read: of a classic file little more than its rows
    /// @throws Error naming the file: not NetCDF, truncated, damaged
    explicit NetcdfFile(const std::filesystem::path& path, bool parts = false);
    ~NetcdfFile();
    NetcdfFile(const NetcdfFile&) = delete;
    NetcdfFile& operator=(const NetcdfFile&) = delete;

    const std::string& name() const { return name_; }
    /// The variables of all groups, in the file's order.
    const std::vector<NetcdfVariable>& variables() const { return variables_; }

    /// The variables of numbers along this dimension alone, in the group of `of` and the groups
    /// around it, the nearest first; behind them those of texts, or of characters along a second one.
    std::vector<const NetcdfVariable*> along(const NetcdfVariable& of,
                                             const NetcdfDimension& dimension) const;

    /// The variable at a path, or a stand-in for the group there, through which the group's attributes
    /// are read; empty: the root.
    NetcdfVariable at(const std::string& path) const;

    /// Names of a variable's attributes.
    std::vector<std::string> attributes(const NetcdfVariable& variable) const;
    /// Attributes; empty if there is none of that name and kind.
    std::string text(const NetcdfVariable& variable, const char* attribute) const;
    std::vector<std::string> texts(const NetcdfVariable& variable, const char* attribute) const;
    std::vector<double> numbers(const NetcdfVariable& variable, const char* attribute) const;
    /// Whether an attribute is f32 or f64.
    bool is_real(const NetcdfVariable& variable, const char* attribute) const;
    /// The value at places that were never written, where no attribute names it; integers have none.
    std::optional<double> fill(const NetcdfVariable& variable) const;

    /// All values, as stored. Meant for coordinates.
    std::vector<double> values(const NetcdfVariable& variable) const;

    /// The texts of a variable along its first dimension, or its only one; characters along the last
    /// dimension are one. Empty: it holds none, or long ones.
    std::vector<std::string> texts(const NetcdfVariable& variable) const;

    /// Reads the box of values at `start` with `count` values along each dimension, as stored, in
    /// the machine's byte order. @throws Error naming file and variable
    void read(const NetcdfVariable& variable, std::span<const std::size_t> start,
              std::span<const std::size_t> count, std::span<std::byte> out) const;

    /// Keeps chunks that several steps share decompressed from one step to the next, if 512 MiB are
    /// enough.
    /// @param time the dimension of the steps
    void keep_chunks(const NetcdfVariable& variable, std::size_t time) const;

    /// Number of values of a chunk along each dimension; empty if there are no chunks.
    std::vector<std::size_t> chunk_of(const NetcdfVariable& variable) const;

    /// Checks that the file can hold the variable, so that a false header does not cost memory.
    /// @throws Error when the file is too small even with the best compression
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
