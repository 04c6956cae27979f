// Writes NetCDF files for tests.
#include "tests/index/readers/formats/netcdf_writer.h"

#include <stdexcept>

namespace isochron::index {
namespace {

void expect(int status) {
    if (status != NC_NOERR)
        throw std::runtime_error(nc_strerror(status));
}

} // namespace

NetcdfWriter::NetcdfWriter(std::filesystem::path path, int form) : path_(std::move(path)) {
    expect(nc_create(path_.c_str(), NC_CLOBBER | form, &file_));
    group_ = file_;
}

NetcdfWriter::~NetcdfWriter() {
    if (open_)
        nc_close(file_);
}

void NetcdfWriter::enter_group(const char* name) {
    expect(nc_def_grp(group_, name, &group_));
}

void NetcdfWriter::dimension(const char* name, std::size_t length) {
    define(true);
    int id = 0;
    expect(nc_def_dim(group_, name, length, &id));
}

void NetcdfWriter::variable(const char* name, nc_type type,
                            const std::vector<std::string>& dimensions) {
    define(true);
    std::vector<int> ids;
    for (const std::string& dimension : dimensions)
        expect(nc_inq_dimid(group_, dimension.c_str(), &ids.emplace_back()));
    int id = 0;
    expect(nc_def_var(group_, name, type, static_cast<int>(ids.size()), ids.data(), &id));
}

void NetcdfWriter::deflate(const char* variable, const std::vector<std::size_t>& chunk) {
    expect(nc_def_var_chunking(group_, id_of(variable), NC_CHUNKED, chunk.data()));
    expect(nc_def_var_deflate(group_, id_of(variable), 1, 1, 9));
}

void NetcdfWriter::text(const char* variable, const char* name, std::string_view value) {
    define(true);
    expect(nc_put_att_text(group_, id_of(variable), name, value.size(), value.data()));
}

void NetcdfWriter::axis(const char* name, const std::vector<double>& at, const char* units) {
    dimension(name, at.size());
    variable(name, NC_DOUBLE, {name});
    if (*units)
        text(name, "units", units);
    put(name, at);
}

const std::filesystem::path& NetcdfWriter::done() {
    define(false);
    open_ = false;
    expect(nc_close(file_));
    return path_;
}

int NetcdfWriter::id_of(const char* variable) const {
    if (!variable)
        return NC_GLOBAL;
    int id = 0;
    expect(nc_inq_varid(group_, variable, &id));
    return id;
}

void NetcdfWriter::put_attribute(const char* variable, const char* name, nc_type type,
                                 std::size_t count, const void* values) {
    define(true);
    expect(nc_put_att(group_, id_of(variable), name, type, count, values));
}

void NetcdfWriter::put_values(const char* variable, std::size_t count, const void* values) {
    define(false);
    const int id = id_of(variable);
    int dimensions = 0, ids[NC_MAX_VAR_DIMS];
    expect(nc_inq_var(group_, id, nullptr, nullptr, &dimensions, ids, nullptr));
    std::vector<std::size_t> start(static_cast<std::size_t>(dimensions)), counts(start);
    std::size_t others = 1;
    for (std::size_t i = start.size(); i-- > 0;) {
        std::size_t length = 0;
        expect(nc_inq_dimlen(group_, ids[i], &length));
        counts[i] = i == 0 ? count / others : length;
        others *= length;
    }
    expect(nc_put_vara(group_, id, start.data(), counts.data(), values));
}

void NetcdfWriter::define(bool defining) {
    if (defining != defining_)
        expect(defining ? nc_redef(file_) : nc_enddef(file_));
    defining_ = defining;
}

} // namespace isochron::index
