// Man pages, from the tables that the program itself works by.
#pragma once

#include <CLI/App.hpp>
#include <string>
#include <vector>

namespace quadrel::cli {

struct ManualPage {
    std::string name;  ///< "quadrel-render"
    int section = 1;   ///< of the manual: 1 commands, 5 files, 7 everything else
    std::string text;  ///< roff
};

/// Of the program, of each verb, of scene files and of channels.
std::vector<ManualPage> manual_pages(const CLI::App& program);

}  // namespace quadrel::cli
