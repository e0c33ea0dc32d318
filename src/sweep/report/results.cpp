#include "sweep/report/results.hpp"

#include <fmt/format.h>

#include <set>

#include "file/atomic_file.hpp"
#include "file/output_group.hpp"
#include "sweep/report/columns.hpp"
#include "sweep/report/page.hpp"
#include "sweep/report/plots.hpp"
#include "sweep/sweep.hpp"

namespace quadrel::sweep {
namespace {

/// RFC 4180.
std::string csv_field(const Json& value) {
    if (value.is_null()) return "";
    std::string text = value.is_string() ? value.get<std::string>() : value.dump();
    if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
    std::string quoted = "\"";
    for (const char c : text) quoted += c == '"' ? "\"\"" : std::string(1, c);
    return quoted + "\"";
}

std::set<std::string> texture_kinds(const std::vector<Json>& records) {
    std::set<std::string> kinds;
    for (const Json& record : records)
        if (record.contains("look_ups_by_kind"))
            for (const auto& [kind, value] : record["look_ups_by_kind"].items()) kinds.insert(kind);
    return kinds;
}

Json value_of(const Json& record, const std::string& key) {
    const auto found = record.find(key);
    return found == record.end() ? Json() : *found;
}

void write(const std::filesystem::path& file, const std::string& text) {
    AtomicFile out(file);
    out.write(text.data(), text.size());
    out.commit();
}

std::string number_text(const Json& value, const char* format) {
    return value.is_number() ? fmt::format(fmt::runtime(format), value.get<double>()) : "-";
}

std::string table_cell(std::string text) {
    for (std::size_t i = 0; (i = text.find('|', i)) != std::string::npos; i += 2)
        text.replace(i, 1, "\\|");
    return text;
}

}  // namespace

Json results_json(const std::string& title, const std::vector<Json>& records) {
    Json results;
    results["title"] = title;
    results["columns"] = Json::array();
    for (const Column& column : columns())
        results["columns"].push_back(
            Json{{"key", column.key}, {"unit", column.unit}, {"meaning", column.meaning}});
    results["runs"] = Json::array();
    for (Json record : records) {
        record.erase("picture");
        record.erase("error_picture");
        results["runs"].push_back(std::move(record));
    }
    return results;
}

std::string results_csv(const std::vector<Json>& records) {
    const std::set<std::string> kinds = texture_kinds(records);
    std::string text;
    const auto add = [&text](const std::string& field) {
        text += (text.empty() || text.back() == '\n' ? "" : ",") + field;
    };
    for (const Column& column : columns()) add(std::string(column.key));
    for (const std::string& kind : kinds) add("look_ups." + kind);
    text += "\r\n";
    for (const Json& record : records) {
        for (const Column& column : columns())
            add(csv_field(value_of(record, std::string(column.key))));
        const Json by_kind = value_of(record, "look_ups_by_kind");
        for (const std::string& kind : kinds)
            add(by_kind.is_object() ? csv_field(value_of(by_kind, kind)) : "");
        text += "\r\n";
    }
    return text;
}

std::string frames_table(const std::vector<Json>& records) {
    std::string text =
        "| algorithm | map | view | frames/s | published | ms | search ms | look-ups | in lockstep "
        "| "
        "lines | median texels | 99 % | wrong % "
        "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
    for (const Json& record : records) {
        const Json wrong = value_of(record, "wrong");
        text += fmt::format(
            "| {} | {} {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} | {} |\n",
            table_cell(record["algorithm"]), table_cell(record["map"]), record["map_width"].dump(),
            record["view"].get<std::string>(), number_text(value_of(record, "fps"), "{:.3g}"),
            number_text(value_of(record, "published_fps"), "{:.0f}"),
            number_text(value_of(record, "draw_ms"), "{:.3g}"),
            number_text(value_of(record, "trace_ms"), "{:.3g}"),
            number_text(value_of(record, "search_look_ups"), "{:.3g}"),
            number_text(value_of(record, "lockstep_look_ups"), "{:.3g}"),
            number_text(value_of(record, "lines_touched"), "{:.0f}"),
            number_text(value_of(record, "texels_median"), "{:.2g}"),
            number_text(value_of(record, "texels_p99"), "{:.2g}"),
            wrong.is_number() ? fmt::format("{:.2g}", 100 * wrong.get<double>()) : "-");
    }
    std::set<std::string> machines;
    for (const Json& record : records)
        machines.insert(fmt::format("{}, {}, {} thread(s), build {}",
                                    record["machine"].get<std::string>(),
                                    record["isa"].get<std::string>(), record["threads"].dump(),
                                    record["build"].get<std::string>()));
    text += "\n";
    for (const std::string& machine : machines) text += "Measured on " + machine + "\n";
    return text;
}

void write_results(const std::filesystem::path& folder, const std::string& title,
                   const std::vector<Json>& records) {
    make_folder(folder / "plots");
    OutputGroup outputs;
    const Json results = results_json(title, records);
    write(folder / "results.json", results.dump(1) + "\n");
    write(folder / "results.csv", results_csv(records));
    write(folder / "page.html", page_html(results, records));
    for (const Plot& plot : make_plots(records)) write(folder / "plots" / plot.name, plot.svg);
    outputs.commit();
}

}  // namespace quadrel::sweep
