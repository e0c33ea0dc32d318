// What may stand next on a command line that is being typed, from the tables that check it.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace quadrel::cli {

struct Candidate {
    std::string word;  ///< the whole word, also where only its end is missing
    std::string meaning{};
};

/// How a word may go on.
struct Candidates {
    std::vector<Candidate> words;
    bool files = false;              ///< names of files and folders, too
    std::vector<std::string> kinds;  ///< how files end (".exr"); empty: any way

    void add(std::string word, std::string_view meaning = "") {
        words.push_back({std::move(word), std::string(meaning)});
    }
    void add_files(std::vector<std::string> endings = {}) {
        files = true;
        kinds = std::move(endings);
    }
};

/// The words after the program's name up to the one that is being typed, which is the last and may
/// be empty. What can be read of a scene that they name decides over keys and parameters; mistakes
/// among them are no errors.
Candidates complete(const std::vector<std::string>& words);

}  // namespace quadrel::cli
