// The file that a build writes, and its commit.
#include "index/indexing/build_target.h"

#include "index/error.h"

#include <string>

namespace isochron::index {

NewTarget::NewTarget(Team& team, const std::filesystem::path& target) : team_(team) {
    std::string temporary;
    team.together([&] {
        if (team.rank() == 0) {
            file_.emplace(target,
                          team.size() > 1 ? NewFile::Writers::several : NewFile::Writers::one);
            temporary = file_->temporary().string();
        }
    });
    const auto names = team.gather(std::as_bytes(std::span(temporary)));
    team.together([&] {
        if (team.rank() > 0)
            file_.emplace(target,
                          std::filesystem::path(std::string(
                              reinterpret_cast<const char*>(names[0].data()), names[0].size())));
    });
}

void NewTarget::commit(const FileHeader& header, const std::function<void()>& look) {
    team_.together([&] {
        if (team_.rank() == 0)
            file_->write_at(slot_of(header), header_bytes(header));
        else
            file_->commit();
    });
    team_.together([&] {
        if (team_.rank() > 0)
            return;
        look();
        file_->commit();
    });
}

GrowingTarget::GrowingTarget(Team& team, GrowingSink& file, const FileHeader& held)
    : team_(team), file_(file), held_bytes_(held.file_bytes) {
    team.together([&] {
        if (team.rank() == 0)
            file.cut(held_bytes_); // cuts off what a killed append has left
    });
}

GrowingTarget::~GrowingTarget() {
    if (team_.rank() > 0 || may_count_)
        return;
    try {
        file_.cut(held_bytes_);
    } catch (const Error&) { // what is left there is harmless
    }
}

void GrowingTarget::commit(const FileHeader& header, const std::function<void()>& look) {
    team_.together([&] { file_.flush(); });
    team_.together([&] {
        if (team_.rank() > 0)
            return;
        may_count_ = true;
        file_.write_at(slot_of(header), header_bytes(header));
        file_.flush();
        look();
    });
}

} // namespace isochron::index
