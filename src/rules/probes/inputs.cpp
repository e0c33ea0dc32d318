#include "rules/probes/inputs.hpp"

#include <set>

namespace quadrel::rules {

std::string bits_words(const Values& values) {
    std::set<float> told_apart;
    for (std::size_t i = 0; i < values.size() / 4; ++i) told_apart.insert(answer(values, i));
    const std::size_t steps = told_apart.size();
    if (2 * steps > values.size() / 4) return "exact";
    return fmt::format("{} values, {:.1f} bits", steps, quadrel::log2(double(steps)));
}

}  // namespace quadrel::rules
