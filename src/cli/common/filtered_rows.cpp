#include "cli/common/filtered_rows.hpp"

#include "cli/common/quiet.hpp"

namespace quadrel::cli {

ListRows filtered_rows(ListRows rows, const std::vector<std::string>& words) {
    std::erase_if(rows, [&](const ListRow& row) { return !has_all_words(row, words); });
    if (rows.empty()) tell("quadrel: nothing in this list has all of these words");
    return rows;
}

}  // namespace quadrel::cli
