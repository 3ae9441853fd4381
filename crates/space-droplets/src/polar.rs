//! The values of fields on a polar grid about a point of the surface.
//!
//! For a target at the parameter s0, turn the unit sphere so that s0 is its north pole. Gauss-Legendre points in theta
//! itself, times uniform points in phi, are a spectral rule there. The area element sin(theta) cancels the singularity
//! 1/r of a Stokeslet, and the rest is smooth in theta for each phi. The grid is symmetric in theta, so the same
//! points serve the antipode of s0, whose pole is the southern one. Four targets of one row are the lanes of a
//! [`Lanes`], and their coefficients go through the same products together.

use std::f64::consts::{PI, TAU};

use motile_base::internal::gauss_legendre;
use sphere_harmonics::{HarmonicsError, Point, Tilt, count, harmonics, index};

/// Targets that are treated together: a register of AVX.
pub(crate) const LANES: usize = 4;
/// Fields of a product.
pub(crate) const FIELDS: usize = 6;
/// Six fields of four targets, field after field.
pub(crate) type Lanes = [f64; FIELDS * LANES];
/// A wave of the angle, and the first of the orders, every other one, that it is for.
type Wave = (fn(f64) -> f64, usize);
/// Nothing yet.
pub(crate) const ZERO: Lanes = [0.0; FIELDS * LANES];
/// Size below which harmonics near a pole are left out: they are below the round-off of the sums.
const NEGLIGIBLE: f64 = 1e-16;

/// Two rings of the polar grid, at theta and pi - theta.
#[derive(Debug, Clone)]
struct Ring {
    /// Weight of each point, with the area element.
    weight: f64,
    /// Largest order that counts.
    most: usize,
    /// Legendre functions: for each order m, the degrees l = m, m + 1 .. p.
    table: Vec<f64>,
}

/// The polar rule of one degree, for all rows of the Gauss grid.
#[derive(Debug, Clone)]
pub(crate) struct Polar {
    degree: usize,
    rings: Vec<Ring>,
    /// The Legendre functions once more: for each pair l >= m, at l (l + 1)/2 + m, the values of all rings.
    by_pair: Vec<f64>,
    /// Quarter of the points of a ring.
    quarter: usize,
    /// For each point of a quarter, the cosines of the even and odd orders, then the sines.
    waves: [Vec<f64>; 4],
    /// Cosines and sines once more, for each order all points of a quarter.
    transposed: [Vec<f64>; 4],
    /// The rotations of the northern rows, the equator among them.
    tilts: Vec<Tilt>,
}

/// Memory of one thread.
#[derive(Debug, Clone)]
pub(crate) struct Work {
    /// Coefficients about the z axis, then about the target.
    pub(crate) turned: Vec<Lanes>,
    tilted: Vec<Lanes>,
    /// Fourier coefficients of the northern and the southern ring: cosines of even and odd orders, sines.
    north: [Vec<Lanes>; 4],
    south: [Vec<Lanes>; 4],
    /// Sums over the four points of a quarter.
    folded: [Vec<Lanes>; 4],
    /// Fourier sums of all rings, even and odd in theta - pi/2: for each order the cosines, then the sines, of all
    /// rings.
    halves: [Vec<Lanes>; 2],
}

/// Returns the sums of rows times the factors of each result.
#[inline(always)]
fn combine<'a, const R: usize>(factors: [&[f64]; R], row: impl Fn(usize) -> &'a Lanes) -> [Lanes; R] {
    let mut sums = [ZERO; R];
    let len = factors[0].len();
    let factors = factors.map(|list| &list[..len]);
    // Indices keep all factors of a row together.
    #[expect(clippy::needless_range_loop)]
    for k in 0..len {
        let row = row(k);
        for r in 0..R {
            let factor = factors[r][k];
            for c in 0..FIELDS * LANES {
                sums[r][c] += factor * row[c];
            }
        }
    }
    sums
}

/// Calls `put` with each row of a matrix of that many columns times the lanes, two rows at a time.
#[inline(always)]
fn product<'a>(
    matrix: &[f64],
    columns: usize,
    row: impl Fn(usize) -> &'a Lanes + Copy,
    mut put: impl FnMut(usize, Lanes),
) {
    let mut pairs = matrix.chunks_exact(2 * columns.max(1));
    let mut k = 0;
    for pair in &mut pairs {
        let [first, second] = combine([&pair[..columns], &pair[columns..]], row);
        put(k, first);
        put(k + 1, second);
        k += 2;
    }
    if pairs.remainder().len() == columns && columns > 0 {
        let [last] = combine([pairs.remainder()], row);
        put(k, last);
    }
}

#[inline(always)]
fn add(a: &Lanes, b: &Lanes) -> Lanes {
    let mut sum = ZERO;
    for c in 0..FIELDS * LANES {
        sum[c] = a[c] + b[c];
    }
    sum
}

