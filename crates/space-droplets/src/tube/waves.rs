//! Sums of sources over waves, and of waves at targets.

use motile_base::internal::widely;

/// Points that are treated together.
pub(super) const LANES: usize = 8;
type Lanes = [f64; LANES];
/// Groups of points whose functions are kept at a time.
const BLOCK: usize = 16;
/// Weights of a source: three of a force, or six of a stresslet.
pub(super) const MOST_WEIGHTS: usize = 6;
/// Functions of each order: `I_n cos(n phi)`, `I_n sin(n phi)`, and the same with `k r I_(n+1)`.
pub(super) const FUNCTIONS: usize = 4;

/// Sums of one order: for each weight the four functions times `cos(k z)`, then times `sin(k z)`.
pub(super) type Sums = [[[f64; FUNCTIONS]; 2]; MOST_WEIGHTS];
/// The same for each lane.
type Totals = [[[Lanes; FUNCTIONS]; 2]; MOST_WEIGHTS];
/// No sums.
pub(super) const NONE: Sums = [[[0.0; FUNCTIONS]; 2]; MOST_WEIGHTS];

/// Points in the units and the frame of a tube, in groups; the last group is filled up with points on the axis.
#[derive(Debug, Clone, Default)]
pub(super) struct Points {
    pub(super) count: usize,
    places: [Vec<Lanes>; 3],
    radius: Vec<Lanes>,
    /// Weights, as many groups after each other for each weight.
    weights: [Vec<Lanes>; MOST_WEIGHTS],
}

impl Points {
    pub(super) fn clear(&mut self) {
        self.count = 0;
        self.places.iter_mut().chain(&mut self.weights).chain([&mut self.radius]).for_each(Vec::clear);
    }

    /// Adds a point with its weights.
    pub(super) fn push(&mut self, place: [f64; 3], weights: [f64; MOST_WEIGHTS]) {
        let (last, lane) = (self.count / LANES, self.count % LANES);
        self.count += 1;
        let values = place.into_iter().chain(weights).chain([place[0].hypot(place[1])]);
        let lists = self.places.iter_mut().chain(&mut self.weights).chain([&mut self.radius]);
        for (list, value) in lists.zip(values) {
            if lane == 0 {
                list.push([0.0; LANES]);
            }
            list[last][lane] = value;
        }
    }
}

/// Memory for the functions of a block of points.
#[derive(Debug, Clone, Default)]
pub(super) struct Functions {
    /// For each order the four functions, each for all groups of the block.
    rows: Vec<Lanes>,
    /// `cos(k z)` and `sin(k z)` for all groups, then their products with a weight.
    phases: [[Lanes; BLOCK]; 2],
    products: [[Lanes; BLOCK]; 2],
    /// Sums of each lane, of which one number is made at the end.
    totals: Vec<Totals>,
    series: Vec<Lanes>,
    /// Inverse of the series at the wall, and its sum.
    wall: Vec<f64>,
    wall_sum: f64,
}

/// Writes the series `t_n = I_n(x) n!/(x/2)^n` times a factor for the orders of a list, by the recurrence downwards,
/// and returns exp(x) times this factor, from `exp(x) = I_0 + 2 I_1 + 2 I_2 ..`. The largest x is given.
#[inline(always)]
fn series(x: &Lanes, largest: f64, list: &mut [Lanes]) -> Lanes {
    // Errors of the start fall as exp(-n^2/x), and the sum has what is beyond as exp(-n^2/(2 x)).
    let orders = list.len() as f64;
    let begin = (orders * orders + 80.0 * largest).sqrt() as usize + 10;
    let square = x.map(|x| 0.25 * x * x);
    let (mut above, mut here, mut sum) = ([1.0; LANES], [1.0; LANES], [1.0; LANES]);
    for n in (1..=begin).rev() {
        if let Some(entry) = list.get_mut(n) {
            *entry = here;
        }
        let (n, mut below) = (n as f64, [0.0; LANES]);
        let (back, half) = (1.0 / (n * (n + 1.0)), 0.5 / n);
        for lane in 0..LANES {
            below[lane] = here[lane] + square[lane] * back * above[lane];
            sum[lane] = below[lane] + x[lane] * half * sum[lane];
        }
        (above, here) = (here, below);
    }
    list[0] = here;
    std::array::from_fn(|lane| 2.0 * sum[lane] - here[lane])
}

