// What a record's keys mean: the columns of the CSV and of the page's table.
#pragma once

#include <span>
#include <string_view>

namespace quadrel::sweep {

struct Column {
    std::string_view key, unit, meaning;
};

/// In the order of the CSV.
std::span<const Column> columns();

}  // namespace quadrel::sweep
