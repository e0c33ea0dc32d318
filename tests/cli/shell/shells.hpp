// Shells that are installed here, with the built executable as `quadrel`.
#pragma once

#include <fcntl.h>
#include <poll.h>
#include <stdlib.h>
#include <sys/ioctl.h>
#include <termios.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <filesystem>
#include <string>
#include <vector>

#include "cli/process.hpp"
#include "film/films.hpp"

namespace quadrel::cli_tests {

/// Whether there is such a program.
inline bool is_installed(const std::string& program) {
    return std::system(("command -v " + program + " >/dev/null 2>&1").c_str()) == 0;
}

/// What a command line for sh prints, standard error included.
inline std::string output_of(const std::string& line) {
    std::string text;
    FILE* const pipe = popen(("{ " + line + "; } 2>&1").c_str(), "r");
    if (pipe == nullptr) return "no pipe";
    char buffer[4096];
    for (std::size_t n; (n = fread(buffer, 1, sizeof buffer, pipe)) > 0;) text.append(buffer, n);
    pclose(pipe);
    return text;
}

/// A folder in which the program is called quadrel, and which is a home without settings.
class ProgramFolder {
  public:
    ProgramFolder() { std::filesystem::create_symlink(QUADREL_EXECUTABLE, folder_ / "quadrel"); }
    std::string path() const { return folder_.path().string(); }
    /// "PATH=... HOME=..." for sh.
    std::string environment() const {
        return "PATH='" + path() + "':\"$PATH\" HOME='" + path() + "' TERM=xterm ";
    }
    std::filesystem::path operator/(const std::string& name) const { return folder_ / name; }

  private:
    testing_films::TemporaryFolder folder_;
};

/// A shell that somebody types into.
class ShellTerminal {
  public:
    ShellTerminal(const ProgramFolder& folder, const std::string& command) {
        master_ = posix_openpt(O_RDWR | O_NOCTTY | O_CLOEXEC);
        if (master_ < 0 || grantpt(master_) != 0 || unlockpt(master_) != 0) return;
        const winsize size{50, 200, 0, 0};
        ioctl(master_, TIOCSWINSZ, &size);
        const std::string slave = ptsname(master_);
        const std::string line =
            "cd '" + folder.path() + "' && exec env " + folder.environment() + command;
        child_ = fork();
        if (child_ != 0) return;
        setsid();
        const int terminal = open(slave.c_str(), O_RDWR);
        for (const int descriptor : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO})
            dup2(terminal, descriptor);
        execl("/bin/sh", "sh", "-c", line.c_str(), nullptr);
        _exit(127);
    }
    ~ShellTerminal() {
        if (child_ > 0) {
            kill(child_, SIGKILL);
            wait_for(child_);
        }
        close(master_);
    }
    ShellTerminal(const ShellTerminal&) = delete;
    ShellTerminal& operator=(const ShellTerminal&) = delete;

    void type(const std::string& text) {
        seen_.clear();
        if (write(master_, text.data(), text.size()) < 0) seen_ = "cannot be typed into";
    }
    /// Waits until the text stands in what has come since the last was typed.
    bool shows(const std::string& text) {
        const auto end = std::chrono::steady_clock::now() + std::chrono::seconds(60);
        while (seen_.find(text) == std::string::npos) {
            pollfd state{master_, POLLIN, 0};
            if (poll(&state, 1, 500) == 1) {
                char buffer[4096];
                const ssize_t n = read(master_, buffer, sizeof buffer);
                if (n <= 0) return false;
                seen_.append(buffer, static_cast<std::size_t>(n));
            }
            if (std::chrono::steady_clock::now() > end) return false;
        }
        return true;
    }
    const std::string& seen() const { return seen_; }

  private:
    int master_ = -1;
    pid_t child_ = -1;
    std::string seen_;
};

}  // namespace quadrel::cli_tests
