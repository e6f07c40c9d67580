/* SPDX-License-Identifier: MIT
 * Fits mixtures of circular Gaussians to an elongated one (Podee et al. 2021, Appendix C) and prints src/kernels/baselines/mixture_fits.k.
 *
 *   ninja fit_mixtures && ./fit_mixtures > mixture_fits.k
 *
 * The elliptical Gaussian has standard deviations 1 and e. One circular kernel stands in its centre, the others in pairs on its long
 * axis. The error that is minimised is the integral of the squared difference (Eq. 25), divided by the integral of the elliptical Gaussian's square. For
 * given places and widths the best weights solve a linear system. NLopt's BOBYQA finds places and widths. It starts each elongation from the result of the
 * next longer one, so that the results stay on one smooth branch. Then every parameter becomes a polynomial in log e. NLopt's L-BFGS optimises all
 * coefficients together for the least mean error over the elongations. */
#include <math.h>
#include <nlopt.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { MAX_PAIRS = 4, MAX_MEMBERS = MAX_PAIRS + 1, GRID = 65, MAX_TERMS = 9, MAX_UNKNOWNS = 3 * MAX_MEMBERS * MAX_TERMS };

static const double longest = 9, pi = 3.14159265358979323846;

/* Member 0 is the kernel in the centre; each member i > 0 is a pair of kernels at ±distance. */
typedef struct mixture {
    int members;
    double weight[MAX_MEMBERS], deviation[MAX_MEMBERS], distance[MAX_MEMBERS];
} mixture;

/* ∬ of the product of two normalised Gaussians whose centres are `apart` along y; variance_x and variance_y are the sums of their variances. */
static double product(double variance_x, double variance_y, double apart)
{
    return exp(-apart * apart / (2 * variance_y)) / (2 * pi * sqrt(variance_x * variance_y));
}

/* ∬ ellipse · member, and ∬ member · member. */
static double with_ellipse(const mixture *m, int i, double e)
{
    const double s = m->deviation[i] * m->deviation[i];
    return (i ? 2 : 1) * product(1 + s, e * e + s, m->distance[i]);
}

static double with_member(const mixture *m, int i, int j)
{
    const double s = m->deviation[i] * m->deviation[i] + m->deviation[j] * m->deviation[j];
    if (i == 0 || j == 0)
        return (i || j ? 2 : 1) * product(s, s, m->distance[i] + m->distance[j]);
    return 2 * (product(s, s, m->distance[i] - m->distance[j]) + product(s, s, m->distance[i] + m->distance[j]));
}

/* Eq. 25 over ∬ ellipse². */
static double relative_error(const mixture *m, double e)
{
    double sum = product(2, 2 * e * e, 0);
    const double whole = sum;
    for (int i = 0; i < m->members; i++) {
        sum -= 2 * m->weight[i] * with_ellipse(m, i, e);
        for (int j = 0; j < m->members; j++)
            sum += m->weight[i] * m->weight[j] * with_member(m, i, j);
    }
    return sum / whole;
}

/* Finds the weights that minimise the error, by Gaussian elimination with pivots. A small ridge keeps the system regular where members coincide. */
static void solve_weights(mixture *m, double e)
{
    const int n = m->members;
    double a[MAX_MEMBERS][MAX_MEMBERS + 1];
    for (int i = 0; i < n; i++) {
        for (int j = 0; j < n; j++)
            a[i][j] = with_member(m, i, j);
        a[i][i] *= 1 + 1e-10;
        a[i][n] = with_ellipse(m, i, e);
    }
    for (int k = 0; k < n; k++) {
        int pivot = k;
        for (int i = k + 1; i < n; i++)
            pivot = fabs(a[i][k]) > fabs(a[pivot][k]) ? i : pivot;
        for (int j = 0; j <= n; j++) {
            const double t = a[k][j];
            a[k][j] = a[pivot][j], a[pivot][j] = t;
        }
        for (int i = k + 1; i < n; i++)
            for (int j = n; j >= k; j--)
                a[i][j] -= a[k][j] * a[i][k] / a[k][k];
    }
    for (int i = n - 1; i >= 0; i--) {
        m->weight[i] = a[i][n];
        for (int j = i + 1; j < n; j++)
            m->weight[i] -= a[i][j] * m->weight[j];
        m->weight[i] /= a[i][i];
    }
}

/* ---- one elongation ---- */

/* Unknowns: log deviations of all members, then the distances of the pairs in units of √(e² − 1). */
typedef struct problem {
    int members;
    double e;
} problem;

static mixture mixture_of(const problem *p, const double *x)
{
    mixture m = {.members = p->members};
    for (int i = 0; i < p->members; i++)
        m.deviation[i] = exp(x[i]);
    for (int i = 1; i < p->members; i++)
        m.distance[i] = x[p->members + i - 1] * sqrt(p->e * p->e - 1);
    solve_weights(&m, p->e);
    return m;
}

