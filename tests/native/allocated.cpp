// SPDX-License-Identifier: GPL-3.0-or-later
#include "allocated.h"

#include <cstdlib>
#include <new>

namespace {
thread_local std::size_t allocated = 0;
}

#ifndef MRC_SANITIZED  // a sanitizer checks its own
void* operator new(std::size_t size) {
    allocated += size;
    if (void* memory = std::malloc(size > 0 ? size : 1)) return memory;
    throw std::bad_alloc();
}

void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
#endif

namespace mrc_test {

std::size_t allocated_bytes() { return allocated; }

}  // namespace mrc_test
