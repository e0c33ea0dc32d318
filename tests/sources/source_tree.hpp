// The project's own files, for tests that read them.
#pragma once

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

namespace quadrel::source_tests {

struct SourceFile {
    std::string path;  // from the top of the project, with forward slashes
    std::string text;
};

inline std::filesystem::path project() { return QUADREL_SOURCE_DIR; }

/// Every file under the folders whose name ends in one of `endings`, sorted by path.
inline std::vector<SourceFile> project_files(const std::vector<std::string>& folders,
                                             const std::vector<std::string>& endings) {
    std::vector<SourceFile> files;
    for (const std::string& folder : folders) {
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(project() / folder)) {
            const std::string name = entry.path().filename().string();
            if (!entry.is_regular_file() ||
                std::ranges::none_of(endings, [&](const auto& e) { return name.ends_with(e); }))
                continue;
            std::ifstream in(entry.path(), std::ios::binary);
            files.push_back({entry.path().lexically_relative(project()).generic_string(),
                             std::string(std::istreambuf_iterator<char>(in), {})});
        }
    }
    std::ranges::sort(files, {}, &SourceFile::path);
    return files;
}

/// Every .hpp and .cpp under include/ and src/.
inline std::vector<SourceFile> project_sources() {
    return project_files({"include", "src"}, {".hpp", ".cpp"});
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

}  // namespace quadrel::source_tests
