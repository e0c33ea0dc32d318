// What quadrel-peers was asked for.
#pragma once

#include <string>
#include <vector>

namespace quadrel::peers {

struct Options {
    std::vector<std::string> tables;  ///< by name (tables/tables.hpp); empty: all
    std::vector<std::string> rows;    ///< by name (rows.hpp); empty: all
    std::vector<double> angles;       ///< between view and normal, degrees, 0 to 85
    int size = 1024;                  ///< side of the frame, pixels
    int map = 1024;                   ///< side of the maps, texels, a power of two
    int repeats = 7;                  ///< of which the least is printed
    std::string isa = "auto";
    std::string program;  ///< the quadrel that the tables of processes run
    std::string json;     ///< file to write the tables to, too; empty: none
    bool quick = false;
    bool planted = false;  ///< wrong shaders and geometry, to see that it is noticed
};

/// Reads the command line. Where the program is to end at once, what with is put into `exit_code`,
/// which else stays as it is.
Options read_options(int argc, char** argv, int& exit_code);

/// Whether `name` is in `names`, or these are none.
bool chosen(const std::vector<std::string>& names, const std::string& name);

}  // namespace quadrel::peers
