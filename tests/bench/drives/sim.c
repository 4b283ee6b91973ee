/* Servo drive in time: bodies, couplings with play, Coulomb friction, sampled control. RK4. */
#include <math.h>
#include <string.h>
#define MAXB 8
#define MAXC 16
typedef struct {
  int nb, nc, fi, fj, nsub, hold, closed;
  int ci[MAXC], cj[MAXC];
  double J[MAXB], k[MAXC], d[MAXC], gap[MAXC];
  double tc, vs;          /* Coulomb torque and speed of its rounding, fi against fj */
  double fs, lsb;
  double t0, ramp;        /* constant torque, its slope [Nm/s] */
  double kp, ki, filt, wref; /* PI of the speed; filt: coefficient of the first-order filter */
} Drive;

static void rate(const Drive *p, const double *x, double torque, double *dx) {
  int n = p->nb;
  double f[MAXB];
  for (int i = 0; i < n; i++) { f[i] = 0; dx[i] = x[n + i]; }
  for (int c = 0; c < p->nc; c++) {
    int i = p->ci[c], j = p->cj[c];
    double a = x[i], v = x[n + i];
    if (j >= 0) { a -= x[j]; v -= x[n + j]; }
    double t = 0, g = 0.5 * p->gap[c];
    if (g == 0) t = p->k[c] * a + p->d[c] * v;
    else if (a > g) t = p->k[c] * (a - g) + p->d[c] * v;
    else if (a < -g) t = p->k[c] * (a + g) + p->d[c] * v;
    f[i] -= t;
    if (j >= 0) f[j] += t;
  }
  double v = x[n + p->fi] - (p->fj >= 0 ? x[n + p->fj] : 0);
  if (p->tc > 0) torque -= p->tc * tanh(v / p->vs);
  f[p->fi] += torque;
  if (p->fj >= 0) f[p->fj] -= torque;
  for (int i = 0; i < n; i++) dx[n + i] = f[i] / p->J[i];
}

/* table: torque at half substeps over one period (hold 0), or at samples (hold 1).
   N samples, P a period; dist: disturbance torque, held over each sample. Returns 1 if it runs away. */
int simulate(const Drive *p, const double *table, long P, long N, const double *dist, double *x,
             double *angle, double *command, double *excitation) {
  int n = 2 * p->nb, s = p->nsub;
  double h = 1 / p->fs / s, k1[2*MAXB], k2[2*MAXB], k3[2*MAXB], k4[2*MAXB], y[2*MAXB];
  double applied = p->t0, next, integral = 0, last = 0, speed = 0;
  for (long q = 0; q < N; q++) {
    double a = x[p->fi] - (p->fj >= 0 ? x[p->fj] : 0);
    double seen = p->lsb * floor(a / p->lsb + 0.5);
    if (q == 0) { last = seen; speed = p->wref; }
    speed += p->filt * ((seen - last) * p->fs - speed);
    if (q == 0) speed = p->wref;
    last = seen;
    double t0 = p->t0 + p->ramp * q / p->fs;
    double e = p->hold ? table[q % P] : table[(q % P) * 2 * s];
    double u = e + t0;
    if (p->closed) {
      double err = p->wref - speed;
      integral += p->ki * err / p->fs;
      u += p->kp * err + integral;
    }
    angle[q] = seen; command[q] = u; excitation[q] = e;
    for (int r = 0; r < s; r++) {
      double ta, tb, tc;
      if (p->hold) ta = tb = tc = applied;
      else {
        long b = (q % P) * 2 * s + 2 * r, L = P * 2 * s;
        ta = table[b] + t0; tb = table[b + 1] + t0; tc = table[(b + 2) % L] + t0;
      }
      ta += dist[q]; tb += dist[q]; tc += dist[q];
      rate(p, x, ta, k1);
      for (int i = 0; i < n; i++) y[i] = x[i] + 0.5 * h * k1[i];
      rate(p, y, tb, k2);
      for (int i = 0; i < n; i++) y[i] = x[i] + 0.5 * h * k2[i];
      rate(p, y, tb, k3);
      for (int i = 0; i < n; i++) y[i] = x[i] + h * k3[i];
      rate(p, y, tc, k4);
      for (int i = 0; i < n; i++) x[i] += h / 6 * (k1[i] + 2 * k2[i] + 2 * k3[i] + k4[i]);
    }
    applied = u; /* what was computed from this sample acts from the next one on */
    if (!(fabs(x[p->nb + p->fi]) < 1e5)) return 1;
  }
  return 0;
}
