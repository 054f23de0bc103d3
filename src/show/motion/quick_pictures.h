// Makes pictures in little time: those in motion, and the first ones of views at rest.
#pragma once
#include <functional>

#include "image/transfer_table.h"
#include "show/motion/resolution.h"
#include "show/motion/screen_image.h"
#include "show/motion/sharpener.h"
#include "trace/tracer.h"

namespace strahl {

class QuickPictures {
  public:
    struct Wish {
        double budget = 0;           // seconds for a picture at full rate
        double sharpened_until = 0;  // seconds that it may take with sharpening; 0: it is not sharpened
        int finest = finest_level;   // the finest level of the traced pixels
        bool averages = false;       // patterns are averaged over squares between traced pixels
        double contrast = 0;         // of light in cells that are filled: twice what their pixels may be off
    };
    /// Returns the level whose pixels can be traced in time.
    int choose(int width, int height, const Wish& wish);
    /// Traces the pixels of a level, interpolates the others, and sharpens the picture. More light is pruned than the
    /// job's view asks for. `clock` returns the seconds since it was begun. `learns`: the next level is chosen by the
    /// time that this one takes. If the job is stopped, the picture is of no use.
    Counts trace(Tracer& tracer, const Job& job, const TransferTable& table, const Wish& wish, int level,
                 const std::function<double()>& clock, bool learns, ScreenImage& picture);

  private:
    Resolution resolution;
    double aspect = 1;  // aspect ratio of the next picture's steps
    Sharpener sharpener;
    ScreenImage coarse;  // the traced pixels of a level
};

}  // namespace strahl
