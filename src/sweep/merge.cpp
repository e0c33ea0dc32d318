// Joining the parts of a sweep: their runs, and the maps that their commands name.
#include <fmt/format.h>

#include <algorithm>
#include <map>
#include <set>
#include <system_error>

#include "file/atomic_file.hpp"
#include "file/read_file.hpp"
#include "quadrel/error.hpp"
#include "sweep/part.hpp"
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

/// A folder of a sweep; its records.
std::vector<Json> records_of(const std::filesystem::path& folder) {
    std::error_code error;
    // A task may have failed before its first run, and where there are more parts than runs have
    // none.
    if (read_part(folder) && !std::filesystem::exists(folder / "runs", error)) return {};
    std::vector<Json> records = read_records(folder / "runs");
    if (records.empty() && !read_part(folder))
        throw InputError((folder / "runs").string(), "", "no runs", "those of a sweep");
    return records;
}

/// A plan of which folders are parts, and the places of the runs that there are.
struct AskedPlan {
    Part part;
    std::set<std::size_t> orders;
};

void add_orders(std::map<std::string, AskedPlan>& plans, const std::vector<Json>& records) {
    for (const Json& record : records) {
        const auto id = record.find("plan_id");
        if (id == record.end() || !id->is_string()) continue;
        const auto plan = plans.find(id->get<std::string>());
        if (plan != plans.end()) plan->second.orders.insert(record["order"].get<std::size_t>());
    }
}

std::map<std::string, AskedPlan> asked_plans(const std::vector<std::filesystem::path>& folders) {
    std::map<std::string, AskedPlan> plans;
    for (const std::filesystem::path& folder : folders)
        if (const auto part = read_part(folder)) {
            AskedPlan& plan = plans.try_emplace(part->plan_id, AskedPlan{*part, {}}).first->second;
            if (plan.part.of != part->of) plan.part.of = 0;
        }
    return plans;
}

std::string lacking_of(const std::map<std::string, AskedPlan>& plans) {
    std::string text;
    for (const auto& [id, plan] : plans)
        if (const std::string lacking = lacking_runs(plan.part, plan.orders); !lacking.empty())
            text += (text.empty() ? "" : ", ") + lacking;
    return text;
}

}  // namespace

MergedSweeps merge_sweeps(const std::vector<std::filesystem::path>& folders,
                          const std::filesystem::path& output, bool partial) {
    std::map<std::string, AskedPlan> plans = asked_plans(folders);
    std::vector<std::vector<Json>> parts;
    for (const std::filesystem::path& folder : folders) {
        parts.push_back(records_of(folder));
        add_orders(plans, parts.back());
    }
    // What was joined before counts.
    std::error_code error;
    if (std::filesystem::exists(output / "runs", error))
        add_orders(plans, read_records(output / "runs"));
    MergedSweeps merged{{}, lacking_of(plans)};
    if (!merged.lacking.empty() && !partial)
        throw InputError("--merge", "", merged.lacking,
                         "all of them, or --partial to join what is there");
    if (std::ranges::all_of(parts, [](const auto& records) { return records.empty(); }))
        throw InputError((folders.front() / "runs").string(), "", "no runs", "those of a sweep");
    make_folder(output / "runs");
    const std::filesystem::path maps = std::filesystem::absolute(output / "maps");
    for (std::size_t i = 0; i < folders.size(); ++i) {
        copy_maps(folders[i] / "maps", maps);
        for (const Json& record : parts[i]) {
            const auto known = read_record(output / "runs", record["key"]);
            // A failed one gives way to one that was measured.
            if (!known || (known->contains("failed") && !record.contains("failed")))
                write_record(output / "runs", moved(record, maps));
        }
    }
    if (plans.size() == 1) write_part(output, plans.begin()->second.part);
    merged.records = read_records(output / "runs");
    return merged;
}

}  // namespace quadrel::sweep
