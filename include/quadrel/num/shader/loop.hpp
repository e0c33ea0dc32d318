// The words of num/loop.hpp on Shader: a body is run once, and a loop is written. To be included
// before the texts, which call them with plain numbers.
#pragma once

#include <exception>

#include "quadrel/num/loop.hpp"
#include "quadrel/num/shader/functions.hpp"

namespace quadrel {

/// The counter of a loop.
struct [[maybe_unused]] ShaderStep {
    recorded::Node* index;

    friend ShaderStep operator+(const ShaderStep& k, int n) {
        using namespace recorded;
        return {binary(Type::integer, "+", k.index, literal(Type::integer, n))};
    }
    friend ShaderStep operator-(const ShaderStep& k, int n) {
        using namespace recorded;
        return {binary(Type::integer, "-", k.index, literal(Type::integer, n))};
    }
};

/// A loop over steps, or without an end, for a range-based loop.
class ShaderSteps {
  public:
    class Iterator {
      public:
        explicit Iterator(const ShaderSteps& of) : of_(of) {}
        bool operator!=(int) {
            if (loop_ != nullptr) return false;
            recorded::Recorder& recorder = recorded::Recorder::current();
            loop_ = of_.endless_ ? recorder.begin_rounds()
                                 : recorder.begin_steps(bound(of_.first_), bound(of_.last_));
            return true;
        }
        ShaderStep operator*() const {
            if (of_.endless_) return {nullptr};
            recorded::Node* const index =
                recorded::Recorder::current().symbol(recorded::Type::integer, loop_->index);
            index->loop = loop_;
            return {index};
        }
        void operator++() { recorded::Recorder::current().end_loop(); }

      private:
        static recorded::Node* bound(int step) {
            return recorded::literal(recorded::Type::integer, step);
        }
        const ShaderSteps& of_;
        recorded::Loop* loop_ = nullptr;
    };

    ShaderSteps(int first, int last) : first_(first), last_(last), endless_(false) {}
    ShaderSteps() : first_(0), last_(0), endless_(true) {}
    Iterator begin() const { return Iterator(*this); }
    int end() const { return 0; }

  private:
    int first_, last_;
    bool endless_;
};

template <Number F>
requires std::same_as<F, Shader> ShaderSteps steps(int first, int last) { return {first, last}; }
template <Number F>
requires std::same_as<F, Shader> ShaderSteps rounds() { return {}; }
template <Number F>
requires std::same_as<F, Shader> F number(const ShaderStep& k) {
    return F(recorded::call(recorded::Type::real, "float", {k.index}));
}

/// A way out of the loop that is recorded.
inline bool none(const ShaderMask& mask) {
    recorded::Recorder::current().leave_unless(mask.node());
    return false;
}

/// A block that a branch guards: `if (const auto in = when(mask)) { ... }`.
class ShaderBlock {
  public:
    explicit ShaderBlock(const ShaderMask& mask) : exceptions_(std::uncaught_exceptions()) {
        recorded::Recorder::current().begin_block(mask.node());
    }
    ShaderBlock(const ShaderBlock&) = delete;
    ShaderBlock& operator=(const ShaderBlock&) = delete;
    ~ShaderBlock() noexcept(false) {
        if (std::uncaught_exceptions() == exceptions_) recorded::Recorder::current().end_loop();
    }
    explicit operator bool() const { return true; }

  private:
    int exceptions_;
};

/// The scope of `if (when(mask))`, whose end no object sees: its block is run unguarded, for it
/// changes nothing in lanes outside of the mask. Texts that are annotated for the module
/// (src/tools/annotate) have the other form, and leave a branch.
inline bool when(const ShaderMask&) { return true; }
inline ShaderBlock branch(const ShaderMask& mask) { return ShaderBlock(mask); }

}  // namespace quadrel
