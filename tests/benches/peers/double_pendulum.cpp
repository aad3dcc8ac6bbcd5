// The rotating double pendulum by hand: closed forms in absolute angles, no library, no allocation.
//
// With phi_1, phi_2 from the vertical, s = sin phi, k = cos phi, everything is linear in five constants of the bars,
//
//   c11 = l1^2 (m1/3 + m2)   c12 = l1 l2 m2/2   c22 = l2^2 m2/3   d1 = l1 (m1/2 + m2)   d2 = l2 m2/2
//
//   R_i  = g d_i s_i - w^2 k_i (c_i1 s_1 + c_i2 s_2)
//   K_ii = g d_i k_i + w^2 s_i (c_i1 s_1 + c_i2 s_2) - w^2 c_ii k_i^2      K_12 = -w^2 c12 k_1 k_2
//   M_ii = c_ii                                                            M_12 = c12 cos(phi_1 - phi_2)
//
// so that derivatives by the four dimensions are derivatives by these five, times a small Jacobian.

#include <cmath>

namespace {

constexpr double gravity = 9.81;

struct Bars {
    double c11, c12, c22, d1, d2;
};

struct Design {
    double l1, l2, m1, m2;

    Bars bars() const {
        return {l1 * l1 * (m1 / 3 + m2), l1 * l2 * m2 / 2, l2 * l2 * m2 / 3, l1 * (m1 / 2 + m2), l2 * m2 / 2};
    }
};

struct Angles {
    double phi1, phi2;
};

struct State {
    double s1, k1, s2, k2;
    double p1, p2;  // w^2 (c_i1 s_1 + c_i2 s_2)
    double k11, k12, k22;
    double r1, r2;
};

inline State state(const Bars &b, double w2, const Angles &a) {
    State x;
    x.s1 = std::sin(a.phi1);
    x.k1 = std::cos(a.phi1);
    x.s2 = std::sin(a.phi2);
    x.k2 = std::cos(a.phi2);
    const double wc12 = w2 * b.c12, wc11 = w2 * b.c11, wc22 = w2 * b.c22;
    x.p1 = wc11 * x.s1 + wc12 * x.s2;
    x.p2 = wc12 * x.s1 + wc22 * x.s2;
    const double g1 = gravity * b.d1, g2 = gravity * b.d2;
    x.r1 = g1 * x.s1 - x.k1 * x.p1;
    x.r2 = g2 * x.s2 - x.k2 * x.p2;
    x.k11 = g1 * x.k1 + x.s1 * x.p1 - wc11 * x.k1 * x.k1;
    x.k12 = -wc12 * x.k1 * x.k2;
    x.k22 = g2 * x.k2 + x.s2 * x.p2 - wc22 * x.k2 * x.k2;
    return x;
}

// Newton's method; the step that follows one below 1e-7 would be below rounding.
inline State equilibrium(const Bars &b, double w2, Angles &a, bool &found) {
    for (int iteration = 0; iteration < 50; ++iteration) {
        const State x = state(b, w2, a);
        const double inverse = 1 / (x.k11 * x.k22 - x.k12 * x.k12);
        const double step1 = (x.k22 * x.r1 - x.k12 * x.r2) * inverse;
        const double step2 = (x.k11 * x.r2 - x.k12 * x.r1) * inverse;
        a.phi1 -= step1;
        a.phi2 -= step2;
        if (std::fabs(step1) + std::fabs(step2) < 1e-7) {
            found = true;
            return state(b, w2, a);
        }
    }
    found = false;
    return state(b, w2, a);
}

struct Pair {
    double low, high;
};

// det(K - lambda M) = 0.
inline Pair eigenvalues(const State &x, const Bars &b, double m12) {
    const double m = b.c11 * b.c22 - m12 * m12;
    const double half = 0.5 * (b.c11 * x.k22 + b.c22 * x.k11) - m12 * x.k12;
    const double k = x.k11 * x.k22 - x.k12 * x.k12;
    const double high = half + std::sqrt(half * half - m * k);
    return {k / high, high / m};
}

// Total derivatives of one eigenvalue by l1, l2, m1, m2, the motion of the equilibrium included.
inline void derivatives(const Design &d, const Bars &b, double w2, const State &x, double m12, double kd, double sd,
                        double inverse, double lambda, double scale, double *out) {
    // the row of K - lambda M whose entries are larger
    const double a11 = x.k11 - lambda * b.c11, a12 = x.k12 - lambda * m12, a22 = x.k22 - lambda * b.c22;
    double f1 = a12, f2 = -a11;
    if (std::fabs(a22) > std::fabs(a11)) {
        f1 = a22;
        f2 = -a12;
    }
    const double n = 1 / (f1 * f1 * b.c11 + 2 * f1 * f2 * m12 + f2 * f2 * b.c22);
    const double f11 = f1 * f1 * n, f12 = f1 * f2 * n, f22 = f2 * f2 * n;
    // by the angles
    const double wc12 = w2 * b.c12;
    const double by1 = f11 * (3 * w2 * b.c11 * x.k1 * x.s1 + x.k1 * x.p1 - gravity * b.d1 * x.s1) +
                       f12 * 2 * (wc12 * x.s1 * x.k2 + lambda * b.c12 * sd) + f22 * wc12 * x.s2 * x.k1;
    const double by2 = f22 * (3 * w2 * b.c22 * x.k2 * x.s2 + x.k2 * x.p2 - gravity * b.d2 * x.s2) +
                       f12 * 2 * (wc12 * x.k1 * x.s2 - lambda * b.c12 * sd) + f11 * wc12 * x.s1 * x.k2;
    const double w_1 = (x.k22 * by1 - x.k12 * by2) * inverse;
    const double w_2 = (x.k11 * by2 - x.k12 * by1) * inverse;
    // by the constants
    const double v11 = f11 * (w2 * (x.s1 * x.s1 - x.k1 * x.k1) - lambda) + w_1 * w2 * x.k1 * x.s1;
    const double v22 = f22 * (w2 * (x.s2 * x.s2 - x.k2 * x.k2) - lambda) + w_2 * w2 * x.k2 * x.s2;
    const double v12 = (f11 + f22) * w2 * x.s1 * x.s2 - 2 * f12 * (w2 * x.k1 * x.k2 + lambda * kd) +
                       w2 * (w_1 * x.k1 * x.s2 + w_2 * x.k2 * x.s1);
    const double vd1 = gravity * (f11 * x.k1 - w_1 * x.s1);
    const double vd2 = gravity * (f22 * x.k2 - w_2 * x.s2);
    // by the dimensions
    out[0] = scale * (v11 * 2 * d.l1 * (d.m1 / 3 + d.m2) + v12 * d.l2 * d.m2 / 2 + vd1 * (d.m1 / 2 + d.m2));
    out[1] = scale * (v12 * d.l1 * d.m2 / 2 + v22 * 2 * d.l2 * d.m2 / 3 + vd2 * d.m2 / 2);
    out[2] = scale * (v11 * d.l1 * d.l1 / 3 + vd1 * d.l1 / 2);
    out[3] = scale * (v11 * d.l1 * d.l1 + v12 * d.l1 * d.l2 / 2 + v22 * d.l2 * d.l2 / 3 + vd1 * d.l1 + vd2 * d.l2 / 2);
}

inline Design unpack(const double *design) { return {design[0], design[1], design[2], design[3]}; }

}  // namespace

