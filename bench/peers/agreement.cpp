#include "agreement.hpp"

#include <cmath>

namespace quadrel::peers {

double mean_difference(const Film& film, const std::vector<float>& rgba) {
    double sum = 0;
    const char* const names[] = {"R", "G", "B"};
    const std::size_t pixels = film.window.area();
    for (std::size_t c = 0; c < 3; ++c) {
        const Plane& plane = *film.find(names[c]);
        for (std::size_t i = 0; i < pixels; ++i)
            sum += std::abs(double(plane.as_float(i)) - double(rgba.at(4 * i + c)));
    }
    return sum / static_cast<double>(3 * pixels);
}

double mean_difference(const Plane& plane, const std::vector<float>& values) {
    double sum = 0;
    for (std::size_t i = 0; i < values.size(); ++i)
        sum += std::abs(double(plane.as_float(i)) - double(values[i]));
    return sum / static_cast<double>(values.size());
}

}  // namespace quadrel::peers
