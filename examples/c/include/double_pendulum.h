/* Kernels of the mechanism DoublePendulum, generated from double_pendulum.mechanism by eigentol-build: do not edit.
 *
 * Numbers are SI, angles in radians. `q` are the unknowns, `u` the inputs, `b` the design variables; matrices are
 * stored row by row. Each array has to be at least as long as the comment of its function says; results may overlap
 * arguments, not each other.
 *
 * Functions return 0, or, without doing anything, the position, from 1, of the first argument that is a null pointer;
 * where an array has no entries null is allowed. They keep no state, allocate nothing and may be called from several
 * threads at once. Outside of the domain of the equations they give NaN or infinity.
 */

#ifndef DOUBLE_PENDULUM_H
#define DOUBLE_PENDULUM_H

#include <stdint.h>

/**
 * Number of unknowns `q`.
 */
#define DOUBLE_PENDULUM_COORDINATES 2

/**
 * Number of inputs `u`.
 */
#define DOUBLE_PENDULUM_INPUTS 1

/**
 * Number of design variables `b`.
 */
#define DOUBLE_PENDULUM_DESIGN 2

/**
 * Number of outputs.
 */
#define DOUBLE_PENDULUM_OUTPUTS 1

/**
 * `theta1`, rad.
 */
#define DOUBLE_PENDULUM_COORDINATE_theta1 0

/**
 * `theta2`, rad.
 */
#define DOUBLE_PENDULUM_COORDINATE_theta2 1

/**
 * Speed of the shaft.
 * `omega`, rad/s.
 */
#define DOUBLE_PENDULUM_INPUT_omega 0

/**
 * Mass of each bar.
 * `m`, kg.
 */
#define DOUBLE_PENDULUM_DESIGN_m 0

/**
 * Length of each bar.
 * `l`, m.
 */
#define DOUBLE_PENDULUM_DESIGN_l 1

/**
 * Angle of the second bar from the vertical.
 * `angle2`, rad.
 */
#define DOUBLE_PENDULUM_OUTPUT_angle2 0

