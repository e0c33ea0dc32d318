// Assertions for our own bugs. They print the expression, the values and the place, what the thread
// was doing, and end the process with exit code 4. Active in release builds at stage borders; never
// used for user input.
#pragma once

#include <cstdio>
#include <cstdlib>
#include <sstream>
#include <string>

namespace quadrel {

/// What the thread is doing, told by a failed check. One that is made later hides the earlier as
/// long as it lives.
class CheckContext {
  public:
    CheckContext() : outer_(innermost()) { innermost() = this; }
    virtual ~CheckContext() { innermost() = outer_; }
    CheckContext(const CheckContext&) = delete;
    CheckContext& operator=(const CheckContext&) = delete;

    /// For the end of a message; one line.
    virtual std::string text() const = 0;

    /// The thread's; null where it told nothing.
    static const CheckContext*& innermost() {
        static thread_local const CheckContext* context = nullptr;
        return context;
    }

  private:
    const CheckContext* outer_;
};

[[noreturn]] inline void check_failed(const char* file, int line, const char* expression,
                                      const std::string& values) {
    const CheckContext* const context = CheckContext::innermost();
    const std::string doing = context != nullptr ? "; " + context->text() : "";
    std::fprintf(stderr, "quadrel: internal check failed: %s (%s) at %s:%d%s\n", expression,
                 values.c_str(), file, line, doing.c_str());
    std::fflush(stderr);
    std::_Exit(4);
}

template <class A, class B>
std::string show_values(const A& a, const B& b) {
    std::ostringstream out;
    out.precision(17);
    out << a << " vs " << b;
    return out.str();
}

}  // namespace quadrel

/// Fails with exit code 4 when `condition` is false; `value` is printed.
#define QUADREL_CHECK(condition, value)                                       \
    do {                                                                      \
        if (!(condition))                                                     \
            ::quadrel::check_failed(__FILE__, __LINE__, #condition,           \
                                    ::quadrel::show_values((value), #value)); \
    } while (false)

/// Compares two values with `op` and prints both when the comparison fails.
#define QUADREL_CHECK_OP(op, a, b)                                         \
    do {                                                                   \
        if (!((a)op(b)))                                                   \
            ::quadrel::check_failed(__FILE__, __LINE__, #a " " #op " " #b, \
                                    ::quadrel::show_values((a), (b)));     \
    } while (false)
