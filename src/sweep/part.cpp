#include "sweep/part.hpp"

#include <fmt/format.h>

#include <cstdint>

#include "file/atomic_file.hpp"
#include "file/read_file.hpp"
#include "io/document/json.hpp"
#include "text/hash.hpp"

namespace quadrel::sweep {
namespace {

constexpr const char* part_file = "part.json";
constexpr std::size_t most_parts_named = 8;
constexpr std::uint64_t most_parts = 1u << 24;

/// "--task 3/3 lacks 4, 2/3 lacks 1".
std::string lacking_parts(const std::vector<std::size_t>& lacking) {
    std::string text;
    std::size_t named = 0, more = 0;
    for (std::size_t i = 0; i < lacking.size(); ++i) {
        if (lacking[i] == 0) continue;
        if (++named > most_parts_named) {
            ++more;
            continue;
        }
        text += fmt::format("{}{}/{} lacks {}", text.empty() ? "--task " : ", ", i + 1,
                            lacking.size(), lacking[i]);
    }
    return more == 0 ? text : fmt::format("{}, and {} more parts", text, more);
}

}  // namespace

std::string plan_id(const std::vector<std::string>& names) {
    return sha256_hex(Json(names).dump()).substr(0, 16);
}

void write_part(const std::filesystem::path& folder, const Part& part) {
    const Json json{
        {"plan", part.title}, {"plan_id", part.plan_id}, {"runs", part.runs}, {"parts", part.of}};
    const std::string text = json.dump(1, ' ', false, Json::error_handler_t::replace) + "\n";
    AtomicFile file(folder / part_file);
    file.write(text.data(), text.size());
    file.commit();
}

std::optional<Part> read_part(const std::filesystem::path& folder) {
    const std::filesystem::path file = folder / part_file;
    std::error_code error;
    if (!std::filesystem::is_regular_file(file, error)) return std::nullopt;
    const Json json = Json::parse(read_whole_file(file), nullptr, false);
    const auto is = [&](const char* key, Json::value_t type) {
        return json.is_object() && json.contains(key) && json[key].type() == type;
    };
    if (!is("plan", Json::value_t::string) || !is("plan_id", Json::value_t::string) ||
        !is("runs", Json::value_t::number_unsigned) || !is("parts", Json::value_t::number_unsigned))
        return std::nullopt;
    if (json["parts"].get<std::uint64_t>() > most_parts) return std::nullopt;
    return Part{json["plan"].get<std::string>(), json["plan_id"].get<std::string>(),
                json["runs"].get<std::size_t>(), json["parts"].get<int>()};
}

std::string lacking_runs(const Part& part, const std::set<std::size_t>& orders) {
    std::size_t found = 0;
    std::vector<std::size_t> lacking(static_cast<std::size_t>(part.of), 0);
    for (std::size_t order = 0; order < part.runs; ++order) {
        if (orders.contains(order))
            ++found;
        else if (!lacking.empty())
            ++lacking[order % lacking.size()];
    }
    if (found == part.runs) return "";
    const std::string parts = part.of > 1 ? " (" + lacking_parts(lacking) + ")" : "";
    return fmt::format("{} of the {} runs of plan \"{}\"{}", found, part.runs, part.title, parts);
}

}  // namespace quadrel::sweep
