// Tells formats by names and first bytes.
#include "index/readers/formats/format.h"

#include "index/error.h"
#include "index/lower_case.h"
#include "index/system/input_file.h"
#include "index/system/whole_path.h"

#include <algorithm>
#include <cassert>
#include <span>

namespace isochron::index {
namespace {

namespace fs = std::filesystem;

/// The end of a name that tells a format; null: none of its ends does.
const NameEnd* end_in(const Format& format, const std::string& name, FileStart& start) {
    const auto end = std::ranges::find_if(format.ends, [&](const NameEnd& each) {
        return name.ends_with(each.end) && (!each.only_if || each.only_if(start));
    });
    return end == format.ends.end() ? nullptr : &*end;
}

void recognize(KnownFile& file) {
    const std::string name = lower_case(file.path.filename().string());
    FileStart start(file.path);
    for (const Format& format : all_formats())
        if (const NameEnd* end = end_in(format, name, start)) {
            file.format = &format;
            file.end = end;
            break;
        }
    if (file.format && (file.format->headerless || begins_as(*file.format, start)))
        return;
    if (const Format* told = told_by_content(start)) {
        file.format = told;
        file.end = nullptr;
    }
}

/// The file that describes a folder; without a format if none does.
KnownFile description_in(const fs::path& folder) {
    std::error_code ignored;
    for (const Format& format : all_formats())
        for (const std::string_view name : format.describe_folder) {
            KnownFile file{.given = folder, .path = folder / name, .is_folder = true};
            if (!fs::is_regular_file(file.path, ignored))
                continue;
            recognize(file);
            if (file.format == &format)
                return file;
        }
    return {.given = folder, .path = folder, .is_folder = true};
}

} // namespace

std::string_view FileStart::bytes(std::size_t count) {
    if (count > asked_) {
        asked_ = std::max(count, FilesSeen::kHead);
        bytes_.resize(asked_);
        try {
            const InputFile file(path_);
            bytes_.resize(file.read(0, std::as_writable_bytes(std::span(bytes_))));
        } catch (const Error&) {
            bytes_.clear();
        }
    }
    return std::string_view(bytes_).substr(0, count);
}

const Format& format_named(std::string_view name) {
    const auto format = std::ranges::find(all_formats(), name, &Format::name);
    assert(format != all_formats().end());
    return *format;
}

KnownFile known_file(const fs::path& given) {
    std::error_code ignored;
    return known_file(given, fs::is_directory(given, ignored));
}

KnownFile known_file(const fs::path& given, bool is_folder) {
    if (is_folder)
        return description_in(given);
    KnownFile file{.given = given, .path = given};
    recognize(file);
    return file;
}

fs::path described_folder(const fs::path& file) {
    const fs::path whole = whole_path(file);
    const auto is_described = [](const fs::path& folder) {
        return known_file(folder).path != folder;
    };
    const std::string name = lower_case(whole.filename().string());
    for (const Format& format : all_formats()) {
        for (const NameEnd& end : format.ends)
            if (end.with_folder && name.ends_with(end.end))
                return whole.parent_path();
        for (const fs::path within : format.describe_folder) {
            fs::path folder = whole;
            for (auto part = within.end(); part != within.begin() && !folder.empty();)
                folder = folder.filename() == *--part ? folder.parent_path() : fs::path();
            if (folder.empty() || !is_described(folder))
                continue;
            while (folder.has_relative_path() && is_described(folder.parent_path()))
                folder = folder.parent_path(); // a group around it
            return folder;
        }
    }
    return {};
}

bool begins_as(const Format& format, FileStart& start) {
    const auto decide = format.may_begin ? format.may_begin : format.recognize;
    return decide && decide(start);
}

const Format* told_by_content(FileStart& start) {
    const auto told = std::ranges::find_if(all_formats(), [&](const Format& format) {
        return format.recognize && format.recognize(start);
    });
    return told == all_formats().end() ? nullptr : &*told;
}

bool is_of_format(const Format& format, const KnownFile& file) {
    if (file.format == &format)
        return true;
    if (!format.recognize || (file.format && !(file.format->join && format.join)))
        return false; // told already
    FileStart start(file.path);
    return format.recognize(start);
}

bool has_known_end(const std::string& name, bool folder) {
    const std::string lower = lower_case(name);
    return std::ranges::any_of(all_formats(), [&](const Format& format) {
        const auto has = [&](std::string_view end) {
            return (folder ? name : lower).ends_with(end);
        };
        return folder ? std::ranges::any_of(format.folder_ends, has)
                      : std::ranges::any_of(format.ends, has, &NameEnd::end);
    });
}

std::string known_extensions() {
    std::string known;
    for (const Format& format : all_formats())
        for (const NameEnd& each : format.ends) {
            known += known.empty() ? "" : " ";
            known += each.end;
        }
    return known;
}

} // namespace isochron::index
