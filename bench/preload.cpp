// Preloaded into a program (LD_PRELOAD), says on standard error what memory it took beyond what it
// had at the start of main: VmHWM at exit minus VmRSS there, of /proc/self/status.
#include <dlfcn.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>

namespace {

using Main = int (*)(int, char**, char**);

Main real_main = nullptr;
long resident_at_start = 0;

/// A line of /proc/self/status, in KiB.
long status_kib(const char* key) {
    std::FILE* const file = std::fopen("/proc/self/status", "r");
    char line[256];
    long value = -1;
    while (file != nullptr && value < 0 && std::fgets(line, sizeof(line), file) != nullptr)
        if (std::strncmp(line, key, std::strlen(key)) == 0)
            value = std::strtol(line + std::strlen(key), nullptr, 10);
    if (file != nullptr) std::fclose(file);
    return value;
}

void report() {
    const long peak = status_kib("VmHWM:");
    std::fprintf(stderr, "peak %.1f MiB, at the start of main %.1f MiB, difference %.1f MiB\n",
                 double(peak) / 1024, double(resident_at_start) / 1024,
                 double(peak - resident_at_start) / 1024);
}

int measured_main(int argc, char** argv, char** environment) {
    std::atexit(report);
    resident_at_start = status_kib("VmRSS:");
    return real_main(argc, argv, environment);
}

}  // namespace

/// In place of the C library's: the only way to be called right before main.
extern "C" int __libc_start_main(Main main, int argc, char** argv, void (*init)(), void (*fini)(),
                                 void (*rtld_fini)(), void* stack_end) {
    using Start = int (*)(Main, int, char**, void (*)(), void (*)(), void (*)(), void*);
    real_main = main;
    const auto start = reinterpret_cast<Start>(dlsym(RTLD_NEXT, "__libc_start_main"));
    return start(measured_main, argc, argv, init, fini, rtld_fini, stack_end);
}
