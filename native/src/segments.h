// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/types.h>

#include <cstddef>
#include <span>
#include <utility>

namespace mrc {

/// The pairs of consecutive points of a curve; of a closed one, also its last point with its first.
template <class Point>
class Segments {
  public:
    class Iterator {
      public:
        Iterator(std::span<const Point> points, std::size_t i) : points_(points), i_(i) {}

        std::pair<const Point&, const Point&> operator*() const {
            return {points_[i_], points_[i_ + 1 == points_.size() ? 0 : i_ + 1]};
        }
        Iterator& operator++() {
            ++i_;
            return *this;
        }
        bool operator==(const Iterator& other) const { return i_ == other.i_; }

      private:
        std::span<const Point> points_;
        std::size_t i_;
    };

    Segments(std::span<const Point> points, bool closed) : points_(points), closed_(closed) {}

    std::size_t size() const { return closed_ || points_.empty() ? points_.size() : points_.size() - 1; }
    Iterator begin() const { return {points_, 0}; }
    Iterator end() const { return {points_, size()}; }

  private:
    std::span<const Point> points_;
    bool closed_;
};

/// The points must outlive the range.
inline Segments<SurfacePoint> segments(const Contour& contour) { return {contour.points, contour.closed}; }
inline Segments<int> segments(std::span<const int> points, bool closed) { return {points, closed}; }

/// The point `step` points after point i, within one turn; null beyond the ends of an open contour.
inline const SurfacePoint* neighbor(const Contour& contour, std::ptrdiff_t i, std::ptrdiff_t step) {
    const auto count = static_cast<std::ptrdiff_t>(contour.points.size()), j = i + step;
    if (!contour.closed && (j < 0 || j >= count)) return nullptr;
    return &contour.points[(j + count) % count];
}

}  // namespace mrc
