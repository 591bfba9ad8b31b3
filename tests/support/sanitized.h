// Whether this is a build with AddressSanitizer or ThreadSanitizer, in which everything takes far longer.
#pragma once

namespace unshot::testing_support {

// GCC defines names of its own, Clang knows features.
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr bool kSanitized = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
inline constexpr bool kSanitized = true;
#else
inline constexpr bool kSanitized = false;
#endif
#else
inline constexpr bool kSanitized = false;
#endif

}  // namespace unshot::testing_support
