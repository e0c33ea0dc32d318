// Running the built executable.
#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <thread>
#include <vector>

#include "film/films.hpp"

namespace quadrel::cli_tests {

struct Outcome {
    int code = -1;  ///< exit code, or 1000 + the signal
    std::string out, err;
};

/// What a child process becomes: `quadrel arguments...`, where it is or in `folder`.
[[noreturn]] inline void become_quadrel(const std::vector<std::string>& arguments,
                                        const std::filesystem::path& folder = {}) {
    std::vector<char*> argv = {const_cast<char*>(QUADREL_EXECUTABLE)};
    for (const std::string& argument : arguments)
        argv.push_back(const_cast<char*>(argument.c_str()));
    argv.push_back(nullptr);
    if (folder.empty() || chdir(folder.c_str()) == 0) execv(QUADREL_EXECUTABLE, argv.data());
    _exit(127);
}

/// Starts `quadrel arguments...` in `folder`, standard output and error into the files out and err
/// of `logs` (or standard output into `out_file`). Returns the process id.
inline pid_t start(const std::vector<std::string>& arguments, const std::filesystem::path& folder,
                   const std::filesystem::path& logs, const std::string& out_file = "") {
    const std::string out = out_file.empty() ? (logs / "out").string() : out_file;
    const std::string err = (logs / "err").string();
    const pid_t child = fork();
    if (child != 0) return child;
    dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
    dup2(open(err.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDERR_FILENO);
    become_quadrel(arguments, folder);
}

inline int wait_for(pid_t child) {
    int status = 0;
    waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : 1000 + WTERMSIG(status);
}

/// Runs `quadrel arguments...` to its end, in `folder`.
inline Outcome run(const std::vector<std::string>& arguments,
                   const std::filesystem::path& folder = "/", const std::string& out_file = "") {
    const testing_films::TemporaryFolder logs;
    Outcome outcome;
    outcome.code = wait_for(start(arguments, folder, logs.path(), out_file));
    if (out_file.empty()) outcome.out = testing_films::file_bytes(logs / "out");
    outcome.err = testing_films::file_bytes(logs / "err");
    return outcome;
}

}  // namespace quadrel::cli_tests
