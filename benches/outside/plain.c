/* The plain loop of src/models/paper/forces/plain.rs as a user would write it in C: velocity Verlet with exact drag over an
 * edge list. It reads the problem as numbers, then solves it once for every further line and prints the seconds
 * that took and the sum of all positions, by which the two programs are compared. */
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

static int nodes, edges, loads, segments;
static int *from, *to, *loaded, *steps;
static double *stiffness, *rest, *load_x, *load_y;
static double *inverse_mass, *decay, *rest_x, *rest_y;
static double *x, *y, *vx, *vy, *fx, *fy, *reach, *keep;
static double *length, **force;

static double *numbers(int n) { return calloc(n > 0 ? n : 1, sizeof(double)); }
static int *integers(int n) { return calloc(n > 0 ? n : 1, sizeof(int)); }

static void scan(double *into) {
    if (scanf("%lf", into) != 1) exit(1);
}

static void scan_integer(int *into) {
    double number;
    scan(&number);
    *into = (int)number;
}

static void read_problem(void) {
    scan_integer(&nodes), scan_integer(&edges), scan_integer(&loads), scan_integer(&segments);
    inverse_mass = numbers(nodes), decay = numbers(nodes), rest_x = numbers(nodes), rest_y = numbers(nodes);
    for (int i = 0; i < nodes; i++)
        scan(inverse_mass + i), scan(decay + i), scan(rest_x + i), scan(rest_y + i);
    from = integers(edges), to = integers(edges), stiffness = numbers(edges), rest = numbers(edges);
    for (int e = 0; e < edges; e++)
        scan_integer(from + e), scan_integer(to + e), scan(stiffness + e), scan(rest + e);
    loaded = integers(loads), load_x = numbers(loads), load_y = numbers(loads);
    for (int i = 0; i < loads; i++) scan_integer(loaded + i), scan(load_x + i), scan(load_y + i);
    steps = integers(segments), length = numbers(segments);
    force = calloc(segments, sizeof(double *));
    for (int s = 0; s < segments; s++) {
        scan_integer(steps + s), scan(length + s);
        force[s] = numbers(steps[s] + 1);
        for (int i = 0; i <= steps[s]; i++) scan(force[s] + i);
    }
    x = numbers(nodes), y = numbers(nodes), vx = numbers(nodes), vy = numbers(nodes);
    fx = numbers(nodes), fy = numbers(nodes), reach = numbers(nodes), keep = numbers(nodes);
}

static void evaluate(double total) {
    for (int i = 0; i < nodes; i++) fx[i] = fy[i] = 0.0;
    for (int e = 0; e < edges; e++) {
        int a = from[e], b = to[e];
        double dx = x[b] - x[a], dy = y[b] - y[a];
        double g = stiffness[e] * (1.0 - rest[e] / sqrt(dx * dx + dy * dy));
        fx[a] += g * dx, fy[a] += g * dy;
        fx[b] -= g * dx, fy[b] -= g * dy;
    }
    for (int i = 0; i < loads; i++) {
        fx[loaded[i]] += load_x[i] * total;
        fy[loaded[i]] += load_y[i] * total;
    }
}

static void kick(double h) {
    for (int i = 0; i < nodes; i++) {
        vx[i] += h * fx[i] * inverse_mass[i];
        vy[i] += h * fy[i] * inverse_mass[i];
    }
}

static void solve(void) {
    for (int i = 0; i < nodes; i++) x[i] = rest_x[i], y[i] = rest_y[i], vx[i] = vy[i] = 0.0;
    for (int s = 0; s < segments; s++) {
        double h = length[s];
        for (int i = 0; i < nodes; i++) {
            reach[i] = decay[i] == 0.0 ? h : -expm1(-decay[i] * h) / decay[i];
            keep[i] = exp(-decay[i] * h);
        }
        evaluate(force[s][0]);
        for (int step = 1; step <= steps[s]; step++) {
            kick(0.5 * h);
            for (int i = 0; i < nodes; i++) {
                x[i] += reach[i] * vx[i], y[i] += reach[i] * vy[i];
                vx[i] *= keep[i], vy[i] *= keep[i];
            }
            evaluate(force[s][step]);
            kick(0.5 * h);
        }
    }
}

int main(void) {
    read_problem();
    while (getchar() != '\n') {
    }
    while (getchar() != EOF) {
        struct timespec begun, ended;
        clock_gettime(CLOCK_MONOTONIC, &begun);
        solve();
        clock_gettime(CLOCK_MONOTONIC, &ended);
        double sum = 0.0;
        for (int i = 0; i < nodes; i++) sum += x[i] + y[i];
        double seconds = (double)(ended.tv_sec - begun.tv_sec) + 1e-9 * (double)(ended.tv_nsec - begun.tv_nsec);
        printf("%.9e %.17e\n", seconds, sum);
        fflush(stdout);
    }
    return 0;
}