// Numbers written per speed: relative angles, both frequencies, derivatives of the first, of the second.
constexpr int width = 12;

// Equilibrium, modes and total derivatives at every speed; each starts from the equilibrium before it.
// `design` = l1, l2, m1, m2; `start` = relative angles. Returns the number of speeds done.
extern "C" int sweep(const double *design, const double *start, const double *speeds, int count, double *out) {
    const Design d = unpack(design);
    const Bars b = d.bars();
    Angles a{start[0], start[0] + start[1]};
    for (int i = 0; i < count; ++i, out += width) {
        const double w2 = speeds[i] * speeds[i];
        bool found;
        const State x = equilibrium(b, w2, a, found);
        const double kd = x.k1 * x.k2 + x.s1 * x.s2, sd = x.s1 * x.k2 - x.k1 * x.s2, m12 = b.c12 * kd;
        const Pair lambda = eigenvalues(x, b, m12);
        if (!found || !(lambda.low > 0)) return i;
        const double inverse = 1 / (x.k11 * x.k22 - x.k12 * x.k12);
        const double low = std::sqrt(lambda.low), high = std::sqrt(lambda.high);
        out[0] = a.phi1;
        out[1] = a.phi2 - a.phi1;
        out[2] = low;
        out[3] = high;
        derivatives(d, b, w2, x, m12, kd, sd, inverse, lambda.low, 0.5 / low, out + 4);
        derivatives(d, b, w2, x, m12, kd, sd, inverse, lambda.high, 0.5 / high, out + 8);
    }
    return count;
}

