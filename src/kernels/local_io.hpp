// What a stage sees of a packet where it runs as a part of a chain.
#pragma once

#include <utility>

#include "quadrel/quad/promises.hpp"
#include "quadrel/quad/stage.hpp"

namespace quadrel {

/// Whether the stage runs once for each light.
template <class Stage>
constexpr bool serves_lights() {
    return std::any_of(Stage::outputs.begin(), Stage::outputs.end(),
                       [](Value v) { return info(v).per_light; });
}

/// The components of one value on one packet; of those that no link hands to another, nothing.
template <class F, Value v, bool is_kept>
struct LocalValue {};
template <class F, Value v>
struct LocalValue<F, v, true> {
    std::conditional_t<info(v).kind == ValueKind::integer, Int<F>, F> parts[arrays_of(v)];
};

/// Whether a link of the chain loads what one before it stores.
template <class Chain>
constexpr bool is_handed_on(Value v) {
    for (std::size_t at = 0; at < Chain::length; ++at)
        if (Chain::stores_before(at, v) && Chain::loads_behind(at - 1, v)) return true;
    return false;
}

template <class Chain, class F, class = std::make_index_sequence<std::size_t(Value::count)>>
struct LocalValues;
template <class Chain, class F, std::size_t... v>
struct LocalValues<Chain, F, std::index_sequence<v...>>
    : LocalValue<F, Value(v), is_handed_on<Chain>(Value(v))>... {
    template <Value of>
    auto& parts() {
        return static_cast<LocalValue<F, of, true>&>(*this).parts;
    }
};

/// In which lanes stages have broken a promise: at least where render/draw/border_check.hpp finds a
/// fault. Who finds more than it has the stages run one by one, and is told that all is well.
template <class F>
struct BrokenPromises {
    Mask<F> any_rule{false};
    Mask<F> no_parameter{false}, is_hit{false};  ///< of the search that is running

    template <Value v, class X>
    void look_at(const X& x) {
        constexpr std::uint32_t end = allowed_end(v);
        if constexpr (end != 0)
            any_rule = any_rule |
                       ((Int<F>(x) & Int<F>(static_cast<std::int32_t>(~(end - 1)))) != Int<F>(0));
        if constexpr (v == Value::hit_status)
            is_hit = Int<F>(x) == Int<F>(static_cast<std::int32_t>(Status::hit));
        if constexpr (v == Value::hit_s) no_parameter = is_nan(F(x));
        if constexpr (v == Value::relief_depth) any_rule = any_rule | (F(x) < F(0));
    }
    void end_search() { any_rule = any_rule | (no_parameter & is_hit); }
};

/// One packet's view of a StageCall for the stage at `at` of a chain. Arrays are null where no one
/// outside of the chain reads them.
template <class Chain, std::size_t at, class F>
class LocalIo : public PacketIo<typename Chain::template Stage<at>, F> {
    using Stage = typename Chain::template Stage<at>;

  public:
    LocalIo(const StageCall& call, int first_lane, int light, LocalValues<Chain, F>& values,
            BrokenPromises<F>& broken)
        : PacketIo<Stage, F>(call, first_lane), light_(light), values_(values), broken_(broken) {}

    template <Value v>
    auto load(int light = 0) const {
        static_assert(contains(Stage::inputs, v), "not among the stage's inputs");
        constexpr int n = info(v).components;
        if constexpr (Chain::stores_before(at, v)) {
            const auto* const parts = values_.template parts<v>() + light * n;
            return detail::assemble<n>([&](int i) { return parts[i]; });
        } else {
            const int slot = slot_of(v) + light * n;
            return detail::assemble<n>([&](int i) {
                if constexpr (info(v).kind == ValueKind::integer)
                    return load_int<F>(array<std::int32_t>(slot + i));
                else
                    return quadrel::load<F>(array<Scalar<F>>(slot + i));
            });
        }
    }

    template <Value v, class X>
    void store(const X& x, int light = 0) const {
        static_assert(contains(Stage::outputs, v), "not among the stage's outputs");
        constexpr int n = info(v).components;
        using Part = std::conditional_t<info(v).kind == ValueKind::integer, Int<F>, F>;
        const int slot = slot_of(v) + light * n;
        if (!wanted<v>(light)) return;
        if constexpr (n == 1) broken_.template look_at<v>(x);
        if constexpr (is_loaded<v>()) {
            auto* const parts = values_.template parts<v>() + light * n;
            detail::take_apart<n>(x, [&](int i, const Part& c) { parts[i] = c; });
        }
        if (!this->call_.values[slot]) return;
        detail::take_apart<n>(x, [&](int i, const Part& c) {
            using Element =
                std::conditional_t<info(v).kind == ValueKind::integer, std::int32_t, Scalar<F>>;
            detail::store_packet(array<Element>(slot + i), c);
        });
    }

    template <Value v>
    bool wanted(int light = 0) const {
        static_assert(contains(Stage::outputs, v), "not among the stage's outputs");
        return is_loaded<v>() ||
               this->call_.values[slot_of(v) + light * info(v).components] != nullptr;
    }

    int light() const { return light_; }

  private:
    /// Whether a later link loads it. It stands among the plan's values then.
    template <Value v>
    static constexpr bool is_loaded() {
        return Chain::loads_behind(at, v);
    }
    template <class Element>
    Element* array(int slot) const {
        return static_cast<Element*>(this->call_.values[slot]) + this->lane_;
    }

    int light_;
    LocalValues<Chain, F>& values_;
    BrokenPromises<F>& broken_;
};

}  // namespace quadrel
