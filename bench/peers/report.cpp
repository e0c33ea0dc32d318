#include "report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <nlohmann/json.hpp>

namespace quadrel::peers {
namespace {

std::string printed(const Cell& cell) {
    std::vector<std::string> words;
    for (const double number : cell.numbers)
        words.push_back(number != number ? "-" : fmt::format("{:.{}f}", number, cell.digits));
    return cell.numbers.empty() ? cell.text : fmt::format("{}", fmt::join(words, " / "));
}

nlohmann::json value_of(const Cell& cell) {
    if (cell.numbers.empty()) return cell.text;
    return cell.numbers.size() == 1 ? nlohmann::json(cell.numbers[0])
                                    : nlohmann::json(cell.numbers);
}

}  // namespace

std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b) {
    std::vector<double> all;
    for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) all.push_back(a[i] / b[i]);
    return all;
}

std::string markdown(const Table& table) {
    std::string text = fmt::format("### {}\n\n{}\n\n| {} |\n|", table.name, table.title,
                                   fmt::join(table.columns, " | "));
    for (std::size_t i = 0; i < table.columns.size(); ++i) text += "---|";
    text += "\n";
    for (const auto& row : table.rows) {
        text += "|";
        for (const Cell& cell : row) text += " " + printed(cell) + " |";
        text += "\n";
    }
    return text;
}

std::string json(const std::vector<Table>& tables) {
    nlohmann::json all = nlohmann::json::array();
    for (const Table& table : tables) {
        nlohmann::json rows = nlohmann::json::array();
        for (const auto& row : table.rows) {
            nlohmann::json cells = nlohmann::json::array();
            for (const Cell& cell : row) cells.push_back(value_of(cell));
            rows.push_back(cells);
        }
        all.push_back({{"name", table.name},
                       {"title", table.title},
                       {"columns", table.columns},
                       {"rows", rows}});
    }
    return all.dump(1) + "\n";
}

}  // namespace quadrel::peers