#[inline(always)]
fn subtract(a: &Lanes, b: &Lanes) -> Lanes {
    let mut difference = ZERO;
    for c in 0..FIELDS * LANES {
        difference[c] = a[c] - b[c];
    }
    difference
}

/// Visits the points phi, -phi, pi - phi and pi + phi, from the sums of even and odd cosines and sines at phi.
#[inline(always)]
fn four(visit: &mut impl FnMut(f64, &Lanes), weight: f64, [ce, co, se, so]: [&Lanes; 4]) {
    let (right, left) = (add(ce, so), subtract(ce, so));
    let (up, down) = (add(co, se), subtract(co, se));
    visit(weight, &add(&right, &up));
    visit(weight, &add(&left, &down));
    visit(weight, &subtract(&right, &up));
    visit(weight, &subtract(&left, &down));
}

impl Polar {
    /// Creates the rule with that many rings, an even number, and points per ring, a multiple of four, for the rows of
    /// the Gauss grid at those colatitudes.
    pub(crate) fn new(
        degree: usize,
        colatitudes: &[f64],
        rings: usize,
        columns: usize,
    ) -> Result<Self, HarmonicsError> {
        let tilts = colatitudes[..colatitudes.len().div_ceil(2)].iter().map(|&theta| Tilt::new(degree, theta));
        let tilts = tilts.collect::<Result<_, _>>()?;
        let ring = |&(x, weight): &(f64, f64)| {
            let theta = 0.5 * PI * (1.0 - x);
            let values = harmonics(degree, Point { theta, phi: 0.0 })?;
            let size = |m: usize| (m..=degree).map(|l| values[index(l, m as isize)].abs()).fold(0.0, f64::max);
            let most = (0..=degree).rfind(|&m| size(m) > NEGLIGIBLE).unwrap_or(0);
            let table = (0..=degree).flat_map(|m| (m..=degree).map(move |l| (l, m)));
            let table = table.map(|(l, m)| values[index(l, m as isize)]).collect();
            Ok(Ring { weight: 0.5 * PI * weight * theta.sin() * TAU / columns as f64, most, table })
        };
        let rule = gauss_legendre(rings);
        let rings: Vec<Ring> = rule[..rings / 2].iter().map(ring).collect::<Result<_, HarmonicsError>>()?;
        let pairs = (0..=degree).flat_map(|l| (0..=l).map(move |m| (l, m)));
        // Before order m, a table has p + 1, p, .. entries.
        let entry = |(l, m): (usize, usize)| m * (2 * degree + 3 - m) / 2 + l - m;
        let by_pair = pairs.flat_map(|pair| rings.iter().map(move |ring| ring.table[entry(pair)])).collect();
        let quarter = columns / 4;
        let orders = |first: usize| (first..=degree).step_by(2);
        let angle = |m: usize, j: usize| m as f64 * TAU * (j as f64 + 0.5) / columns as f64;
        let kinds: [Wave; 4] = [(f64::cos, 0), (f64::cos, 1), (f64::sin, 0), (f64::sin, 1)];
        let by_point = |(wave, first): Wave| {
            (0..quarter).flat_map(|j| orders(first).map(move |m| wave(angle(m, j)))).collect::<Vec<f64>>()
        };
        let by_order = |(wave, first): Wave| {
            orders(first).flat_map(|m| (0..quarter).map(move |j| wave(angle(m, j)))).collect::<Vec<f64>>()
        };
        let (waves, transposed) = (kinds.map(by_point), kinds.map(by_order));
        Ok(Self { degree, rings, by_pair, quarter, waves, transposed, tilts })
    }

    /// Returns the memory that a thread needs.
    pub(crate) fn work(&self) -> Work {
        let orders = || vec![ZERO; self.degree / 2 + 1];
        let (north, south) = ([(); 4].map(|()| orders()), [(); 4].map(|()| orders()));
        let folded = [(); 4].map(|()| vec![ZERO; self.quarter]);
        let halves = [(); 2].map(|()| vec![ZERO; 2 * (self.degree + 1) * self.rings.len()]);
        let turned = vec![ZERO; count(self.degree)];
        Work { tilted: turned.clone(), turned, north, south, folded, halves }
    }

    /// Puts the coefficients of up to six fields, as seen after turns about the z axis by these angles, to
    /// `work.turned`.
    #[inline(always)]
    pub(crate) fn turn(&self, work: &mut Work, fields: &[&[f64]], phi: [f64; LANES]) {
        for m in 0..=self.degree {
            let turns: [(f64, f64); LANES] = phi.map(|phi| (m as f64 * phi).sin_cos());
            for l in m..=self.degree {
                let (c, s) = (l * l + l + m, l * l + l - m);
                for (f, field) in fields.iter().enumerate() {
                    for (t, (sin, cos)) in turns.iter().enumerate() {
                        // For m = 0 both are the same entry, and the turn is none.
                        work.turned[s][f * LANES + t] = field[s] * cos - field[c] * sin;
                        work.turned[c][f * LANES + t] = field[c] * cos + field[s] * sin;
                    }
                }
            }
        }
    }

