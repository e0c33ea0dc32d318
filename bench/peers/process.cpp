#include "process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <stdexcept>

#include "support/clock.hpp"

extern char** environ;

namespace quadrel::peers {
namespace {

pid_t spawned(const std::vector<std::string>& command) {
    std::vector<char*> arguments;
    for (const std::string& word : command) arguments.push_back(const_cast<char*>(word.c_str()));
    arguments.push_back(nullptr);
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int file : {0, 1, 2})
        posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0);
    pid_t child = -1;
    const int error =
        posix_spawn(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    return error == 0 ? child : -1;
}

double milliseconds(const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

}  // namespace

ProcessUse run_process(const std::vector<std::string>& command) {
    const double start = bench::seconds(CLOCK_MONOTONIC);
    const pid_t child = spawned(command);
    int status = -1;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) != child || status != 0)
        throw std::runtime_error(fmt::format("{}: failed", fmt::join(command, " ")));
    return {{1e3 * (bench::seconds(CLOCK_MONOTONIC) - start),
             milliseconds(used.ru_utime) + milliseconds(used.ru_stime)},
            static_cast<double>(used.ru_maxrss) / 1024};
}

}  // namespace quadrel::peers
