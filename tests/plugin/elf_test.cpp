// A plugin whose headers are damaged, or that is cut off, is refused before the loader believes it.
#include "render/registry/elf_check.hpp"

#include <dlfcn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <fstream>
#include <functional>

#include "effort.hpp"
#include "plugin/support.hpp"

namespace quadrel::plugin_tests {
namespace {

using Check = std::function<bool(const std::string& bytes)>;

std::string bytes_of(const std::filesystem::path& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), {}};
}

/// Whether the loader survives these bytes, whatever it says.
bool loader_survives(const std::filesystem::path& file, const std::string& bytes) {
    std::ofstream(file, std::ios::binary) << bytes;
    const pid_t child = fork();
    if (child == 0) {
        for (const int signal : {SIGSEGV, SIGBUS, SIGABRT, SIGFPE, SIGILL})
            std::signal(signal, SIG_DFL);
        dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
        _exit(0);
    }
    int status = 0;
    waitpid(child, &status, 0);
    std::filesystem::remove(file);
    return WIFEXITED(status);
}

/// Every byte of the headers damaged, and the file cut off at many lengths.
std::vector<std::string> damaged(const std::string& whole) {
    std::vector<std::string> all;
    // The ELF header, and as many program headers as its byte 56 says.
    const std::size_t headers = 64 + 56 * static_cast<unsigned char>(whole.at(56));
    for (std::size_t i = 0; i < headers && i < whole.size(); ++i) {
        for (const int flip : {1 << i % 8, 0xff}) {
            all.push_back(whole);
            all.back()[i] = static_cast<char>(all.back()[i] ^ flip);
        }
    }
    for (int part = 0; part < 64; ++part) all.push_back(whole.substr(0, whole.size() * part / 64));
    return all;
}

/// What the check passes, the loader survives; and whole plugins pass.
testing::AssertionResult protects(const Check& sound) {
    const testing_films::TemporaryFolder folder;
    for (const char* name : {"quadrel-test-clash", "quadrel-test-stages"})
        if (!sound(bytes_of(plugin(name))))
            return testing::AssertionFailure() << name << " refused";
    int index = 0;
    for (const std::string& bytes : damaged(bytes_of(plugin("quadrel-test-clash")))) {
        if (sound(bytes) && !loader_survives(folder / "damaged.so", bytes))
            return testing::AssertionFailure() << "damage " << index;
        ++index;
    }
    return testing::AssertionSuccess();
}

TEST(ElfCheck, TheLoaderSurvivesWhatPasses) {
    if (test::sanitized) GTEST_SKIP() << "the sanitizers take the signals";
    EXPECT_TRUE(protects([](const std::string& bytes) { return !elf_fault(bytes); }));
    EXPECT_FALSE(protects([](const std::string& bytes) {
        return bytes.starts_with(
            "\x7f"
            "ELF");
    }));
    EXPECT_FALSE(protects([](const std::string&) { return false; }));
}

}  // namespace
}  // namespace quadrel::plugin_tests
