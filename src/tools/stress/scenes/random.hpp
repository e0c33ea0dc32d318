// Random numbers that are the same everywhere: no distribution of the standard library is.
#pragma once

#include <charconv>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace quadrel::stress {

/// SplitMix64 (Steele, Lea and Flood 2014). A scene's numbers depend on seed and number alone.
class Random {
  public:
    Random(std::uint64_t seed, std::uint64_t stream) : state_(seed) {
        state_ = next() ^ (stream * 0xd1342543de82ef95u);
        next();
    }

    std::uint64_t next() {
        std::uint64_t z = state_ += 0x9e3779b97f4a7c15u;
        z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
        z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
        return z ^ (z >> 31);
    }
    /// In [0, 1).
    double unit() { return static_cast<double>(next() >> 11) / 9007199254740992.0; }
    double between(double from, double to) { return from + (to - from) * unit(); }
    /// In [0, count), count >= 1.
    int index(std::size_t count) { return static_cast<int>(next() % count); }
    /// In [from, to].
    int whole(int from, int to) {
        return from + index(static_cast<std::size_t>(static_cast<std::int64_t>(to) - from + 1));
    }
    bool chance(double share) { return unit() < share; }
    bool coin() { return chance(0.5); }
    double sign() { return coin() ? 1 : -1; }

    template <class T>
    const T& pick(const std::vector<T>& from) {
        return from[static_cast<std::size_t>(index(from.size()))];
    }
    const char* pick(std::initializer_list<const char*> from) {
        return std::data(from)[index(from.size())];
    }
    /// Positive, three digits, of a decimal exponent in [from, to]: the same double everywhere.
    double decade(int from, int to) {
        const std::string text =
            std::to_string(whole(100, 999)) + "e" + std::to_string(whole(from, to) - 2);
        double value = 0;
        std::from_chars(text.data(), text.data() + text.size(), value);
        return value;
    }

    /// The same of either sign.
    double signed_decade(int from, int to) {
        const double side = sign();
        return side * decade(from, to);
    }

  private:
    std::uint64_t state_;
};

}  // namespace quadrel::stress