#ifdef __cplusplus
extern "C" {
#endif // __cplusplus

/**
 * Residual at rest, N or N m by coordinate: zero at an equilibrium.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `residual[2]`.
 */
int32_t double_pendulum_residual(const double *q,
                                 const double *u,
                                 const double *b,
                                 double *residual);

/**
 * Residual at rest in two parts: `residual = inertia - applied`.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `inertia[2]`, `applied[2]`.
 */
int32_t double_pendulum_residual_parts(const double *q,
                                       const double *u,
                                       const double *b,
                                       double *inertia,
                                       double *applied);

/**
 * Residual of the nonlinear equations of motion: zero along a motion.
 *
 * Reads `acceleration[2]`, `velocity[2]`, `q[2]`, `u[1]`, `b[2]`.
 * Writes `residual[2]`.
 */
int32_t double_pendulum_motion_residual(const double *acceleration,
                                        const double *velocity,
                                        const double *q,
                                        const double *u,
                                        const double *b,
                                        double *residual);

/**
 * Mass matrix and force of the nonlinear equations of motion, `mass * acceleration = force`.
 *
 * Reads `velocity[2]`, `q[2]`, `u[1]`, `b[2]`.
 * Writes `mass[2][2]`, `force[2]`.
 */
int32_t double_pendulum_motion(const double *velocity,
                               const double *q,
                               const double *u,
                               const double *b,
                               double *mass,
                               double *force);

/**
 * Derivatives of `motion_residual` by accelerations, velocities and coordinates.
 *
 * Reads `acceleration[2]`, `velocity[2]`, `q[2]`, `u[1]`, `b[2]`.
 * Writes `mass[2][2]`, `damping[2][2]`, `stiffness[2][2]`.
 */
int32_t double_pendulum_motion_linear(const double *acceleration,
                                      const double *velocity,
                                      const double *q,
                                      const double *u,
                                      const double *b,
                                      double *mass,
                                      double *damping,
                                      double *stiffness);

/**
 * Residual at rest and its derivative by the coordinates: what a step of Newton's method needs.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `residual[2]`, `stiffness[2][2]`.
 */
int32_t double_pendulum_residual_and_stiffness(const double *q,
                                               const double *u,
                                               const double *b,
                                               double *residual,
                                               double *stiffness);

/**
 * Mass, damping and stiffness of small motions about an equilibrium.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `mass[2][2]`, `damping[2][2]`, `stiffness[2][2]`.
 */
int32_t double_pendulum_linear(const double *q,
                               const double *u,
                               const double *b,
                               double *mass,
                               double *damping,
                               double *stiffness);

/**
 * Derivatives of the residual at rest by every input and every design variable.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `by_input[2][1]`, `by_design[2][2]`.
 */
int32_t double_pendulum_residual_partials(const double *q,
                                          const double *u,
                                          const double *b,
                                          double *by_input,
                                          double *by_design);

/**
 * Derivatives of the three matrices by every coordinate, input and design variable: `..[k]` by the one of index `k`.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `mass_by_coordinate[2][2][2]`, `damping_by_coordinate[2][2][2]`, `stiffness_by_coordinate[2][2][2]`, `mass_by_input[1][2][2]`, `damping_by_input[1][2][2]`, `stiffness_by_input[1][2][2]`, `mass_by_design[2][2][2]`, `damping_by_design[2][2][2]`, `stiffness_by_design[2][2][2]`.
 */
int32_t double_pendulum_linear_partials(const double *q,
                                        const double *u,
                                        const double *b,
                                        double *mass_by_coordinate,
                                        double *damping_by_coordinate,
                                        double *stiffness_by_coordinate,
                                        double *mass_by_input,
                                        double *damping_by_input,
                                        double *stiffness_by_input,
                                        double *mass_by_design,
                                        double *damping_by_design,
                                        double *stiffness_by_design);

/**
 * Derivative of the three matrices along the direction `dq`, `du`, `db`.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`, `dq[2]`, `du[1]`, `db[2]`.
 * Writes `mass[2][2]`, `damping[2][2]`, `stiffness[2][2]`.
 */
int32_t double_pendulum_linear_along(const double *q,
                                     const double *u,
                                     const double *b,
                                     const double *dq,
                                     const double *du,
                                     const double *db,
                                     double *mass,
                                     double *damping,
                                     double *stiffness);

/**
 * Derivatives of `phi^T (stiffness - lambda mass) phi`, with `phi` and `lambda` held fixed.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`, `phi[2]`, `lambda`.
 * Writes `by_coordinate[2]`, `by_input[1]`, `by_design[2]`.
 */
int32_t double_pendulum_mode_gradient(const double *q,
                                      const double *u,
                                      const double *b,
                                      const double *phi,
                                      double lambda,
                                      double *by_coordinate,
                                      double *by_input,
                                      double *by_design);

/**
 * Derivatives of `left^T (mass acceleration + damping velocity + stiffness position)`, the four vectors held fixed.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`, `left[2]`, `acceleration[2]`, `velocity[2]`, `position[2]`.
 * Writes `by_coordinate[2]`, `by_input[1]`, `by_design[2]`.
 */
int32_t double_pendulum_pencil_gradient(const double *q,
                                        const double *u,
                                        const double *b,
                                        const double *left,
                                        const double *acceleration,
                                        const double *velocity,
                                        const double *position,
                                        double *by_coordinate,
                                        double *by_input,
                                        double *by_design);

/**
 * Derivatives of `w^T residual`, with `w` held fixed.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`, `w[2]`.
 * Writes `by_coordinate[2]`, `by_input[1]`, `by_design[2]`.
 */
int32_t double_pendulum_residual_gradient(const double *q,
                                          const double *u,
                                          const double *b,
                                          const double *w,
                                          double *by_coordinate,
                                          double *by_input,
                                          double *by_design);

/**
 * How the vibration `Re((real + i imaginary) e^(i w t))`, `w > 0`, moves the bodies that spin: `moment`, `lateral`,
 * `torsional`, `axial`, `eccentric`, `moving`, `still`. `moment` is positive where the vibration runs with the
 * spin, negative where it runs against it, at most as large as `lateral`.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`, `real[2]`, `imaginary[2]`.
 * Writes `sums[7]`.
 */
int32_t double_pendulum_whirl(const double *q,
                              const double *u,
                              const double *b,
                              const double *real,
                              const double *imaginary,
                              double *sums);

/**
 * The declared outputs, SI.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `outputs[1]`.
 */
int32_t double_pendulum_outputs(const double *q, const double *u, const double *b, double *outputs);

/**
 * Derivatives of the outputs by every coordinate, input and design variable.
 *
 * Reads `q[2]`, `u[1]`, `b[2]`.
 * Writes `by_coordinate[1][2]`, `by_input[1][1]`, `by_design[1][2]`.
 */
int32_t double_pendulum_output_partials(const double *q,
                                        const double *u,
                                        const double *b,
                                        double *by_coordinate,
                                        double *by_input,
                                        double *by_design);

/**
 * Nominal values of the design variables, SI.
 *
 * Writes `b[2]`.
 */
int32_t double_pendulum_nominal(double *b);

/**
 * The first physical requirement that inputs and design variables break, as text that lives for ever, null where there
 * is none: `mass of bar has to be positive`. Ask this before anything else; NaN breaks every requirement.
 *
 * Reads `u[1]`, `b[2]`.
 * Writes `violation[1]`.
 */
int32_t double_pendulum_violation(const double *u,
                                  const double *b,
                                  const char **violation);

#ifdef __cplusplus
}  // extern "C"
#endif  // __cplusplus

#endif  /* DOUBLE_PENDULUM_H */
