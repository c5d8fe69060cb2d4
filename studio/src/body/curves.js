// Filters and differences over time, as scipy and numpy define them; a curve is an array of numbers.

/** Gaussian average; `mode` "nearest" repeats the ends, "reflect" mirrors them (d c b a | a b c d). */
export function gaussian(values, deviation, mode = "nearest") {
  const reach = Math.floor(4 * deviation + 0.5), weights = [];
  for (let i = -reach; i <= reach; i++) weights.push(Math.exp((-0.5 * i * i) / (deviation * deviation)));
  const total = weights.reduce((a, b) => a + b, 0);
  return values.map((_, at) => {
    let sum = 0;
    for (let i = -reach; i <= reach; i++) sum += weights[i + reach] * values[inside(at + i, values.length, mode)];
    return sum / total;
  });
}

function inside(at, length, mode) {
  if (mode === "nearest") return Math.min(Math.max(at, 0), length - 1);
  const round = 2 * length;
  const place = ((at % round) + round) % round;
  return place < length ? place : round - 1 - place;
}

function extreme(values, width, pick) {
  const half = Math.floor(width / 2);
  return values.map((_, at) => {
    let found = values[at];
    for (let i = -half; i <= width - 1 - half; i++) found = pick(found, values[inside(at + i, values.length, "reflect")]);
    return found;
  });
}
export const maximum = (values, width) => extreme(values, width, Math.max);
export const minimum = (values, width) => extreme(values, width, Math.min);

/** Central differences, one-sided at the ends. */
export const gradient = (values) =>
  values.map((_, t) => {
    if (t === 0) return values[1] - values[0];
    if (t === values.length - 1) return values[t] - values[t - 1];
    return (values[t + 1] - values[t - 1]) / 2;
  });

/** As numpy's default, linear between the ranks. */
export function percentile(values, share) {
  const sorted = [...values].sort((a, b) => a - b);
  const rank = ((sorted.length - 1) * share) / 100, low = Math.floor(rank);
  const next = sorted[Math.min(low + 1, sorted.length - 1)];
  return sorted[low] + (rank - low) * (next - sorted[low]);
}

/** y at `at`, on straight lines between points of increasing x. */
export function interpolate(at, x, y) {
  if (at <= x[0]) return y[0];
  if (at >= x[x.length - 1]) return y[y.length - 1];
  let low = 0, high = x.length - 1;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (x[middle] <= at) low = middle;
    else high = middle;
  }
  return y[low] + ((y[high] - y[low]) * (at - x[low])) / (x[high] - x[low]);
}

export const linspace = (from, to, number) =>
  Array.from({ length: number }, (_, i) => (number === 1 ? from : from + ((to - from) * i) / (number - 1)));

/** To the even neighbour where two are equally near, as Python and numpy round. */
export function round(x) {
  const low = Math.floor(x), rest = x - low;
  if (rest !== 0.5) return Math.round(x);
  return low % 2 === 0 ? low : low + 1;
}
