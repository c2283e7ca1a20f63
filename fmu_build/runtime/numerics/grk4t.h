/* Coefficients of GRK4T.
 *
 * P. Kaps and P. Rentrop: Generalized Runge-Kutta methods of order four with stepsize control for stiff ordinary
 * differential equations. Numerische Mathematik 33 (1979) 55-68, doi 10.1007/BF01396495.
 * Four stages, order 4, embedded order 3, A(89.3 degrees)-stable. The fourth stage has the argument of the third.
 *
 * They are in the transformed form (see rodas5p.h; the weights are those of the u_j), as in the program ROS4 of Hairer
 * and Wanner, whose digits, some twelve, are continued so that the order conditions hold to those of a double. */
#ifndef GRK4T_H
#define GRK4T_H

enum { GRK4T_STAGES = 4, GRK4T_ARGUMENTS = 3 };

static const double GRK4T_GAMMA = 0.231;

static const double GRK4T_A[GRK4T_ARGUMENTS][GRK4T_ARGUMENTS - 1] = {
    {0.0},
    {2.0},
    {4.524708207373115, 4.163528788597646},
};

static const double GRK4T_C[GRK4T_STAGES][GRK4T_STAGES - 1] = {
    {0.0},
    {-5.071675338776316},
    {6.020152728650656, 0.1597506846724809},
    {-1.8563436186863875, -8.505380858180137, -2.0840751360232908},
};

static const double GRK4T_WEIGHT[GRK4T_STAGES] = {
    3.9575037466407714,
    4.624892388363311,
    0.6174772638750661,
    1.28261294526899,
};

/* The weights less those of the embedded solution. */
static const double GRK4T_ERROR[GRK4T_STAGES] = {
    -2.3021554029274327,
    -3.0736344853851874,
    0.8732808018024487,
    1.2826129452658865,
};

/* Nodes: the sum of a stage's alpha_ij, 169/192 the last. */
static const double GRK4T_NODE[GRK4T_ARGUMENTS] = {0.0, 0.462, 0.8802083333333334};

/* The sum of a stage's gamma_ij. */
static const double GRK4T_D[GRK4T_STAGES] = {
    0.231,
    -0.039629667752443,
    0.5507789395789078,
    -0.05535098457055034,
};

#endif
