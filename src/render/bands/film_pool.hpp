// Memory that one band's film leaves to the next.
#pragma once

#include <memory>
#include <mutex>
#include <utility>
#include <vector>

#include "quadrel/film/film.hpp"

namespace quadrel {

/// Films come back when nobody holds them any more, whether the pool is still there or not.
class FilmPool {
  public:
    /// One that nobody holds, with whatever was drawn into it.
    std::shared_ptr<Film> take() {
        std::unique_ptr<Film> film = state_->take();
        return {film.release(), [state = state_](Film* used) { state->give(used); }};
    }

  private:
    class State {
      public:
        std::unique_ptr<Film> take() {
            const std::lock_guard lock(mutex_);
            if (free_.empty()) return std::make_unique<Film>();
            std::unique_ptr<Film> film = std::move(free_.back());
            free_.pop_back();
            return film;
        }

        void give(Film* film) {
            const std::lock_guard lock(mutex_);
            free_.emplace_back(film);
        }

      private:
        std::mutex mutex_;
        std::vector<std::unique_ptr<Film>> free_;
    };

    std::shared_ptr<State> state_ = std::make_shared<State>();
};

}  // namespace quadrel
