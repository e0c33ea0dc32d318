// Names for what a text computes. The copies of texts that the module is compiled from have them
// around the right-hand sides of declarations and assignments (src/tools/annotate).
#pragma once

#include "quadrel/num/shader/functions.hpp"

namespace quadrel {

namespace recorded {

/// While it lives, names end in that of what is computed: low_x. Of axes, whose texts are the same.
class [[maybe_unused]] NamedFor {
  public:
    explicit NamedFor(const char* axis) : outer_(current_) { current_ = axis; }
    NamedFor(const NamedFor&) = delete;
    NamedFor& operator=(const NamedFor&) = delete;
    ~NamedFor() { current_ = outer_; }

    static std::string name(const std::string& name) {
        if (current_ == nullptr) return name;
        const std::string axis = current_;
        const bool has_it = name == axis || name.ends_with("_" + axis) ||
                            name.ends_with("." + axis) || name.empty();
        return has_it ? name : name + "_" + axis;
    }

  private:
    inline static thread_local const char* current_ = nullptr;
    const char* outer_;
};

/// What `compute` gives, computed of that axis.
template <class Compute>
decltype(auto) of_axis(const char* axis, const Compute& compute) {
    const NamedFor scope(axis);
    return compute();
}

/// `name`, and behind line breaks the comments that stand in front. A '?' first: a weak name.
inline void give_name(Node* node, const std::string& name) {
    using Kind = Node::Kind;
    if (node == nullptr || !node->name.empty() || node->kind == Kind::symbol ||
        node->kind == Kind::read ||
        (node->kind == Kind::component && node->arguments[0]->kind == Kind::symbol))
        return;
    if (name[0] == '?') {
        node->weak_name = NamedFor::name(name.substr(1));
        return;
    }
    std::size_t end = name.find('\n');
    node->name = NamedFor::name(name.substr(0, end));
    while (end != std::string::npos) {
        const std::size_t next = name.find('\n', end + 1);
        node->comments.push_back(name.substr(end + 1, next - end - 1));
        end = next;
    }
}

}  // namespace recorded

/// What has no lanes has no name.
template <class T>
constexpr T named(const char*, T x) {
    return x;
}
inline Shader named(const char* name, Shader x) {
    recorded::give_name(x.node(), name);
    return x;
}
inline ShaderInt named(const char* name, ShaderInt x) {
    recorded::give_name(x.node(), name);
    return x;
}
inline ShaderMask named(const char* name, ShaderMask x) {
    recorded::give_name(x.node(), name);
    return x;
}
template <int n>
vec<n, Shader> named(const char* name, const vec<n, Shader>& v) {
    for (int i = 0; i < n; ++i)
        if (v[i].node() == nullptr) return v;
    recorded::Node* const packed = recorded::pack<n>(v);
    recorded::give_name(packed, name);
    return recorded::unpack<n>(packed);
}

}  // namespace quadrel
