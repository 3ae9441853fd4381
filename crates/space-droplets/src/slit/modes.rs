//! Sums over the waves of a slit: from sources to walls, and from walls to targets.

use std::f64::consts::PI;

use motile_base::internal::{dot, widely};

use super::rule::{Extent, Ring, Rule};
use crate::surroundings::{Components, FIELDS, Sources, Targets};
use crate::waves::cos_sin;

/// Sources and targets that are treated together.
const SOURCES: usize = 256;
pub(super) const TARGETS: usize = 64;
/// Sums of a wave vector: each field at both walls, times 1 and the distance from the wall.
const MOMENTS: usize = 4 * FIELDS;
/// Sums of a target: w, the longitudinal flow along x and y, the transverse flow along x and y.
const SUMS: usize = 16;

/// Complex numbers.
type Complex = [f64; 2];

/// The rings that one thread works on.
#[derive(Debug, Clone, Default)]
pub(super) struct Share {
    pub(super) rings: Vec<usize>,
    /// For each angle of these rings, the coefficients of the walls' flow: of w, even and odd, and of the transverse
    /// flow.
    pub(super) coefficients: Vec<[Complex; 6]>,
    moments: Vec<[Complex; MOMENTS]>,
    fields: Vec<[f64; SOURCES]>,
}

/// Targets that one thread works on.
#[derive(Debug, Clone, Default)]
pub(super) struct Block {
    /// List of targets, and the first of them.
    pub(super) group: usize,
    pub(super) first: usize,
    pub(super) sums: Vec<[f64; TARGETS]>,
}

/// Cosine and sine of an angle of a ring.
fn direction(ring: &Ring, angle: usize) -> [f64; 2] {
    let (sin, cos) = (PI * angle as f64 / ring.angles as f64).sin_cos();
    [cos, sin]
}

