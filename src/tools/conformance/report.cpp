#include "conformance/report.hpp"

#include <fmt/format.h>

#include <bit>
#include <map>
#include <nlohmann/json.hpp>
#include <set>

namespace quadrel::conformance {
namespace {

/// What a row's cases come to.
struct RowSum {
    std::string row;
    std::size_t cases = 0, equal_cases = 0;
    Counts counts{};
    std::map<std::string, Counts> groups;
    std::set<std::string> refusals, notes;
};

std::vector<RowSum> sums(const Report& report) {
    std::vector<RowSum> rows;
    for (const CaseReport& one : report.cases) {
        if (rows.empty() || rows.back().row != one.row)
            rows.push_back({one.row, 0, 0, {}, {}, {}, {}});
        RowSum& row = rows.back();
        if (!one.refusal.empty() || !one.failure.empty()) {
            row.refusals.insert(one.refusal + one.failure);
            continue;
        }
        const Counts counts = one.counts();
        ++row.cases;
        row.equal_cases += count_of(counts, Verdict::same) == total(counts);
        add(row.counts, counts);
        for (const GroupReport& group : one.groups) {
            add(row.groups[group.name], group.counts);
            if (!group.note.empty()) row.notes.insert(group.note);
        }
    }
    return rows;
}

/// "12.34 %": shares that are above 0 are never written as if they were not.
std::string share(std::uint64_t count, std::uint64_t of) {
    if (count == 0 || of == 0) return "-";
    const double percent = 100 * static_cast<double>(count) / static_cast<double>(of);
    if (count == of) return "100 %";
    return percent < 0.001    ? "<0.001 %"
           : percent > 99.999 ? ">99.999 %"
                              : fmt::format("{:.3f} %", percent);
}

std::string value_text(const std::string& channel, std::uint32_t bits) {
    const bool whole = channel.ends_with("steps") || channel.ends_with("fetches") ||
                       channel.ends_with("status") || channel.ends_with("flags");
    return whole ? fmt::format("{}", bits)
                 : fmt::format("{:.9g} ({:#010x})", std::bit_cast<float>(bits), bits);
}

std::string unexplained_text(const CaseReport& one) {
    std::string text;
    for (const GroupReport& group : one.groups)
        for (const Unexplained& pixel : group.examples)
            text += fmt::format("  {} {} {} degrees: {} at {},{}: found {}, reference {}\n    {}\n",
                                one.row, one.map, one.angle, pixel.channel, pixel.x, pixel.y,
                                value_text(pixel.channel, pixel.found),
                                value_text(pixel.channel, pixel.reference), pixel.command);
    return text;
}

/// Verdicts that any case has, in their order.
std::vector<std::size_t> used_verdicts(const std::vector<RowSum>& rows) {
    std::vector<std::size_t> used;
    for (std::size_t v = 0; v < verdict_count; ++v) {
        std::uint64_t sum = 0;
        for (const RowSum& row : rows) sum += row.counts[v];
        if (sum > 0 || v == static_cast<std::size_t>(Verdict::unexplained)) used.push_back(v);
    }
    return used;
}

}  // namespace

bool conforms(const Report& report, const Bounds& bounds) {
    const std::pair<Verdict, double> most[] = {{Verdict::perturbed, bounds.perturbed},
                                               {Verdict::legal, bounds.legal},
                                               {Verdict::open, bounds.open},
                                               {Verdict::left, bounds.left},
                                               {Verdict::coverage, bounds.coverage},
                                               {Verdict::unordered, bounds.unordered},
                                               {Verdict::defect, bounds.defect},
                                               {Verdict::divergent, bounds.divergent},
                                               {Verdict::unexplained, 0}};
    for (const CaseReport& one : report.cases) {
        if (!one.failure.empty()) return false;
        for (const GroupReport& group : one.groups)
            for (const auto& [verdict, bound] : most)
                if (static_cast<double>(count_of(group.counts, verdict)) >
                    bound * static_cast<double>(total(group.counts)))
                    return false;
    }
    return true;
}

std::string to_text(const Report& report) {
    const std::vector<RowSum> rows = sums(report);
    const std::vector<std::size_t> used = used_verdicts(rows);
    std::string text =
        fmt::format("{}\n{}, hardware {}, limits {}\n\n{:<36} {:>12}", report.renderer,
                    report.version, report.hardware, report.limits, "row", "equal cases");
    for (const std::size_t v : used) text += fmt::format(" {:>11}", verdict_names[v]);
    text += "\n";
    for (const RowSum& row : rows) {
        for (const std::string& refusal : row.refusals)
            text += fmt::format("{:<36} not drawn: {}\n", row.row, refusal);
        if (row.cases == 0) continue;
        text +=
            fmt::format("{:<36} {:>12}", row.row, fmt::format("{}/{}", row.equal_cases, row.cases));
        for (const std::size_t v : used)
            text += fmt::format(" {:>11}", share(row.counts[v], total(row.counts)));
        text += "\n";
        for (const auto& [name, counts] : row.groups) {
            if (count_of(counts, Verdict::same) == total(counts)) continue;
            text += fmt::format("    {:<32} {:>12}", name, "");
            for (const std::size_t v : used)
                text += fmt::format(" {:>11}", share(counts[v], total(counts)));
            text += "\n";
        }
        for (const std::string& note : row.notes) text += "    " + note + "\n";
    }
    std::string unexplained;
    for (const CaseReport& one : report.cases) unexplained += unexplained_text(one);
    return unexplained.empty() ? text : text + "\nunexplained:\n" + unexplained;
}

std::string to_markdown(const Report& report) {
    const std::vector<RowSum> rows = sums(report);
    const std::vector<std::size_t> used = used_verdicts(rows);
    std::string text = "| rows | cases | equal bit for bit |", line = "|---|---|---|";
    for (const std::size_t v : used) {
        text += fmt::format(" {} |", verdict_names[v]);
        line += "---|";
    }
    text += "\n" + line + "\n";
    // Rows that are the same all over stand together.
    std::string equal;
    std::size_t equal_cases = 0;
    for (const RowSum& row : rows) {
        if (row.cases == 0 || row.equal_cases != row.cases) continue;
        equal += (equal.empty() ? "`" : " `") + row.row + "`";
        equal_cases += row.cases;
    }
    const auto append = [&](const std::string& names, std::size_t cases, std::size_t same,
                            const Counts& counts) {
        text += fmt::format("| {} | {} | {} |", names, cases, same);
        for (const std::size_t v : used)
            text += fmt::format(" {} |", share(counts[v], total(counts)));
        text += "\n";
    };
    Counts all_same{};
    for (const RowSum& row : rows)
        if (row.cases != 0 && row.equal_cases == row.cases) add(all_same, row.counts);
    if (!equal.empty()) append(equal, equal_cases, equal_cases, all_same);
    for (const RowSum& row : rows)
        if (row.cases != 0 && row.equal_cases != row.cases)
            append("`" + row.row + "`", row.cases, row.equal_cases, row.counts);
    return text;
}

nlohmann::ordered_json to_json(const Report& report) {
    nlohmann::ordered_json json{{"renderer", report.renderer},
                                {"version", report.version},
                                {"hardware", report.hardware},
                                {"limits", report.limits},
                                {"cases", nlohmann::ordered_json::array()}};
    for (const CaseReport& one : report.cases) {
        nlohmann::ordered_json entry{{"row", one.row}, {"map", one.map}, {"angle", one.angle}};
        if (!one.refusal.empty()) entry["refusal"] = one.refusal;
        if (!one.failure.empty()) entry["failure"] = one.failure;
        for (const GroupReport& group : one.groups) {
            nlohmann::ordered_json& counts = entry["groups"][group.name];
            for (std::size_t v = 0; v < verdict_count; ++v)
                if (group.counts[v] != 0) counts[verdict_names[v]] = group.counts[v];
            for (const Unexplained& pixel : group.examples)
                counts["examples"].push_back(
                    {{"channel", pixel.channel},
                     {"pixel", {pixel.x, pixel.y}},
                     {"reference", fmt::format("{:#010x}", pixel.reference)},
                     {"found", fmt::format("{:#010x}", pixel.found)},
                     {"command", pixel.command}});
            if (!group.note.empty()) counts["note"] = group.note;
        }
        json["cases"].push_back(std::move(entry));
    }
    return json;
}

}  // namespace quadrel::conformance
