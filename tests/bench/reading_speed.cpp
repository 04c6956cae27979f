// How fast files are read, beside the plain libraries: `reading_speed FOLDER [MEBIBYTES]`.
//
// Makes a volume of f32 in each format in the folder, which the page cache must have room for, and
// reads it in turns with the library alone and with ours: into memory that was never touched, and
// into memory that was. Prints the best time of each and their ratio.
#include "index/readers/formats/open_series.h"
#include "index/system/input_file.h"
#include "index/volume/volume_series.h"

#include <fmt/format.h>
#include <hdf5.h>
#include <tiffio.h>

#include <sys/mman.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <functional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using isochron::index::InputFile;

constexpr std::size_t kEdge = 512, kSlice = kEdge * kEdge * sizeof(float);

/// Memory of pages that were never touched, or were.
class Pages {
  public:
    Pages(std::size_t bytes, bool touched)
        : bytes_(static_cast<std::byte*>(::mmap(nullptr, bytes, PROT_READ | PROT_WRITE,
                                                MAP_PRIVATE | MAP_ANONYMOUS, -1, 0)),
                 bytes) {
        if (touched)
            std::memset(bytes_.data(), 1, bytes);
    }
    ~Pages() { ::munmap(bytes_.data(), bytes_.size()); }
    Pages(const Pages&) = delete;
    Pages& operator=(const Pages&) = delete;
    std::span<std::byte> bytes() const { return bytes_; }

  private:
    std::span<std::byte> bytes_;
};

using Read = std::function<void(std::span<std::byte>)>;

double milliseconds_of(const Read& read, std::size_t bytes, bool touched) {
    const Pages pages(bytes, touched);
    const auto begin = std::chrono::steady_clock::now();
    read(pages.bytes());
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - begin)
        .count();
}

void compare(const std::string& name, const fs::path& file, std::size_t bytes, const Read& plain) {
    isochron::index::ReadOptions options;
    if (file.extension() == ".raw") {
        options.dims = {kEdge, kEdge, static_cast<std::uint32_t>(bytes / kSlice)};
        options.type = isochron::index::ValueType::f32;
    }
    const auto series = isochron::index::open_series({file}, options);
    const Read ours = [&](std::span<std::byte> out) { series->read(0, out); };
    for (const bool touched : {false, true}) {
        constexpr int kTurns = 5;
        double of_plain = 1e9, of_ours = 1e9;
        for (int turn = 0; turn < kTurns; ++turn) {
            of_plain = std::min(of_plain, milliseconds_of(plain, bytes, touched));
            of_ours = std::min(of_ours, milliseconds_of(ours, bytes, touched));
        }
        fmt::print("{:16} {:14} library {:7.1f} ms, ours {:7.1f} ms: {:.2f}x\n", name,
                   touched ? "touched memory" : "new memory", of_plain, of_ours,
                   of_plain / of_ours);
    }
}

void read_whole(const fs::path& file, std::span<std::byte> out) {
    InputFile(file).read(0, out);
}

