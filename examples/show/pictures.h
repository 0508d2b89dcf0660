// Pictures of a demo's states, one after the other, from where the first one was seen.
#pragma once

#include <algorithm>
#include <thread>

#include "show/demo.h"

namespace show {

/// What stays as it is, is drawn once.
class Pictures {
  public:
    Pictures(const Demo& demo, const View& view)
        : demo_(demo), view_(view), camera_(corners_of(demo.soup()), view), still_(view) {
        draw_mesh();
    }

    Image next() {
        if (demo_.mesh_changes()) draw_mesh();
        Canvas canvas = still_;
        canvas.draw(camera_, demo_.dots());
        canvas.draw(camera_, demo_.lines());
        return canvas.image();
    }

  private:
    void draw_mesh() {
        draw(demo_.mesh(), camera_, still_, std::max(1u, std::thread::hardware_concurrency()), demo_.paint());
    }

    const Demo& demo_;
    View view_;
    Camera camera_;
    Canvas still_;
};

}  // namespace show
