// A directory of image files for a test, removed afterwards.
#pragma once

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "texture/files.hpp"

namespace quadrel::test {

class ImageFolder : public testing::Test {
  protected:
    void SetUp() override {
        std::string name =
            (std::filesystem::temp_directory_path() / "quadrel-images-XXXXXX").string();
        ASSERT_NE(mkdtemp(name.data()), nullptr);
        directory_ = name;
    }
    void TearDown() override { std::filesystem::remove_all(directory_); }

    std::filesystem::path write(const std::string& name, const Bytes& bytes) {
        std::ofstream(directory_ / name, std::ios::binary) << bytes;
        return directory_ / name;
    }

    std::filesystem::path directory_;
};

}  // namespace quadrel::test
