// Derivatives of a text on dual numbers, judged by central differences of the same text in double.
#pragma once

#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "quadrel/num/dual.hpp"

namespace quadrel::num_tests {

/// A function of up to three numbers, on duals and on doubles.
struct DualCase {
    using DualText = std::function<Quad<Dual>(const std::array<Quad<Dual>, 3>&)>;
    using PlainText = std::function<Quad<double>(const std::array<Quad<double>, 3>&)>;

    std::string name;
    DualText dual;
    PlainText plain;
    double low = -4, high = 4;  ///< of all arguments
};

template <class Text>
DualCase dual_case(std::string name, const Text& text, double low = -4, double high = 4) {
    return {std::move(name), [text](const auto& x) { return text(x); },
            [text](const auto& x) { return text(x); }, low, high};
}

/// A derivative's distance from central differences of three steps, each half of the one before.
struct StepErrors {
    double error[3];
    double floor;  ///< what rounding may leave

    /// As the step's square, until rounding.
    bool fall() const {
        return error[1] <= error[0] / 2.5 + floor && error[2] <= error[1] / 2.5 + 2 * floor;
    }
};

/// `f(t)`: the function t along a direction, with a rounding error of `noise`.
template <class Function>
StepErrors step_errors(const Function& f, double derivative, double step, double noise) {
    StepErrors errors{{}, 8 * noise / step + 1e-13 * std::abs(derivative)};
    for (double& error : errors.error) {
        error = std::abs((f(step) - f(-step)) / (2 * step) - derivative);
        step /= 2;
    }
    return errors;
}

}  // namespace quadrel::num_tests