/// Returns exp(x), by the series of a fraction of x and squares.
#[inline(always)]
fn exponential(x: &Lanes) -> Lanes {
    let halvings = halvings(x);
    let scale = 0.5_f64.powi(halvings);
    let part = x.map(|x| x * scale);
    let mut value = [1.0; LANES];
    for n in (1..=TERMS).rev() {
        let back = 1.0 / f64::from(n);
        for lane in 0..LANES {
            value[lane] = 1.0 + part[lane] * back * value[lane];
        }
    }
    for _ in 0..halvings {
        value = value.map(|value| value * value);
    }
    value
}

/// Returns cosines and sines, by their series for a fraction of x and doubled angles.
#[inline(always)]
fn waves(x: &Lanes) -> [Lanes; 2] {
    let halvings = halvings(x);
    let scale = 0.5_f64.powi(halvings);
    let part = x.map(|x| x * scale);
    let square = part.map(|x| x * x);
    // 1 - cos and sin: differences from 1 keep their digits when they are doubled.
    let (mut less, mut sin) = ([1.0; LANES], [1.0; LANES]);
    for n in (1..TERMS / 2).rev() {
        let (even, odd) = (1.0 / f64::from((2 * n + 1) * (2 * n + 2)), 1.0 / f64::from(2 * n * (2 * n + 1)));
        for lane in 0..LANES {
            less[lane] = 1.0 - square[lane] * even * less[lane];
            sin[lane] = 1.0 - square[lane] * odd * sin[lane];
        }
    }
    for lane in 0..LANES {
        less[lane] *= 0.5 * square[lane];
        sin[lane] *= part[lane];
    }
    for _ in 0..halvings {
        for lane in 0..LANES {
            let (a, b) = (less[lane], sin[lane]);
            (less[lane], sin[lane]) = (2.0 * b * b, 2.0 * b * (1.0 - a));
        }
    }
    [less.map(|less| 1.0 - less), sin]
}

/// Terms of the series of exp for parts of at most 1/2.
const TERMS: i32 = 14;

/// Returns how often the largest of these is halved to be at most 1/2.
#[inline(always)]
fn halvings(x: &Lanes) -> i32 {
    let mut largest = x.iter().fold(0.0_f64, |most, x| most.max(x.abs()));
    let mut count = 0;
    while largest > 0.5 {
        largest *= 0.5;
        count += 1;
    }
    count
}

impl Functions {
    /// Prepares for a wave number and so many orders.
    pub(super) fn prepare(&mut self, k: f64, orders: usize) {
        self.rows.resize(orders * FUNCTIONS * BLOCK, [0.0; LANES]);
        self.series.resize(orders + 1, [0.0; LANES]);
        let Self { series: list, wall, wall_sum, .. } = self;
        *wall_sum = series(&[k; LANES], k, list)[0];
        wall.clear();
        wall.extend(list.iter().map(|values| 1.0 / values[0]));
    }

    /// Computes the functions of the groups from `first`, over I_n at the wall, and returns their number.
    fn fill(&mut self, points: &Points, first: usize, k: f64, orders: usize) -> usize {
        let groups = (points.places[0].len() - first).min(BLOCK);
        for group in 0..groups {
            let [x, y, z] = points.places.each_ref().map(|list| &list[first + group]);
            let radius = &points.radius[first + group];
            let Self { rows, series: list, wall, wall_sum, phases, .. } = self;
            widely(
                #[inline(always)]
                || {
                    let growth = exponential(&radius.map(|r| k * (r - 1.0)));
                    [phases[0][group], phases[1][group]] = waves(&z.map(|z| k * z));
                    let sum = series(&radius.map(|r| k * r), k, list);
                    let (mut c, mut s) = ([0.0; LANES], [0.0; LANES]);
                    let mut square = [0.0; LANES];
                    for lane in 0..LANES {
                        c[lane] = growth[lane] * *wall_sum / sum[lane];
                        square[lane] = 0.5 * (k * radius[lane]).powi(2);
                    }
                    // (x + i y)^n = r^n exp(i n phi), and X_n = (k r)^2/(2 (n + 1)) t_(n+1)/t_n psi_n.
                    for n in 0..orders {
                        let row = n * FUNCTIONS * BLOCK + group;
                        let (factor, next) = (wall[n], wall[n] / (n + 1) as f64);
                        let mut values = [[0.0; LANES]; FUNCTIONS];
                        for lane in 0..LANES {
                            let psi = factor * list[n][lane];
                            let x = next * square[lane] * list[n + 1][lane];
                            values[0][lane] = psi * c[lane];
                            values[1][lane] = psi * s[lane];
                            values[2][lane] = x * c[lane];
                            values[3][lane] = x * s[lane];
                        }
                        for (f, values) in values.into_iter().enumerate() {
                            rows[row + f * BLOCK] = values;
                        }
                        for lane in 0..LANES {
                            let (a, b) = (c[lane], s[lane]);
                            c[lane] = a * x[lane] - b * y[lane];
                            s[lane] = b * x[lane] + a * y[lane];
                        }
                    }
                },
            );
        }
        groups
    }

