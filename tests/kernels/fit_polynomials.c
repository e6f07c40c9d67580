/* SPDX-License-Identifier: MIT */
/*
 * Prints the polynomial coefficients of src/kernels/common/math.k and disk_path.k with the error each has before rounding to float.
 *
 * Every function of math.k is g(p(x)): p a polynomial, g a power or nothing. Remez's exchange on a fine grid finds the p with
 * the smallest largest weighted error. In sincos_turns the coefficients' last bits were then chosen for the smallest error in float.
 * Build with: cc -O2 fit_polynomials.c -lm
 */
#include <math.h>
#include <stdio.h>

enum { MOST = 12, GRID = 20000 };

typedef long double wide;

struct problem {
    const char *name;
    wide (*function)(wide x);
    wide (*weight)(wide x);
    wide low, high;
    int count; /* coefficients, constant term first */
};

static void solve(int n, wide a[MOST + 1][MOST + 2], wide *x)
{
    for (int column = 0; column < n; column++) {
        int pivot = column;
        for (int row = column + 1; row < n; row++)
            if (fabsl(a[row][column]) > fabsl(a[pivot][column]))
                pivot = row;
        for (int k = 0; k <= n; k++) {
            wide swap = a[column][k];
            a[column][k] = a[pivot][k];
            a[pivot][k] = swap;
        }
        for (int row = column + 1; row < n; row++) {
            wide factor = a[row][column] / a[column][column];
            for (int k = column; k <= n; k++)
                a[row][k] -= factor * a[column][k];
        }
    }
    for (int row = n - 1; row >= 0; row--) {
        x[row] = a[row][n];
        for (int k = row + 1; k < n; k++)
            x[row] -= a[row][k] * x[k];
        x[row] /= a[row][row];
    }
}

static wide polynomial(const struct problem *p, const wide *c, wide x)
{
    wide sum = 0;
    for (int k = p->count - 1; k >= 0; k--)
        sum = sum * x + c[k];
    return sum;
}

static wide grid_point(const struct problem *p, int i)
{
    wide s = (1 - cosl(acosl(-1.0L) * i / GRID)) / 2;
    return p->low + (p->high - p->low) * s;
}

static wide error_at(const struct problem *p, const wide *c, wide x) { return p->weight(x) * (polynomial(p, c, x) - p->function(x)); }

/* Between two changes of the error's sign lies one extremum; a fit has count + 1 of them of equal size when it is the best. */
static int find_extrema(const struct problem *p, const wide *c, wide *nodes)
{
    wide best = 0, where = p->low;
    int found = 0;
    for (int i = 0; i <= GRID; i++) {
        wide x = grid_point(p, i), e = error_at(p, c, x);
        if (e * best < 0 && found <= MOST) {
            nodes[found++] = where;
            best = 0;
        }
        if (fabsl(e) >= fabsl(best)) {
            best = e;
            where = x;
        }
    }
    if (found <= MOST)
        nodes[found++] = where;
    return found;
}

static void fit(const struct problem *p)
{
    wide nodes[MOST + 2], c[MOST + 1] = {0};
    int n = p->count + 1;
    for (int i = 0; i < n; i++)
        nodes[i] = grid_point(p, 1 + (GRID - 2) * i / (n - 1));
    for (int round = 0; round < 60; round++) {
        wide a[MOST + 1][MOST + 2], x[MOST + 1], next[MOST + 2];
        for (int i = 0; i < n; i++) {
            wide power = 1;
            for (int k = 0; k < p->count; k++, power *= nodes[i])
                a[i][k] = power;
            a[i][p->count] = (i % 2 ? -1 : 1) / p->weight(nodes[i]);
            a[i][n] = p->function(nodes[i]);
        }
        solve(n, a, x);
        for (int k = 0; k < p->count; k++)
            c[k] = x[k];
        int found = find_extrema(p, c, next);
        int skip = found > n && fabsl(error_at(p, c, next[0])) < fabsl(error_at(p, c, next[found - 1]));
        if (found < n)
            break;
        for (int i = 0; i < n; i++)
            nodes[i] = next[i + skip];
    }
    wide worst = 0;
    for (int i = 0; i <= GRID; i++)
        worst = fmaxl(worst, fabsl(error_at(p, c, grid_point(p, i))));
    printf("%s on [%Lg, %Lg]: error %.2Le\n", p->name, p->low, p->high, worst);
    for (int k = 0; k < p->count; k++)
        printf("    %.9gf\n", (double)c[k]);
}

static wide half_pi(void) { return acosl(0.0L); }

/* Turns, z = r^2 with r in quarter turns: sin = r + r p(z), cos = 1 - z + z p(z). */
static wide sine_turns(wide z) { return z > 1e-12L ? sinl(half_pi() * sqrtl(z)) / sqrtl(z) - 1 : half_pi() - 1; }
static wide sine_turns_weight(wide z) { return sqrtl(z) + 1e-6L; }
static wide cosine_turns(wide z) { return z > 1e-7L ? (cosl(half_pi() * sqrtl(z)) - 1 + z) / z : 1 - half_pi() * half_pi() / 2; }
static wide cosine_turns_weight(wide z) { return z * (1 - z / 2) + 1e-6L; }

