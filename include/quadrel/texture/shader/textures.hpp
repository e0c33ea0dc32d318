// The textures that a recorded text knows by name, instead of by their texels.
#pragma once

#include <array>
#include <string>

#include "quadrel/num/shader/functions.hpp"
#include "quadrel/texture/view.hpp"

namespace quadrel {

/// A texture of a recorded text. Texts look at its sizes, its channels and its sampler's state
/// where they decide what to do; texels it has none.
struct ShaderTexture {
    SampledTexture texture{};
    std::string name;
    bool is_bound = false;
};

class ShaderTextures {
  public:
    static constexpr int most = 64;

    /// `texture` is known by its texels' address, which is nobody's.
    void bind(int slot, const std::string& name, const TextureView& view,
              const SamplerState& sampler) {
        ShaderTexture& entry = entries_[static_cast<std::size_t>(slot)];
        entry.texture = {view, sampler};
        entry.texture.view.texels = &tags_[static_cast<std::size_t>(slot)];
        entry.name = name;
        entry.is_bound = true;
    }
    const SampledTexture* texture(int slot) const {
        const ShaderTexture& entry = entries_[static_cast<std::size_t>(slot)];
        return entry.is_bound ? &entry.texture : nullptr;
    }

    const ShaderTexture& entry_of(const TextureView& view) const {
        const std::ptrdiff_t slot = view.texels - tags_.data();
        if (slot < 0 || slot >= most) throw recorded::RecordingError("reads a map of its own");
        return entries_[static_cast<std::size_t>(slot)];
    }
    /// A text may look a map up by a sampler of its own: the nearest texel.
    std::string name_of(const SampledTexture& texture) const {
        const ShaderTexture& entry = entry_of(texture.view);
        if (texture.sampler.mag == entry.texture.sampler.mag) return entry.name;
        if (texture.sampler.mag == Filter::nearest) return entry.name + "_nearest";
        throw recorded::RecordingError("filters a map that has no filter");
    }
    /// The texture whose table of sizes by level `table` is, and which: 0 width, 1 height.
    const TextureView* view_of_sizes(const std::int32_t* table, int& axis) const {
        for (const ShaderTexture& entry : entries_) {
            axis = table == entry.texture.view.height ? 1 : 0;
            if (axis == 1 || table == entry.texture.view.width) return &entry.texture.view;
        }
        return nullptr;
    }

    /// Those of the text that this thread records.
    static const ShaderTextures& current() {
        if (current_ == nullptr) throw recorded::RecordingError("no textures are known");
        return *current_;
    }
    class Use {
      public:
        explicit Use(const ShaderTextures& textures) : outer_(current_) { current_ = &textures; }
        Use(const Use&) = delete;
        Use& operator=(const Use&) = delete;
        ~Use() { current_ = outer_; }

      private:
        const ShaderTextures* outer_;
    };

  private:
    inline static thread_local const ShaderTextures* current_ = nullptr;
    std::array<ShaderTexture, most> entries_;
    std::array<float, most> tags_{};
};

namespace recorded {

/// A sampler, as an argument of look-ups.
inline Node* sampler(const SampledTexture& texture, const char* type) {
    const std::string name = ShaderTextures::current().name_of(texture);
    return Recorder::current().uniform(Type::integer, {name, type, 0});
}
/// The same where nothing is filtered.
inline Node* sampler(const TextureView& view, const char* type) {
    const std::string& name = ShaderTextures::current().entry_of(view).name;
    return Recorder::current().uniform(Type::integer, {name, type, 0});
}

/// A look-up in a texture: its name, and arguments after the sampler.
template <class Map>
Node* look_up(const char* function, const Map& map, std::vector<Node*> arguments,
              const char* type = "sampler2D") {
    arguments.insert(arguments.begin(), sampler(map, type));
    return call(Type::vec4, function, std::move(arguments));
}

}  // namespace recorded
}  // namespace quadrel
