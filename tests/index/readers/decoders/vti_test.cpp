// The reader of VTK's image data: pieces, slabs, field data, and what is damaged or meant to do harm.
#include "index/readers/decoders/decoders.h"
#include "tests/support/paths.h"
#include "tests/support/reader_fixtures.h"
#include "tests/support/test_seed.h"

#include <fmt/format.h>
#include <gmock/gmock.h>

#include <random>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;
using testing::AnyOf;
using testing::HasSubstr;

const fs::path kData = fs::path(test_support::test_data()) / "vti";
const std::vector<const char*> kFiles{"ascii.vti",        "inline_plain32.vti", "inline_zlib64.vti",
                                      "raw_plain32.vti",  "raw_plain64.vti",    "raw_zlib32.vti",
                                      "raw_lz464.vti",    "raw_lzma64.vti",     "base64_zlib32.vti",
                                      "base64_lz432.vti", "base64_plain64.vti", "big_endian.vti",
                                      "pieces.vti",       "cells.vti"};

std::vector<std::byte> all_of(DecodedFile& file) {
    const SeriesInfo& info = file.info();
    std::vector<std::byte> values(info.step_bytes());
    const std::uint32_t slices = info.grid.vertices[2], at_once = file.slices_at_once();
    const std::size_t slice = values.size() / slices;
    for (std::uint32_t first = 0; first < slices; first += at_once) {
        const std::uint32_t count = std::min(at_once, slices - first);
        file.read(0, {first, count}, std::span(values).subspan(first * slice, count * slice));
    }
    return values;
}

class VtiFiles : public testing::Test {
  protected:
    fs::path write(const std::string& text) const { return folder_.write("a.vti", text); }
    std::string error_in(const std::string& text, const ReadOptions& options = {}) const {
        return error_of([&] { all_of(*decode_vti(write(text), options)); });
    }
    TestFolder folder_;
};

/// Two pieces along x that share the vertices at x = 2, and the cells of neither.
std::string in_pieces(const std::string& type, const std::string& first,
                      const std::string& second) {
    const auto piece = [&](const char* extent, const std::string& values) {
        return fmt::format("<Piece Extent='{}'><PointData><DataArray type='{}' Name='p' "
                           "format='ascii'>{}</DataArray></PointData></Piece>",
                           extent, type, values);
    };
    return "<VTKFile type='ImageData'><ImageData WholeExtent='0 4 0 1 0 1'>" +
           piece("0 2 0 1 0 1", first) + piece("2 4 0 1 0 1", second) + "</ImageData></VTKFile>";
}

TEST_F(VtiFiles, OfSeveralPiecesAreOneWhole) {
    const auto file = decode_vti(
        write(in_pieces("Int32", "0 1 2 5 6 7 10 11 12 15 16 17", "2 3 4 7 8 9 12 13 14 17 18 19")),
        {});
    std::vector<std::int32_t> values(20);
    file->read(0, {0, 2}, std::as_writable_bytes(std::span(values)));
    EXPECT_EQ(values, ramp<std::int32_t>(20));
}

TEST_F(VtiFiles, PiecesThatDifferAreRefused) {
    std::string text =
        in_pieces("Int32", "0 1 2 5 6 7 10 11 12 15 16 17", "2 3 4 7 8 9 12 13 14 17 18 19");
    text.replace(text.rfind("Int32"), 5, "Int16");
    EXPECT_THAT(error_in(text), HasSubstr("a.vti: array p is not the same in all pieces"));
}

TEST_F(VtiFiles, NumbersAsTextFitTheirType) {
    const auto with = [&](const char* type, const char* number) {
        return in_pieces(type, fmt::format("{} 1 2 5 6 7 10 11 12 15 16 17", number),
                         "2 3 4 7 8 9 12 13 14 17 18 19");
    };
    for (const auto& [type, number] : {std::pair{"Int8", "128"},
                                       {"UInt8", "-1"},
                                       {"UInt8", "256"},
                                       {"Int16", "32768"},
                                       {"UInt16", "65536"},
                                       {"Int32", "2147483648"},
                                       {"UInt32", "-1"},
                                       {"UInt32", "4294967296"},
                                       {"Int64", "9223372036854775808"},
                                       {"UInt64", "18446744073709551616"},
                                       {"Float32", "1e39"},
                                       {"Float64", "1e309"},
                                       {"Int32", "1.5"},
                                       {"Float32", "1,5"},
                                       {"Float32", "x"}})
        EXPECT_THAT(error_in(with(type, number)),
                    HasSubstr(fmt::format("a.vti: array p: value 0: `{}` is not a number", number)))
            << type;
    for (const auto& [type, number] :
         {std::pair{"Float32", "1e-60"}, {"Float64", "1e-400"}, {"Int8", "+0"}, {"Float32", "-0"}})
        EXPECT_EQ(decode_vti(write(with(type, number)), {})->info().array, "p") << type;
    const auto file = decode_vti(write(with("Float32", "1e-60")), {});
    std::vector<float> values(20);
    file->read(0, {0, 2}, std::as_writable_bytes(std::span(values)));
    EXPECT_EQ(values[0], 0.f);
}

