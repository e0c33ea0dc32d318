// The project's own sources, for tests that read them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace quadrel::num_tests {

struct SourceFile {
    std::string path;  // from the top of the project, with forward slashes
    std::string text;
};

/// Every .hpp and .cpp under include/ and src/, sorted by path.
inline std::vector<SourceFile> project_sources() {
    const std::filesystem::path top(QUADREL_SOURCE_DIR);
    std::vector<SourceFile> files;
    for (const char* folder : {"include", "src"}) {
        for (const auto& entry : std::filesystem::recursive_directory_iterator(top / folder)) {
            const std::string extension = entry.path().extension().string();
            if (extension != ".hpp" && extension != ".cpp") continue;
            std::ifstream in(entry.path(), std::ios::binary);
            files.push_back({entry.path().lexically_relative(top).generic_string(),
                             std::string(std::istreambuf_iterator<char>(in), {})});
        }
    }
    std::sort(files.begin(), files.end(),
              [](const SourceFile& a, const SourceFile& b) { return a.path < b.path; });
    return files;
}

/// The text with // comments removed, so that prose may name what code may not.
inline std::string without_comments(const std::string& text) {
    std::string code;
    for (std::size_t i = 0; i < text.size();) {
        if (text.compare(i, 2, "//") == 0) {
            i = std::min(text.find('\n', i), text.size());
        } else {
            code += text[i++];
        }
    }
    return code;
}

}  // namespace quadrel::num_tests
