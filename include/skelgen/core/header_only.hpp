#pragma once

/// Two ways to use skelgen, one code. Every header x.hpp of the core declares and documents; impl/x.hpp defines. What
/// one stage alone uses stands in its impl/, without a declaration.
///
/// - Linked (the default): only declarations are seen; the definitions are compiled once for each of float and double
///   into the library `skelgen::skelgen` (src/instantiate/).
/// - Header-only: where SKELGEN_HEADER_ONLY is defined (the target `skelgen::core` does that), each header includes its
///   definitions, for any floating-point scalar, and nothing of skelgen is linked.
///
/// SKELGEN_INLINE marks functions that are no templates; `inline`, too, where the library's second scalar is compiled.
#ifdef SKELGEN_HEADER_ONLY
#define SKELGEN_INLINE inline
#elif !defined(SKELGEN_INLINE)
#define SKELGEN_INLINE
#endif
