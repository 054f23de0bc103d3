// Makes a scene's pigments and reliefs of POV-Ray's.
#pragma once
#include <map>
#include <optional>

#include "pov/meaning/notes.h"
#include "pov/things/pattern_values.h"
#include "pov/things/textures.h"
#include "scene/material.h"
#include "text/reading/scene_files.h"

namespace strahl::pov {

/// A pigment, and how much light its colours let through: in the mean, and whether that varies from place to place.
struct Look {
    Pigment pigment{Color(0)};
    double filter = 0, transmit = 0;
    bool varies = false;
    /// Returns the pigment whose colours let through as much as these, but for pictures; and the one whose colours let
    /// nothing through.
    Pigment clear() const;
    Pigment opaque() const;
};

class PigmentMaker {
  public:
    PigmentMaker(NoteTaker notes, bool mirrored) : notes(notes), mirrored(mirrored) {}

    /// `way` leads from the texture's space into that of the body, whose places by uv are `uv`.
    Look look_of(const PigmentThing& pigment, const Steps& way, const UvMapping& uv);
    Bump bump_of(const NormalThing& normal, const Steps& way, const UvMapping& uv);
    /// Returns the largest value of a pigment's colours, at least 1.
    static double largest_of(const PigmentThing& pigment) { return brightest_of(pigment).value; }
    /// Do any of a pigment's colours let light through?
    static bool is_clear(const PigmentThing& pigment) {
        const Brightest most = brightest_of(pigment);
        return most.filters || most.transmits;
    }

  private:
    struct Mean {
        Color color{0};
        double filter = 0, transmit = 0;
    };
    Look shown_look_of(const PigmentThing& pigment, const Steps& way, const UvMapping& uv);
    Mean mean_of(const MapEntry& entry);
    Mean mean_of(const PigmentThing& pigment);
    Mean mean_of(const MapThing& map, bool list);
    ColorStop stop_of(const Blend& blend, const MapEntry& entry, double at);
    std::vector<ColorStop> stops_of(const Blend& blend);
    std::vector<ColorStop> listed_stops(const Blend& blend);
    std::optional<SolidPattern> solid_of(const Blend& blend, bool bends) const;
    std::shared_ptr<const FilePixels> pixels_of(const Blend& blend) const;
    void tell_ignored(const Blend& blend) const;
    bool is_shown(const Blend& blend) const;
    /// The largest value of a pigment's colours, at least 1, and whether any of them lets light through.
    struct Brightest {
        double value = 1;
        bool filters = false, transmits = false;
        /// Returns a pigment with this as its bounds.
        Pigment of(Pattern pattern) const;
    };
    static Brightest brightest_of(const PigmentThing& pigment);
    bool set_channels(const std::shared_ptr<const FunctionThing>& colors, const Blend& blend, const Brightest& most,
                      Pattern& pattern);
    std::vector<Transformation> space_of(const Blend& blend, const Steps& way) const;
    std::vector<Transformation> space_of_argument(const Blend& blend, const Steps& way) const;

    NoteTaker notes;
    const bool mirrored;
    bool add_mean(const Blend& blend, Pattern& pattern);
    Moves moves_inside(const Blend& blend) const;

    /// Holds what a pigment in a map became, and whether it has patterns that are nested too deeply.
    struct MadeStop {
        ColorStop stop;
        bool too_deep;
    };
    // Keep what was made of pigments in maps, so that bodies share it; stops also by how many patterns are around them.
    std::map<std::shared_ptr<const Thing>, Mean> means;
    std::map<std::pair<std::shared_ptr<const Thing>, int>, MadeStop> made_stops;
    MadeColors made_colors;
    // From the space of the pigment that is made, if it is nested: into that of the pattern around it, where that
    // cannot be done by transformations.
    Moves around;
    int patterns_around = 0;               // the pigment that is made
    bool too_deep = false;                 // it has patterns that are nested more deeply than the scene's
    static constexpr int most_nested = 4;  // as scene text has it
};

}  // namespace strahl::pov