impl Share {
    /// Computes the coefficients of all rings of this share.
    pub(super) fn gather(&mut self, rule: &Rule, extent: &Extent, sources: &[Sources<'_>]) {
        self.coefficients.clear();
        self.fields.resize(MOMENTS + 5, [0.0; SOURCES]);
        let rings = std::mem::take(&mut self.rings);
        for &ring in &rings {
            let ring = &rule.rings[ring];
            let walls = Walls::new(ring.k);
            let start = self.coefficients.len();
            self.coefficients.resize(start + ring.angles, [[0.0; 2]; 6]);
            for source in sources {
                self.moments.clear();
                self.moments.resize(ring.angles, [[0.0; 2]; MOMENTS]);
                for first in (0..source.places()[0].len()).step_by(SOURCES) {
                    widely(
                        #[inline(always)]
                        || self.add_block(ring, extent, source, first),
                    );
                }
                let forces = matches!(source, Sources::Forces { .. });
                let weight = ring.weight * if forces { extent.scale } else { extent.scale * extent.scale };
                let flow = if forces { flow_of_forces } else { flow_of_doubles };
                let all = self.coefficients[start..].iter_mut().zip(&self.moments).enumerate();
                for (angle, (coefficients, moments)) in all {
                    let direction = direction(ring, angle);
                    let flows = [0, 1].map(|wall| flow(ring.k, direction, moments, wall));
                    for (sum, part) in coefficients.iter_mut().zip(walls.cancel(flows, weight)) {
                        *sum = mix(1.0, *sum, 1.0, part);
                    }
                }
            }
        }
        self.rings = rings;
    }

    /// Adds a block of sources to the moments of a ring.
    #[inline(always)]
    fn add_block(&mut self, ring: &Ring, extent: &Extent, source: &Sources<'_>, first: usize) {
        let (places, used) = (source.places(), source.fields());
        let len = SOURCES.min(places[0].len() - first);
        let (fields, rest) = self.fields.split_at_mut(MOMENTS);
        let [x, y, phases, cosines, sines] = rest else { return };
        for j in 0..len {
            let [px, py, z] = extent.local(&places, first + j);
            (x[j], y[j]) = (-ring.k * px, -ring.k * py);
            let values = source.values(first + j);
            for (wall, a) in [1.0 - z, 1.0 + z].into_iter().enumerate() {
                let decay = (-ring.k * a).exp();
                for (f, value) in values[..used].iter().enumerate() {
                    fields[moment(wall, 0, f)][j] = decay * value;
                    fields[moment(wall, 1, f)][j] = a * decay * value;
                }
            }
        }
        for (angle, moments) in self.moments.iter_mut().enumerate() {
            let [c, s] = direction(ring, angle);
            for j in 0..len {
                phases[j] = c * x[j] + s * y[j];
            }
            cos_sin(&phases[..len], &mut cosines[..len], &mut sines[..len]);
            for half in 0..4 {
                for f in 0..used {
                    let place = half * FIELDS + f;
                    moments[place][0] += dot(&cosines[..len], &fields[place][..len]);
                    moments[place][1] += dot(&sines[..len], &fields[place][..len]);
                }
            }
        }
    }
}

/// Returns the place of the moment of a field at a wall, times a power of the distance from it.
const fn moment(wall: usize, power: usize, field: usize) -> usize {
    (2 * wall + power) * FIELDS + field
}

/// Returns `a z + b w` for complex numbers z and w.
fn mix(a: f64, z: Complex, b: f64, w: Complex) -> Complex {
    [a * z[0] + b * w[0], a * z[1] + b * w[1]]
}

/// Returns `i z` times a number.
fn turned(factor: f64, z: Complex) -> Complex {
    [-factor * z[1], factor * z[0]]
}

/// Returns the free flow of forces on the upper or lower wall: longitudinal, along z, transverse.
fn flow_of_forces(k: f64, [c, s]: [f64; 2], moments: &[Complex; MOMENTS], wall: usize) -> [Complex; 3] {
    let sign = [1.0, -1.0][wall];
    let get = |power: usize, field: usize| moments[moment(wall, power, field)];
    let along = |power: usize| mix(c, get(power, 0), s, get(power, 1));
    let (l, l1, z, z1) = (along(0), along(1), get(0, 2), get(1, 2));
    let across = mix(-s, get(0, 0), c, get(0, 1));
    [
        mix(1.0, mix(2.0 * PI / k, l, -2.0 * PI, l1), -2.0 * PI * sign, turned(1.0, z1)),
        mix(-2.0 * PI * sign, turned(1.0, l1), 1.0, mix(2.0 * PI / k, z, 2.0 * PI, z1)),
        mix(4.0 * PI / k, across, 0.0, across),
    ]
}

/// Returns the free flow of a double layer on the upper or lower wall. With `S = n u + u n` and its trace tr,
///
/// ```text
/// u_L = 2 pi e^(-k a) [-i (1 - k a)(S_LL - S_zz) + 2 s (1 - k a) S_Lz - i tr]
/// u_z = 2 pi e^(-k a) [-s k a (S_LL - S_zz) - 2 i k a S_Lz + s tr]
/// u_T = 4 pi e^(-k a) [-i S_TL + s S_Tz],     s = 1 at the upper wall and -1 at the lower one
/// ```
fn flow_of_doubles(k: f64, [c, s]: [f64; 2], moments: &[Complex; MOMENTS], wall: usize) -> [Complex; 3] {
    let sign = [1.0, -1.0][wall];
    let get = |power: usize, field: usize| moments[moment(wall, power, field)];
    let sum = |terms: [(f64, Complex); 3]| {
        terms.iter().fold([0.0; 2], |[re, im], (factor, z)| [re + factor * z[0], im + factor * z[1]])
    };
    let [xx, xy, xz, yy, yz, zz] = [0, 1, 2, 3, 4, 5];
    let difference = |power: usize| {
        let longitudinal = sum([(c * c, get(power, xx)), (2.0 * c * s, get(power, xy)), (s * s, get(power, yy))]);
        mix(1.0, longitudinal, -1.0, get(power, zz))
    };
    let oblique = |power: usize| mix(c, get(power, xz), s, get(power, yz));
    let trace = sum([(1.0, get(0, xx)), (1.0, get(0, yy)), (1.0, get(0, zz))]);
    let across = sum([(-c * s, get(0, xx)), (c * c - s * s, get(0, xy)), (c * s, get(0, yy))]);
    let across_z = mix(-s, get(0, xz), c, get(0, yz));
    let (d, d1) = (mix(1.0, difference(0), -k, difference(1)), difference(1));
    let (o, o1) = (mix(1.0, oblique(0), -k, oblique(1)), oblique(1));
    let pi = 2.0 * PI;
    [
        sum([(-pi, turned(1.0, d)), (2.0 * sign * pi, o), (-pi, turned(1.0, trace))]),
        sum([(-sign * k * pi, d1), (-2.0 * k * pi, turned(1.0, o1)), (sign * pi, trace)]),
        mix(-2.0 * pi, turned(1.0, across), 2.0 * sign * pi, across_z),
    ]
}

/// The functions of z of one ring, times exp(-k): four for w, their derivatives over k, and two for the transverse
/// flow.
#[derive(Debug, Clone, Copy)]
struct Functions {
    normal: [f64; 4],
    slope: [f64; 4],
}

impl Functions {
    #[inline(always)]
    fn new(k: f64, z: f64) -> Self {
        let x = k * z;
        let (up, down) = ((k * (z - 1.0)).exp(), (-k * (z + 1.0)).exp());
        let ch = 0.5 * (up + down);
        // sinh(x)/x and (x cosh(x) - sinh(x))/x^3, by their series for small x.
        let (sh, bend) = if x.abs() < 1.0 {
            let (square, mut term, mut sh, mut bend) = (x * x, 1.0, 1.0, 0.0);
            for n in 1..10 {
                let m = f64::from(2 * n);
                bend += term * m / (m * (m + 1.0));
                term *= square / (m * (m + 1.0));
                sh += term;
            }
            let decay = (-k).exp();
            (decay * sh, decay * bend)
        } else {
            let sh = 0.5 * (up - down) / x;
            (sh, (ch - sh) / (x * x))
        };
        Self {
            normal: [ch, z * z * sh, z * sh, z * z * z * bend],
            slope: [x * sh, z * (sh + ch) / k, ch / k, z * z * sh / k],
        }
    }
}

/// The equations for the walls' flow of one ring.
#[derive(Debug, Clone, Copy)]
struct Walls {
    k: f64,
    /// The functions at the upper wall.
    here: [f64; 4],
    determinants: [f64; 2],
}

impl Walls {
    fn new(k: f64) -> Self {
        let here = Functions::new(k, 1.0).normal;
        let [ch, _, sh, bend] = here;
        // With w = a f + b g, the determinants f g' - g f' at the wall.
        let decay = (-2.0 * k).exp();
        let even = ch * sh + decay;
        let odd = if k < 1.0 { sh * sh - bend * ch } else { (ch * sh - decay) / (k * k) };
        Self { k, here, determinants: [even, odd] }
    }