    /// Tilts `work.turned` to the targets of a northern row.
    #[inline(always)]
    pub(crate) fn tilt(&self, work: &mut Work, row: usize) {
        let Work { turned, tilted, .. } = work;
        for l in 0..=self.degree {
            let (zero, old) = (l * l + l, &*turned);
            product(
                self.tilts[row].cosines(l),
                l + 1,
                #[inline(always)]
                |m| &old[zero + m],
                #[inline(always)]
                |k, lanes| tilted[zero + k] = lanes,
            );
            let sines = self.tilts[row].sines(l);
            product(
                sines,
                l,
                #[inline(always)]
                |m| &old[zero - 1 - m],
                #[inline(always)]
                |k, lanes| tilted[zero - 1 - k] = lanes,
            );
        }
    }

    /// Legendre sums of both rings: the even and odd functions of theta - pi/2 apart, then added and subtracted.
    #[inline(always)]
    fn legendre(&self, work: &mut Work, ring: &Ring) {
        let mut start = 0;
        for m in 0..=ring.most {
            let table = &ring.table[start..][..self.degree + 1 - m];
            start += table.len();
            for sine in [false, true] {
                if sine && m == 0 {
                    continue;
                }
                let (mut even, mut odd) = (ZERO, ZERO);
                let place = |l: usize| if sine { l * l + l - m } else { l * l + l + m };
                let mut pairs = table.chunks_exact(2);
                let mut l = m;
                for factors in &mut pairs {
                    let (first, second) = (&work.tilted[place(l)], &work.tilted[place(l + 1)]);
                    for c in 0..FIELDS * LANES {
                        even[c] += factors[0] * first[c];
                        odd[c] += factors[1] * second[c];
                    }
                    l += 2;
                }
                if let [factor] = pairs.remainder() {
                    let last = &work.tilted[place(l)];
                    for c in 0..FIELDS * LANES {
                        even[c] += factor * last[c];
                    }
                }
                let kind = m % 2 + if sine { 2 } else { 0 };
                work.north[kind][m / 2] = add(&even, &odd);
                work.south[kind][m / 2] = subtract(&even, &odd);
            }
        }
    }

    /// Returns the number of orders of each kind (cosines of even and odd orders, sines) up to `most`.
    fn orders(most: usize) -> [usize; 4] {
        [most / 2 + 1, most.div_ceil(2), most / 2 + 1, most.div_ceil(2)]
    }

    /// Calls `visit` with the weight and the values of all fields at each point of the grid.
    #[inline(always)]
    pub(crate) fn visit(&self, work: &mut Work, mut visit: impl FnMut(f64, &Lanes)) {
        let strides = Self::orders(self.degree);
        for ring in &self.rings {
            self.legendre(work, ring);
            let orders = Self::orders(ring.most);
            for coefficients in [&work.north, &work.south] {
                let mut j = 0;
                while j + 1 < self.quarter {
                    let [ce, ce2] = self.pair(&strides, &orders, coefficients, 0, j);
                    let [co, co2] = self.pair(&strides, &orders, coefficients, 1, j);
                    let [se, se2] = self.pair(&strides, &orders, coefficients, 2, j);
                    let [so, so2] = self.pair(&strides, &orders, coefficients, 3, j);
                    four(&mut visit, ring.weight, [&ce, &co, &se, &so]);
                    four(&mut visit, ring.weight, [&ce2, &co2, &se2, &so2]);
                    j += 2;
                }
                if j < self.quarter {
                    let [ce, _] = self.pair(&strides, &orders, coefficients, 0, j);
                    let [co, _] = self.pair(&strides, &orders, coefficients, 1, j);
                    let [se, _] = self.pair(&strides, &orders, coefficients, 2, j);
                    let [so, _] = self.pair(&strides, &orders, coefficients, 3, j);
                    four(&mut visit, ring.weight, [&ce, &co, &se, &so]);
                }
            }
        }
    }

    /// Returns the Fourier sums of one kind at the points j and j + 1 of a quarter, or twice at j if it is the last.
    #[inline(always)]
    fn pair(
        &self,
        strides: &[usize; 4],
        orders: &[usize; 4],
        coefficients: &[Vec<Lanes>; 4],
        kind: usize,
        j: usize,
    ) -> [Lanes; 2] {
        let (waves, stride, order) = (&self.waves[kind], strides[kind], orders[kind]);
        let next = (j + 1).min(self.quarter - 1);
        let lanes = &coefficients[kind][..order];
        combine(
            [&waves[j * stride..][..order], &waves[next * stride..][..order]],
            #[inline(always)]
            |m| &lanes[m],
        )
    }

