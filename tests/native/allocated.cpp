// SPDX-License-Identifier: GPL-3.0-or-later
#include "allocated.h"

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t allocated = 0;
}

// All that may meet in one pointer, since the address sanitizer has its own of those that are not replaced.
void* operator new(std::size_t size, const std::nothrow_t&) noexcept {
    allocated += size;
    return std::malloc(size > 0 ? size : 1);
}

void* operator new(std::size_t size) {
    if (void* memory = operator new(size, std::nothrow)) return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }

namespace mrc_test {

std::size_t allocated_bytes() { return allocated; }

}  // namespace mrc_test
