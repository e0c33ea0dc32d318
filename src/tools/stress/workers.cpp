#include "stress/workers.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <csignal>
#include <cstring>
#include <ctime>
#include <fstream>
#include <memory>

#include "quadrel/error.hpp"
#include "stress/wire.hpp"

namespace quadrel::stress {
namespace {

using Clock = std::chrono::steady_clock;

/// The folder of a process: its scene, and links to the maps.
std::filesystem::path make_folder(const std::filesystem::path& folder, int process) {
    const std::filesystem::path own = folder / fmt::format("process-{}", process);
    std::filesystem::create_directory(own);
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".exr" &&
            !std::filesystem::exists(own / entry.path().filename()))
            std::filesystem::create_hard_link(entry.path(), own / entry.path().filename());
    return own;
}

void write_files(const std::filesystem::path& folder, const StressScene& scene) {
    std::ofstream(folder / "scene.json", std::ios::binary) << scene.document.dump(1);
    if (!scene.mesh.empty())
        std::ofstream(folder / scene.mesh_file(), std::ios::binary) << scene.mesh;
}

/// Writes all of it; ends the process where nobody reads any more.
void write_all(int to, const std::string& text) {
    for (std::size_t at = 0; at < text.size();) {
        const ssize_t wrote = write(to, text.data() + at, text.size() - at);
        if (wrote < 0 && errno == EINTR) continue;
        if (wrote <= 0) _exit(1);
        at += static_cast<std::size_t>(wrote);
    }
}

/// A process that runs every `stride`-th scene from `first` on, and what it has told so far.
class Worker {
  public:
    Worker(const Job& job, std::filesystem::path folder, std::uint64_t first, std::uint64_t stride,
           double look_ups)
        : job_(job),
          folder_(std::move(folder)),
          next_(job.next(first, stride)),
          stride_(stride),
          look_ups_(look_ups) {}
    ~Worker() { stop(); }
    Worker(const Worker&) = delete;
    Worker& operator=(const Worker&) = delete;

    bool finished() const { return next_ >= job_.count(); }
    bool running() const { return child_ > 0; }
    int from_child() const { return from_child_; }
    /// Whether its scene has taken `seconds` of processor time, or ten times that on the clock: a
    /// machine may have other work, and what waits for ever takes no processor time.
    bool is_over(double seconds) const {
        const double waited = std::chrono::duration<double>(Clock::now() - begun_).count();
        return cpu_seconds() - cpu_begun_ > seconds || waited > 10 * seconds;
    }
    StressScene scene() const { return job_.scene(next_); }

    void start() {
        int pipe_ends[2];
        if (pipe(pipe_ends) != 0) throw OutputError("a pipe", std::strerror(errno));
        child_ = fork();
        if (child_ < 0) throw OutputError("a process", std::strerror(errno));
        if (child_ == 0) {
            close(pipe_ends[0]);
            run(pipe_ends[1]);
        }
        close(pipe_ends[1]);
        from_child_ = pipe_ends[0];
        begin_scene();
    }

    /// What came from the child: results of whole scenes.
    std::vector<SceneResult> read_results() {
        char bytes[65536];
        const ssize_t got = read(from_child_, bytes, sizeof bytes);
        if (got > 0) text_.append(bytes, static_cast<std::size_t>(got));
        ended_ = got == 0;
        std::vector<SceneResult> results;
        for (std::size_t end; (end = text_.find('\n')) != std::string::npos;
             text_.erase(0, end + 1))
            results.push_back(from_line(text_.substr(0, end)));
        return results;
    }
    bool ended() const { return ended_; }

    void advance() {
        next_ = job_.next(next_ + stride_, stride_);
        begin_scene();
    }

    /// Ends the process, and says how it had ended by itself.
    std::string stop() {
        if (!running()) return "";
        if (!ended_) kill(child_, SIGKILL);
        int status = 0;
        waitpid(child_, &status, 0);
        close(from_child_);
        child_ = -1;
        text_.clear();
        ended_ = false;
        if (WIFSIGNALED(status)) return fmt::format("signal {}", WTERMSIG(status));
        return WEXITSTATUS(status) == 0 ? "" : fmt::format("exit code {}", WEXITSTATUS(status));
    }