    /// Returns the number of points.
    pub(crate) fn points(&self) -> usize {
        8 * self.quarter * self.rings.len()
    }

    /// Writes the sums over all points, in the order of [`Polar::visit`], of the values times each harmonic of the
    /// untilted and unturned sphere: the transpose of [`Polar::turn`], [`Polar::tilt`] and [`Polar::visit`].
    #[inline(always)]
    pub(crate) fn gather(
        &self,
        work: &mut Work,
        values: &[Lanes],
        (row, phi): (usize, [f64; LANES]),
        sums: &mut [Lanes],
    ) {
        for (number, values) in values.chunks_exact(8 * self.quarter).enumerate() {
            self.gather_ring(work, number, values);
        }
        self.gather_rings(work);
        self.tilt(work, row);
        // The transpose of a tilt is the tilt between two turns by pi; the first is in `gather_ring`.
        for m in 0..=self.degree {
            let turns: [(f64, f64); LANES] = phi.map(|phi| (m as f64 * (phi + PI)).sin_cos());
            for l in m..=self.degree {
                let (c, s) = (l * l + l + m, l * l + l - m);
                for k in 0..FIELDS * LANES {
                    let (sin, cos) = turns[k % LANES];
                    sums[s][k] = work.tilted[s][k] * cos + work.tilted[c][k] * sin;
                    sums[c][k] = work.tilted[c][k] * cos - work.tilted[s][k] * sin;
                }
            }
        }
    }

    /// Fourier sums of two rings.
    #[inline(always)]
    fn gather_ring(&self, work: &mut Work, number: usize, values: &[Lanes]) {
        let (quarter, most, rings) = (self.quarter, self.rings[number].most, self.rings.len());
        let orders = Self::orders(most);
        for (side, values) in values.chunks_exact(4 * quarter).enumerate() {
            for (j, four) in values.chunks_exact(4).enumerate() {
                // The inverse of the sums in `visit`.
                let (right, left) = (add(&four[0], &four[1]), add(&four[2], &four[3]));
                let (up, down) = (subtract(&four[0], &four[1]), subtract(&four[2], &four[3]));
                work.folded[0][j] = add(&right, &left);
                work.folded[1][j] = subtract(&right, &left);
                work.folded[2][j] = subtract(&up, &down);
                work.folded[3][j] = add(&up, &down);
            }
            let target = if side == 0 { &mut work.north } else { &mut work.south };
            for kind in 0..4 {
                let matrix = &self.transposed[kind][..orders[kind] * quarter];
                let (folded, target) = (&work.folded[kind], &mut target[kind]);
                product(
                    matrix,
                    quarter,
                    #[inline(always)]
                    |j| &folded[j],
                    #[inline(always)]
                    |m, lanes| target[m] = lanes,
                );
            }
        }
        for m in 0..=most {
            for sine in 0..2 {
                let (north, south) = (&work.north[m % 2 + 2 * sine][m / 2], &work.south[m % 2 + 2 * sine][m / 2]);
                let place = (2 * m + sine) * rings + number;
                work.halves[0][place] = add(north, south);
                work.halves[1][place] = subtract(north, south);
            }
        }
    }

    /// Legendre sums over all rings to `work.turned`, odd orders with the other sign.
    #[inline(always)]
    fn gather_rings(&self, work: &mut Work) {
        let rings = self.rings.len();
        for m in 0..=self.degree {
            // Rings near the pole have no harmonics of high order.
            let first = self.rings.iter().position(|ring| ring.most >= m).unwrap_or(rings);
            for sine in 0..2.min(m + 1) {
                for parity in 0..2 {
                    let half = &work.halves[parity][(2 * m + sine) * rings..][first..rings];
                    let mut l = m + parity;
                    while l <= self.degree {
                        let next = (l + 2).min(self.degree - (self.degree - l) % 2);
                        let table = |l: usize| &self.by_pair[(l * (l + 1) / 2 + m) * rings..][first..rings];
                        let mut sums = combine(
                            [table(l), table(next)],
                            #[inline(always)]
                            |ring| &half[ring],
                        );
                        if m % 2 == 1 {
                            sums.as_flattened_mut().iter_mut().for_each(|sum| *sum = -*sum);
                        }
                        let place = |l: usize| if sine == 1 { l * l + l - m } else { l * l + l + m };
                        work.turned[place(l)] = sums[0];
                        work.turned[place(next)] = sums[1];
                        l += 4;
                    }
                }
            }
        }
    }
}
