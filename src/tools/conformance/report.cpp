#include "conformance/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <map>
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

std::vector<std::string> complaints(const Report& report, const Bounds& bounds) {
    const std::pair<Verdict, double> most[] = {{Verdict::perturbed, bounds.perturbed},
                                               {Verdict::legal, bounds.legal},
                                               {Verdict::open, bounds.open},
                                               {Verdict::left, bounds.left},
                                               {Verdict::coverage, bounds.coverage},
                                               {Verdict::unordered, bounds.unordered},
                                               {Verdict::defect, bounds.defect},
                                               {Verdict::divergent, bounds.divergent},
                                               {Verdict::unexplained, 0}};
    std::vector<std::string> lines;
    for (const CaseReport& one : report.cases) {
        const std::string name = fmt::format("{} {} {} degrees", one.row, one.map, one.angle);
        if (!one.failure.empty())
            lines.push_back(fmt::format("{}: not drawn: {}", name, one.failure));
        for (const GroupReport& group : one.groups)
            for (const auto& [verdict, bound] : most) {
                const double found = static_cast<double>(count_of(group.counts, verdict));
                if (found > bound * static_cast<double>(total(group.counts)))
                    lines.push_back(
                        fmt::format("{}: found {} {} of {} pixels of {}, expected at most {:.4g} %",
                                    name, count_of(group.counts, verdict),
                                    verdict_names[static_cast<std::size_t>(verdict)],
                                    total(group.counts), group.name, 100 * bound));
            }
    }
    const bool judged = std::ranges::any_of(
        report.cases, [](const CaseReport& one) { return !one.groups.empty(); });
    if (!judged && lines.empty()) lines.emplace_back("no row could be drawn, and nothing judged");
    return lines;
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

namespace {

/// One row of a table in Markdown, shares of the verdicts that are used.
std::string line_of(const std::string& first, const Counts& counts,
                    const std::vector<std::size_t>& used) {
    std::string text = "| " + first + " |";
    for (const std::size_t v : used) text += fmt::format(" {} |", share(counts[v], total(counts)));
    return text + "\n";
}

std::string head_of(const std::string& first, std::size_t columns,
                    const std::vector<std::size_t>& used) {
    std::string text = "| " + first + " |", line = "|";
    for (std::size_t i = 0; i < columns + used.size(); ++i) line += "---|";
    for (const std::size_t v : used) text += fmt::format(" {} |", verdict_names[v]);
    return text + "\n" + line + "\n";
}

/// Channels of one place in the data flow, over all rows.
std::string table_of_groups(const Report& report, const std::vector<std::size_t>& used) {
    std::vector<std::string> names;
    std::map<std::string, Counts> sums;
    for (const CaseReport& one : report.cases)
        for (const GroupReport& group : one.groups) {
            add(sums[group.name], group.counts);
            // In the order of the data flow, of which some rows have less than others.
            if (std::ranges::count(names, group.name) == 0) names.push_back(group.name);
        }
    std::string text = head_of("channels", 1, used);
    for (const std::string& name : names) text += line_of(name, sums.at(name), used);
    return text;
}

}  // namespace

std::string to_markdown(const Report& report) {
    const std::vector<RowSum> rows = sums(report);
    const std::vector<std::size_t> used = used_verdicts(rows);
    std::string text =
        table_of_groups(report, used) + "\n" + head_of("rows | cases | equal bit for bit", 3, used);
    const auto is_equal = [](const RowSum& row) { return row.equal_cases == row.cases; };
    // Rows that are the same all over stand together.
    RowSum equal;
    for (const RowSum& row : rows) {
        if (row.cases == 0 || !is_equal(row)) continue;
        equal.row += (equal.row.empty() ? "`" : " `") + row.row + "`";
        equal.cases += row.cases;
        add(equal.counts, row.counts);
    }
    if (equal.cases > 0)
        text += line_of(fmt::format("{0} | {1} | {1}", equal.row, equal.cases), equal.counts, used);
    for (const RowSum& row : rows)
        if (row.cases != 0 && !is_equal(row))
            text += line_of(fmt::format("`{}` | {} | {}", row.row, row.cases, row.equal_cases),
                            row.counts, used);
    return text;
}

}  // namespace quadrel::conformance
