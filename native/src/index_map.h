// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace mrc {

/// Numbers keys of 0 and above in the order in which they are met: a flat hash table, since the stages look up little else.
class IndexMap {
  public:
    IndexMap() : slots_(64, {empty, 0}) {}

    /// The key's number, or -1.
    int find(int key) const {
        for (std::size_t i = home(key);; i = (i + 1) & (slots_.size() - 1)) {
            if (slots_[i].key == key) return slots_[i].number;
            if (slots_[i].key == empty) return -1;
        }
    }

    /// The key's number, a new one where it was not met before.
    int insert(int key) {
        if (2 * static_cast<std::size_t>(size_) >= slots_.size()) grow();
        for (std::size_t i = home(key);; i = (i + 1) & (slots_.size() - 1)) {
            if (slots_[i].key == key) return slots_[i].number;
            if (slots_[i].key == empty) {
                slots_[i] = {key, size_};
                return size_++;
            }
        }
    }

    int size() const { return size_; }

    /// Room for so many keys.
    void reserve(int count) {
        while (slots_.size() < 2 * static_cast<std::size_t>(count)) grow();
    }

  private:
    static constexpr int empty = -1;
    struct Slot {
        int key, number;
    };
    std::vector<Slot> slots_;  // a power of two
    int size_ = 0;

    std::size_t home(int key) const {
        return (static_cast<std::uint64_t>(key) * 0x9E3779B97F4A7C15ULL >> 32) & (slots_.size() - 1);
    }

    void grow() {
        std::vector<Slot> old(2 * slots_.size(), {empty, 0});
        old.swap(slots_);
        for (const Slot& slot : old) {
            if (slot.key == empty) continue;
            std::size_t i = home(slot.key);
            while (slots_[i].key != empty) i = (i + 1) & (slots_.size() - 1);
            slots_[i] = slot;
        }
    }
};

}  // namespace mrc
