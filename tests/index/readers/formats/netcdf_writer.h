// Writes NetCDF files for tests, with the library itself.
#pragma once

#include <netcdf.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace isochron::index {

/// All four forms that the library writes: CDF-1, -2, -5 and NetCDF-4.
inline constexpr int kNetcdfForms[]{NC_CLASSIC_MODEL, NC_64BIT_OFFSET, NC_64BIT_DATA, NC_NETCDF4};

/// Writes one file. Any failure of the library throws.
class NetcdfWriter {
  public:
    NetcdfWriter(std::filesystem::path path, int form);
    ~NetcdfWriter();
    NetcdfWriter(const NetcdfWriter&) = delete;
    NetcdfWriter& operator=(const NetcdfWriter&) = delete;

    /// What follows is made in a group of that name, NetCDF-4 only.
    void enter_group(const char* name);
    /// @param length NC_UNLIMITED for the one of records
    void dimension(const char* name, std::size_t length);
    void variable(const char* name, nc_type type, const std::vector<std::string>& dimensions);
    /// Compresses the variable, NetCDF-4 only.
    void deflate(const char* variable, const std::vector<std::size_t>& chunk);
    /// Attributes; those of the group where `variable` is nullptr.
    void text(const char* variable, const char* name, std::string_view value);
    template <class T>
    void number(const char* variable, const char* name, const std::vector<T>& values) {
        put_attribute(variable, name, type_of(T{}), values.size(), values.data());
    }
    /// Writes the values of the whole variable, or of its first records.
    template <class T>
    void put(const char* variable, const std::vector<T>& values) {
        put_values(variable, values.size(), values.data());
    }
    /// A coordinate variable, f64, with its dimension.
    void axis(const char* name, const std::vector<double>& at, const char* units = "");

    /// Closes the file. @return its path
    const std::filesystem::path& done();

  private:
    static nc_type type_of(std::int8_t) { return NC_BYTE; }
    static nc_type type_of(std::uint8_t) { return NC_UBYTE; }
    static nc_type type_of(std::int16_t) { return NC_SHORT; }
    static nc_type type_of(std::uint16_t) { return NC_USHORT; }
    static nc_type type_of(std::int32_t) { return NC_INT; }
    static nc_type type_of(std::uint32_t) { return NC_UINT; }
    static nc_type type_of(std::int64_t) { return NC_INT64; }
    static nc_type type_of(std::uint64_t) { return NC_UINT64; }
    static nc_type type_of(float) { return NC_FLOAT; }
    static nc_type type_of(double) { return NC_DOUBLE; }

    int id_of(const char* variable) const;
    void put_attribute(const char* variable, const char* name, nc_type type, std::size_t count,
                       const void* values);
    void put_values(const char* variable, std::size_t count, const void* values);
    void define(bool defining);

    std::filesystem::path path_;
    int file_ = -1, group_ = -1;
    bool open_ = true, defining_ = true;
};

} // namespace isochron::index
