// The clock of a scene of POV-Ray, as a function of the time of its flight.
#pragma once
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "pov/ini_file.h"

namespace strahl::pov {

/// The frames of an animation. Frame `first` is at 0 s, and 25 of them last a second: POV-Ray's have no time.
struct Animation {
    int first = 1, last = 1;
    double initial_clock = 0, final_clock = 1;
    bool cyclic = false;                     // the last frame is followed by the first one
    double first_shown = 1, last_shown = 1;  // Subset_Start_Frame and Subset_End_Frame
    double seconds = 10;                     // how long it takes
    bool counted = false;                    // does an .ini file give the frames?

    /// The clock changes from its first to its last value within `flight` seconds, unless the file gives frames.
    static Animation of(const std::optional<IniFile>& ini, std::optional<double> flight);
    double clock_at(double time) const;
    /// Returns the numbers that POV-Ray declares for a frame, such as frame_number.
    std::vector<std::pair<std::string, double>> declared_at(double time) const;
    /// Returns the frames that the file asks for, counted from 0.
    std::pair<int, int> frames() const;

  private:
    double steps() const;
    int frame_at(double time) const;
};

}  // namespace strahl::pov
