#include "measure.hpp"

#include <sched.h>

namespace quadrel::peers {
namespace {

cpu_set_t allowed_now() {
    cpu_set_t set;
    CPU_ZERO(&set);
    sched_getaffinity(0, sizeof(set), &set);
    return set;
}

const cpu_set_t& allowed_at_first() {
    static const cpu_set_t set = allowed_now();
    return set;
}

}  // namespace

int processors() { return std::max(1, CPU_COUNT(&allowed_at_first())); }

void keep_to(int count) {
    cpu_set_t chosen;
    CPU_ZERO(&chosen);
    for (int i = 0; i < CPU_SETSIZE && CPU_COUNT(&chosen) < count; ++i)
        if (CPU_ISSET(i, &allowed_at_first())) CPU_SET(i, &chosen);
    sched_setaffinity(0, sizeof(chosen), &chosen);
}

}  // namespace quadrel::peers
