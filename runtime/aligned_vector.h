// std::vector whose storage is aligned as kernels ask (kernel_abi.h), long ones on large pages.
#pragma once

#if defined(__linux__)
#include <sys/mman.h>
#endif

#include <cstddef>
#include <new>
#include <vector>

namespace elastogen {

inline constexpr std::size_t kernel_alignment = 64;

/// Arrays from this size on lie on pages of this size where the system has them: a stream through
/// memory looks up fewer addresses.
inline constexpr std::size_t large_page = std::size_t{2} << 20;

template <class T>
struct AlignedAllocator {
  using value_type = T;

  AlignedAllocator() = default;
  template <class U>
  AlignedAllocator(const AlignedAllocator<U>&) {}

  T* allocate(std::size_t n) {
    void* const p = ::operator new(n * sizeof(T), alignment(n));
#if defined(MADV_HUGEPAGE)
    // Only advice: where it is refused, small pages do.
    const std::size_t bytes = n * sizeof(T) / large_page * large_page;
    if (bytes > 0) ::madvise(p, bytes, MADV_HUGEPAGE);
#endif
    return static_cast<T*>(p);
  }
  void deallocate(T* p, std::size_t n) noexcept { ::operator delete(p, alignment(n)); }
  static std::align_val_t alignment(std::size_t n) {
    return std::align_val_t(n * sizeof(T) >= large_page ? large_page : kernel_alignment);
  }
  template <class U>
  bool operator==(const AlignedAllocator<U>&) const {
    return true;
  }
};

template <class T>
using AlignedVector = std::vector<T, AlignedAllocator<T>>;

}  // namespace elastogen
