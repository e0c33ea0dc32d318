// A stage's parameters by their names in the text of its function. Texts compute with plain numbers
// that no recording sees, so the text is recorded several times: where all that changes with a
// parameter are literals, and each is what a short expression of the parameter gives, that
// expression stands there.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "export/stages/recorded_stage.hpp"

namespace quadrel::recorded {

/// The fewest digits that read back as the number; whole ones without a point.
std::string shortest_number(double value);

class NamedParameters {
  public:
    /// `params`: the stage's Params, or null for the defaults.
    NamedParameters(const RecordedStage& stage, const ShaderScene& scene, const void* params);

    /// What they are called, in their order.
    const std::vector<std::string>& names() const { return names_; }

    /// Records the text. Throws RecordingError.
    void record(Graph& graph) const;

    /// What record() has left in the text as numbers or by what it does: "steps = 16, smooth = on";
    /// empty where there is nothing.
    std::string written_in(const Graph& graph) const;

  private:
    using Params = std::vector<std::max_align_t>;
    using Nodes = std::vector<std::unique_ptr<Node>>;
    /// A literal, by its place among the nodes, and the forms of its type that give its value: of
    /// the parameter, or of the greater of it and another.
    struct Place {
        std::size_t node;
        int whole, real;
        int other;  ///< parameter; -1 for none
    };
    struct Places {
        std::vector<Place> all;
        bool has_least, has_most;  ///< whether the parameter's ends have the same text
    };
    struct Found {
        int parameter;
        Places places;
        double value;
    };

    Params with(int parameter, double value) const;
    bool is_value(int parameter, double value) const;
    std::optional<double> value_of(int parameter) const;
    bool changes(int parameter, const Graph& graph) const;
    bool records(Graph& graph, int parameter, double value) const;

    std::optional<Places> places_of(int parameter, const Graph& graph) const;
    std::optional<Place> place_of(int parameter, std::size_t node, const std::vector<Graph>& others,
                                  const std::vector<double>& values) const;
    bool fits(const Node& literal, int parameter, double value, const Place& place) const;
    Node* expression(const Node& literal, int parameter, const Place& place) const;
    std::optional<double> value_at(int parameter, const Graph& graph, const Places& places) const;
    void put(int parameter, const Place& place, Graph& graph, Nodes& made) const;
    std::vector<Found> all_places(const Graph& graph) const;

    const RecordedStage& stage_;
    const ShaderScene& scene_;
    Params params_;
    std::vector<std::string> names_;
};

}  // namespace quadrel::recorded
