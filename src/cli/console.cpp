#include "cli/console.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <set>

#include "quadrel/error.hpp"

namespace quadrel::cli {
namespace {

[[noreturn]] void fail() { throw OutputError("standard output", std::strerror(errno)); }

bool plain_terminal() {
    const char* no_color = std::getenv("NO_COLOR");
    const char* kind = std::getenv("TERM");
    return (no_color != nullptr && *no_color != '\0') ||
           (kind != nullptr && std::strcmp(kind, "dumb") == 0);
}

}  // namespace

void print(std::string_view text) {
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail();
}

void flush_output() {
    std::cout.flush();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0) fail();
}

void say_notes(const std::vector<std::string>& notes) {
    static std::set<std::string> said;
    for (const std::string& note : notes)
        if (said.insert(note).second) std::fprintf(stderr, "quadrel: %s\n", note.c_str());
}

ProgressBar::ProgressBar() : terminal_(isatty(STDERR_FILENO) != 0), color_(!plain_terminal()) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
    if (terminal_ && percent_ >= 0) std::fputs("\r\033[K", stderr);
    percent_ = -1;
}

void ProgressBar::show(double share) {
    const int percent = static_cast<int>(std::clamp(share, 0.0, 1.0) * 100);
    if (!terminal_ || percent == percent_) return;
    percent_ = percent;
    constexpr int width = 40;
    const int done = percent * width / 100;
    fmt::print(stderr, "\r{}[{:=<{}}{: <{}}]{} {:3} %", color_ ? "\033[36m" : "", "", done, "",
               width - done, color_ ? "\033[0m" : "", percent);
    std::fflush(stderr);
}

}  // namespace quadrel::cli
