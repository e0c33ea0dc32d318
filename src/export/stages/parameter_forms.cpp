#include "export/stages/parameter_forms.hpp"

namespace quadrel::recorded {
namespace {

template <class Form>
constexpr WholeForm whole(Form) {
    return {[](std::int32_t n) { return Form()(n); }, [](const ShaderInt& n) { return Form()(n); }};
}
template <class Form>
constexpr RealForm real(Form) {
    return {[](float x) { return Form()(x); }, [](const Shader& x) { return Form()(x); }};
}

}  // namespace

std::span<const WholeForm> whole_forms() {
    static constexpr WholeForm forms[] = {whole([](auto n) { return n; }),
                                          whole([](auto n) { return n - decltype(n)(1); }),
                                          whole([](auto n) { return n + decltype(n)(1); }),
                                          whole([](auto n) { return decltype(n)(2) * n; }),
                                          whole([](auto n) { return n - decltype(n)(2); })};
    return forms;
}

std::span<const RealForm> real_forms() {
    static constexpr RealForm forms[] = {real([](auto x) { return x; }),
                                         real([](auto x) { return -x; }),
                                         real([](auto x) { return decltype(x)(1) / x; }),
                                         real([](auto x) { return decltype(x)(1) - x; }),
                                         real([](auto x) { return decltype(x)(1) + x; }),
                                         real([](auto x) { return decltype(x)(0.5f) * x; }),
                                         real([](auto x) { return decltype(x)(2) * x; }),
                                         real([](auto x) { return x * x; }),
                                         real([](auto x) { return decltype(x)(0.5f) / x; })};
    return forms;
}

}  // namespace quadrel::recorded