fs::path make_hdf5(const fs::path& file, const std::vector<float>& values, hsize_t chunk) {
    const hsize_t sizes[]{values.size() / (kEdge * kEdge), kEdge, kEdge},
        chunks[]{chunk, kEdge, kEdge};
    const hid_t h5 = H5Fcreate(file.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
    const hid_t space = H5Screate_simple(3, sizes, nullptr), how = H5Pcreate(H5P_DATASET_CREATE);
    if (chunk > 0)
        H5Pset_chunk(how, 3, chunks);
    const hid_t data = H5Dcreate2(h5, "rho", H5T_IEEE_F32LE, space, H5P_DEFAULT, how, H5P_DEFAULT);
    H5Dwrite(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(data);
    H5Fclose(h5);
    return file;
}

void read_hdf5(const fs::path& file, std::span<std::byte> out) {
    const hid_t h5 = H5Fopen(file.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
    const hid_t data = H5Dopen2(h5, "rho", H5P_DEFAULT);
    H5Dread(data, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, out.data());
    H5Dclose(data);
    H5Fclose(h5);
}

fs::path make_tiff(const fs::path& file, const std::vector<float>& values) {
    TIFF* tiff = TIFFOpen(file.c_str(), "w8");
    for (std::size_t z = 0; z * kEdge * kEdge < values.size(); ++z) {
        TIFFSetField(tiff, TIFFTAG_IMAGEWIDTH, kEdge);
        TIFFSetField(tiff, TIFFTAG_IMAGELENGTH, kEdge);
        TIFFSetField(tiff, TIFFTAG_BITSPERSAMPLE, 32);
        TIFFSetField(tiff, TIFFTAG_SAMPLEFORMAT, SAMPLEFORMAT_IEEEFP);
        TIFFSetField(tiff, TIFFTAG_SAMPLESPERPIXEL, 1);
        TIFFSetField(tiff, TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
        TIFFSetField(tiff, TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
        TIFFSetField(tiff, TIFFTAG_ROWSPERSTRIP, kEdge);
        TIFFWriteEncodedStrip(tiff, 0, const_cast<float*>(&values[z * kEdge * kEdge]), kSlice);
        TIFFWriteDirectory(tiff);
    }
    TIFFClose(tiff);
    return file;
}

void read_tiff(const fs::path& file, std::span<std::byte> out) {
    TIFF* tiff = TIFFOpen(file.c_str(), "rc"); // strips as they are
    std::size_t at = 0;
    do
        if (const tmsize_t read = TIFFReadEncodedStrip(tiff, 0, out.data() + at, kSlice);
            read != tmsize_t{kSlice})
            throw std::runtime_error(fmt::format("{}: libtiff read {} bytes of a strip of {} at {}",
                                                 file.string(), read, kSlice, at));
    while ((at += kSlice) < out.size() && TIFFReadDirectory(tiff));
    TIFFClose(tiff);
}

void write(const fs::path& file, std::span<const float> values) {
    std::ofstream(file, std::ios::binary)
        .write(reinterpret_cast<const char*>(values.data()),
               static_cast<std::streamsize>(values.size_bytes()));
}

constexpr std::size_t kZarrSlices = 16; ///< slices of a chunk

fs::path make_zarr(const fs::path& folder, const std::vector<float>& values) {
    fs::create_directories(folder);
    const std::size_t slices = values.size() / (kEdge * kEdge);
    std::ofstream(folder / ".zarray")
        << fmt::format(R"({{"zarr_format": 2, "shape": [{}, {}, {}], "chunks": [{}, {}, {}],)"
                       R"( "dtype": "<f4", "compressor": null, "fill_value": 0, "order": "C",)"
                       R"( "filters": null}})",
                       slices, kEdge, kEdge, kZarrSlices, kEdge, kEdge);
    for (std::size_t chunk = 0; chunk * kZarrSlices < slices; ++chunk)
        write(folder / fmt::format("{}.0.0", chunk),
              std::span(values).subspan(chunk * kZarrSlices * kEdge * kEdge,
                                        kZarrSlices * kEdge * kEdge));
    return folder;
}

void read_zarr(const fs::path& folder, std::span<std::byte> out) {
    constexpr std::size_t kChunk = kZarrSlices * kSlice;
    for (std::size_t chunk = 0; chunk * kChunk < out.size(); ++chunk)
        read_whole(folder / fmt::format("{}.0.0", chunk), out.subspan(chunk * kChunk, kChunk));
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 2) {
        fmt::print(stderr, "reading_speed FOLDER [MEBIBYTES]\n");
        return 2;
    }
    const fs::path folder = argv[1];
    const std::size_t mebibytes = argc > 2 ? std::strtoul(argv[2], nullptr, 10) : 256;
    std::vector<float> values(mebibytes / kZarrSlices * kZarrSlices * kEdge * kEdge);
    for (std::size_t i = 0; i < values.size(); ++i)
        values[i] = static_cast<float>(i % 100003);
    const std::size_t bytes = values.size() * sizeof(float);
    try {
        const auto one = [&](const std::string& name, const fs::path& file, const auto& plain) {
            compare(name, file, bytes, [&](std::span<std::byte> out) { plain(file, out); });
            fs::remove_all(file);
        };
        write(folder / "a.raw", values);
        one("raw", folder / "a.raw", read_whole);
        one("HDF5", make_hdf5(folder / "a.h5", values, 0), read_hdf5);
        one("HDF5 in chunks", make_hdf5(folder / "b.h5", values, kZarrSlices), read_hdf5);
        one("TIFF", make_tiff(folder / "a.tif", values), read_tiff);
        one("Zarr", make_zarr(folder / "a.zarr", values), read_zarr);
    } catch (const std::exception& error) {
        fmt::print(stderr, "{}\n", error.what());
        return 1;
    }
}
