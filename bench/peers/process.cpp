#include "process.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <fmt/ranges.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstring>
#include <stdexcept>

#include "measure.hpp"

extern char** environ;

namespace quadrel::peers {
namespace {

struct Answer {
    bool ended_well = false;
    ProcessUse use;
};

/// A request is one message: the number of processors, then the words, each ended by a 0.
constexpr std::size_t longest_request = 4096;

pid_t spawned(char* const* arguments) {
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    for (const int file : {0, 1, 2})
        posix_spawn_file_actions_addopen(&actions, file, "/dev/null", O_RDWR, 0);
    pid_t child = -1;
    const int error = posix_spawn(&child, arguments[0], &actions, nullptr, arguments, environ);
    posix_spawn_file_actions_destroy(&actions);
    return error == 0 ? child : -1;
}

double milliseconds(const timeval& time) {
    return 1e3 * static_cast<double>(time.tv_sec) + 1e-3 * static_cast<double>(time.tv_usec);
}

Answer run_and_wait(char* const* arguments) {
    const double start = bench::seconds(CLOCK_MONOTONIC);
    const pid_t child = spawned(arguments);
    int status = -1;
    rusage used{};
    if (child < 0 || wait4(child, &status, 0, &used) != child) return {};
    const double wall = 1e3 * (bench::seconds(CLOCK_MONOTONIC) - start);
    return {status == 0,
            {{wall, milliseconds(used.ru_utime) + milliseconds(used.ru_stime)},
             static_cast<double>(used.ru_maxrss) / 1024}};
}

/// Answers requests until the other end is closed.
void serve(int socket) {
    char request[longest_request];
    ssize_t bytes = 0;
    while ((bytes = recv(socket, request, sizeof(request), 0)) > 0) {
        std::vector<char*> words;
        for (char* word = request; word < request + bytes; word += std::strlen(word) + 1)
            words.push_back(word);
        keep_to(std::atoi(words[0]));
        words.push_back(nullptr);
        const Answer answer = run_and_wait(words.data() + 1);
        send(socket, &answer, sizeof(answer), MSG_NOSIGNAL);
    }
}

}  // namespace

ProcessRunner::ProcessRunner() {
    int ends[2];
    if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0)
        throw std::runtime_error("no pair of sockets");
    starter_ = fork();
    if (starter_ == 0) {
        close(ends[0]);
        serve(ends[1]);
        _exit(0);
    }
    close(ends[1]);
    socket_ = ends[0];
}

ProcessRunner::~ProcessRunner() {
    close(socket_);
    if (starter_ > 0) waitpid(starter_, nullptr, 0);
}

ProcessUse ProcessRunner::run(const std::vector<std::string>& command, int processors) {
    std::string request = std::to_string(processors) + '\0';
    for (const std::string& word : command) request += word + '\0';
    Answer answer;
    const bool answered =
        request.size() <= longest_request &&
        send(socket_, request.data(), request.size(), MSG_NOSIGNAL) > 0 &&
        recv(socket_, &answer, sizeof(answer), 0) == static_cast<ssize_t>(sizeof(answer));
    if (!answered || !answer.ended_well)
        throw std::runtime_error(fmt::format("{}: failed", fmt::join(command, " ")));
    return answer.use;
}

}  // namespace quadrel::peers
