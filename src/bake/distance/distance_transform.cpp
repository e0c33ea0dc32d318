#include "bake/distance/distance_transform.hpp"

#include <limits>
#include <vector>

namespace quadrel {

namespace {

/// The lower envelope of parabolas value + (x - at)^2 with growing `at`.
class LowerEnvelope {
  public:
    void add(double at, double value) {
        while (!roots_.empty()) {
            const double from = crossing(roots_.back(), {at, value, 0});
            if (from > roots_.back().from) {
                roots_.push_back({at, value, from});
                return;
            }
            roots_.pop_back();
        }
        roots_.push_back({at, value, -std::numeric_limits<double>::infinity()});
    }

    /// The envelope at x; to be asked with growing x.
    double operator()(double x) {
        while (next_ + 1 < roots_.size() && roots_[next_ + 1].from <= x) ++next_;
        const double d = x - roots_[next_].at;
        return roots_[next_].value + d * d;
    }

  private:
    struct Root {
        double at, value, from;  ///< from: the least x where it is the lowest
    };
    static double crossing(const Root& left, const Root& right) {
        const double shift = (right.value - left.value) / (2 * (right.at - left.at));
        return (left.at + right.at) / 2 + shift;
    }

    std::vector<Root> roots_;
    std::size_t next_ = 0;
};

}  // namespace

void transform_boxes(double* values, int count, int stride, bool periodic) {
    // An image more than one period away is never nearer than one of the three.
    const int first = periodic ? -count : 0, last = periodic ? 2 * count : count;
    LowerEnvelope envelope;
    for (int i = first; i < last; ++i) {
        const double value = values[static_cast<std::ptrdiff_t>((i + count) % count) * stride];
        const double next = values[static_cast<std::ptrdiff_t>((i + 1 + count) % count) * stride];
        if (i == first) envelope.add(i - 0.5, value);
        envelope.add(i, value);
        // Where two boxes meet, the lower one counts.
        envelope.add(i + 0.5, i + 1 < last && next < value ? next : value);
    }
    std::vector<double> result;
    result.reserve(count);
    for (int i = 0; i < count; ++i) result.push_back(envelope(i));
    for (int i = 0; i < count; ++i) values[static_cast<std::ptrdiff_t>(i) * stride] = result[i];
}

}  // namespace quadrel
