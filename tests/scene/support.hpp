// Files and errors for the scene tests.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <string>

#include "quadrel/error.hpp"

namespace quadrel {

/// A folder of its own for each test, gone afterwards.
class TemporaryFolder {
  public:
    TemporaryFolder() {
        const auto* test = testing::UnitTest::GetInstance()->current_test_info();
        path_ =
            std::filesystem::temp_directory_path() / ("quadrel-" + std::to_string(getpid()) + "-" +
                                                      test->test_suite_name() + "-" + test->name());
        std::filesystem::create_directories(path_);
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path_, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    std::filesystem::path write(const std::string& name, const std::string& bytes) const {
        std::ofstream(path_ / name, std::ios::binary) << bytes;
        return path_ / name;
    }
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// What an InputError should say; empty parts are not looked at.
struct Complaint {
    std::string key, found, expected;
    int line = 0;
};

/// Whether `action` throws an InputError about the named key, whose texts contain the given ones.
template <class Action>
testing::AssertionResult complains(const Action& action, const Complaint& complaint) {
    try {
        action();
    } catch (const InputError& error) {
        const bool as_expected =
            error.key == complaint.key && error.found.find(complaint.found) != std::string::npos &&
            error.expected.find(complaint.expected) != std::string::npos &&
            (complaint.line == 0 || error.line == complaint.line) && !error.file.empty();
        if (as_expected) return testing::AssertionSuccess();
        return testing::AssertionFailure() << "another complaint: " << error.what();
    }
    return testing::AssertionFailure() << "no complaint about " << complaint.key;
}

}  // namespace quadrel
