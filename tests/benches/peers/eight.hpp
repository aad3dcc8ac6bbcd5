// C code that CasADi generates, for eight states at once: `casadi_real` is a vector of eight numbers, or two of four, and
// sines and cosines are those of libmvec, which a compiler takes for loops. A file includes this, then the C.
#include <math.h>
#include <immintrin.h>

#define INLINED inline __attribute__((always_inline))

#ifdef __AVX512F__
typedef __m512d Part;
extern "C" Part _ZGVeN8v_sin(Part);
extern "C" Part _ZGVeN8v_cos(Part);
#define LIBMVEC(name) _ZGVeN8v_##name
#define PARTS(expression) PART(a, expression)
#else
typedef __m256d Part;
extern "C" Part _ZGVdN4v_sin(Part);
extern "C" Part _ZGVdN4v_cos(Part);
#define LIBMVEC(name) _ZGVdN4v_##name
#define PARTS(expression) PART(a, expression) PART(b, expression)
#endif

struct Eight {
#define PART(p, expression) Part p;
    PARTS()
#undef PART
    INLINED Eight() {}
#define PART(p, expression) p = Part{} + number;
    INLINED Eight(double number) { PARTS() }
#undef PART
#define PART(p, expression) z.p = expression(p);
#define PLUS(p) x.p + y.p
#define MINUS(p) x.p - y.p
#define TIMES(p) x.p * y.p
#define OVER(p) x.p / y.p
#define NEGATED(p) -x.p
#define SINE(p) LIBMVEC(sin)(x.p)
#define COSINE(p) LIBMVEC(cos)(x.p)
#define RESULT(expression) { Eight z; PARTS(expression) return z; }
    friend INLINED Eight operator+(Eight x, Eight y) RESULT(PLUS)
    friend INLINED Eight operator-(Eight x, Eight y) RESULT(MINUS)
    friend INLINED Eight operator*(Eight x, Eight y) RESULT(TIMES)
    friend INLINED Eight operator/(Eight x, Eight y) RESULT(OVER)
    friend INLINED Eight operator-(Eight x) RESULT(NEGATED)
    friend INLINED Eight sin(Eight x) RESULT(SINE)
    friend INLINED Eight cos(Eight x) RESULT(COSINE)
};

#define casadi_real Eight
