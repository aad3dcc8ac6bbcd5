// C code that CasADi generates, for eight states at once: `casadi_real` is a vector of eight numbers, and sines and
// cosines are those of libmvec, which a compiler takes for loops. A file defines nothing else, and includes the C.
#include <math.h>
#if defined(__AVX512F__) || defined(__AVX2__)
#include <immintrin.h>
#else
#error "libmvec has eight sines at once for AVX2 and AVX-512 only"
#endif

typedef double Numbers __attribute__((vector_size(64)));

#define INLINED inline __attribute__((always_inline))

#ifdef __AVX512F__
extern "C" __m512d _ZGVeN8v_sin(__m512d);
extern "C" __m512d _ZGVeN8v_cos(__m512d);
#define LIBMVEC(name) \
    static INLINED Numbers name##_of(Numbers x) { return (Numbers)_ZGVeN8v_##name((__m512d)x); }
#else
extern "C" __m256d _ZGVdN4v_sin(__m256d);
extern "C" __m256d _ZGVdN4v_cos(__m256d);
#define LIBMVEC(name)                                                     \
    static INLINED Numbers name##_of(Numbers x) {                         \
        union { Numbers all; __m256d half[2]; } both = {x};               \
        both.half[0] = _ZGVdN4v_##name(both.half[0]);                     \
        both.half[1] = _ZGVdN4v_##name(both.half[1]);                     \
        return both.all;                                                  \
    }
#endif
LIBMVEC(sin)
LIBMVEC(cos)

struct Eight {
    Numbers of;
    INLINED Eight() {}
    INLINED Eight(Numbers numbers) : of(numbers) {}
    INLINED Eight(double number) : of(Numbers{} + number) {}
    friend INLINED Eight operator+(Eight a, Eight b) { return a.of + b.of; }
    friend INLINED Eight operator-(Eight a, Eight b) { return a.of - b.of; }
    friend INLINED Eight operator*(Eight a, Eight b) { return a.of * b.of; }
    friend INLINED Eight operator/(Eight a, Eight b) { return a.of / b.of; }
    friend INLINED Eight operator-(Eight a) { return -a.of; }
    friend INLINED Eight sin(Eight a) { return sin_of(a.of); }
    friend INLINED Eight cos(Eight a) { return cos_of(a.of); }
};

#define casadi_real Eight
