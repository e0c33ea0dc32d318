// A stage's parameters by their names in the text of its function. Texts compute with plain numbers
// that no recording sees, so the text is written several times: where it changes with a parameter,
// and by nothing but its value, that is what stands there.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "export/print/dialect.hpp"
#include "export/stages/recorded_stage.hpp"

namespace quadrel::recorded {

class NamedParameters {
  public:
    /// `params`: the stage's Params, or null for the defaults.
    NamedParameters(const RecordedStage& stage, const void* params);

    /// What they are called, in their order.
    const std::vector<std::string>& names() const { return names_; }

    using Write = std::function<std::string(const void* params)>;
    /// What `write` gives for the parameters, with a constant for each that it has by name. What
    /// was computed from a parameter beforehand stays a number.
    std::string written(const Write& write, const Dialect& dialect) const;

  private:
    using Params = std::vector<std::max_align_t>;
    struct Places {
        std::vector<std::size_t> tokens;
        std::vector<int> offsets;  ///< what is added to the parameter there
    };

    Params with(int parameter, double value) const;
    /// Values that no default has, the last one below all of them.
    static constexpr int odd_count = 3;
    void odd_values(int parameter, double (&odd)[odd_count]) const;
    bool is_value(int parameter, double value) const;
    Places places_of(int parameter, const std::vector<std::string>& tokens,
                     const Write& write) const;

    const RecordedStage& stage_;
    Params params_;
    std::vector<std::string> names_;
};

}  // namespace quadrel::recorded