TEST_F(VtiFiles, CutOffAnywhereAreRefused) {
    for (const char* name : kFiles) {
        const std::string whole = read_file(kData / name);
        const std::size_t end = whole.find("</VTKFile>");
        for (std::size_t size = 0; size < end; size += size < 64 ? 1 : 41)
            EXPECT_THAT(error_in(whole.substr(0, size)), HasSubstr("a.vti: "))
                << name << " " << size;
    }
}

/// Bytes are missing at the end of the values, and the markup goes on as it did.
TEST_F(VtiFiles, LackingTheirLastValuesAreRefusedThoughTheirMarkupIsWhole) {
    for (const char* name : {"inline_plain32.vti", "inline_zlib64.vti", "raw_plain32.vti",
                             "raw_plain64.vti", "raw_zlib32.vti", "raw_lz464.vti", "raw_lzma64.vti",
                             "base64_zlib32.vti", "base64_lz432.vti", "base64_plain64.vti"}) {
        const std::string whole = read_file(kData / name);
        const std::size_t appended = whole.find("</AppendedData>");
        const std::size_t tag = appended != whole.npos ? appended : whole.rfind("</DataArray>");
        const std::size_t end = whole.find_last_not_of(" \n", tag - 1) + 1;
        // As many as the time may take, which stands behind the values in some of these files.
        for (const std::size_t missing : {60, 80, 100}) {
            if (end < whole.find("<Piece") + missing)
                continue;
            EXPECT_THAT(error_in(whole.substr(0, end - missing) + whole.substr(end)),
                        AnyOf(HasSubstr("truncated"), HasSubstr("damaged")))
                << name << " without " << missing;
        }
    }
}

TEST_F(VtiFiles, WhoseBytesAreChangedAreReadOrRefusedInOneLine) {
    std::mt19937 random(test_seed());
    const int rounds = 3 * rounds_percent();
    ReadOptions any;
    any.any_array = true;
    int refused = 0;
    for (const char* name : kFiles) {
        const std::string whole = read_file(kData / name);
        for (int round = 0; round < rounds; ++round) {
            std::string text = whole;
            for (std::uint32_t changes = 1 + random() % 4; changes > 0; --changes)
                text[random() % text.size()] = static_cast<char>(random());
            try {
                const auto file = decode_vti(write(text), any);
                if (file->info().step_bytes() < (1 << 24))
                    all_of(*file);
            } catch (const Error& error) {
                EXPECT_THAT(error.what(), HasSubstr("a.vti: "));
                ++refused;
            }
        }
    }
    EXPECT_GT(refused, rounds);
}

/// Values of a file as it should not be, in numbers of the header's width.
std::string appended(const std::string& packing, bool wide,
                     const std::vector<std::uint64_t>& numbers,
                     const std::string& body = std::string(64, '\1')) {
    std::string text = fmt::format(
        "<VTKFile type='ImageData' byte_order='LittleEndian' header_type='{}'{}><ImageData "
        "WholeExtent='0 3 0 3 0 3'><Piece Extent='0 3 0 3 0 3'><PointData><DataArray type='UInt8' "
        "Name='p' format='appended' offset='0'/></PointData></Piece></ImageData><AppendedData "
        "encoding='raw'>_",
        wide ? "UInt64" : "UInt32",
        packing.empty() ? "" : fmt::format(" compressor='vtk{}DataCompressor'", packing));
    for (const std::uint64_t number : numbers)
        text.append(reinterpret_cast<const char*>(&number), wide ? 8 : 4);
    return text + body + "</AppendedData></VTKFile>";
}