static double best_weights_error(unsigned n, const double *x, double *gradient, void *data)
{
    (void)n, (void)gradient;
    const problem *p = data;
    const mixture m = mixture_of(p, x);
    return relative_error(&m, p->e);
}

static double fit_one(problem *p, double *x)
{
    const int n = 2 * p->members - 1;
    double error = 0;
    for (int round = 0; round < 3; round++) {
        nlopt_opt opt = nlopt_create(NLOPT_LN_BOBYQA, (unsigned)n);
        nlopt_set_min_objective(opt, best_weights_error, p);
        nlopt_set_initial_step1(opt, round ? 0.01 : 0.05);
        nlopt_set_xtol_rel(opt, 1e-10);
        nlopt_set_maxeval(opt, 20000);
        nlopt_optimize(opt, x, &error);
        nlopt_destroy(opt);
    }
    return error;
}

/* ---- all elongations ---- */

/* Each member's weight, log deviation and distance / √(e² − 1) as polynomials in log e with `terms` coefficients. */
typedef struct curves {
    int members, terms;
    double coefficient[MAX_UNKNOWNS];
} curves;

static double grid_log(int g) { return log(longest) * g / (GRID - 1); }

static double curve(const curves *c, int parameter, int member, double x)
{
    const double *k = c->coefficient + (parameter * c->members + member) * c->terms;
    double value = 0;
    for (int i = c->terms - 1; i >= 0; i--)
        value = value * x + k[i];
    return value;
}

static mixture mixture_at(const curves *c, double x)
{
    mixture m = {.members = c->members};
    for (int i = 0; i < c->members; i++) {
        m.weight[i] = curve(c, 0, i, x);
        m.deviation[i] = exp(curve(c, 1, i, x));
        m.distance[i] = i ? curve(c, 2, i, x) * sqrt(exp(2 * x) - 1) : 0;
    }
    return m;
}

/* Mean relative error over the elongations. The gradient takes the derivatives of a mixture's error from finite differences, and the chain rule for the
 * coefficients. */
static double mean_error(unsigned n, const double *x, double *gradient, void *data)
{
    curves *c = data;
    memcpy(c->coefficient, x, n * sizeof *x);
    if (gradient)
        memset(gradient, 0, n * sizeof *gradient);
    double sum = 0;
    for (int g = 1; g < GRID; g++) {
        const double at = grid_log(g), e = exp(at), root = sqrt(e * e - 1);
        mixture m = mixture_at(c, at);
        /* The root of the error, so that elongations with small errors count, too. */
        const double norm = sqrt(relative_error(&m, e) + 1e-8);
        sum += norm;
        for (int parameter = 0; gradient && parameter < 3; parameter++)
            for (int i = 0; i < c->members; i++) {
                if (parameter == 2 && i == 0)
                    continue;
                double *value = parameter == 0 ? &m.weight[i] : parameter == 1 ? &m.deviation[i] : &m.distance[i];
                const double kept = *value, step = 1e-6 * (parameter == 2 ? root : 1);
                *value = kept + step;
                const double more = relative_error(&m, e);
                *value = kept - step;
                const double less = relative_error(&m, e);
                *value = kept;
                const double inner = parameter == 0 ? 1 : parameter == 1 ? kept : root;
                double term = (more - less) / (2 * step) * inner / (2 * norm);
                double *out = gradient + (parameter * c->members + i) * c->terms;
                for (int k = 0; k < c->terms; k++, term *= at)
                    out[k] += term / (GRID - 1);
            }
    }
    return sum / (GRID - 1);
}

/* Fits a polynomial to values on the grid by least squares; the normal equations are solved in long double. */
static void fit_curve(const double *value, int first, int terms, double *out)
{
    long double a[MAX_TERMS][MAX_TERMS + 1] = {{0}};
    for (int g = first; g < GRID; g++) {
        long double power[2 * MAX_TERMS] = {1};
        for (int k = 1; k < 2 * terms; k++)
            power[k] = power[k - 1] * grid_log(g);
        for (int i = 0; i < terms; i++) {
            for (int j = 0; j < terms; j++)
                a[i][j] += power[i + j];
            a[i][terms] += power[i] * value[g];
        }
    }
    for (int k = 0; k < terms; k++)
        for (int i = 0; i < terms; i++) {
            if (i == k)
                continue;
            const long double factor = a[i][k] / a[k][k];
            for (int j = k; j <= terms; j++)
                a[i][j] -= factor * a[k][j];
        }
    for (int k = 0; k < terms; k++)
        out[k] = (double)(a[k][terms] / a[k][k]);
}