/* Waves, z = r^2 with r in turns: S = r p(z) = sqrt(2) sin(pi r), C = p(z) = sqrt(2) cos(pi r); sin = S C, cos = 1 - S^2. */
static wide pi(void) { return 2 * half_pi(); }
static wide sine_half(wide z) { return sqrtl(2) * (z > 1e-12L ? sinl(pi() * sqrtl(z)) / sqrtl(z) : pi()); }
static wide sine_half_weight(wide z) { return sqrtl(8 * z) * sinl(pi() * fmaxl(sqrtl(z), 0.25L)) + 1e-6L; }
static wide cosine_half(wide z) { return sqrtl(2) * cosl(pi() * sqrtl(z)); }
static wide cosine_half_weight(wide z) { return sqrtl(2) * sinl(pi() * sqrtl(z)) + 1e-6L; }

/* C = (1/4 - z) p(z), so that sin is 0 where r jumps from 1/2 to -1/2. p is fitted to sin, with S as it is. */
static wide coarse_sine(wide z) { return sqrtl(z) * (4.44131875L - z * (7.26150066L - z * 3.24235883L)); }
static wide cosine_falling(wide z)
{
    wide r = sqrtl(fminl(fmaxl(z, 1e-9L), 0.25L - 1e-9L));
    return sinl(2 * pi() * r) / (coarse_sine(r * r) * (0.25L - r * r));
}
static wide cosine_falling_weight(wide z) { return (0.25L - z) * coarse_sine(z) + 1e-6L; }

/* Radians, z = r^2: sin = r + r z p(z), cos = 1 - k z + z p(z) with k = (2 / pi)^2 as a float. */
static wide sine(wide z) { return z > 1e-6L ? (sinl(sqrtl(z)) / sqrtl(z) - 1) / z : -1 / 6.0L + z / 120; }
static wide sine_weight(wide z) { return z * sqrtl(z) + 1e-6L; }
static wide cosine(wide z) { return 0.405284736f + (z > 1e-6L ? (cosl(sqrtl(z)) - 1) / z : z / 24 - 0.5L); }
static wide cosine_weight(wide z) { return z + 1e-6L; }

/* atan r = r + r z p(z), z = r^2 */
static wide arc_tangent(wide z) { return z > 1e-6L ? (atanl(sqrtl(z)) / sqrtl(z) - 1) / z : z / 5 - 1 / 3.0L; }

static wide power_of_two(wide x) { return exp2l(x); }
static wide power_weight(wide x) { return exp2l(-x); }

/* log(1 + t) = t - t²/2 + t³ p(t) */
static wide log_rest(wide t)
{
    if (fabsl(t) < 1e-3L)
        return 1 / 3.0L - t / 4 + t * t / 5 - t * t * t / 6;
    return (log1pl(t) - t + t * t / 2) / (t * t * t);
}
static wide log_weight(wide t) { return fabsl(t * t * t) / (fabsl(t) + 0.05L) + 1e-5L; }

/* Tails as eighth powers: P(N > t), and e(t) = ∫ P(N > s) ds over s > t. */
static wide tail(wide t) { return erfcl(t * sqrtl(0.5L)) / 2; }
static wide tail_root(wide t) { return powl(tail(t), 0.125L); }
static wide tail_weight(wide t) { return 8 * powl(tail(t), 0.875L); }
static wide excess(wide t) { return expl(-t * t / 2) / sqrtl(2 * acosl(-1.0L)) - t * tail(t); }
static wide excess_root(wide t) { return powl(excess(t), 0.125L); }
static wide excess_weight(wide t) { return 8 * powl(excess(t), 0.875L); }

int main(void)
{
    const struct problem problems[] = {
        {"sincos_turns, sine", sine_turns, sine_turns_weight, 0, 1, 5},
        {"sincos_turns, cosine", cosine_turns, cosine_turns_weight, 0, 1, 4},
        {"sincos_wave, sine", sine_half, sine_half_weight, 0, 0.25L, 4},
        {"sincos_wave, cosine", cosine_half, cosine_half_weight, 0, 0.25L, 4},
        {"sincos_coarse, sine", sine_half, sine_half_weight, 0, 0.25L, 3},
        {"sincos_coarse, cosine", cosine_falling, cosine_falling_weight, 0, 0.25L, 2},
        {"sincos_reduced, sine", sine, sine_weight, 0, 2.47L, 4},
        {"sincos_reduced, cosine", cosine, cosine_weight, 0, 2.47L, 5},
        {"exp2_fraction, relative", power_of_two, power_weight, -0.5L, 0.5L, 6},
        {"log_real", log_rest, log_weight, -0.2929L, 0.4143L, 7},
        {"normal_cdf", tail_root, tail_weight, 0, 5.6L, 9},
        {"normal_excess", excess_root, excess_weight, 0, 5.6L, 8},
        {"angle_above", arc_tangent, cosine_weight, 0, 1, 7},
    };
    for (unsigned i = 0; i < sizeof problems / sizeof problems[0]; i++)
        fit(&problems[i]);
    return 0;
}