    /// Returns the coefficients of the flow that cancels the flow on the upper and lower wall, times a weight.
    fn cancel(&self, flows: [[Complex; 3]; 2], weight: f64) -> [Complex; 6] {
        let k = self.k;
        let [upper, lower] = flows;
        let half = |sign: f64, i: usize| mix(-0.5 * weight, upper[i], -0.5 * weight * sign, lower[i]);
        // w' = -i k u_L, which is even if w is odd.
        let slope = |sign: f64| turned(-k, half(sign, 0));
        let [ch, _, sh, bend] = self.here;
        let [even, odd] = self.determinants;
        // Even: f = cosh kz, g = z sinh(kz)/k, f' = k^2 sh, g' = sh + ch.
        let (w, s) = (half(1.0, 1), slope(-1.0));
        let a = mix((sh + ch) / even, w, -sh / even, s);
        let b = mix(ch / even, s, -k * k * sh / even, w);
        // Odd: f = sinh(kz)/k, f' = cosh kz, g' = z sinh(kz)/k.
        let (w, s) = (half(-1.0, 1), slope(1.0));
        let c = mix(sh / odd, w, -bend / odd, s);
        let d = mix(sh / odd, s, -ch / odd, w);
        let (t, u) = (half(1.0, 2), half(-1.0, 2));
        [a, b, c, d, mix(1.0 / ch, t, 0.0, t), mix(1.0 / sh, u, 0.0, u)]
    }
}

impl Block {
    /// Divides targets into blocks, and returns their number. Memory only grows.
    pub(super) fn distribute(blocks: &mut Vec<Self>, targets: &[Targets<'_>]) -> usize {
        let mut count = 0;
        for (group, target) in targets.iter().enumerate() {
            for first in (0..target.places[0].len()).step_by(TARGETS) {
                if blocks.len() == count {
                    blocks.push(Self::default());
                }
                (blocks[count].group, blocks[count].first) = (group, first);
                count += 1;
            }
        }
        count
    }

    /// Computes the walls' flow at the targets of this block.
    pub(super) fn scatter(&mut self, rule: &Rule, extent: &Extent, shares: &[Share], targets: Components<'_>) {
        self.sums.clear();
        self.sums.resize(3, [0.0; TARGETS]);
        for share in shares {
            let mut start = 0;
            for &ring in &share.rings {
                let ring = &rule.rings[ring];
                let coefficients = &share.coefficients[start..start + ring.angles];
                start += ring.angles;
                widely(
                    #[inline(always)]
                    || self.add_ring(ring, extent, coefficients, targets),
                );
            }
        }
    }

    #[inline(always)]
    fn add_ring(&mut self, ring: &Ring, extent: &Extent, coefficients: &[[Complex; 6]], targets: Components<'_>) {
        let len = TARGETS.min(targets[0].len() - self.first);
        let (mut x, mut y, mut heights) = ([0.0; TARGETS], [0.0; TARGETS], [0.0; TARGETS]);
        for j in 0..len {
            let [px, py, z] = extent.local(&targets, self.first + j);
            (x[j], y[j], heights[j]) = (ring.k * px, ring.k * py, z);
        }
        let mut sums = [[0.0; TARGETS]; SUMS];
        let (mut phases, mut cosines, mut sines) = ([0.0; TARGETS], [0.0; TARGETS], [0.0; TARGETS]);
        for (angle, coefficients) in coefficients.iter().enumerate() {
            let [c, s] = direction(ring, angle);
            for j in 0..TARGETS {
                phases[j] = c * x[j] + s * y[j];
            }
            cos_sin(&phases, &mut cosines, &mut sines);
            let mut put = |place: usize, [re, im]: Complex| {
                for j in 0..TARGETS {
                    sums[place][j] += re * cosines[j] - im * sines[j];
                }
            };
            for (f, &z) in coefficients[..4].iter().enumerate() {
                put(f, z);
                put(4 + f, turned(c, z));
                put(8 + f, turned(s, z));
            }
            for (f, &z) in coefficients[4..].iter().enumerate() {
                put(12 + f, mix(-s, z, 0.0, z));
                put(14 + f, mix(c, z, 0.0, z));
            }
        }
        for (j, &z) in heights[..len].iter().enumerate() {
            let Functions { normal, slope } = Functions::new(ring.k, z);
            let across = [normal[0], normal[2]];
            let total = |first: usize, functions: &[f64]| {
                functions.iter().enumerate().map(|(f, function)| function * sums[first + f][j]).sum::<f64>()
            };
            self.sums[0][j] += total(4, &slope) + total(12, &across);
            self.sums[1][j] += total(8, &slope) + total(14, &across);
            self.sums[2][j] += total(0, &normal);
        }
    }
}
