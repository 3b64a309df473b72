/* What Eigen includes first of SSE: Emscripten's, with splats that Clang 14 compiles right. Its load of a value that fills a
   vector may pass stores that come behind it, as in `v = m * v`: here the value is in a register before it is spread. */
#ifndef SKELGEN_WASM_MMINTRIN_H
#define SKELGEN_WASM_MMINTRIN_H
#include <emmintrin.h>

static inline double skelgen_loaded(double value) {
    __asm__("" : "+r"(value));
    return value;
}
static inline float skelgen_loaded_float(float value) {
    __asm__("" : "+r"(value));
    return value;
}
static inline int skelgen_loaded_int(int value) {
    __asm__("" : "+r"(value));
    return value;
}
#undef _mm_set1_pd
#undef _mm_set_ps1
#undef _mm_set1_epi32
#define _mm_set1_pd(value) ((__m128d)wasm_f64x2_splat(skelgen_loaded(value)))
#define _mm_set_ps1(value) ((__m128)wasm_f32x4_splat(skelgen_loaded_float(value)))
#define _mm_set1_epi32(value) ((__m128i)wasm_i32x4_splat(skelgen_loaded_int(value)))
#endif
