// What tables of distances may give anywhere in a box, against what they give at points of it; and
// which part of a turn directions of a box lie in.
#include "quadrel/relief/trace/table/range_table.hpp"
#include "effort.hpp"
#include "quadrel/relief/range_words.hpp"
#include "quadrel/relief/shadow/range_horizon.hpp"
#include "random.hpp"

namespace quadrel::test {
namespace {

using range_detail::TableBox;
using range_detail::TableSpan;

constexpr std::int32_t nodes[] = {4, 3, 5, 2, 3};

/// Random numbers at the nodes of a table.
class RandomTable {
  public:
    explicit RandomTable(Random& random) {
        for (double& value : values_) value = random.uniform(-1, 1);
    }
    double operator()(const std::int32_t (&k)[5]) const {
        std::size_t index = 0;
        for (int d = 0; d < 5; ++d)
            index = index * static_cast<std::size_t>(nodes[d]) + static_cast<std::size_t>(k[d]);
        return values_[index];
    }
    /// Linear in each of five dimensions; the first two repeat.
    double at(const double (&place)[5]) const {
        double sum = 0;
        for (int corner = 0; corner < 32; ++corner) {
            std::int32_t index[5];
            double weight = 1;
            for (int d = 0; d < 5; ++d) {
                const double low = std::floor(place[d]), part = place[d] - low;
                const int side = corner >> d & 1;
                const int k = static_cast<int>(low) + side;
                index[d] = d < 2 ? (k + 8 * nodes[d]) % nodes[d] : std::min(k, nodes[d] - 1);
                weight *= side == 1 ? part : 1 - part;
            }
            sum += weight * (*this)(index);
        }
        return sum;
    }

  private:
    std::array<double, 4 * 3 * 5 * 2 * 3> values_;
};

TableBox random_box(Random& random, double widest) {
    TableBox box;
    for (int d = 0; d < 5; ++d) {
        const bool repeats = d < 2;
        const double last = nodes[d] - 1, low = repeats ? -last : 0,
                     high = repeats ? 2 * last : last;
        const double from = random.uniform(low, high);
        box[static_cast<std::size_t>(d)] = {from, std::min(from + random.uniform(0, widest), high),
                                            nodes[d], repeats};
    }
    return box;
}

/// Whether points of a box, or of one that is wider by `beyond`, lie in the ranges of boxes.
bool table_ranges_hold(double beyond, double& shares) {
    Random random(5);
    const RandomTable table(random);
    bool all = true;
    const int boxes = rounds(60);
    for (int i = 0; i < boxes; ++i) {
        const TableBox box = random_box(random, i % 2 == 0 ? 0.3 : 1.6);
        const RealInterval range = range_detail::table_range(box, table);
        double least = 1, most = -1;
        for (int n = 0; n < 400; ++n) {
            double place[5];
            for (int d = 0; d < 5; ++d) {
                const TableSpan& span = box[static_cast<std::size_t>(d)];
                const double off = d < 2 ? beyond : 0;
                const double at[] = {span.low - off, span.high + off,
                                     random.uniform(span.low, span.high)};
                place[d] = at[random.below(3)];
            }
            const double value = table.at(place);
            least = std::min(least, value);
            most = std::max(most, value);
            all &= value >= range.lo - 1e-12 && value <= range.hi + 1e-12;
        }
        shares += (most - least) / range.width() / boxes;
    }
    return all;
}

TEST(RangeTables, HoldWhatIsInterpolatedInABox) {
    double shares = 0;
    EXPECT_TRUE(table_ranges_hold(0, shares));
    EXPECT_GT(shares, 0.8);  // and little beside that
    EXPECT_FALSE(table_ranges_hold(0.5, shares));
}

TEST(RangeTables, KnowTheTurnsOfDirections) {
    Random random(8);
    double width = 0;
    const int boxes = rounds(2000);
    for (int i = 0; i < boxes; ++i) {
        const double x = random.uniform(-1, 1), y = random.chance(0.2) ? 0 : random.uniform(-1, 1);
        const double off = random.chance(0.5) ? 1e-6 : 0.1;
        const RealInterval turn =
            range_detail::turn_range(Ranged(x - off, x + off), Ranged(y - off, y + off));
        width += turn.width() / boxes;
        for (int n = 0; n < 8; ++n) {
            const double a = random.chance(0.5) ? x + off : random.uniform(x - off, x + off);
            const double b = random.chance(0.5) ? y - off : random.uniform(y - off, y + off);
            const double one = std::atan2(b, a) / (2 * 3.14159265358979323846);
            const double within = one - std::floor(one - turn.lo);
            ASSERT_LE(within, turn.hi + 1e-12) << a << ", " << b;
        }
    }
    EXPECT_LT(width, 0.15);
    EXPECT_GE(range_detail::turn_range(Ranged(-1e-9, 1e-9), Ranged(-1e-9, 1e-9)).width(), 1);
}

}  // namespace
}  // namespace quadrel::test