    /// The last line on the child's standard error.
    std::string last_words() const {
        std::ifstream file(folder_ / "stderr");
        std::string last, line;
        while (std::getline(file, line)) last = line;
        return last;
    }

  private:
    void begin_scene() {
        begun_ = Clock::now();
        cpu_begun_ = cpu_seconds();
    }
    /// Of the child so far; 0 where there is none.
    double cpu_seconds() const {
        clockid_t clock = 0;
        timespec time{};
        if (!running() || clock_getcpuclockid(child_, &clock) != 0 ||
            clock_gettime(clock, &time) != 0)
            return 0;
        return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
    }

    /// The child's life.
    [[noreturn]] void run(int to_parent) {
        const std::string log = (folder_ / "stderr").string();
        const int errors = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
        dup2(errors, STDERR_FILENO);
        for (; !finished(); next_ = job_.next(next_ + stride_, stride_)) {
            const StressScene scene = job_.scene(next_);
            write_files(folder_, scene);
            const CheckOptions options{scene.number, look_ups_};
            write_all(to_parent, to_line(check_scene(folder_, scene, options)) + "\n");
        }
        _exit(0);
    }

    const Job& job_;
    std::filesystem::path folder_;
    std::uint64_t next_, stride_;
    double look_ups_;
    pid_t child_ = -1;
    int from_child_ = -1;
    Clock::time_point begun_;
    double cpu_begun_ = 0;
    std::string text_;
    bool ended_ = false;
};

SceneResult lost(const StressScene& scene, const std::string& kind, const std::string& detail) {
    SceneResult result;
    const Json& material = scene.document["materials"]["stress"];
    const Json& frame = material["relief"]["frame"];
    result.findings.push_back(
        {kind,
         fmt::format("{} {}", frame.is_object() ? frame["id"].get<std::string>() : frame.dump(),
                     material["relief"]["trace"].dump()),
         detail});
    return result;
}

}  // namespace

void run_scenes(const Job& job, const WorkerOptions& options,
                const std::function<void(const StressScene&, const SceneResult&)>& done) {
    std::vector<std::unique_ptr<Worker>> workers;
    const auto count = static_cast<std::uint64_t>(options.processes);
    for (int process = 0; process < options.processes; ++process)
        workers.push_back(std::make_unique<Worker>(job, make_folder(options.folder, process),
                                                   static_cast<std::uint64_t>(process), count,
                                                   options.look_ups));
    const auto give_up = [&](Worker& worker, const std::string& kind, const std::string& detail) {
        done(worker.scene(), lost(worker.scene(), kind, detail));
        worker.advance();
    };
    for (bool busy = true; busy;) {
        busy = false;
        std::vector<pollfd> ready;
        for (auto& worker : workers) {
            if (!worker->running() && !worker->finished()) worker->start();
            ready.push_back({worker->running() ? worker->from_child() : -1, POLLIN, 0});
            busy = busy || worker->running();
        }
        constexpr int tenth_of_a_second = 100;
        poll(ready.data(), ready.size(), tenth_of_a_second);
        for (std::size_t i = 0; i < workers.size(); ++i) {
            Worker& worker = *workers[i];
            if (!worker.running()) continue;
            if (ready[i].revents != 0)
                for (const SceneResult& result : worker.read_results()) {
                    done(worker.scene(), result);
                    worker.advance();
                }
            if (worker.ended()) {
                const std::string how = worker.stop();
                if (!worker.finished()) give_up(worker, "crash", how + ": " + worker.last_words());
            } else if (worker.is_over(options.seconds)) {
                worker.stop();
                give_up(worker, "hang", fmt::format("more than {} s", options.seconds));
            }
        }
    }
}

}  // namespace quadrel::stress