    /// Adds the sums of all points over their functions and so many weights, for each order.
    pub(super) fn gather(&mut self, points: &Points, k: f64, weights: usize, sums: &mut [Sums]) {
        self.totals.clear();
        self.totals.resize(sums.len(), [[[[0.0; LANES]; FUNCTIONS]; 2]; MOST_WEIGHTS]);
        for first in (0..points.places[0].len()).step_by(BLOCK) {
            let groups = self.fill(points, first, k, sums.len());
            for weight in 0..weights {
                let list = &points.weights[weight][first..first + groups];
                let Self { rows, phases, products, totals, .. } = self;
                widely(
                    #[inline(always)]
                    || {
                        for (product, phase) in products.iter_mut().zip(&*phases) {
                            for ((product, phase), weight) in product.iter_mut().zip(phase).zip(list) {
                                for lane in 0..LANES {
                                    product[lane] = phase[lane] * weight[lane];
                                }
                            }
                        }
                        for (sums, rows) in totals.iter_mut().zip(rows.chunks_exact(FUNCTIONS * BLOCK)) {
                            for (sums, product) in sums[weight].iter_mut().zip(&*products) {
                                let mut totals = *sums;
                                for group in 0..groups {
                                    for (f, total) in totals.iter_mut().enumerate() {
                                        for lane in 0..LANES {
                                            total[lane] += rows[f * BLOCK + group][lane] * product[group][lane];
                                        }
                                    }
                                }
                                *sums = totals;
                            }
                        }
                    },
                );
            }
        }
        for (sums, totals) in sums.iter_mut().zip(&self.totals) {
            for (sum, total) in sums[..weights]
                .as_flattened_mut()
                .as_flattened_mut()
                .iter_mut()
                .zip(totals.as_flattened().as_flattened())
            {
                let pairs: [f64; 4] = std::array::from_fn(|lane| total[lane] + total[lane + 4]);
                *sum += (pairs[0] + pairs[2]) + (pairs[1] + pairs[3]);
            }
        }
    }

    /// Adds the velocities at all points, of which `factors` has the multiples of each function, phase and component.
    pub(super) fn spread(
        &mut self,
        points: &Points,
        k: f64,
        factors: &[[[[f64; FUNCTIONS]; 2]; 3]],
        out: &mut [[Lanes; 3]],
    ) {
        for first in (0..points.places[0].len()).step_by(BLOCK) {
            let groups = self.fill(points, first, k, factors.len());
            for group in 0..groups {
                let Self { rows, phases, .. } = self;
                let out = &mut out[first + group];
                widely(
                    #[inline(always)]
                    || {
                        let mut sums = [[[0.0; LANES]; 2]; 3];
                        for (factors, rows) in factors.iter().zip(rows.chunks_exact(FUNCTIONS * BLOCK)) {
                            for (f, row) in rows[group..].iter().step_by(BLOCK).enumerate() {
                                for i in 0..3 {
                                    for phase in 0..2 {
                                        let factor = factors[i][phase][f];
                                        for lane in 0..LANES {
                                            sums[i][phase][lane] += factor * row[lane];
                                        }
                                    }
                                }
                            }
                        }
                        for i in 0..3 {
                            for lane in 0..LANES {
                                out[i][lane] += sums[i][0][lane] * phases[0][group][lane]
                                    + sums[i][1][lane] * phases[1][group][lane];
                            }
                        }
                    },
                );
            }
        }
    }
}
