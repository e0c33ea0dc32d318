// A walk over every cell on a ray's way: what searches that leave out cells are held to, and where
// errors are planted.
#pragma once

#include "quadrel/relief/trace/exact/cell_search.hpp"

namespace quadrel::test {

/// Tests the cells of a search one after the other; `after(exit)` runs behind each step.
template <class Search, class After>
void search_every_cell(Search& search, const After& after) {
    for (;;) {
        search.count_step(1, 2);
        if (!any(search.active)) break;
        const auto exit = search.exit(search.cell());
        search.test(search.active, exit);
        search.step(search.active, exit);
        after(exit);
    }
}
template <class Search>
void search_every_cell(Search& search) {
    search_every_cell(search, [](const auto&) {});
}

}  // namespace quadrel::test
