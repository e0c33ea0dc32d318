// Joining the parts of a sweep: their runs, and the maps that their commands name.
#include <fmt/format.h>

#include <system_error>

#include "file/atomic_file.hpp"
#include "file/read_file.hpp"
#include "quadrel/error.hpp"
#include "sweep/record.hpp"
#include "sweep/sweep.hpp"
#include "text/shell_word.hpp"

namespace quadrel::sweep {
namespace {

/// A path as it stands in a command's -D, which is JSON in a word of a shell.
std::string in_command(const std::filesystem::path& path) {
    const std::string word = shell_word(Json(path.string()).dump());
    const std::size_t quotes = word.find('"') + 1;
    return word.substr(quotes, word.rfind('"') - quotes);
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
    for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size())
        text.replace(at, from.size(), to);
}

/// The record of a part as one of the whole, whose maps lie in `maps`.
Json moved(Json record, const std::filesystem::path& maps) {
    const auto own = record.find("maps");
    const auto command = record.find("command");
    if (own == record.end() || !own->is_string() || own->get<std::string>().empty() ||
        command == record.end() || !command->is_string())
        return record;
    std::string line = command->get<std::string>();
    replace_all(line, in_command(own->get<std::string>()) + "/", in_command(maps) + "/");
    *command = line;
    *own = maps.string();
    return record;
}

void copy_maps(const std::filesystem::path& from, const std::filesystem::path& to) {
    std::error_code error;
    for (std::filesystem::directory_iterator i(from, error), end; !error && i != end;
         i.increment(error)) {
        const std::filesystem::path target = to / i->path().filename();
        if (i->path().extension() != ".exr" || std::filesystem::exists(target)) continue;
        make_folder(to);
        const std::string bytes = read_whole_file(i->path());
        AtomicFile file(target);
        file.write(bytes.data(), bytes.size());
        file.commit();
    }
}

void refuse_empty(const std::filesystem::path& folder) {
    if (read_records(folder / "runs").empty())
        throw InputError((folder / "runs").string(), "", "no runs", "those of a sweep");
}

}  // namespace

std::vector<Json> merge_sweeps(const std::vector<std::filesystem::path>& folders,
                               const std::filesystem::path& output) {
    for (const std::filesystem::path& folder : folders) refuse_empty(folder);
    make_folder(output / "runs");
    const std::filesystem::path maps = std::filesystem::absolute(output / "maps");
    for (const std::filesystem::path& folder : folders) {
        copy_maps(folder / "maps", maps);
        for (const Json& record : read_records(folder / "runs")) {
            const auto known = read_record(output / "runs", record["key"]);
            // A failed one gives way to one that was measured.
            if (!known || (known->contains("failed") && !record.contains("failed")))
                write_record(output / "runs", moved(record, maps));
        }
    }
    return read_records(output / "runs");
}

}  // namespace quadrel::sweep
