#include "cli/common/console.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <iostream>
#include <set>

#include "cli/common/quiet.hpp"
#include "file/atomic_file.hpp"
#include "quadrel/error.hpp"
#include "text/printable.hpp"
#include "text/time_left.hpp"

namespace quadrel::cli {
namespace {

bool reader_gone = false;

/// Whether standard output is a pipe that nobody reads.
bool is_broken_pipe() {
    pollfd out{STDOUT_FILENO, 0, 0};
    return poll(&out, 1, 0) == 1 && (out.revents & (POLLERR | POLLHUP)) != 0;
}

/// After a write to standard output that failed; 0 where nobody knows why.
void fail(int error) {
    if (error == 0) error = is_broken_pipe() ? EPIPE : EIO;
    if (error != EPIPE) throw OutputError("standard output", std::strerror(error));
    reader_gone = true;
}

void write_out(const std::string& text) {
    if (reader_gone) return;
    if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) fail(errno);
}

/// Progress, and the like: without a line break, and with sequences that terminals obey.
void write_message(const std::string& text) {
    std::fwrite(text.data(), 1, text.size(), stderr);
    std::fflush(stderr);
}

bool plain_terminal() {
    const char* no_color = std::getenv("NO_COLOR");
    const char* kind = std::getenv("TERM");
    return (no_color != nullptr && *no_color != '\0') ||
           (kind != nullptr && std::strcmp(kind, "dumb") == 0);
}

}  // namespace

void print(std::string_view text) { write_out(printable_lines(text)); }

void print_json(std::string_view json) { write_out(printable_json(json)); }

void print_bytes(const std::string& bytes) { write_out(bytes); }

void flush_output() {
    // Help comes by way of std::cout, which writes through stdout and may have failed before.
    errno = 0;
    std::cout.flush();
    std::fflush(stdout);
    if (!reader_gone && (std::ferror(stdout) != 0 || !std::cout)) fail(errno);
}

void say(std::string_view message) { write_message(printable(message) + "\n"); }

void say_written(const std::filesystem::path& file) {
    if (!is_quiet()) say(full_name(file).string());
}

void occupy_standard_descriptors() {
    for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(descriptor, F_GETFD) >= 0) continue;
        // The lowest free one, which is this one.
        const int opened = open("/dev/null", descriptor == STDIN_FILENO ? O_WRONLY : O_RDONLY);
        if (opened > STDERR_FILENO) close(opened);
    }
}

void say_notes(const std::vector<std::string>& notes) {
    if (is_quiet()) return;
    static std::set<std::string> said;
    for (const std::string& note : notes)
        if (said.insert(note).second) say("quadrel: " + note);
}

ProgressBar::ProgressBar()
    : terminal_(isatty(STDERR_FILENO) != 0 && !is_quiet()), color_(!plain_terminal()) {}

ProgressBar::~ProgressBar() { clear(); }

void ProgressBar::clear() {
    if (terminal_ && percent_ >= 0) write_message("\r\033[K");
    percent_ = -1;
}

void ProgressBar::show(double share, std::string_view what) {
    const int percent = static_cast<int>(std::clamp(share, 0.0, 1.0) * 100);
    if (!terminal_ || (percent == percent_ && what == what_)) return;
    const auto now = std::chrono::steady_clock::now();
    if (!begun_ || what != what_) begun_ = now;
    const std::string left = time_left(std::chrono::duration<double>(now - *begun_).count(), share);
    percent_ = percent;
    what_ = what;
    constexpr int width = 40;
    const int done = percent * width / 100;
    write_message(fmt::format("\r{}[{:=<{}}{: <{}}]{} {:3} % {}{}{}\033[K",
                              color_ ? "\033[36m" : "", "", done, "", width - done,
                              color_ ? "\033[0m" : "", percent, printable(what),
                              what.empty() || left.empty() ? "" : ", ", left));
}

void say_not_kept(const std::string& reason, ProgressBar& bar) {
    static std::set<std::string> said;
    if (!said.insert(reason).second) return;
    bar.clear();
    say("quadrel: warning: the map is not kept in the cache: " + reason);
}

}  // namespace quadrel::cli
