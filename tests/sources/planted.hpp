// Defects that the tests of this room must catch; each is planted in a test of its own.
#pragma once

namespace quadrel::source_tests {

enum class Planted {
    simd_header_elsewhere,
    upward_include,
    path_to_nowhere,     // a text names a file that is not there
    crowded_folder,      // a folder with more files than one reads through
    lonely_file,         // a folder of its own for one file
    loop_without_words,  // a text's loop that a number type cannot follow
};

}  // namespace quadrel::source_tests
