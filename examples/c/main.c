/* Where the double pendulum stays at 5 rad/s, how it vibrates there, and what a longer bar changes. */

#include <math.h>
#include <stddef.h>
#include <stdio.h>

#include "double_pendulum.h"

enum {
    N = DOUBLE_PENDULUM_COORDINATES,
    U = DOUBLE_PENDULUM_INPUTS,
    P = DOUBLE_PENDULUM_DESIGN,
    L = DOUBLE_PENDULUM_DESIGN_l
};

/* x = a^-1 y for two unknowns. */
static void solve(double a[N][N], const double y[N], double x[N])
{
    double determinant = a[0][0] * a[1][1] - a[0][1] * a[1][0];
    x[0] = (y[0] * a[1][1] - a[0][1] * y[1]) / determinant;
    x[1] = (a[0][0] * y[1] - y[0] * a[1][0]) / determinant;
}

/* Newton's method on the residual; 0 where it has converged. */
static int equilibrium(double q[N], const double u[U], const double b[P])
{
    for (int iteration = 0; iteration < 50; iteration++) {
        double residual[N], stiffness[N][N], step[N];
        if (double_pendulum_residual_and_stiffness(q, u, b, residual, *stiffness) != 0)
            return 1;
        solve(stiffness, residual, step);
        q[0] -= step[0];
        q[1] -= step[1];
        if (fabs(step[0]) + fabs(step[1]) < 1e-14)
            return 0;
    }
    return 1;
}

/* The squares of the natural frequencies, the smaller one first: det(stiffness - lambda mass) = 0. */
static void eigenvalues(double m[N][N], double k[N][N], double lambda[N])
{
    double a = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    double b = m[0][0] * k[1][1] + m[1][1] * k[0][0] - m[0][1] * k[1][0] - m[1][0] * k[0][1];
    double c = k[0][0] * k[1][1] - k[0][1] * k[1][0];
    double larger = (b + sqrt(b * b - 4 * a * c)) / 2;
    lambda[0] = c / larger;
    lambda[1] = larger / a;
}

/* The derivative of lambda by the length of the bars: explicitly, and through the equilibrium, which the length moves. */
static double slope(const double q[N], const double u[U], const double b[P], double m[N][N], double k[N][N],
                    double lambda)
{
    double phi[N] = {k[0][1] - lambda * m[0][1], lambda * m[0][0] - k[0][0]};
    double by_q[N], by_u[U], by_b[P], g_by_u[N][U], g_by_b[N][P], shift[N];
    double norm = 0;
    for (int i = 0; i < N; i++)
        for (int j = 0; j < N; j++)
            norm += phi[i] * m[i][j] * phi[j];
    if (double_pendulum_mode_gradient(q, u, b, phi, lambda, by_q, by_u, by_b) != 0)
        return NAN;
    if (double_pendulum_residual_partials(q, u, b, *g_by_u, *g_by_b) != 0)
        return NAN;
    double moved[N] = {-g_by_b[0][L], -g_by_b[1][L]};
    solve(k, moved, shift);
    return (by_b[L] + by_q[0] * shift[0] + by_q[1] * shift[1]) / norm;
}

int main(void)
{
    double q[N] = {60 * 3.14159265358979323846 / 180, 0}, u[U] = {5}, b[P];
    double mass[N][N], damping[N][N], stiffness[N][N], lambda[N], outputs[DOUBLE_PENDULUM_OUTPUTS];
    const char *violation;

    if (double_pendulum_nominal(b) != 0 || double_pendulum_violation(u, b, &violation) != 0)
        return 1;
    if (violation != NULL) {
        fprintf(stderr, "%s\n", violation);
        return 1;
    }
    if (equilibrium(q, u, b) != 0) {
        fprintf(stderr, "no equilibrium found\n");
        return 1;
    }
    if (double_pendulum_linear(q, u, b, *mass, *damping, *stiffness) != 0)
        return 1;
    if (double_pendulum_outputs(q, u, b, outputs) != 0)
        return 1;
    eigenvalues(mass, stiffness, lambda);

    printf("theta1 %.17g rad\n", q[DOUBLE_PENDULUM_COORDINATE_theta1]);
    printf("theta2 %.17g rad\n", q[DOUBLE_PENDULUM_COORDINATE_theta2]);
    printf("angle2 %.17g rad\n", outputs[DOUBLE_PENDULUM_OUTPUT_angle2]);
    for (int k = 0; k < N; k++) {
        double frequency = sqrt(lambda[k]);
        double by_length = slope(q, u, b, mass, stiffness, lambda[k]) / (2 * frequency);
        printf("frequency%d %.17g rad/s\n", k + 1, frequency);
        printf("frequency%d_by_l %.17g rad/s/m\n", k + 1, by_length);
    }

    /* A forgotten argument is answered, not followed. */
    printf("null %d\n", (int)double_pendulum_residual(q, NULL, b, outputs));
    return 0;
}
