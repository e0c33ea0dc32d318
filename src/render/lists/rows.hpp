// What there is to choose from, for people and as JSON: rows of `quadrel list`.
#pragma once

#include <string>
#include <vector>

#include "io/document/json.hpp"

namespace quadrel {

/// One thing of a list.
struct ListRow {
    std::string words;  ///< what a filter looks into
    std::string text;   ///< for people, lines
    Json json;
};
using ListRows = std::vector<ListRow>;

/// Every stage with its parameters, in the order of all_stages().
ListRows algorithm_rows();
/// Everything that an image can hold.
ListRows channel_rows();
/// The installed scenes and what they show. Throws InputError for one that cannot be read.
ListRows scene_rows();
/// What engines ship, as choices of stages.
ListRows preset_rows();

/// Whether the row has every word of the filter, in any case.
bool has_all_words(const ListRow& row, const std::vector<std::string>& filter);

/// An array with an object a row.
std::string rows_json(const ListRows& rows);

}  // namespace quadrel
