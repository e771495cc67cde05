#pragma once
/// \file
/// Whether this is a build under AddressSanitizer.

#if defined(__SANITIZE_ADDRESS__)
#define SLIPFRONT_SANITIZED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define SLIPFRONT_SANITIZED 1
#endif
#endif
#ifndef SLIPFRONT_SANITIZED
#define SLIPFRONT_SANITIZED 0
#endif
