// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <mrc/surface.h>

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace mrc {

/// Collects complaints; the message has the first few in full and the number of the others.
class Complaints {
  public:
    template <class Text>
    void add(ErrorCode code, const Element& element, Text&& text) {
        if (++count_ > shown) return;
        if (count_ == 1) code_ = code;
        elements_.push_back(element);
        if (!message_.empty()) message_ += "; ";
        message_ += text();
    }

    void raise() const {
        if (count_ == 0) return;
        const std::string more = count_ > shown ? "; and " + std::to_string(count_ - shown) + " more" : "";
        throw InvalidInput(code_, message_ + more, elements_);
    }

  private:
    static constexpr size_t shown = 3;
    size_t count_ = 0;
    ErrorCode code_{};               // of the first
    std::vector<Element> elements_;  // those that are shown
    std::string message_;
};

inline std::string element_name(const char* kind, int64_t id) { return std::string(kind) + " " + std::to_string(id); }

// Each copies one of the arrays that a surface is made from. @throws InvalidInput, naming the first few elements that are wrong.

void require_size(size_t size, const char* what);
std::vector<Vec3> copy_positions(std::span<const double> values);
std::vector<int> copy_offsets(std::span<const int32_t> offsets, size_t corner_count);
void check_faces(std::span<const int> face_offsets, std::span<const int> face_vertices, int vertex_count);
std::vector<uint8_t> mark_hidden(std::span<const int32_t> hidden_faces, int face_count);

}  // namespace mrc
