// Tables, as Markdown for people and as JSON.
#pragma once

#include <string>
#include <vector>

namespace quadrel::peers {

/// A cell: words, or numbers that are printed one after the other with " / " between.
struct Cell {
    std::string text;
    std::vector<double> numbers;
    int digits = 0;  ///< behind the decimal point

    Cell(const char* words) : text(words) {}
    Cell(std::string words) : text(std::move(words)) {}
    Cell(std::vector<double> values, int places) : numbers(std::move(values)), digits(places) {}
    Cell(double value, int places) : numbers{value}, digits(places) {}
};

struct Table {
    std::string name;   ///< on the command line
    std::string title;  ///< a sentence: what is measured, and in which unit
    std::vector<std::string> columns;
    std::vector<std::vector<Cell>> rows;
};

/// a[i] / b[i]; as many as the shorter has.
std::vector<double> ratios(const std::vector<double>& a, const std::vector<double>& b);

std::string markdown(const Table& table);
/// A list of objects with name, title, columns and rows; NaN is null.
std::string json(const std::vector<Table>& tables);

}  // namespace quadrel::peers