// The same by central differences: every dimension moved both ways, equilibrium and frequencies found anew.
extern "C" int sweep_by_differences(const double *design, const double *start, const double *speeds, int count,
                                    double *out) {
    const Bars b = unpack(design).bars();
    Angles a{start[0], start[0] + start[1]};
    for (int i = 0; i < count; ++i, out += width) {
        const double w2 = speeds[i] * speeds[i];
        bool found;
        const State x = equilibrium(b, w2, a, found);
        const Pair lambda = eigenvalues(x, b, b.c12 * (x.k1 * x.k2 + x.s1 * x.s2));
        if (!found || !(lambda.low > 0)) return i;
        out[0] = a.phi1;
        out[1] = a.phi2 - a.phi1;
        out[2] = std::sqrt(lambda.low);
        out[3] = std::sqrt(lambda.high);
        for (int k = 0; k < 4; ++k) {
            const double h = 1e-5 * design[k];
            double low[2], high[2];
            for (int side = 0; side < 2; ++side) {
                double moved[4] = {design[0], design[1], design[2], design[3]};
                moved[k] += side ? h : -h;
                const Bars c = unpack(moved).bars();
                Angles near = a;
                const State y = equilibrium(c, w2, near, found);
                const Pair l = eigenvalues(y, c, c.c12 * (y.k1 * y.k2 + y.s1 * y.s2));
                low[side] = std::sqrt(l.low);
                high[side] = std::sqrt(l.high);
            }
            out[4 + k] = (low[1] - low[0]) / (2 * h);
            out[8 + k] = (high[1] - high[0]) / (2 * h);
        }
    }
    return count;
}

// Monte Carlo at one speed: `designs` holds four dimensions per sample, drawn beforehand; every sample finds its own
// equilibrium from `start`. `out` = mean and standard deviation of both frequencies. Returns the number of stable samples.
extern "C" int monte_carlo(const double *start, double speed, const double *designs, int count, double *out) {
    const double w2 = speed * speed;
    double sum1 = 0, sum2 = 0, square1 = 0, square2 = 0, shift1 = 0, shift2 = 0;
    int stable = 0;
    for (int i = 0; i < count; ++i) {
        const Bars b = unpack(designs + 4 * i).bars();
        Angles a{start[0], start[0] + start[1]};
        bool found;
        const State x = equilibrium(b, w2, a, found);
        const Pair lambda = eigenvalues(x, b, b.c12 * (x.k1 * x.k2 + x.s1 * x.s2));
        if (!found || !(lambda.low > 0)) continue;
        const double low = std::sqrt(lambda.low), high = std::sqrt(lambda.high);
        if (stable++ == 0) {
            shift1 = low;
            shift2 = high;
        }
        sum1 += low - shift1;
        sum2 += high - shift2;
        square1 += (low - shift1) * (low - shift1);
        square2 += (high - shift2) * (high - shift2);
    }
    const double n = stable, mean1 = sum1 / n, mean2 = sum2 / n;
    out[0] = shift1 + mean1;
    out[1] = std::sqrt((square1 - n * mean1 * mean1) / (n - 1));
    out[2] = shift2 + mean2;
    out[3] = std::sqrt((square2 - n * mean2 * mean2) / (n - 1));
    return stable;
}