static curves fit_all(int pairs, int terms)
{
    static double values[3][MAX_MEMBERS][GRID];
    const int members = pairs + 1;
    double x[2 * MAX_MEMBERS] = {0};
    for (int i = 0; i < members; i++)
        x[i] = log(pairs ? longest / (1.2 * members) : sqrt(longest));
    for (int i = 1; i < members; i++)
        x[members + i - 1] = 1.9 * i / members;
    /* The shortest elongations hardly determine the parameters: any mixture of equal kernels fits them. */
    const int first = 6;
    for (int g = GRID - 1; g >= first; g--) {
        problem p = {members, exp(grid_log(g))};
        const double error = fit_one(&p, x);
        const mixture m = mixture_of(&p, x);
        for (int i = 0; i < members; i++) {
            values[0][i][g] = m.weight[i];
            values[1][i][g] = x[i];
            values[2][i][g] = i ? x[members + i - 1] : 0;
        }
        if (g % 8 == 0) {
            fprintf(stderr, "%d kernels, e %.3f: relative L2 %.5f;", 2 * pairs + 1, p.e, sqrt(fmax(error, 0)));
            for (int i = 0; i < members; i++)
                fprintf(stderr, " (%.4f %.4f %.4f)", m.weight[i], m.deviation[i], i ? x[members + i - 1] : 0);
            fprintf(stderr, "\n");
        }
    }
    curves c = {.members = members, .terms = terms};
    for (int parameter = 0; parameter < 3; parameter++)
        for (int i = 0; i < members; i++)
            fit_curve(values[parameter][i], first, terms, c.coefficient + (parameter * members + i) * terms);
    const unsigned unknowns = (unsigned)(3 * members * terms);
    double best[MAX_UNKNOWNS], error = mean_error(unknowns, c.coefficient, NULL, &(curves){.members = members, .terms = terms});
    fprintf(stderr, "%d kernels: mean relative L2 %.6f as fitted one by one, ", 2 * pairs + 1, error);
    memcpy(best, c.coefficient, sizeof best);
    curves work = c;
    nlopt_opt opt = nlopt_create(NLOPT_LD_LBFGS, unknowns);
    nlopt_set_min_objective(opt, mean_error, &work);
    nlopt_set_maxeval(opt, 3000);
    nlopt_set_ftol_rel(opt, 1e-9);
    nlopt_optimize(opt, best, &error);
    nlopt_destroy(opt);
    memcpy(c.coefficient, best, sizeof best);
    fprintf(stderr, "%.6f together\n", error);
    return c;
}

/* ---- output ---- */

/* Horner's rule in two lines, the second one of four coefficients. */
static void print_polynomial(const char *name, const double *k, int terms)
{
    printf("        f.%s = ", name);
    for (int i = 0; i < terms - 6; i++)
        printf("fma(");
    printf("fma(x, %.9ef, %.9ef)", k[terms - 1], k[terms - 2]);
    for (int i = terms - 3; i >= 4; i--)
        printf(", x, %.9ef)", k[i]);
    printf(";\n        f.%s = fma(fma(fma(fma(f.%s, x, %.9ef), x, %.9ef), x, %.9ef), x, %.9ef);\n", name, name, k[3], k[2], k[1], k[0]);
}

static void print_curves(const curves *c)
{
    static const char *const names[] = {"weight", "log_deviation", "distance"};
    for (int i = 0; i < c->members; i++) {
        printf("    if (kernels == %d && member == %d) {\n", 2 * c->members - 1, i);
        for (int parameter = 0; parameter < (i ? 3 : 2); parameter++)
            print_polynomial(names[parameter], c->coefficient + (parameter * c->members + i) * c->terms, c->terms);
        printf("    }\n");
    }
}

int main(void)
{
    static const int pairs[] = {0, 1, 2, 4}, terms[] = {7, 8, 8, 8};
    curves all[4];
    for (int i = 0; i < 4; i++) {
        all[i] = fit_all(pairs[i], terms[i]);
        for (int e = 1; e <= 9; e++) {
            const mixture m = mixture_at(&all[i], log(e));
            fprintf(stderr, "  e %d: relative L2 %.4f\n", e, sqrt(fmax(relative_error(&m, e), 0)));
        }
    }
    printf("/* SPDX-License-Identifier: MIT\n"
           " *\n"
           " * Made by `ninja fit_mixtures && ./fit_mixtures > mixture_fits.k` (src/frame/fit/fit_mixtures.c); not to be edited.\n"
           " *\n"
           " * Members of the mixtures of 1, 3, 5 and 9 circular Gaussians that stand for an elliptical one of deviations 1 and e, 1 <= e <= 9\n"
           " * (Podee et al. 2021, Appendix C), as polynomials in x = log e. Member 0 is the centre, each other one a pair.\n"
           " */\n"
           "#pragma once\n"
           "#include \"math.k\"\n\n"
           "STRUCT(MixtureMember) {\n"
           "    real weight;        /* of each kernel of the pair */\n"
           "    real log_deviation;\n"
           "    real distance;      /* from the centre, in units of sqrt(e^2 - 1) */\n"
           "};\n\n"
           "KERNEL MixtureMember mixture_member(CTX cx, int kernels, int member, real x)\n"
           "{\n"
           "    MixtureMember f;\n"
           "    f.weight = real(0.0f);\n"
           "    f.log_deviation = real(0.0f);\n"
           "    f.distance = real(0.0f);\n");
    for (int i = 0; i < 4; i++)
        print_curves(&all[i]);
    printf("    return f;\n}\n");
    return 0;
}
