// A stage of someone else's: the colour map in two tones.
#include "quadrel/plugin.hpp"

using namespace quadrel;

struct TwoTones : StageDefaults {
    static constexpr StageText text{"two-tones", "shade", "light or dark", "an example"};
    static constexpr auto inputs = values(Value::dUVdx, Value::dUVdy, Value::hit_uv);
    static constexpr auto outputs = values(Value::color, Value::opacity);
    static constexpr auto textures = slots(TextureSlot::color);

    template <class Io>
    void operator()(Io& io, const Params&) const {
        using F = typename Io::Number;
        const vec3<F> base = rgb(map_at_hit<TextureSlot::color>(io, vec4<F>(F(1))));
        const F grey = dot(base, vec3<F>(F(0.2126f), F(0.7152f), F(0.0722f)));
        io.template store<Value::color>(vec3<F>(step(F(0.2f), grey)));
        io.template store<Value::opacity>(F(1));
    }
};
QUADREL_STAGES(TwoTones);