TEST_F(VtiFiles, WhoseNumbersLieCostNoMemoryAndAreRefused) {
    constexpr std::uint64_t kHuge = ~std::uint64_t{0}, kHigh = std::uint64_t{1} << 63;
    EXPECT_EQ(decode_vti(write(appended("", false, {64})), {})->info().array, "p");
    for (const bool wide : {false, true}) {
        for (const std::uint64_t stated : {std::uint64_t{0}, std::uint64_t{63}})
            EXPECT_THAT(error_in(appended("", wide, {stated})), HasSubstr("truncated")) << stated;
        EXPECT_THAT(error_in(appended("", wide, {kHuge}, std::string(60, '\1'))),
                    HasSubstr("truncated"));
        for (const char* packing : {"ZLib", "LZ4", "LZMA"})
            for (const std::uint64_t huge : {kHuge, kHigh, kHuge / 8, std::uint64_t{1} << 31})
                for (const std::vector<std::uint64_t>& numbers :
                     {std::vector<std::uint64_t>{huge, 64, 0, 8},
                      {1, huge, 0, 8},
                      {1, 64, huge, 8},
                      {1, 64, 0, huge},
                      {huge, huge, huge, huge},
                      {2, huge, huge, 8, 8},
                      {0, huge, 0},
                      {1, 0, 0, 8},
                      {1, 64, 65, 8}})
                    EXPECT_THAT(error_in(appended(packing, wide, numbers)),
                                AnyOf(HasSubstr("truncated"), HasSubstr("damaged")))
                        << packing << " " << huge << " " << wide;
    }
    const std::string good = appended("", true, {64});
    const auto with = [&](const std::string& what, const std::string& instead) {
        std::string text = good;
        for (std::size_t at = 0; (at = text.find(what, at)) != text.npos; at += instead.size())
            text.replace(at, what.size(), instead);
        return error_in(text);
    };
    EXPECT_THAT(with("offset='0'", "offset='1000'"), HasSubstr("truncated"));
    for (const char* offset : {"-1", "18446744073709551616", "x", ""})
        EXPECT_THAT(with("offset='0'", fmt::format("offset='{}'", offset)), HasSubstr("offset"));
    for (const char* components : {"0", "-1", "4294967296", "1000000", "x"})
        EXPECT_THAT(with("Name='p'", fmt::format("Name='p' NumberOfComponents='{}'", components)),
                    HasSubstr("NumberOfComponents"));
    EXPECT_THAT(with("0 3 0 3 0 3", "0 2147483647 0 2147483647 0 2147483647"),
                HasSubstr("a.vti: "));
    EXPECT_THAT(with("0 3 0 3 0 3", "-2147483648 2147483647 0 3 0 3"), HasSubstr("a.vti: "));
    EXPECT_THAT(with("Piece Extent='0 3 0 3 0 3'",
                     "Piece Extent='-2147483648 2147483647 -2147483648 2147483647 0 2147483647'"),
                HasSubstr("a piece is larger than the whole extent"));
    EXPECT_THAT(with("UInt64", "UInt16"),
                HasSubstr("header_type UInt16, expected UInt32 or UInt64"));
    EXPECT_THAT(with("LittleEndian", "Middle"), HasSubstr("byte_order Middle, expected"));
    EXPECT_THAT(with(">_", ">"), HasSubstr("do not begin with an underscore"));
    EXPECT_THAT(error_in(appended("Snappy", true, {64})),
                HasSubstr("compressor vtkSnappyDataCompressor, expected vtkZLibDataCompressor"));
}

TEST_F(VtiFiles, PaddedBase64MayEndWithinTheValues) {
    // The header is encoded for itself, as some programs do: `AAAAAA==` beside one stream of both.
    const std::string head =
        "<VTKFile type='ImageData' header_type='UInt32'><ImageData WholeExtent='0 1 0 1 0 "
        "1'><Piece "
        "Extent='0 1 0 1 0 1'><PointData><DataArray type='UInt8' Name='p' format='binary'>";
    const std::string tail = "</DataArray></PointData></Piece></ImageData></VTKFile>";
    for (const char* text :
         {"CAAAAA==AQIDBAUGBwg=", "CAAAAAECAwQFBgcI", " CAAA\nAAEC AwQF\r\nBgcI\n"}) {
        const auto file = decode_vti(write(head + text + tail), {});
        std::vector<std::uint8_t> values(8);
        file->read(0, {0, 2}, std::as_writable_bytes(std::span(values)));
        EXPECT_EQ(values, (std::vector<std::uint8_t>{1, 2, 3, 4, 5, 6, 7, 8})) << text;
    }
    EXPECT_THAT(error_in(head + "CAAAAAECAwQF" + tail), HasSubstr("truncated"));
    EXPECT_THAT(error_in(head + "CAAAAAECAwQF!gcI" + tail), HasSubstr("damaged"));
}

TEST(PvdFiles, ThatAreDamagedAreRefusedInOneLine) {
    const TestFolder folder;
    const auto message = [&](const std::string& text) {
        return error_of([&] { decode_pvd(folder.write("s.pvd", text)); });
    };
    const std::string good = "<VTKFile type='Collection'><Collection><DataSet timestep='1' "
                             "file='a.vti'/></Collection></VTKFile>";
    EXPECT_EQ(decode_pvd(folder.write("s.pvd", good)).front().time, 1);
    for (std::size_t size = 0; size < good.find("</Coll"); ++size)
        EXPECT_THAT(message(good.substr(0, size)), HasSubstr("s.pvd: ")) << size;
    for (const char* time : {"nan", "inf", "1e999", "x", "", "1,5", "1 2"}) {
        std::string text = good;
        text.replace(text.find("'1'"), 3, fmt::format("'{}'", time));
        EXPECT_THAT(message(text), HasSubstr("expected a number")) << time;
    }
}

} // namespace
} // namespace isochron::index
